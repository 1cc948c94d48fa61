// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/shape/shape_index.hpp"

#define NO_MANUAL_VECTORIZATION  // the distance is ours
#include <hnswlib/hnswlib.h>

#include <cmath>
#include <stdexcept>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/parallel.hpp"
#include "shape/descriptor_row.hpp"
#include "shape/file_sum.hpp"

namespace eigengrasp {

namespace {

/// What hnswlib is told of descriptors.
class DescriptorSpace final : public hnswlib::SpaceInterface<float> {
 public:
  explicit DescriptorSpace(std::size_t dimension) : stride_(row_stride(dimension)) {}
  std::size_t get_data_size() override { return stride_ * sizeof(float); }
  hnswlib::DISTFUNC<float> get_dist_func() override { return distance; }
  void* get_dist_func_param() override { return &stride_; }

 private:
  static float distance(const void* a, const void* b, const void* stride) {
    return squared_distance(static_cast<const float*>(a), static_cast<const float*>(b),
                            *static_cast<const std::size_t*>(stride));
  }
  std::size_t stride_;
};

}  // namespace

std::vector<std::string> ShapeIndexOptions::validate() const {
  std::vector<std::string> violations;
  if (links < 2 || links > 100) violations.push_back(fmt::format("links is {}, expected 2 to 100", links));
  if (build_width < links || build_width > 10000)
    violations.push_back(fmt::format("build_width is {}, expected {} (links) to 10000", build_width, links));
  return violations;
}

class ShapeIndex::Graph {
 public:
  using Hnsw = hnswlib::HierarchicalNSW<float>;

  Graph(const NearestShapes& shapes, const ShapeIndexOptions& options)
      : dimension(shapes.dimension()),
        space(dimension),
        hnsw(&space, shapes.size(), static_cast<std::size_t>(options.links),
             static_cast<std::size_t>(options.build_width), options.seed) {
    const auto add = [&](std::size_t i) {
      hnsw.addPoint(checked_row(shapes.descriptor(i), dimension).data(), i);
    };
    add(0);  // where every search begins
    parallel_for(shapes.size() - 1, options.threads, [&](std::size_t i, int) { add(i + 1); });
  }
  Graph(const std::string& file, std::size_t n) : dimension(n), space(n), hnsw(&space, file) {}

  std::size_t dimension;
  DescriptorSpace space;
  Hnsw hnsw;
};

ShapeIndex::ShapeIndex(std::unique_ptr<Graph> graph) : graph_(std::move(graph)) {
  graph_->hnsw.setEf(1);  // the width comes with each search
}

ShapeIndex::ShapeIndex(const NearestShapes& shapes, const ShapeIndexOptions& options) {
  if (const auto violations = options.validate(); !violations.empty()) fail("{}", violations.front());
  if (shapes.size() == 0) fail("there is no shape to make an index of, expected at least one");
  graph_ = std::make_unique<Graph>(shapes, options);
  graph_->hnsw.setEf(1);
}

ShapeIndex::ShapeIndex(ShapeIndex&&) noexcept = default;
ShapeIndex& ShapeIndex::operator=(ShapeIndex&&) noexcept = default;
ShapeIndex::~ShapeIndex() = default;

ShapeIndex ShapeIndex::load(const std::filesystem::path& file) {
  const std::size_t dimension = check_file_sum(file);
  try {
    return ShapeIndex(std::make_unique<Graph>(file.string(), dimension));
  } catch (const std::runtime_error& e) {
    fail("{}: is no shape index ({}); make the index again", file.string(), e.what());
  }
}

std::size_t ShapeIndex::size() const {
  return graph_->hnsw.cur_element_count;
}

std::size_t ShapeIndex::dimension() const {
  return graph_->dimension;
}

void ShapeIndex::save(const std::filesystem::path& file) const {
  const std::filesystem::path partial = file.string() + ".partial";
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);  // where it fails, writing does
  graph_->hnsw.saveIndex(partial.string());
  if (!std::filesystem::exists(partial, error)) fail("{}: cannot be written", file.string());
  std::filesystem::rename(partial, file, error);
  if (error) fail("{}: cannot be written ({})", file.string(), error.message());
  write_file_sum(file, graph_->dimension);
}

std::vector<NearShape> ShapeIndex::find_nearest(const std::vector<float>& descriptor, std::size_t count,
                                                std::size_t width) const {
  const std::vector<float> query = checked_row(descriptor, graph_->dimension);
  auto found = graph_->hnsw.searchKnn(query.data(), std::max(count, width));  // the farthest on top
  while (found.size() > count) found.pop();
  std::vector<NearShape> nearest(found.size());
  for (; !found.empty(); found.pop())
    nearest[found.size() - 1] = {found.top().second, std::sqrt(static_cast<double>(found.top().first))};
  return nearest;
}

}  // namespace eigengrasp
