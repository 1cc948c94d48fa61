// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Medial balls (shrinking-ball construction) at places of the surface that no earlier ball touches, and a
// greedy choice among them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_set>

#include "eigengrasp/geometry/sphere_cover.hpp"
#include "geometry/hole_lids.hpp"
#include "geometry/point_tree.hpp"
#include "geometry/triangle_pieces.hpp"

namespace eigengrasp {

namespace {

using detail::center_of;
using detail::longest_side_first;
using detail::size_about;
using detail::visit_pieces;

/// Largest ball inside the surface that touches it at p, and where it touches it again; radius 0 where none
/// was found.
struct MedialBall {
  Sphere ball;
  Vec3 other = Vec3::Zero();
};

MedialBall find_medial_ball(const MeshBvh& bvh, const Vec3& p, const Vec3& n, double largest) {
  double r = largest;
  Vec3 other = p;
  for (int i = 0; i < 40; ++i) {
    const Vec3 c = p - r * n;
    const ClosestPoint q = bvh.closest_point(c, r * (1.0 - 1e-6) - 1e-7);
    if (q.triangle < 0) break;
    other = q.point;
    const Vec3 d = p - other;
    const double along = 2.0 * n.dot(d);
    if (!(along > 1e-12)) return {};
    const double smaller = d.squaredNorm() / along;
    if (!(smaller < r)) return {{c, q.distance}, other};
    r = smaller;
  }
  const Vec3 c = p - r * n;
  return {{c, std::min(r, bvh.closest_point(c, r).distance)}, other};
}

/// -1: the solid is behind the surface at p, where the normal comes from; 1: in front of it; 0: on both sides
/// (a surface hidden inside the solid) or on none (a loose sheet).
int find_solid_side(const MeshBvh& bvh, const Vec3& p, const Vec3& n) {
  const double behind = bvh.winding_number(p - 1e-5 * n);
  // The winding number falls by one across the surface; more only where it lies there twice.
  const bool in_front = !(behind > 0.5 && behind < 1.4) && bvh.contains(p + 1e-5 * n);
  return (behind > 0.5 ? -1 : 0) + (in_front ? 1 : 0);
}

/// Balls that reach all samples that have the solid on one side.
class SphereChoice {
 public:
  /// Samples nearer than `skipped_about_hidden` [m] to one without a ball may be left out with it.
  SphereChoice(const MeshBvh& bvh, double tolerance, const SurfaceSamples& samples,
               double skipped_about_hidden)
      : bvh_(bvh),
        tolerance_(tolerance),
        skipped_about_hidden_(skipped_about_hidden),
        largest_(0.5 * bvh.box().diagonal()),
        samples_(samples),
        tree_(samples.points) {
    const std::size_t stride = 1 + tree_.size() / 300;
    probes_.resize(3, static_cast<Eigen::Index>((tree_.size() + stride - 1) / stride));
    for (Eigen::Index i = 0; i < probes_.cols(); ++i)
      probes_.col(i) = tree_.point(static_cast<int>(i) * static_cast<int>(stride));
  }

  std::vector<Sphere> run() {
    if (tree_.size() == 0) return {};
    collect_candidates();
    choose_greedily();
    drop_needless();
    std::vector<Sphere> spheres;
    for (int i : chosen_) spheres.push_back(candidates_[static_cast<std::size_t>(i)].ball);
    return spheres;
  }

 private:
  struct Candidate {
    Sphere ball;
    int first = 0;  ///< of reaches_: samples within the tolerance
    int count = 0;
  };

