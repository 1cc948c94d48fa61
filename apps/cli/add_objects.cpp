// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "cli/add_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "cli/db_parts.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_options.hpp"
#include "eigengrasp/core/content_hash.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/files.hpp"
#include "eigengrasp/database/graspable_size.hpp"
#include "eigengrasp/geometry/mass_properties.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/model_io/model_library.hpp"
#include "eigengrasp/model_io/psb_io.hpp"
#include "eigengrasp/render/pictures.hpp"

namespace eigengrasp::cli {

namespace {

namespace fs = std::filesystem;

struct Candidate {
  std::string name;
  fs::path mesh;
  std::vector<std::string> tags = {};
  bool of_library = false;
};

void require_sound(const AddObjectsChoice& choice) {
  if (choice.library && (!choice.folder.empty() || choice.psb || !choice.units.empty()))
    fail("--library stands beside a folder, --psb or --units; the objects of the library need none of them");
  if (!choice.library && choice.folder.empty())
    fail("there is no folder of meshes; name one, or give --library for the shipped objects");
  if (choice.psb && !choice.units.empty())
    fail("--units is '{}' beside --psb, whose meshes have no units; leave one of them out", choice.units);
  if (!choice.units.empty()) unit_length(choice.units);
  double last = 0.0;
  for (const double scale : choice.scales) {
    if (!(scale > last) || !std::isfinite(scale))
      fail("--scales holds {} behind {}, expected ascending numbers above 0", scale, last);
    last = scale;
  }
}

/// Endings of the files that load_object reads beside meshes.
bool is_open_inventor(const fs::path& file) {
  return file.extension() == ".iv" || file.extension() == ".wrl";
}

/// The folder's meshes, named after their files; those of equal names after their paths in the folder.
std::vector<Candidate> folder_candidates(const fs::path& folder) {
  std::error_code ec;
  if (!fs::is_directory(folder, ec)) fail("{}: is no folder", folder.string());
  std::vector<Candidate> found;
  std::map<std::string, int> uses;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && (is_mesh_file(entry.path()) || is_open_inventor(entry.path()))) {
      found.push_back({entry.path().stem().string(), entry.path()});
      ++uses[found.back().name];
    }
  for (Candidate& c : found)
    if (uses[c.name] > 1) {
      c.name = fs::relative(c.mesh, folder).string();
      std::replace(c.name.begin(), c.name.end(), '/', '_');
    }
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.name < b.name; });
  if (found.empty())
    fail("{}: holds no mesh, expected OBJ, STL, PLY, OFF, GLB, IV or WRL files", folder.string());
  return found;
}

std::vector<Candidate> psb_candidates(const fs::path& folder, AddObjectsReport& report) {
  const PsbLibrary psb = load_psb(folder);
  for (const int number : psb.absent) report.absent.push_back(fmt::format("m{}", number));
  std::vector<Candidate> found;
  for (const PsbModel& m : psb.models) found.push_back({fmt::format("psb_{}", m.number), m.mesh, m.tags});
  return found;
}

std::vector<Candidate> library_candidates() {
  std::vector<Candidate> found;
  for (const NamedModel& object : list_objects()) {
    found.push_back({object.name, object.path});
    found.back().of_library = true;
  }
  return found;
}

std::vector<Candidate> find_candidates(const AddObjectsChoice& choice, AddObjectsReport& report) {
  if (choice.library) return library_candidates();
  return choice.psb ? psb_candidates(choice.folder, report) : folder_candidates(choice.folder);
}

/// Draws an object from above and aside. @returns the picture's path
std::string draw_thumbnail(const ObjectModel& object, const std::string& name, const fs::path& folder) {
  RenderScene scene;
  scene.add(object.mesh, Pose::Identity(), Palette().object);
  const Vec3 view = Vec3(-1.0, 0.6, -0.7).normalized();
  const Camera camera = frame_camera(bounding_box(object.mesh), view, Vec3::UnitZ(), kDefaultFov, 1.0, 0.05);
  const fs::path file = fs::absolute(folder / (name + ".png")).lexically_normal();
  save_png(render(scene, camera, {.width = 160, .height = 160, .threads = 1}), file);
  return file.string();
}

/// A mesh without units always gets a graspable size, another one where it has none. Millimetres are as good
/// as any for the former, and let huge numbers pass.
StoredModel measure(const Candidate& candidate, const AddObjectsChoice& choice) {
  const std::string by_kind = choice.psb || is_open_inventor(candidate.mesh) ? "mm" : "m";
  const std::string units = choice.units.empty() ? by_kind : choice.units;
  ObjectReadOptions options;
  options.units = units;
  const ObjectModel object = load_sound_object(candidate.mesh, options);
  const Box box = bounding_box(object.mesh);
  const bool keep = choice.keep_size || (!choice.psb && is_graspable(box));
  const double factor = keep ? 1.0 : graspable_rescale(box);
  StoredModel model;
  model.name = candidate.name;
  model.geometry_path = candidate.of_library ? kLibraryPath + candidate.name
                                             : fs::absolute(candidate.mesh).lexically_normal().string();
  model.content_hash = content_hash(read_text_file(candidate.mesh));
  model.tags = candidate.tags;
  model.rescale = unit_length(units) * factor;
  model.approximate_radius = factor * approximate_radius(object.mesh, object.center_of_mass);
  model.scales = choice.scales;
  if (!choice.thumbnails.empty())
    model.thumbnail_path = draw_thumbnail(object, model.name, choice.thumbnails);
  return model;
}

}  // namespace

AddObjectsReport add_objects(const AddObjectsChoice& choice, const StopFlag& stop) {
  AddObjectsReport report;
  require_sound(choice);
  const auto candidates = find_candidates(choice, report);
  const auto store = open_to_write(choice.store);
  report.place = store->place();
  if (!choice.thumbnails.empty()) require_writable_folder(choice.thumbnails);
  ProgressBar bar;
  constexpr std::size_t at_once = 64;  // stored in order, while the next ones are read
  for (std::size_t begin = 0; begin < candidates.size() && !report.stopped; begin += at_once) {
    const std::size_t n = std::min(at_once, candidates.size() - begin);
    std::vector<std::optional<StoredModel>> models(n);
    std::vector<std::string> sentences(n);
    parallel_for(n, choice.threads, [&](std::size_t i, int) {
      if (stop.stop_requested()) return;
      try {
        models[i] = measure(candidates[begin + i], choice);
      } catch (const Error& e) {
        sentences[i] = e.what();
      }
    });
    report.stopped = stop.stop_requested();
    for (std::size_t i = 0; i < n && !report.stopped; ++i) {
      if (!models[i]) {
        report.bad.push_back(sentences[i]);
      } else {
        ++(store->add_model(*models[i]) ? report.added : report.there);
      }
    }
    bar.show(static_cast<double>(begin + n) / static_cast<double>(candidates.size()),
             candidates[begin + n - 1].name);
  }
  return report;
}

}  // namespace eigengrasp::cli
