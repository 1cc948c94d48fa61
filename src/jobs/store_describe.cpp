// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/store_describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/jobs/stored_shapes.hpp"
#include "eigengrasp/jobs/stored_views.hpp"
#include "eigengrasp/shape/shape_alignment.hpp"

namespace eigengrasp {

std::vector<std::string> DescribeOptions::validate() const {
  std::vector<std::string> violations;
  if (neighbors < 0 || neighbors > 1000)
    violations.push_back(fmt::format("neighbors is {}, expected 0 to 1000", neighbors));
  if (threads < 0 || threads > 4096)
    violations.push_back(fmt::format("threads is {}, expected 0 (all) to 4096", threads));
  return violations;
}

namespace {

constexpr std::size_t kBatch = 32;  ///< objects that are stored together

using Pairs = std::map<std::string, std::vector<std::string>>;  ///< neighbours by object

class Description {
 public:
  Description(GraspStore& store, const DescribeOptions& options) : store_(store), options_(options) {
    for (StoredModel& model : store.models()) models_.emplace(model.name, order_.emplace_back(model));
  }

  DescribeReport run() {
    describe();
    if (!stopped() && options_.views) describe_all_views();
    if (!stopped() && options_.neighbors > 0) {
      const Pairs pairs = find_neighbors();
      if (options_.align) align(pairs);
    }
    report_.stopped = stopped();
    return std::move(report_);
  }

 private:
  void describe();
  void describe_all_views();
  Pairs find_neighbors();
  void align(const Pairs& pairs);
  std::vector<StoredAlignment> align_to(const std::string& object,
                                        const std::vector<std::string>& neighbors) const;

  std::set<std::string> described(const std::string& function) const {
    const std::vector<std::string> names = store_.described(function);
    return {names.begin(), names.end()};
  }
  bool stopped() const { return options_.stop != nullptr && options_.stop->stop_requested(); }

  /// Works on items in batches, all threads on one; what comes of a batch is stored in order.
  template <typename Result, typename Item, typename Work, typename Store>
  void in_batches(const std::vector<Item>& items, const std::string& what, Work work, Store store);

  GraspStore& store_;
  const DescribeOptions& options_;
  std::vector<StoredModel> order_;
  std::map<std::string, StoredModel> models_;
  DescribeReport report_;
};

template <typename Result, typename Item, typename Work, typename Store>
void Description::in_batches(const std::vector<Item>& items, const std::string& what, Work work,
                             Store store) {
  for (std::size_t begin = 0; begin < items.size() && !stopped(); begin += kBatch) {
    const std::size_t n = std::min(kBatch, items.size() - begin);
    std::vector<std::optional<Result>> results(n);
    std::vector<std::string> sentences(n);
    parallel_for(n, options_.threads, [&](std::size_t i, int) {
      if (stopped()) return;
      try {
        results[i] = work(items[begin + i]);
      } catch (const Error& e) {
        sentences[i] = e.what();
      }
    });
    std::vector<Result> done;
    for (std::size_t i = 0; i < n; ++i) {
      if (results[i]) done.push_back(std::move(*results[i]));
      if (!sentences[i].empty()) report_.bad.push_back(sentences[i]);
    }
    store(std::move(done));
    if (options_.progress)
      options_.progress(static_cast<double>(begin + n) / static_cast<double>(items.size()),
                        fmt::format("{}: {} of {}", what, begin + n, items.size()));
  }
}

void Description::describe() {
  const std::set<std::string> there = described(to_string(ShapeFunction::surface));
  std::vector<StoredModel> missing = order_;
  std::erase_if(missing, [&](const StoredModel& model) { return there.contains(model.name); });
  report_.there = order_.size() - missing.size();
  in_batches<StoredDescriptor>(
      missing, "descriptors",
      [](const StoredModel& model) {
        return descriptor_record(model.name, describe_object(load_stored_mesh(model)));
      },
      [this](const std::vector<StoredDescriptor>& done) {
        store_.set_descriptors(done);
        report_.described += done.size();
      });
}

void Description::describe_all_views() {
  const std::set<std::string> there = described(kViewsFunction);
  const std::set<std::string> sound = described(to_string(ShapeFunction::surface));
  std::vector<StoredModel> missing = order_;
  std::erase_if(missing, [&](const StoredModel& model) {
    return there.contains(model.name) || !sound.contains(model.name);
  });
  in_batches<StoredDescriptor>(
      missing, "views",
      [](const StoredModel& model) { return describe_views(model.name, load_stored_mesh(model)); },
      [this](const std::vector<StoredDescriptor>& done) {
        store_.set_descriptors(done);
        report_.viewed += done.size();
      });
}

/// Of all described objects; those that are not in the store yet are put there.
Pairs Description::find_neighbors() {
  const StoredShapes shapes(store_);
  std::set<std::pair<std::string, std::string>> known;
  for (const StoredNeighbor& n : store_.neighbors())
    if (n.distance_function == kZernikeDistance) known.emplace(n.model, n.neighbor);
  std::vector<StoredNeighbor> fresh;
  Pairs pairs;
  for (const std::string& name : shapes.names())
    for (const auto& [neighbor, distance] :
         shapes.find_nearest(shapes.values(name), static_cast<std::size_t>(options_.neighbors), {name})) {
      pairs[name].push_back(neighbor);
      if (!known.contains({name, neighbor})) fresh.push_back({name, neighbor, kZernikeDistance, distance});
    }
  store_.set_neighbors(fresh);
  report_.neighbors = fresh.size();
  return pairs;
}

std::vector<StoredAlignment> Description::align_to(const std::string& object,
                                                   const std::vector<std::string>& neighbors) const {
  std::vector<StoredAlignment> all;
  const AlignmentShape target = make_alignment_shape(load_stored_mesh(models_.at(object)));
  for (const std::string& neighbor : neighbors) {
    const AlignmentShape shape = make_alignment_shape(load_stored_mesh(models_.at(neighbor)));
    for (const Alignment& a : {align_by_pca(shape, target), align_by_icp(shape, target)})
      all.push_back({neighbor, object, a.method, a.matrix(a.scale)});
  }
  return all;
}

void Description::align(const Pairs& pairs) {
  std::set<std::pair<std::string, std::string>> known;
  for (const StoredAlignment& a : store_.alignments())
    if (a.method == kIcpAlignment) known.emplace(a.model, a.target);
  std::vector<std::pair<std::string, std::vector<std::string>>> missing;
  for (const StoredModel& model : order_) {
    const auto of_object = pairs.find(model.name);
    if (of_object == pairs.end()) continue;
    std::vector<std::string> neighbors = of_object->second;
    std::erase_if(neighbors, [&](const std::string& n) { return known.contains({n, model.name}); });
    if (!neighbors.empty()) missing.emplace_back(model.name, std::move(neighbors));
  }
  in_batches<std::vector<StoredAlignment>>(
      missing, "alignments", [this](const auto& item) { return align_to(item.first, item.second); },
      [this](const std::vector<std::vector<StoredAlignment>>& done) {
        std::vector<StoredAlignment> all;
        for (const auto& some : done) all.insert(all.end(), some.begin(), some.end());
        store_.set_alignments(all);
        report_.alignments += all.size();
      });
}

}  // namespace

DescribeReport describe_store(GraspStore& store, const DescribeOptions& options) {
  if (const auto violations = options.validate(); !violations.empty()) throw Error(violations.front());
  return Description(store, options).run();
}

}  // namespace eigengrasp
