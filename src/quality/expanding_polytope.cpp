// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "quality/expanding_polytope.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace eigengrasp::detail {
namespace {

// All relative to the largest wrench.
constexpr double kFlat = 1e-11;     // a set of less width has no inside
constexpr double kOutward = 1e-12;  // a support point that is higher over its facet expands the polytope
constexpr double kVisible = 1e-13;  // a facet sees points that are higher
constexpr double kPlaneDrift = 1e-14;

// A facet across a ridge, and the slot of that facet's vertex that is not on the ridge. ~facet, negative,
// while the ridge is on the horizon of the vertex in hand.
constexpr std::int32_t kUnlinked = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t link(std::int32_t facet, std::int32_t slot) {
  return facet * 8 + slot;
}
constexpr std::int32_t facet_of(std::int32_t across) {
  return across >> 3;
}
constexpr std::int32_t slot_of(std::int32_t across) {
  return across & 7;
}

constexpr std::size_t kMaxFacets = 1'000'000;  // work limit: about a second

}  // namespace

Vec6 ExpandingPolytope::normal(const Facet& facet) {
  return Vec6(facet.plane.data());
}

double ExpandingPolytope::compute_height(const Facet& facet, const Vec6& w) {
  const auto& p = facet.plane;
  return ((p[0] * w[0] + p[1] * w[1]) + (p[2] * w[2] + p[3] * w[3])) + ((p[4] * w[4] + p[5] * w[5]) - p[6]);
}

double ExpandingPolytope::slack() const {
  return tolerance_ * std::max(1.0, upper_);
}

double ExpandingPolytope::probe(const Vec6& u, Vec6& w) {
  const double h = set_->support(u, w);
  if (h < upper_) {
    upper_ = h;
    weakest_ = u;
  }
  return h;
}

DistanceBounds ExpandingPolytope::compute_distance(const WrenchSupport& set, const ExpansionGoal& goal) {
  set_ = &set;
  whole_ = false;
  scale_ = set.scale();
  tolerance_ = std::max(goal.tolerance, 0.0);
  n_expansions_ = n_created_ = 0;
  upper_ = std::numeric_limits<double>::infinity();
  weakest_.setZero();
  if (!(scale_ > 0.0) || !build_simplex()) return {0.0, 0.0, true, weakest_};
  make_simplex_facets();
  Candidate least;
  Vec6 w;
  while (true) {
    const bool any = pop_next(least);
    const double lower = any ? std::min(least.offset, upper_) : upper_ - slack();
    if (upper_ <= 0.0) return {0.0, 0.0, true, weakest_};
    if (!any || lower >= upper_ - slack() || upper_ < goal.threshold || upper_ < goal.enough_below ||
        lower >= goal.threshold) {
      return {std::max(lower, 0.0), upper_, true, weakest_};
    }
    Facet& facet = facets_[static_cast<std::size_t>(least.facet)];
    if (plane_error(facet) > kPlaneDrift * scale_) refine(facet);
    probe(normal(facet), w);
    // A facet that the set does not reach over is part of the set's own boundary; it stays, but is done.
    if (!(compute_height(facet, w) > kOutward * scale_)) continue;
    if (n_created_ > kMaxFacets || n_expansions_ + 1 >= goal.most_expansions)
      return {std::max(lower, 0.0), std::max(upper_, 0.0), false, weakest_};
    expand(least.facet, w);
  }
}

double ExpandingPolytope::compute_volume(const WrenchSupport& set) {
  set_ = &set;
  whole_ = true;
  scale_ = set.scale();
  n_expansions_ = n_created_ = 0;
  if (!(scale_ > 0.0) || !build_any_simplex()) return 0.0;
  make_simplex_facets();
  Candidate least;
  Vec6 w;
  while (pop_next(least)) {
    if (n_created_ > kMaxFacets) return std::numeric_limits<double>::quiet_NaN();
    Facet& facet = facets_[static_cast<std::size_t>(least.facet)];
    if (plane_error(facet) > kPlaneDrift * scale_) refine(facet);
    set_->support(normal(facet), w);
    if (compute_height(facet, w) > kOutward * scale_) expand(least.facet, w);
  }
  return sum_volume();
}

