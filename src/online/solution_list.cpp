// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "online/solution_list.hpp"

#include <algorithm>
#include <cmath>

#include "online/approach_space.hpp"
#include "planning/pregrasp_search.hpp"

namespace eigengrasp {

namespace {

constexpr double keep_out_of_reach = 2.0;  // [s]
constexpr double least_offer = 0.4;        // [s] an offer stands at least that long while it is in reach
constexpr double beside = 0.10;         // [m] a grasp that much sideways and no farther on leans 45 degrees
constexpr double wider = 1.25;          // reach goes that much beyond the cone that is searched
constexpr double slack = 0.02;          // [m] and that much beyond its ends
constexpr double angle_class = 0.1745;  // [rad] within it quality decides
constexpr double clearly_nearer = 0.1222;  // [rad]
constexpr double clearly_stronger = 1.25;

PreGrasp pregrasp_of(const Grasp& g) {
  PreGrasp p;
  p.X_OH = g.X_OH_pregrasp;
  p.dofs = g.pregrasp_dofs;
  return p;
}

/// Nearer by whole classes of angle, or in the same class stronger.
bool ranks_before(const OnlineSolution& a, const OnlineSolution& b) {
  const double class_a = std::floor(a.angle / angle_class);
  const double class_b = std::floor(b.angle / angle_class);
  return class_a != class_b ? class_a < class_b : a.epsilon > b.epsilon;
}

}  // namespace

SolutionList::SolutionList(const Scene& scene, const OnlineOptions& options)
    : scene_(scene), options_(options), distinct_(distinctness_of(*scene.hand)) {}

void SolutionList::add(const Grasp& grasp, const Pose& X_OW, double now) {
  const PreGrasp p = pregrasp_of(grasp);
  for (Solution& s : solutions_) {
    if (distinct_.between(p, pregrasp_of(s.grasp)) >= 1.0) continue;
    // What is shown does not jump about for little.
    if (grasp.epsilon > (s.id == offered_ ? clearly_stronger : 1.0) * s.grasp.epsilon) s.grasp = grasp;
    return;
  }
  solutions_.push_back({next_id_++, grasp, now, now});
  if (solutions_.size() <= options_.solutions) return;
  const auto farthest =
      std::max_element(solutions_.begin(), solutions_.end(), [&](const Solution& a, const Solution& b) {
        if ((a.id == offered_) != (b.id == offered_)) return a.id == offered_;
        return ranks_before(seen_from(a, X_OW, now), seen_from(b, X_OW, now));
      });
  solutions_.erase(farthest);
}

OnlineSolution SolutionList::seen_from(const Solution& s, const Pose& X_OW, double now) const {
  const ApproachOffset o = offset_from(*scene_.hand, X_OW, s.grasp.X_OH_pregrasp);
  const double lean = std::atan2(o.offset, std::max(o.distance, 0.0) + beside);
  return {s.id, s.grasp.epsilon, o.distance, std::max(o.angle, lean), o.offset, now - s.found};
}

bool SolutionList::in_reach(const OnlineSolution& s) const {
  return s.angle <= wider * options_.cone_half_angle && s.distance >= -options_.step_back - slack &&
         s.distance <= options_.look_ahead + slack;
}

bool SolutionList::clearly_better(const OnlineSolution& a, const OnlineSolution& b) const {
  return a.angle < b.angle - clearly_nearer ||
         (a.angle < b.angle + 0.5 * clearly_nearer && a.epsilon > clearly_stronger * b.epsilon);
}

void SolutionList::update(const Pose& X_OW, double now) {
  std::optional<OnlineSolution> best, last;
  for (Solution& s : solutions_) {
    const OnlineSolution seen = seen_from(s, X_OW, now);
    if (!in_reach(seen)) continue;
    s.in_reach = now;
    if (s.id == offered_) last = seen;
    if (!best || ranks_before(seen, *best)) best = seen;
  }
  std::erase_if(solutions_, [&](const Solution& s) { return now - s.in_reach > keep_out_of_reach; });
  const bool stays = last && best && (now - offered_since_ < least_offer || !clearly_better(*best, *last));
  if (stays) return;
  const std::uint64_t chosen = best ? best->id : 0;
  if (chosen != offered_) offered_since_ = now;
  offered_ = chosen;
}

const SolutionList::Solution* SolutionList::get(std::uint64_t id) const {
  for (const Solution& s : solutions_)
    if (s.id == id) return &s;
  return nullptr;
}

const Grasp* SolutionList::offered() const {
  return find(offered_);
}

const Grasp* SolutionList::find(std::uint64_t id) const {
  const Solution* s = get(id);
  return s ? &s->grasp : nullptr;
}

std::vector<OnlineSolution> SolutionList::list(const Pose& X_OW, double now) const {
  std::vector<OnlineSolution> all;
  for (const Solution& s : solutions_) all.push_back(seen_from(s, X_OW, now));
  std::sort(all.begin(), all.end(), [&](const OnlineSolution& a, const OnlineSolution& b) {
    if ((a.id == offered_) != (b.id == offered_)) return a.id == offered_;
    return a.angle != b.angle ? a.angle < b.angle : a.id < b.id;
  });
  return all;
}

bool SolutionList::any_in_reach(const Pose& X_OW) const {
  return std::any_of(solutions_.begin(), solutions_.end(),
                     [&](const Solution& s) { return in_reach(seen_from(s, X_OW, 0.0)); });
}

void SolutionList::clear() {
  solutions_.clear();
  offered_ = 0;
}

}  // namespace eigengrasp