  /// Balls until every sample is well within reach of one; far places first.
  void collect_candidates() {
    std::vector<bool> well_reached(tree_.size(), false);
    const auto size = static_cast<std::uint32_t>(tree_.size());
    const int bits = std::max(1, static_cast<int>(std::bit_width(size - 1)));
    for (std::uint64_t k = 0; k < std::uint64_t{1} << bits; ++k) {
      std::uint32_t place = 0;  // k with its bits in reverse order
      for (int b = 0; b < bits; ++b) place |= static_cast<std::uint32_t>(k >> b & 1) << (bits - 1 - b);
      if (place >= size || well_reached[place]) continue;
      well_reached[place] = true;
      const Sphere ball = ball_at(static_cast<int>(place));
      if (!(ball.radius > 0.0)) {
        tree_.find_in({tree_.point(static_cast<int>(place)), skipped_about_hidden_}, near_);
        for (int s : near_) well_reached[static_cast<std::size_t>(s)] = true;
        continue;
      }
      const std::vector<int>& near = add_candidate(ball);
      const double close = ball.radius + well_within * tolerance_;
      for (int s : near)
        if ((tree_.point(s) - ball.center).squaredNorm() <= close * close)
          well_reached[static_cast<std::size_t>(s)] = true;
    }
  }

  const std::vector<int>& add_candidate(const Sphere& ball) {
    tree_.find_in({ball.center, ball.radius + tolerance_}, near_);
    candidates_.push_back({ball, static_cast<int>(reaches_.size()), static_cast<int>(near_.size())});
    reaches_.insert(reaches_.end(), near_.begin(), near_.end());
    return near_;
  }

  /// A ball inside the solid that reaches a sample; radius 0 where there is none.
  Sphere ball_at(int place) const {
    const auto sample = static_cast<std::size_t>(tree_.original(place));
    const Vec3& p = samples_.points[sample];
    Vec3 normal = samples_.normals[sample];
    const int side = find_solid_side(bvh_, p, normal);
    if (side == 0) return {};
    if (side > 0) normal = -normal;
    const MedialBall medial = find_medial_ball(bvh_, p, normal, largest_ball(p, normal));
    Sphere ball = medial.ball;
    if (ball.radius > 0.0 && ball.radius < tolerance_) ball = sunk(medial, p);
    if (ball.radius > 0.0 && bvh_.contains(ball.center)) return ball;
    const Vec3 c = p - 0.5 * tolerance_ * normal;
    return {c, std::clamp(-bvh_.signed_distance(c), 0.0, 0.5 * tolerance_)};
  }

  /// Radius of the largest ball that touches the surface at p and holds none of the probes: a first guess.
  double largest_ball(const Vec3& p, const Vec3& n) const {
    const auto d = (-probes_).colwise() + p;
    const double curvature =
        (2.0 * (n.transpose() * d).array() / (d.colwise().squaredNorm().array() + 1e-12)).maxCoeff();
    return curvature * largest_ > 1.0 ? 1.0 / curvature : largest_;
  }

  /// In an edge or corner: the ball moved away from both faces, where it is larger, as far as it still
  /// reaches p.
  Sphere sunk(const MedialBall& medial, const Vec3& p) const {
    const Sphere& ball = medial.ball;
    const Vec3 away = 2.0 * ball.center - p - medial.other;
    const double slope = away.norm() / (2.0 * ball.radius);  // gain of radius along the way
    if (!(slope > 0.1)) return ball;
    double way = (tolerance_ - ball.radius) / slope;
    if (slope < 1.0) way = std::min(way, well_within * tolerance_ / (1.0 - slope));
    const Vec3 c = ball.center + way * away.normalized();
    const double r = bvh_.closest_point(c, 2.0 * tolerance_).distance;
    return r > ball.radius && (p - c).norm() <= r + tolerance_ ? Sphere{c, r} : ball;
  }

  /// Greedy set cover with lazily updated gains.
  void choose_greedily() {
    const auto fewer = [](const std::pair<int, int>& a, const std::pair<int, int>& b) {
      return a.first != b.first ? a.first < b.first : a.second > b.second;
    };
    std::vector<std::pair<int, int>> heap;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      heap.emplace_back(candidates_[i].count, static_cast<int>(i));
    std::make_heap(heap.begin(), heap.end(), fewer);
    reached_by_.assign(tree_.size(), 0);
    while (!heap.empty()) {
      std::pop_heap(heap.begin(), heap.end(), fewer);
      const auto [promised, index] = heap.back();
      heap.pop_back();
      const int gain = count_reached(index, 0);
      if (gain == 0) continue;
      if (gain < promised) {
        heap.emplace_back(gain, index);
        std::push_heap(heap.begin(), heap.end(), fewer);
        continue;
      }
      add_reach(index, 1);
      chosen_.push_back(index);
    }
  }