// As build_simplex, but wherever the origin is: always the point farthest from the affine hull so far.
bool ExpandingPolytope::build_any_simplex() {
  vertices_.clear();
  std::array<Vec6, kDim> basis;
  Vec6 w;
  set_->support(Vec6::Unit(0), w);
  vertices_.push_back(w);
  for (std::size_t n = 0; n < kDim; ++n) {
    Vec6 best = Vec6::Zero();
    double widest = kFlat * scale_;
    for (int axis = 0; axis < kDim; ++axis) {
      Vec6 u = Vec6::Unit(axis);
      for (int pass = 0; pass < 2; ++pass)
        for (std::size_t k = 0; k < n; ++k) u -= basis[k].dot(u) * basis[k];
      if (u.norm() < 0.1) continue;
      u.normalize();
      for (const double sign : {1.0, -1.0}) {
        set_->support(sign * u, w);
        const double width = sign * u.dot(w - vertices_[0]);
        if (width <= widest) continue;
        widest = width;
        best = w;
      }
    }
    if (best.isZero()) return false;
    Vec6 direction = best - vertices_[0];
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t k = 0; k < n; ++k) direction -= basis[k].dot(direction) * basis[k];
    basis[n] = direction.normalized();
    vertices_.push_back(best);
  }
  return true;
}

// Seen from the middle of the first simplex.
Eigen::Matrix<double, 6, 6> ExpandingPolytope::corners(const Facet& facet) const {
  Vec6 middle = Vec6::Zero();
  for (std::size_t i = 0; i <= kDim; ++i) middle += vertices_[i] / (kDim + 1.0);
  Eigen::Matrix<double, kDim, kDim> m;
  for (std::size_t i = 0; i < kDim; ++i)
    m.col(static_cast<int>(i)) = vertices_[static_cast<std::size_t>(facet.vertex[i])] - middle;
  return m;
}

// Every facet with the middle is a simplex, counted by its orientation, so that slivers that fold over
// cancel.
double ExpandingPolytope::sum_volume() const {
  constexpr double factorial_of_6 = 720.0;
  double sum = 0.0;
  for (const Facet& f : facets_)
    if (f.serial != 0) sum += f.plane[7] * corners(f).partialPivLu().determinant();
  return std::abs(sum) / factorial_of_6;
}

bool ExpandingPolytope::build_simplex() {
  vertices_.clear();
  std::array<Vec6, kDim> basis;
  Vec6 w;
  probe(Vec6::Unit(0), w);
  vertices_.push_back(w);
  for (int n = 0; n < kDim; ++n) {
    if (!find_next_vertex(basis, vertices_[0], n, w)) return false;
    Vec6 direction = w - vertices_[0];
    // Twice is enough: keeps the basis orthogonal where the new vertex is close to the old ones.
    for (int pass = 0; pass < 2; ++pass) {
      for (int k = 0; k < n; ++k) {
        const Vec6& b = basis[static_cast<std::size_t>(k)];
        direction -= b.dot(direction) * b;
      }
    }
    basis[static_cast<std::size_t>(n)] = direction.normalized();
    vertices_.push_back(w);
  }
  return true;
}

// A point of the set that is off the affine hull of the simplex so far: towards the origin where the hull
// misses it, else wherever the set is wide. False: the set is flat or the origin is not inside.
bool ExpandingPolytope::find_next_vertex(const std::array<Vec6, kDim>& basis, const Vec6& first, int n_basis,
                                         Vec6& w) {
  const auto residual = [&](Vec6 x) {
    for (int pass = 0; pass < 2; ++pass) {
      for (int k = 0; k < n_basis; ++k) {
        const Vec6& b = basis[static_cast<std::size_t>(k)];
        x -= b.dot(x) * b;
      }
    }
    return x;
  };
  const Vec6 foot = residual(first);
  if (foot.norm() > 1e-9 * scale_) {
    const Vec6 u = -foot.normalized();
    const double h = probe(u, w);
    return h > 0.0 && h + foot.norm() > kFlat * scale_;
  }
  Vec6 u = Vec6::Zero();
  for (int axis = 0; axis < kDim; ++axis) {
    const Vec6 r = residual(Vec6::Unit(axis));
    if (r.squaredNorm() > u.squaredNorm()) u = r;
  }
  u.normalize();
  const double level = u.dot(first);
  Vec6 opposite;
  const double h = probe(u, w) - level;
  const double h_opposite = probe(-u, opposite) + level;
  if (h_opposite > h) w = opposite;
  return upper_ > 0.0 && std::max(h, h_opposite) > kFlat * scale_;
}

