// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "eigengrasp/quality/wrench_space.hpp"
#include "quality/expanding_polytope.hpp"
#include "quality/wrench_support.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace eigengrasp {
namespace {

constexpr int kDim = 6;

/// Whether the points leave a dimension out, up to rounding.
bool is_flat(std::span<const Vec6> points) {
  if (points.size() < kDim + 1) return true;
  Vec6 centre = Vec6::Zero();
  for (const Vec6& p : points) centre += p / static_cast<double>(points.size());
  Eigen::Matrix<double, kDim, kDim> scatter = Eigen::Matrix<double, kDim, kDim>::Zero();
  for (const Vec6& p : points) scatter += (p - centre) * (p - centre).transpose();
  const Vec6 spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kDim, kDim>>(scatter).eigenvalues();
  return spread[0] <= 1e-15 * spread[kDim - 1];
}

/// Where Qhull's messages go: it wants a FILE, and must not print.
class NullFile {
 public:
  NullFile() : file_(std::fopen("/dev/null", "w")) {
    if (file_ == nullptr) file_ = std::tmpfile();
  }
  ~NullFile() {
    if (file_ != nullptr) std::fclose(file_);
  }
  NullFile(const NullFile&) = delete;
  NullFile& operator=(const NullFile&) = delete;
  FILE* get() const { return file_; }

 private:
  FILE* file_;
};

/// One hull of Qhull; frees what it holds. Qhull ends with a code, also where the points are flat: it jumps
/// out of its own C frames only.
class QhullRun {
 public:
  explicit QhullRun(std::span<const Vec6> points) {
    if (null_.get() == nullptr || is_flat(points)) return;
    coordinates_.reserve(points.size() * kDim);
    for (const Vec6& p : points) coordinates_.insert(coordinates_.end(), p.data(), p.data() + kDim);
    qh_zero(&qhull_, null_.get());
    started_ = true;
    // QJ1e-10: joggled by rounding's worth, with a fixed seed. Merging coplanar facets instead (Qt Qx, Qt
    // C-0) fails, or silently loses a tenth of the volume and more, on sets of contacts with many coplanar
    // wrenches. Pp: no warnings. FA: volume; only inside of this call may Qhull meet an error without ending
    // the process.
    char command[] = "qhull QJ1e-10 Pp FA";
    ok_ = qh_new_qhull(&qhull_, kDim, static_cast<int>(points.size()), coordinates_.data(), False, command,
                       nullptr, null_.get()) == 0;
  }
  ~QhullRun() {
    if (!started_) return;
    qhull_.NOerrexit = True;
    qh_freeqhull(&qhull_, !qh_ALL);
    int n_blocks = 0;
    int n_bytes = 0;
    qh_memfreeshort(&qhull_, &n_blocks, &n_bytes);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  bool ok() const { return ok_; }

  double volume() const { return qhull_.totvol; }

  /// The points that are corners of the hull.
  void append_corners(std::span<const Vec6> points, std::vector<Vec6>& out) {
    const vertexT* vertex = nullptr;
    for (vertex = qhull_.vertex_list; vertex != nullptr && vertex->next != nullptr; vertex = vertex->next) {
      out.push_back(points[static_cast<std::size_t>(qh_pointid(&qhull_, vertex->point))]);
    }
  }

 private:
  NullFile null_;
  qhT qhull_{};
  std::vector<double> coordinates_;
  bool started_ = false;
  bool ok_ = false;
};

/// Sums of one point of each set, each set joined with the origin.
std::vector<Vec6> sum_sets(const std::vector<Vec6>& a, const std::vector<Vec6>& b) {
  std::vector<Vec6> out = a;
  out.reserve(a.size() * (b.size() + 1));
  for (const Vec6& w : b) {
    for (const Vec6& v : a) out.push_back(v + w);
  }
  return out;
}

/// Without the points that are no corners of the hull; all of them where there is no hull (still flat).
std::vector<Vec6> keep_corners(std::vector<Vec6> points) {
  QhullRun run(points);
  if (!run.ok()) return points;
  std::vector<Vec6> corners;
  run.append_corners(points, corners);
  return corners;
}

}  // namespace

double compute_hull_volume(std::span<const Vec6> wrenches) {
  if (is_flat(wrenches)) return 0.0;
  thread_local detail::PointSupport points;
  thread_local detail::ExpandingPolytope polytope;
  points.assign(wrenches);
  const double volume = polytope.compute_volume(points);
  if (std::isfinite(volume)) return volume;
  const QhullRun run(wrenches);
  return run.ok() ? run.volume() : 0.0;
}

double compute_volume(std::span<const ContactPoint> contacts, const WrenchSpaceOptions& options) {
  std::vector<Vec6> wrenches;
  if (options.norm == WrenchNorm::l1) {
    for (const ContactPoint& c : contacts) append_edge_wrenches(c, options, wrenches);
    return compute_hull_volume(wrenches);
  }
  if (contacts.size() > most_linf_volume_contacts) return 0.0;
  std::vector<Vec6> sum(1, Vec6::Zero());
  for (const ContactPoint& c : contacts) {
    wrenches.clear();
    append_edge_wrenches(c, options, wrenches);
    sum = keep_corners(sum_sets(sum, wrenches));
  }
  return compute_hull_volume(sum);
}

}  // namespace eigengrasp
