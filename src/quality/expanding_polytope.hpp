// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "quality/wrench_support.hpp"

namespace eigengrasp::detail {

/// When to stop expanding.
struct ExpansionGoal {
  double tolerance = 0.0;  ///< stop where upper - lower <= tolerance * max(1, upper)
  /// Stop where upper < threshold or lower >= threshold; NaN: never for that reason.
  double threshold = std::numeric_limits<double>::quiet_NaN();
  double enough_below = 0.0;  ///< stop where upper < enough_below
  /// Stop where a facet is looked beyond for the so many-th time; the last one is not expanded any more.
  std::size_t most_expansions = std::numeric_limits<std::size_t>::max();
};

/// lower <= distance from the origin to the boundary of the set <= upper; both 0 where the origin is not
/// inside. Not converged: the work limit was reached first, the bounds still hold.
struct DistanceBounds {
  double lower = 0.0;
  double upper = 0.0;
  bool converged = true;
  Vec6 weakest =
      Vec6::Zero();  ///< unit direction in which the set reaches no farther than upper; where the
                     ///< origin is not inside, one that parts it from the set, as far as one was met
};

/// Distance from the origin to the boundary of a convex set in six dimensions, by a polytope inside of the
/// set that grows towards the facet with the least offset (Zheng 2013; EPA of van den Bergen 2001). The
/// origin may be outside of the polytope at first: offsets are signed then.
///
/// How it stays sound with rounding: the plane of a new facet is a convex combination of the planes of the
/// visible and the hidden facet that meet in its horizon ridge, so it supports the polytope whatever the
/// shape of the facet, a sliver included; and neighbours are found by turning about a ridge through the
/// visible facets, which pairs every new facet whatever was judged visible. Holds its memory between calls.
class ExpandingPolytope {
 public:
  DistanceBounds compute_distance(const WrenchSupport& set, const ExpansionGoal& goal);

  /// Volume of the set where it is the hull of finitely many points: the polytope grows over all its facets
  /// until it is the set. The origin may be anywhere. 0 where the set is flat, NaN where the work limit was
  /// reached first.
  double compute_volume(const WrenchSupport& set);

  /// Counters of the last call.
  std::size_t n_expansions() const { return n_expansions_; }
  std::size_t n_facets() const { return n_created_; }

 private:
  static constexpr int kDim = 6;

  struct alignas(64) Facet {
    // Unit normal, offset: normal . x <= offset inside; and the orientation of the vertices' order, +-1.
    std::array<double, 8> plane;
    std::array<std::int32_t, kDim> vertex;
    std::array<std::int32_t, kDim> across;  // what lies across the ridge without the vertex of the slot
    double height;                          // of the vertex in hand, computed in step seen
    std::uint32_t seen;                     // step in which height was computed
    std::uint32_t serial;                   // tells a reused slot from the facet that the queue means
  };
  struct Candidate {
    double offset;
    std::int32_t facet;
    std::uint32_t serial;
    bool operator<(const Candidate& other) const { return offset > other.offset; }  // least offset on top
  };
  struct HorizonRidge {
    std::int32_t visible;
    std::int32_t slot;    // of the visible facet's vertex that is not on the ridge
    std::int32_t hidden;  // link to the hidden facet
    std::int32_t made;    // the new facet
  };

  double slack() const;  // facets with offset >= upper_ - slack() need no expansion
  double probe(const Vec6& u, Vec6& w);
  bool build_simplex();
  bool find_next_vertex(const std::array<Vec6, kDim>& basis, const Vec6& first, int n_basis, Vec6& w);
  void make_simplex_facets();
  /// Of those that need expansion that of the least offset; any, where the whole is wanted.
  bool pop_next(Candidate& next);
  void push(std::int32_t facet);
  bool build_any_simplex();
  Eigen::Matrix<double, kDim, kDim> corners(const Facet& facet) const;
  double sum_volume() const;
  void expand(std::int32_t seed, const Vec6& w);
  void find_visible(std::int32_t seed, const Vec6& w);
  std::int32_t make_facet(const HorizonRidge& ridge, std::int32_t vertex);
  void link_around(const HorizonRidge& ridge);
  void refine(Facet& facet) const;
  double plane_error(const Facet& facet) const;
  std::int32_t allocate_facet();
  static double compute_height(const Facet& facet, const Vec6& w);
  static Vec6 normal(const Facet& facet);

  const WrenchSupport* set_ = nullptr;
  double scale_ = 0.0;
  double upper_ = 0.0;
  Vec6 weakest_ = Vec6::Zero();
  double tolerance_ = 0.0;
  bool whole_ = false;  // every facet is to be expanded, not only the nearest ones
  std::uint32_t step_ = 0;
  std::uint32_t serial_ = 0;
  std::size_t n_expansions_ = 0;
  std::size_t n_created_ = 0;
  std::vector<Vec6> vertices_;
  std::vector<Facet> facets_;
  std::vector<std::int32_t> free_;
  std::vector<Candidate> queue_;
  std::vector<std::int32_t> visible_;
  std::vector<HorizonRidge> horizon_;
};

}  // namespace eigengrasp::detail