// Rows of the inverse of the homogeneous vertex matrix are the planes opposite of the vertices.
void ExpandingPolytope::make_simplex_facets() {
  facets_.clear();
  free_.clear();
  queue_.clear();
  step_ = serial_ = 0;
  Eigen::Matrix<double, 7, 7> homogeneous;
  for (int i = 0; i < 7; ++i) {
    homogeneous.col(i) << vertices_[static_cast<std::size_t>(i)], 1.0;
  }
  const Eigen::Matrix<double, 7, 7> inverse = homogeneous.partialPivLu().inverse();
  for (int i = 0; i < 7; ++i) {
    const std::int32_t id = allocate_facet();
    Facet& f = facets_[static_cast<std::size_t>(id)];
    const double length = inverse.row(i).head<6>().norm();
    for (int k = 0; k < 6; ++k) f.plane[static_cast<std::size_t>(k)] = -inverse(i, k) / length;
    f.plane[6] = inverse(i, 6) / length;
    std::size_t slot = 0;
    for (int v = 0; v < 7; ++v) {
      if (v == i) continue;
      f.vertex[slot] = v;
      // The facet opposite of vertex v has number v and keeps vertex i in the slot that leaves out v.
      f.across[slot++] = link(v, i < v ? i : i - 1);
    }
    // Leaving out the next vertex turns the order round.
    f.plane[7] = i % 2 == 0 ? 1.0 : -1.0;
  }
  for (int i = 0; i < 7; ++i) push(i);
}

std::int32_t ExpandingPolytope::allocate_facet() {
  ++n_created_;
  std::int32_t id;
  if (free_.empty()) {
    id = static_cast<std::int32_t>(facets_.size());
    facets_.emplace_back();
  } else {
    id = free_.back();
    free_.pop_back();
  }
  Facet& f = facets_[static_cast<std::size_t>(id)];
  f.seen = 0;
  f.serial = ++serial_;
  return id;
}

void ExpandingPolytope::push(std::int32_t facet) {
  const Facet& f = facets_[static_cast<std::size_t>(facet)];
  if (!whole_ && !(f.plane[6] < upper_ - slack())) return;
  queue_.push_back({f.plane[6], facet, f.serial});
  if (!whole_) std::push_heap(queue_.begin(), queue_.end());
}

// The order does not matter to the whole: the last one is at hand.
bool ExpandingPolytope::pop_next(Candidate& next) {
  while (!queue_.empty()) {
    if (!whole_) std::pop_heap(queue_.begin(), queue_.end());
    next = queue_.back();
    queue_.pop_back();
    if (facets_[static_cast<std::size_t>(next.facet)].serial == next.serial) return true;
  }
  return false;
}

void ExpandingPolytope::expand(std::int32_t seed, const Vec6& w) {
  ++n_expansions_;
  ++step_;
  const auto vertex = static_cast<std::int32_t>(vertices_.size());
  vertices_.push_back(w);
  find_visible(seed, w);
  for (HorizonRidge& ridge : horizon_) ridge.made = make_facet(ridge, vertex);
  for (const HorizonRidge& ridge : horizon_) link_around(ridge);
  for (const std::int32_t f : visible_) {
    facets_[static_cast<std::size_t>(f)].serial = 0;
    free_.push_back(f);
  }
  for (const HorizonRidge& ridge : horizon_) push(ridge.made);
}

void ExpandingPolytope::find_visible(std::int32_t seed, const Vec6& w) {
  const double threshold = kVisible * scale_;
  visible_.assign(1, seed);
  horizon_.clear();
  Facet& first = facets_[static_cast<std::size_t>(seed)];
  first.seen = step_;
  first.height = compute_height(first, w);
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const std::int32_t id = visible_[i];
    for (std::int32_t slot = 0; slot < kDim; ++slot) {
      const std::int32_t across =
          facets_[static_cast<std::size_t>(id)].across[static_cast<std::size_t>(slot)];
      const std::int32_t other = facet_of(across);
      Facet& g = facets_[static_cast<std::size_t>(other)];
      if (g.seen != step_) {
        g.seen = step_;
        g.height = compute_height(g, w);
        if (g.height > threshold) visible_.push_back(other);
      }
      if (!(g.height > threshold)) horizon_.push_back({id, slot, across, -1});
    }
  }
}

