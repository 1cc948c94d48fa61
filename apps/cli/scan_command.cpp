// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <iterator>
#include <memory>

#include "cli/commands.hpp"
#include "eigengrasp/core/error.hpp"
#include "eigengrasp/geometry/mesh_io.hpp"
#include "eigengrasp/geometry/point_cloud.hpp"
#include "eigengrasp/geometry/registered_scans.hpp"
#include "eigengrasp/modeling/mesh_tools.hpp"
#include "eigengrasp/scan/scan_surface.hpp"

namespace eigengrasp::cli {

namespace {

struct ScanChoice {
  std::vector<std::string> files;
  std::string out, units = "m", unseen, up;
  std::vector<std::string> cameras;
  ScanOptions options;
  double cell_mm = 0.0;
};

Vec3 numbers_of(const std::string& option, const std::string& text) {
  Vec3 p = Vec3::Zero();
  int used = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &p.x(), &p.y(), &p.z(), &used) != 3 ||
      used != static_cast<int>(text.size()) || !p.allFinite())
    fail("{} is \"{}\", expected three numbers such as 0,0,0.5", option, text);
  return p;
}

/// Views with their names.
RegisteredScans load_scans(const ScanChoice& choice) {
  const double unit = unit_length(choice.units);
  RegisteredScans all;
  for (const std::string& file : choice.files) {
    if (!is_registered_scans_file(file)) {
      all.views.push_back(load_point_cloud(file, unit));
      all.names.push_back(file);
      continue;
    }
    RegisteredScans scans = load_registered_scans(file, unit);
    if (!scans.missing.empty())
      fmt::print(stderr, "eigengrasp: {}: {} of its {} scans are not there and were left out: {}\n", file,
                 scans.missing.size(), scans.missing.size() + scans.views.size(),
                 fmt::join(scans.missing, ", "));
    std::move(scans.views.begin(), scans.views.end(), std::back_inserter(all.views));
    all.names.insert(all.names.end(), scans.names.begin(), scans.names.end());
  }
  return all;
}

std::vector<PointCloud> load_seen(const ScanChoice& choice) {
  RegisteredScans scans = load_scans(choice);
  const auto& cameras = choice.cameras;
  if (!cameras.empty() && cameras.size() != 1 && cameras.size() != scans.views.size())
    fail("there are {} cameras for {} views, expected one for all or one for each", cameras.size(),
         scans.views.size());
  for (std::size_t i = 0; i < scans.views.size(); ++i) {
    PointCloud& view = scans.views[i];
    if (!cameras.empty())
      view.viewpoint =
          unit_length(choice.units) * numbers_of("--camera", cameras[cameras.size() == 1 ? 0 : i]);
    if (view.dropped > 0)
      fmt::print(stderr, "eigengrasp: {}: {} points are not finite and were left out\n", scans.names[i],
                 view.dropped);
  }
  return std::move(scans.views);
}

void print_scan(const ScanSurface& s) {
  fmt::print("points     {} of the object, {:.2g} mm apart\n", s.points, 1e3 * s.spacing);
  for (std::size_t i = 0; i < s.viewpoints.size(); ++i)
    fmt::print("view {}     from {:.3f} {:.3f} {:.3f} m{}\n", i + 1, s.viewpoints[i].x(), s.viewpoints[i].y(),
               s.viewpoints[i].z(), s.viewpoint_guessed[i] ? " (estimated; --camera says it)" : "");
  if (s.table)
    fmt::print("table      up is {:.3f} {:.3f} {:.3f}; removed\n", s.table->normal.x(), s.table->normal.y(),
               s.table->normal.z());
  if (s.mirror) {
    fmt::print(
        "unseen     mirrored about the plane of normal {:.3f} {:.3f} {:.3f}; {:.0f} % of the mirrored "
        "points where nothing is, {:.0f} % on what is seen\n",
        s.mirror->normal.x(), s.mirror->normal.y(), s.mirror->normal.z(), 100.0 * s.mirror->conflicts,
        100.0 * s.mirror->support);
  } else {
    fmt::print("unseen     {}{}\n", s.unseen == UnseenSpace::free ? "free" : "unknown: counts as the object",
               s.unseen == UnseenSpace::mirrored ? " (no mirror plane agrees with what is seen)" : "");
  }
  const Vec3 size = 1e3 * bounding_box(s.mesh).size();
  fmt::print("surface    {} triangles, {:.0f} x {:.0f} x {:.0f} mm, {:.0f} % of it seen\n",
             s.mesh.triangles.size(), size.x(), size.y(), size.z(), 100.0 * s.seen_share);
}

void run_scan(ScanChoice& choice) {
  if (!choice.unseen.empty()) choice.options.unseen = parse_unseen_space(choice.unseen);
  if (!choice.up.empty()) choice.options.up = numbers_of("--up", choice.up);
  if (choice.options.up && choice.options.up->isZero())
    fail("--up is 0,0,0, expected a direction such as 0,0,1");
  choice.options.cell = 1e-3 * choice.cell_mm;
  const ScanSurface surface = make_scan_surface(load_seen(choice), choice.options);
  print_scan(surface);
  modeling::save_obj(surface.mesh, choice.out, 6, fmt::format("unseen space: {}", to_string(surface.unseen)));
  fmt::print("written    {}\n", choice.out);
}

}  // namespace

void add_scan_command(CLI::App& app) {
  auto choice = std::make_shared<ScanChoice>();
  CLI::App* scan = app.add_subcommand("scan", "Make a closed surface of clouds of points, to grasp it");
  scan->add_option(
          "views", choice->files,
          "Clouds of one object in one frame, a file for each view: PLY, PCD, OBJ; or a list of range "
          "scans with their poses: .conf (Stanford)")
      ->required();
  scan->add_option("-o,--out", choice->out, "OBJ file to write, in the frame of the clouds, in metres")
      ->required();
  scan->add_option("--units", choice->units, "Of the clouds: m (default), cm, mm, in");
  scan->add_option(
      "--camera", choice->cameras,
      "Where the sensor stood, x,y,z in the clouds' frame and units; once, or once for each view "
      "(default: PCD's VIEWPOINT, else estimated)");
  scan->add_option(
      "--unseen", choice->unseen,
      "Space behind what is seen: mirrored (default for one view), unknown (default for several: "
      "counts as the object), free");
  scan->add_option("--up", choice->up,
                   "Against gravity, x,y,z, if known: things that stand are mirror images about "
                   "upright or level planes");
  scan->add_flag("--remove-table", choice->options.remove_table, "Find the table's plane and drop it");
  scan->add_option("--cell", choice->cell_mm, "Finest detail of the surface [mm] (default: of the cloud)");
  scan->add_option("--triangles", choice->options.triangles, "About as many at most")
      ->check(CLI::Range(100, 1000000));
  scan->add_option("--threads", choice->options.threads, "Default: all");
  scan->footer(
      "plan, transfer and serve take a cloud of one view, or a .conf, as an object directly, with the "
      "defaults of this command.\nExamples:\n  eigengrasp scan mug.ply -o mug.obj --camera 0,0,0\n"
      "  eigengrasp scan left.pcd right.pcd -o part.obj --units mm --remove-table\n"
      "  eigengrasp scan bunny/bun.conf -o bunny.obj\n"
      "Exit code: 0, 2 bad input.");
  scan->callback([choice] { run_scan(*choice); });
}

}  // namespace eigengrasp::cli
