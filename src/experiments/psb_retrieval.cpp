// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/psb_retrieval.hpp"

#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "eigengrasp/core/core_watch.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/experiments/statistics.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/model_io/psb_io.hpp"
#include "eigengrasp/shape/shape_descriptor.hpp"

namespace eigengrasp {

namespace {

/// What is made of one model.
struct Described {
  std::optional<ShapeDescriptor> surface, solid;
  double surface_seconds = 0.0, solid_seconds = 0.0;
};

std::optional<ShapeDescriptor> describe(const TriangleMesh& mesh, ShapeFunction function, double& seconds) {
  const CoreWatch watch;
  std::optional<ShapeDescriptor> descriptor;
  try {
    DescriptorOptions options;
    options.function = function;
    options.allow_flat = true;
    descriptor = compute_shape_descriptor(mesh, options);
  } catch (const Error&) {  // counted as failed
  }
  seconds = watch.seconds();
  return descriptor;
}

std::vector<Described> describe_all(const std::vector<PsbModel>& models, const PsbRetrievalOptions& options) {
  std::vector<Described> all(models.size());
  std::atomic<std::size_t> done{0};
  std::mutex mutex;
  parallel_for(models.size(), options.threads, [&](std::size_t i, int) {
    if (options.stop && options.stop->stop_requested()) return;
    constexpr double any_unit = 1e-6;  // a few models are very large, and size does not matter
    const TriangleMesh mesh = load_mesh(models[i].mesh, {.scale = any_unit});
    all[i].surface = describe(mesh, ShapeFunction::surface, all[i].surface_seconds);
    if (options.solid) all[i].solid = describe(mesh, ShapeFunction::solid, all[i].solid_seconds);
    const double share = static_cast<double>(++done) / static_cast<double>(models.size());
    const std::lock_guard lock(mutex);
    if (options.progress) options.progress(share, models[i].mesh.stem().string());
  });
  return all;
}

/// The invariants as they are, made a vector of length 1.
std::vector<float> plain_values(const ShapeDescriptor& d) {
  double sum = 0.0;
  for (const double x : d.invariants) sum += x * x;
  std::vector<float> values;
  for (const double x : d.invariants) values.push_back(static_cast<float>(x / std::sqrt(sum)));
  return values;
}

class RowMaker {
 public:
  RowMaker(const std::vector<PsbModel>& models, const std::vector<Described>& described)
      : models_(models), described_(described) {}

  RetrievalRow make(const std::string& name, bool test, ShapeFunction function, bool weighted) const {
    RetrievalRow row;
    row.name = name;
    row.test = test;
    NearestShapes shapes(kDescriptorSize);
    std::vector<int> classes;
    std::vector<double> seconds;
    std::map<std::vector<std::string>, int> numbers;
    for (std::size_t i = 0; i < models_.size(); ++i) {
      if (models_[i].test != test) continue;
      const bool solid = function == ShapeFunction::solid;
      const auto& d = solid ? described_[i].solid : described_[i].surface;
      seconds.push_back(solid ? described_[i].solid_seconds : described_[i].surface_seconds);
      classes.push_back(numbers.try_emplace(models_[i].tags, static_cast<int>(numbers.size())).first->second);
      if (!d) {
        ++row.failed;
        shapes.add(std::vector<float>(kDescriptorSize, -1.0F));  // far from all others
        continue;
      }
      ++(d->route == DescriptorRoute::moments ? row.moments : row.voxels);
      shapes.add(weighted ? d->values : plain_values(*d));
    }
    row.seconds = median(seconds);
    row.measures = measure_retrieval(shapes, classes);
    return row;
  }

 private:
  const std::vector<PsbModel>& models_;
  const std::vector<Described>& described_;
};

}  // namespace

PsbRetrieval run_psb_retrieval(const PsbRetrievalOptions& options) {
  PsbLibrary library = load_psb(options.psb);
  std::erase_if(library.models, [](const PsbModel& m) { return m.tags.empty(); });
  if (library.models.empty()) fail("{}: has no classified model with a mesh", options.psb.string());
  PsbRetrieval result;
  result.absent = library.absent;
  const std::vector<Described> described = describe_all(library.models, options);
  result.stopped_early = options.stop && options.stop->stop_requested();
  if (result.stopped_early) return result;
  const RowMaker rows(library.models, described);
  for (const bool test : {true, false}) {
    result.rows.push_back(rows.make("surface, weighted (default)", test, ShapeFunction::surface, true));
    result.rows.push_back(rows.make("surface, invariants as they are", test, ShapeFunction::surface, false));
    if (!options.solid) continue;
    result.rows.push_back(rows.make("solid, weighted", test, ShapeFunction::solid, true));
    result.rows.push_back(rows.make("solid, invariants as they are", test, ShapeFunction::solid, false));
  }
  NearestShapes shapes(kDescriptorSize);
  for (const Described& d : described)
    if (d.surface) shapes.add(d.surface->values);
  result.search = measure_search(shapes, options.index_size, options.threads);
  return result;
}

}  // namespace eigengrasp