  /// Later choices can make earlier ones needless; the last and smallest are asked first.
  void drop_needless() {
    std::vector<int> kept;
    for (auto i = chosen_.rbegin(); i != chosen_.rend(); ++i) {
      if (count_reached(*i, 1) == 0) {
        add_reach(*i, -1);
      } else {
        kept.push_back(*i);
      }
    }
    chosen_ = std::move(kept);
  }

  /// Samples of a candidate that so many chosen balls reach.
  int count_reached(int index, int times) const {
    const Candidate& c = candidates_[static_cast<std::size_t>(index)];
    const auto begin = reaches_.begin() + c.first;
    return static_cast<int>(std::count_if(
        begin, begin + c.count, [&](int s) { return reached_by_[static_cast<std::size_t>(s)] == times; }));
  }

  void add_reach(int index, int times) {
    const Candidate& c = candidates_[static_cast<std::size_t>(index)];
    for (int k = c.first; k < c.first + c.count; ++k)
      reached_by_[static_cast<std::size_t>(reaches_[static_cast<std::size_t>(k)])] += times;
  }

  static constexpr double well_within = 0.4;  ///< of the tolerance: no further ball is made there

  const MeshBvh& bvh_;
  double tolerance_;
  double skipped_about_hidden_;
  double largest_;
  const SurfaceSamples& samples_;
  PointTree tree_;
  Eigen::Matrix3Xd probes_;  ///< some of the samples
  std::vector<Candidate> candidates_;
  std::vector<int> reaches_;
  std::vector<int> near_;
  std::vector<int> reached_by_;  ///< by how many chosen balls, a sample
  std::vector<int> chosen_;
};

Vec3 unit_normal(const TriangleMesh& mesh, std::size_t t) {
  const Vec3 n = area_normal(mesh, t);
  const double length = n.norm();
  return length > 0.0 ? Vec3(n / length) : Vec3::Zero();
}

/// Samples of the whole surface, of those near each other and facing alike only one.
SurfaceSamples sample_thinly(const TriangleMesh& mesh, const MeshBvh& bvh, double spacing) {
  SurfaceSamples samples;
  std::unordered_set<std::uint64_t> taken;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = unit_normal(mesh, t);
    if (normal.isZero()) continue;
    Eigen::Index axis = 0;  // the two sides of a thin plate are not one
    normal.cwiseAbs().maxCoeff(&axis);
    const auto face = static_cast<std::uint64_t>(2 * axis + (normal[axis] < 0.0 ? 1 : 0));
    visit_pieces(bvh.corners(static_cast<int>(t)), 1.5 * spacing, [&](const TriangleCorners& piece) {
      const Vec3 p = center_of(piece);
      std::uint64_t key = face;
      for (Eigen::Index k = 0; k < 3; ++k)
        key = key << 20 | (static_cast<std::uint64_t>(std::llround(p[k] / spacing)) & 0xfffff);
      if (!taken.insert(key).second) return;
      samples.points.push_back(p);
      samples.normals.push_back(normal);
    });
  }
  return samples;
}

/// Looks for the pieces of a surface that no sphere reaches. A sphere that reaches the corners of a piece
/// reaches all of it.
class GapSearch {
 public:
  GapSearch(const MeshBvh& bvh, std::vector<Sphere> spheres, double tolerance, double side)
      : bvh_(bvh), spheres_(std::move(spheres)), tolerance_(tolerance), side_(side) {
    groups_ = group_spheres(spheres_, 16);
  }

  /// Adds the centres of pieces of the side or smaller that are not reached.
  void search(const TriangleCorners& t, const Vec3& normal, SurfaceSamples& gaps) {
    const Vec3 center = center_of(t);
    const double radius = size_about(t, center);
    near_.clear();
    for (const SphereGroup& g : groups_)
      if (within(g.bound, center, tolerance_ + radius))
        for (int i = g.first; i < g.first + g.count; ++i) near_.push_back(i);
    search_piece(t, 0, normal, gaps);
  }

