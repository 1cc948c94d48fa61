// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/partial_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numbers>

#include "eigengrasp/core/core_watch.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/geometry/registered_scans.hpp"
#include "eigengrasp/planning/pregrasp_rating.hpp"
#include "eigengrasp/render/depth_camera.hpp"
#include "eigengrasp/render/pictures.hpp"
#include "eigengrasp/shape/shape_alignment.hpp"

namespace eigengrasp {

namespace fs = std::filesystem;

namespace {

/// A view that is still to be taken, or to be planned on.
struct ViewTask {
  std::string object;
  fs::path complete;  ///< the complete object in the frame of the views; empty: there is none
  std::shared_ptr<const RegisteredScans> scans;  ///< null: a simulated camera looks at the complete object
  int view = 0;                                  ///< of the cameras or the scans; kAllViews: all scans
  bool upright = true;                           ///< z is up
  bool shown = false;                            ///< in pictures
};
constexpr int kAllViews = -1;

std::vector<fs::path> sorted_files(const fs::path& folder, bool recursive) {
  std::vector<fs::path> files;
  std::error_code ec;
  const auto take = [&](const fs::directory_entry& entry) {
    if (entry.is_regular_file() && (is_mesh_file(entry.path()) || entry.path().extension() == ".pcd" ||
                                    is_registered_scans_file(entry.path())))
      files.push_back(entry.path());
  };
  if (recursive) {
    for (const auto& entry : fs::recursive_directory_iterator(folder, ec)) take(entry);
  } else {
    for (const auto& entry : fs::directory_iterator(folder, ec)) take(entry);
  }
  if (files.empty()) fail("{}: holds no meshes or clouds of points; check the folder", folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

RegisteredScans load_clouds(const std::vector<fs::path>& files) {
  RegisteredScans scans;
  for (const fs::path& file : files) {
    scans.views.push_back(load_point_cloud(file));
    scans.names.push_back(file.stem().string());
  }
  return scans;
}

/// Of one folder: each scan of a list is a view, and all together; else each cloud. A mesh with faces beside
/// them is the complete object; where there are only meshes, they are the views.
std::vector<ViewTask> list_scans(const std::string& object, const std::vector<fs::path>& files) {
  const auto list = std::find_if(files.begin(), files.end(), is_registered_scans_file);
  const bool registered = list != files.end();
  std::vector<fs::path> clouds, meshes;
  for (const fs::path& file : files)
    if (!is_registered_scans_file(file)) (is_point_cloud_file(file) ? clouds : meshes).push_back(file);
  if (!registered && clouds.empty()) std::swap(clouds, meshes);
  ViewTask task;
  task.object = object;
  if (!meshes.empty()) task.complete = meshes.front();
  task.scans = std::make_shared<const RegisteredScans>(registered ? load_registered_scans(*list)
                                                                  : load_clouds(clouds));
  task.upright = !registered;
  std::vector<ViewTask> tasks(task.scans->views.size(), task);
  for (std::size_t i = 0; i < tasks.size(); ++i) tasks[i].view = static_cast<int>(i);
  tasks.front().shown = true;
  if (registered) {
    tasks.push_back(task);
    tasks.back().view = kAllViews;
    tasks.back().shown = true;
  }
  return tasks;
}

std::vector<ViewTask> list_views(const PartialScansOptions& options) {
  std::vector<ViewTask> tasks;
  // Pictures show one view of every real object, and of every fourth complete one.
  int objects = 0;
  if (!options.complete.empty())
    for (const fs::path& file : sorted_files(options.complete, false)) {
      const bool shown = objects++ % 4 == 2;
      for (int view = 0; view < options.views; ++view)
        tasks.push_back({file.stem().string(), file, nullptr, view, true, shown && view == 0});
    }
  if (!options.scans.empty()) {
    std::map<fs::path, std::vector<fs::path>> folders;
    for (const fs::path& file : sorted_files(options.scans, true))
      folders[file.parent_path()].push_back(file);
    for (const auto& [folder, files] : folders) {
      const std::vector<ViewTask> scans = list_scans(folder.filename().string(), files);
      tasks.insert(tasks.end(), scans.begin(), scans.end());
    }
  }
  if (tasks.empty()) fail("there is nothing to scan: name a folder of complete objects, of scans, or both");
  return tasks;
}

/// Cameras stand around the upright object, 40 degrees above the horizon.
PointCloud simulated_view(const TriangleMesh& mesh, int view, const PartialScansOptions& options) {
  const double turn = 2.0 * std::numbers::pi * (view + 0.15) / options.views;
  const double rise = 40.0 * std::numbers::pi / 180.0;
  const Vec3 to_camera(std::cos(turn) * std::cos(rise), std::sin(turn) * std::cos(rise), std::sin(rise));
  DepthCamera depth;
  const Box box = bounding_box(mesh);
  depth.columns = depth.rows = 400;
  depth.noise = options.noise;
  depth.camera.position = box.center() + options.distance * to_camera;
  depth.camera.forward = -to_camera;
  depth.camera.up = (Vec3::UnitZ() - to_camera.z() * to_camera).normalized();
  depth.camera.fov = 2.0 * std::atan(0.55 * box.diagonal() / options.distance);
  return take_depth_view(mesh, depth, options.seed + static_cast<std::uint64_t>(view));
}

/// Volume common to both over that of both, by points spread evenly over their boxes.
double agreement(const MeshBvh& a, const MeshBvh& b) {
  Box box = a.box();
  box.add(b.box());
  RandomStream random({0x766f6cULL});
  int both = 0, any = 0;
  for (int i = 0; i < 8000; ++i) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(box.min[k], box.max[k]);
    const bool in_a = a.contains(p), in_b = b.contains(p);
    both += in_a && in_b;
    any += in_a || in_b;
  }
  return any > 0 ? both / static_cast<double>(any) : 0.0;
}

class PartialTrials {
 public:
  explicit PartialTrials(const PartialScansOptions& options) : options_(options), store_(*options.store) {}

  ScanTrial run(const ViewTask& task, std::vector<ResultPicture>& pictures) const;

 private:
  using ObjectPtr = std::shared_ptr<const ObjectModel>;
  using HandPtr = std::shared_ptr<const HandModel>;

  Scene scene_of(const HandPtr& hand, const ObjectPtr& object) const {
    Scene scene;
    scene.hand = hand;
    scene.object = object;
    scene.object_material.name = object->material;
    return scene;
  }
  CollisionModel model_of(const HandPtr& hand, const ObjectPtr& object) const {
    CollisionModel::Options exact;  // few candidates: fields would take longer than they save
    exact.threads = 1;
    exact.fast = false;
    return {scene_of(hand, object), exact};
  }
  PlanOptions plan_options(ScanPlanner planner) const {
    PlanOptions plan;
    plan.threads = 1;
    plan.seed = options_.seed;
    plan.stop = options_.stop;
    plan.volumes = false;
    plan.grasps = planner == ScanPlanner::transfer ? 1000 : options_.best;
    return plan;
  }
  std::vector<Grasp> find_grasps(const Scene& scene, ScanPlanner planner) const;
  struct Complete {
    ObjectPtr object;              ///< null: there is none
    Pose X_CS = Pose::Identity();  ///< of the scan's frame in its frame
  };
  Complete lay_upon_complete(const ScanSurface& surface, ScanTrial& trial) const;
  void try_on(const Complete& complete, const HandPtr& hand, const std::vector<Grasp>& grasps,
              ScanGrasps& result) const;
  void draw(const ScanTrial& trial, const Scene& scene, const std::vector<Grasp>& grasps,
            std::vector<ResultPicture>& pictures) const;

  const PartialScansOptions& options_;
  TransferStore store_;
};

std::vector<Grasp> PartialTrials::find_grasps(const Scene& scene, ScanPlanner planner) const {
  PlanResult plan;
  if (planner == ScanPlanner::transfer) {
    TransferOptions transfer;
    transfer.candidates.neighbors = options_.neighbors;
    transfer.candidates.most = 0;
    transfer.plan = plan_options(planner);
    plan = transfer_grasps(scene, store_, transfer).plan;
  } else {
    plan = plan_grasps(scene, plan_options(planner));
  }
  std::erase_if(plan.grasps, [](const Grasp& g) { return !g.form_closure; });
  return std::move(plan.grasps);
}

/// The file of the complete object that was scanned; empty where there is none.
fs::path complete_file(const std::string& object, const PartialScansOptions& options) {
  if (options.complete.empty()) return {};
  const auto named = options.same.find(object);
  const std::string& name = named != options.same.end() ? named->second : object;
  for (const fs::path& file : sorted_files(options.complete, false))
    if (file.stem().string().find(name) != std::string::npos) return file;
  return {};
}

PartialTrials::Complete PartialTrials::lay_upon_complete(const ScanSurface& surface, ScanTrial& trial) const {
  const fs::path file = complete_file(trial.object, options_);
  if (file.empty()) return {};
  auto object = std::make_shared<const ObjectModel>(make_object(file.stem().string(), load_mesh(file)));
  AlignmentOptions options;
  options.match_scale = false;
  options.one_sided = true;
  options.seeds = 24;
  options.iterations = 40;
  const AlignmentShape target = make_alignment_shape(object->mesh);
  const Alignment best = align_by_icp(make_alignment_shape(seen_part(surface)), target, options);
  trial.misfit = best.distance * target.size;
  if (trial.misfit > kMostMisfit) return {};
  trial.complete = object->name;
  Complete complete{std::move(object), Pose::Identity()};
  complete.X_CS.matrix() = best.matrix(1.0);
  return complete;
}

void PartialTrials::try_on(const Complete& complete, const HandPtr& hand, const std::vector<Grasp>& grasps,
                           ScanGrasps& result) const {
  std::vector<GivenPreGrasp> given;
  for (std::size_t i = 0; i < grasps.size() && i < static_cast<std::size_t>(options_.best); ++i)
    given.push_back({complete.X_CS * grasps[i].X_OH_pregrasp, grasps[i].pregrasp_dofs});
  const RatedPreGrasps rated =
      rate_pregrasps(model_of(hand, complete.object), given, plan_options(ScanPlanner::transfer));
  result.tried = static_cast<int>(given.size());
  result.closed =
      static_cast<int>(std::count(rated.outcomes.begin(), rated.outcomes.end(), GivenOutcome::form_closed));
}

void PartialTrials::draw(const ScanTrial& trial, const Scene& scene, const std::vector<Grasp>& grasps,
                         std::vector<ResultPicture>& pictures) const {
  PictureOptions picture;
  picture.threads = 1;
  picture.tile = 300;
  picture.columns = 4;
  picture.heading = fmt::format("{} on {}, view {}", scene.hand->name, trial.object, trial.view);
  const std::span<const Grasp> best(grasps.data(), std::min<std::size_t>(grasps.size(), 4));
  pictures.push_back(
      {fmt::format("partial/{}-{}-{}.png", trial.object, trial.view, scene.hand->name),
       fmt::format("{}, view {}, {}: {} grasps", trial.object, trial.view, scene.hand->name, grasps.size()),
       grasps_picture(scene, best, picture)});
}

/// What the view is called on the page.
std::string name_of(const ViewTask& task) {
  if (task.view == kAllViews) return "all";
  return task.scans ? task.scans->names[static_cast<std::size_t>(task.view)]
                    : fmt::format("{}", task.view + 1);
}

/// Clouds of a real scan.
std::vector<PointCloud> clouds_of(const ViewTask& task) {
  if (task.view == kAllViews) return task.scans->views;
  return {task.scans->views[static_cast<std::size_t>(task.view)]};
}

ScanTrial PartialTrials::run(const ViewTask& task, std::vector<ResultPicture>& pictures) const {
  ScanTrial trial;
  trial.simulated = task.scans == nullptr;
  trial.object = task.object;
  trial.view = name_of(task);
  Complete complete;
  const bool same_frame = !task.complete.empty();
  if (same_frame) {
    complete.object = std::make_shared<const ObjectModel>(
        make_object(task.complete.stem().string(), load_mesh(task.complete)));
    trial.complete = complete.object->name;
  }
  const std::vector<PointCloud> clouds =
      task.scans ? clouds_of(task)
                 : std::vector<PointCloud>{simulated_view(complete.object->mesh, task.view, options_)};
  ObjectPtr seen;
  try {
    const CoreWatch watch;
    ScanOptions scan;
    scan.threads = 1;
    if (task.upright) scan.up = Vec3::UnitZ();
    const ScanSurface surface = make_scan_surface(clouds, scan);
    trial.seconds = watch.seconds();
    trial.mirrored = surface.mirror.has_value();
    trial.seen_share = surface.seen_share;
    seen = std::make_shared<const ObjectModel>(make_scanned_object(trial.object, surface));
    if (!complete.object) complete = lay_upon_complete(surface, trial);
  } catch (const Error& e) {
    trial.failure = e.what();
    return trial;
  }
  if (same_frame) trial.agreement = agreement(seen->bvh, complete.object->bvh);
  for (const HandPtr& hand : options_.hands) {
    const Scene scene = scene_of(hand, seen);
    for (const ScanPlanner planner : kScanPlanners) {
      ScanGrasps result;
      result.hand = hand->name;
      result.planner = planner;
      const CoreWatch watch;
      const std::vector<Grasp> grasps = find_grasps(scene, planner);
      result.seconds = watch.seconds();
      result.found = static_cast<int>(grasps.size());
      if (!grasps.empty()) result.best_epsilon = grasps.front().epsilon;
      if (complete.object && !grasps.empty()) try_on(complete, hand, grasps, result);
      trial.grasps.push_back(result);
      if (options_.pictures && task.shown && planner == ScanPlanner::transfer && !grasps.empty())
        draw(trial, scene, grasps, pictures);
    }
  }
  return trial;
}

}  // namespace

PartialScans run_partial_scans(const PartialScansOptions& options) {
  const std::vector<ViewTask> tasks = list_views(options);
  const PartialTrials trials(options);
  PartialScans result;
  result.trials.resize(tasks.size());
  std::vector<std::vector<ResultPicture>> pictures(tasks.size());
  std::vector<char> ended(tasks.size(), 0);
  std::atomic<int> done{0};
  std::mutex mutex;
  parallel_for(tasks.size(), options.threads, [&](std::size_t i, int) {
    if (options.stop != nullptr && options.stop->stop_requested()) return;
    result.trials[i] = trials.run(tasks[i], pictures[i]);
    ended[i] = options.stop == nullptr || !options.stop->stop_requested();
    const int count = ++done;
    const std::lock_guard lock(mutex);
    if (options.progress) options.progress(count, static_cast<int>(tasks.size()));
  });
  std::vector<ScanTrial> kept;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (ended[i] == 0) {
      result.stopped_early = true;
      continue;
    }
    kept.push_back(std::move(result.trials[i]));
    for (ResultPicture& p : pictures[i]) result.pictures.push_back(std::move(p));
  }
  result.trials = std::move(kept);
  return result;
}

}  // namespace eigengrasp
