// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/geometry/object_checks.hpp"

#include <fmt/format.h>

#include "eigengrasp/geometry/mesh_io.hpp"

namespace eigengrasp {

namespace {

constexpr double kSmallest = 0.01, kLargest = 0.60;  // [m] of the things that hands grasp

std::string length_text(double metres) {
  if (metres >= 1.0) return fmt::format("{:.3g} m", metres);
  if (metres >= 0.01) return fmt::format("{:.3g} cm", 100.0 * metres);
  return fmt::format("{:.3g} mm", 1000.0 * metres);
}

bool usual(double metres) {
  return metres >= kSmallest && metres <= kLargest;
}

std::string too_large(double size) {
  std::vector<std::string> guesses;
  for (const char* unit : {"mm", "cm", "in"})
    if (const double mended = size * unit_length(unit); usual(mended))
      guesses.push_back(fmt::format("--units {} ({})", unit, length_text(mended)));
  if (guesses.empty())
    return fmt::format("the object is {} wide, much more than the hand; check its units and scale",
                       length_text(size));
  return fmt::format("the object is {} wide; did you mean {}?", length_text(size),
                     fmt::join(guesses, " or "));
}

std::string too_small(double size) {
  std::vector<std::string> guesses;
  for (const char* unit : {"mm", "cm", "in"})
    if (const double mended = size / unit_length(unit); usual(mended))
      guesses.push_back(fmt::format("--units m instead of {} ({})", unit, length_text(mended)));
  if (guesses.empty())
    return fmt::format("the object is {} wide, much less than the hand; check its units and scale",
                       length_text(size));
  return fmt::format("the object is {} wide; did you mean {}?", length_text(size),
                     fmt::join(guesses, " or "));
}

}  // namespace

std::vector<std::string> size_warnings(const MeshReport& report, double hand_size) {
  std::vector<std::string> warnings;
  const double size = report.box.empty() ? 0.0 : report.box.size().maxCoeff();
  if (size > 5.0 * hand_size) warnings.push_back(too_large(size));
  if (size < hand_size / 20.0) warnings.push_back(too_small(size));
  if (!report.watertight) {
    warnings.push_back(fmt::format(
        "the mesh is not watertight ({} open edges, {} edges of more than two triangles{}), so the centre of "
        "mass is that of its surface",
        report.boundary_edges, report.non_manifold_edges,
        report.consistent_orientation ? "" : ", some triangles turned over"));
  } else if (!report.solid()) {
    warnings.push_back(fmt::format(
        "the mesh is {}, so the centre of mass is that of its surface",
        report.volume < 0.0 ? "inside out (its triangles run clockwise)" : "flat (it encloses no volume)"));
  }
  return warnings;
}

}  // namespace eigengrasp