 private:
  static bool within(const Sphere& s, const Vec3& p, double distance) {
    const double reach = s.radius + distance;
    return (p - s.center).squaredNorm() <= reach * reach;
  }

  bool is_hidden(const TriangleCorners& t, const Vec3& normal) const {
    const Vec3 center = center_of(t);
    for (const Vec3* p : {&center, &t.a, &t.b, &t.c})
      if (find_solid_side(bvh_, *p + 0.01 * (center - *p), normal) != 0) return false;
    return true;
  }

  /// near_ from `first` on: all spheres that may reach the piece.
  void search_piece(const TriangleCorners& t, std::size_t first, const Vec3& normal, SurfaceSamples& gaps) {
    const std::size_t end = near_.size();
    const Vec3 center = center_of(t);
    const double radius = size_about(t, center);
    bool center_reached = false;
    for (std::size_t i = first; i < end; ++i) {
      const Sphere& s = spheres_[static_cast<std::size_t>(near_[i])];
      if (!within(s, center, tolerance_ + radius)) continue;
      center_reached = center_reached || within(s, center, tolerance_);
      if (within(s, t.a, tolerance_) && within(s, t.b, tolerance_) && within(s, t.c, tolerance_)) {
        near_.resize(end);
        return;
      }
      near_.push_back(near_[i]);
    }
    const TriangleCorners s = longest_side_first(t);
    const double longest = (s.b - s.a).norm();
    if (near_.size() == end && longest <= 4.0 * side_ && longest > 2.0 * side_ && is_hidden(t, normal)) {
      return;
    }
    if (longest > side_) {
      const Vec3 middle = 0.5 * (s.a + s.b);
      search_piece({s.b, s.c, middle}, end, normal, gaps);
      search_piece({s.c, s.a, middle}, end, normal, gaps);
    } else if (!center_reached) {
      gaps.points.push_back(center);
      gaps.normals.push_back(normal);
    }
    near_.resize(end);
  }

  const MeshBvh& bvh_;
  std::vector<Sphere> spheres_;
  std::vector<SphereGroup> groups_;
  double tolerance_;
  double side_;
  std::vector<int> near_;  ///< a stack of lists
};

/// @param bvh of the mesh, and of further triangles that no sphere may cross
std::vector<Sphere> cover(const TriangleMesh& mesh, const MeshBvh& bvh, double tolerance) {
  const double size = std::sqrt(surface_area(mesh));  // large surfaces get larger pieces
  const SurfaceSamples samples = sample_thinly(mesh, bvh, std::max(1.4 * tolerance, size / 250.0));
  std::vector<Sphere> spheres = SphereChoice(bvh, 0.9 * tolerance, samples, 3.0 * tolerance).run();
  GapSearch search(bvh, spheres, tolerance, std::max(0.4 * tolerance, size / 1000.0));
  SurfaceSamples gaps;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    search.search(bvh.corners(static_cast<int>(t)), unit_normal(mesh, t), gaps);
  const std::vector<Sphere> more = SphereChoice(bvh, tolerance, gaps, 0.0).run();
  spheres.insert(spheres.end(), more.begin(), more.end());
  std::stable_sort(spheres.begin(), spheres.end(),
                   [](const Sphere& a, const Sphere& b) { return a.radius > b.radius; });
  return spheres;
}

}  // namespace

// Out of a hole the spheres would bulge.
std::vector<Sphere> cover_with_inner_spheres(const TriangleMesh& mesh, const MeshBvh& bvh, double tolerance) {
  if (mesh.empty()) return {};
  const TriangleMesh lids = make_hole_lids(mesh);
  if (lids.empty()) return cover(mesh, bvh, tolerance);
  TriangleMesh closed = mesh;
  append(closed, lids);
  return cover(mesh, MeshBvh(closed), tolerance);
}

}  // namespace eigengrasp