std::int32_t ExpandingPolytope::make_facet(const HorizonRidge& ridge, std::int32_t vertex) {
  const std::int32_t id = allocate_facet();
  Facet& made = facets_[static_cast<std::size_t>(id)];
  Facet& visible = facets_[static_cast<std::size_t>(ridge.visible)];
  Facet& hidden = facets_[static_cast<std::size_t>(facet_of(ridge.hidden))];
  const auto slot = static_cast<std::size_t>(ridge.slot);
  const double share_hidden = visible.height;
  const double share_visible = std::max(0.0, -hidden.height);
  double squared = 0.0;
  for (std::size_t k = 0; k < 7; ++k) {
    made.plane[k] = share_hidden * hidden.plane[k] + share_visible * visible.plane[k];
    if (k < 6) squared += made.plane[k] * made.plane[k];
  }
  made.plane[7] = visible.plane[7];  // the apex takes the place of a vertex
  const double factor = 1.0 / std::sqrt(squared);
  for (std::size_t k = 0; k < 7; ++k) made.plane[k] *= factor;
  made.vertex = visible.vertex;
  made.vertex[slot] = vertex;
  made.across.fill(kUnlinked);
  made.across[slot] = ridge.hidden;
  visible.across[slot] = ~id;
  hidden.across[static_cast<std::size_t>(slot_of(ridge.hidden))] = link(id, ridge.slot);
  return id;
}

// The new facet of a ridge has five more neighbours: its siblings across (ridge without one vertex) + apex.
// Each is the new facet at the other end of the fan of visible facets about that sub-ridge.
void ExpandingPolytope::link_around(const HorizonRidge& ridge) {
  Facet& made = facets_[static_cast<std::size_t>(ridge.made)];
  for (std::int32_t j = 0; j < kDim; ++j) {
    if (made.across[static_cast<std::size_t>(j)] != kUnlinked) continue;
    const Facet* fan = &facets_[static_cast<std::size_t>(ridge.visible)];
    std::int32_t gained = ridge.slot;  // slot of the vertex that the last turn of the fan has brought
    std::int32_t next = fan->across[static_cast<std::size_t>(j)];
    while (next >= 0) {
      const std::int32_t pivot = fan->vertex[static_cast<std::size_t>(gained)];
      fan = &facets_[static_cast<std::size_t>(facet_of(next))];
      gained = slot_of(next);
      std::size_t dropped = 0;  // without branches
      for (std::size_t k = 1; k < kDim; ++k) dropped = fan->vertex[k] == pivot ? k : dropped;
      next = fan->across[dropped];
    }
    made.across[static_cast<std::size_t>(j)] = link(~next, gained);
    facets_[static_cast<std::size_t>(~next)].across[static_cast<std::size_t>(gained)] = link(ridge.made, j);
  }
}

double ExpandingPolytope::plane_error(const Facet& facet) const {
  double error = 0.0;
  for (const std::int32_t v : facet.vertex) {
    error = std::max(error, std::abs(compute_height(facet, vertices_[static_cast<std::size_t>(v)])));
  }
  return error;
}

// The plane through the vertices themselves, without the rounding that the combinations have gathered. Left
// as it is where the vertices do not span it.
void ExpandingPolytope::refine(Facet& facet) const {
  const auto vertex = [&](std::size_t i) -> const Vec6& {
    return vertices_[static_cast<std::size_t>(facet.vertex[i])];
  };
  Eigen::Matrix<double, 6, 6> edges;
  for (std::size_t i = 1; i < kDim; ++i) {
    edges.row(static_cast<int>(i)) = (vertex(i) - vertex(0)).transpose();
  }
  const Vec6 n = normal(facet);
  edges.row(0) = n.transpose();
  const Vec6 x = edges.partialPivLu().solve(Vec6::Unit(0));
  if (!((x - n).norm() < 1e-6)) return;
  Facet refined = facet;
  Vec6::Map(refined.plane.data()) = x.normalized();
  refined.plane[6] = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; i < kDim; ++i) {
    refined.plane[6] = std::max(refined.plane[6], normal(refined).dot(vertex(i)));
  }
  if (plane_error(refined) < plane_error(facet)) facet = refined;
}

}  // namespace eigengrasp::detail
