// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/grasp_energy.hpp"

#include <cmath>
#include <limits>

#include "eigengrasp/contact/material.hpp"

namespace eigengrasp {

GraspEnergy::GraspEnergy(const CollisionModel& model, const PlanOptions& options)
    : model_(model), kind_(options.energy), alpha_(options.alpha) {
  const Scene& scene = model.scene();
  wrench_space_.norm = options.norm;
  wrench_space_.cone = options.cone;
  wrench_space_.edges = options.cone_edges;
  wrench_space_.torque_origin_O = scene.object->center_of_mass;
  wrench_space_.torque_scale = options.torque_scale > 0.0 ? options.torque_scale : scene.object->max_radius;
  wrench_space_.epsilon_min = options.epsilon_min;
  for (const VirtualContact& c : scene.hand->virtual_contacts)
    friction_.push_back(contact_friction(scene.hand->links[static_cast<std::size_t>(c.link)].material,
                                         scene.object_material));
}

void GraspEnergy::approach(const std::vector<Pose>& X_OL, DistanceSource source,
                           std::vector<ContactApproach>& out) const {
  const auto& virtual_contacts = model_.scene().hand->virtual_contacts;
  out.resize(virtual_contacts.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const VirtualContact& c = virtual_contacts[i];
    const Pose& X = X_OL[static_cast<std::size_t>(c.link)];
    ContactApproach& a = out[i];
    a.p_OC = X * c.p_LC;
    a.n_OC = X.linear() * c.n_LC;
    const FieldSample s =
        source == DistanceSource::exact ? FieldSample{} : model_.object_field().sample(a.p_OC);
    Vec3 to_object;  // any length
    // Near the medial axis, where the field's gradient is short, it does not know the direction.
    const double least_gradient = source == DistanceSource::gradients ? 1e-3 : 0.97;
    if (s.gradient.squaredNorm() > least_gradient * least_gradient) {
      a.distance = std::abs(s.distance);
      to_object = s.distance > 0.0 ? Vec3(-s.gradient) : s.gradient;
    } else {
      const ClosestPoint q = model_.scene().object->bvh.closest_point(a.p_OC);
      a.distance = q.distance;
      to_object = q.point - a.p_OC;
    }
    const double length = to_object.norm();
    a.cosine = length > 0.0 ? a.n_OC.dot(to_object) / length : 1.0;
  }
}

double GraspEnergy::contact_energy(const std::vector<ContactApproach>& approaches) const {
  if (approaches.empty()) return 0.0;
  double sum = 0.0;
  for (const ContactApproach& a : approaches) sum += a.delta(alpha_);
  return 1000.0 * alpha_ * sum / static_cast<double>(approaches.size());
}

double GraspEnergy::paper_quality(const std::vector<ContactApproach>& approaches) const {
  double quality = 0.0;
  for (const ContactApproach& a : approaches) quality += 1.0 - a.delta(alpha_);
  return quality;
}

double GraspEnergy::wrench_energy(const std::vector<ContactApproach>& approaches) const {
  WeakDirections none;
  return wrench_energy(approaches, std::numeric_limits<double>::infinity(), none, 0);
}

double GraspEnergy::wrench_energy(const std::vector<ContactApproach>& approaches, double threshold,
                                  WeakDirections& weak, int most_expansions) const {
  for (const Vec6& u : weak.all()) {
    const double h = reach(approaches, u);
    if (h <= 0.0) return contact_energy(approaches);
    if (-100.0 * h >= threshold) return -100.0 * h;
  }
  thread_local std::vector<Vec6> wrenches;
  wrenches.clear();
  for (std::size_t i = 0; i < approaches.size(); ++i) {
    const double weight = 1.0 - approaches[i].delta(alpha_);
    if (weight <= 0.0) continue;
    const std::size_t first = wrenches.size();
    append_edge_wrenches({approaches[i].p_OC, approaches[i].n_OC, friction_[i], 0.0}, wrench_space_,
                         wrenches);
    for (std::size_t k = first; k < wrenches.size(); ++k) wrenches[k] *= weight;
  }
  const RoughEpsilon rough{std::max(0.0, -0.01 * threshold), most_expansions};
  const WrenchSpaceQuality quality = estimate_epsilon(wrenches, wrench_space_.epsilon_min, rough);
  if (!quality.weakest.isZero()) weak.add(quality.weakest);
  return quality.form_closure ? -100.0 * quality.epsilon : contact_energy(approaches);
}

/// How far the wrench space of eq. (8) reaches in a direction, with true friction cones: at least as far as
/// with their edges.
double GraspEnergy::reach(const std::vector<ContactApproach>& approaches, const Vec6& u) const {
  double h = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < approaches.size(); ++i) {
    const ContactApproach& a = approaches[i];
    const double weight = 1.0 - a.delta(alpha_);
    if (weight <= 0.0) continue;
    const Vec3 arm = (a.p_OC - wrench_space_.torque_origin_O) / wrench_space_.torque_scale;
    const Vec3 g = u.head<3>() + u.tail<3>().cross(arm);
    const double along = g.dot(a.n_OC);
    const double across = std::sqrt(std::max(0.0, g.squaredNorm() - along * along));
    h = std::max(h, weight * (along + friction_[i] * across));
  }
  return h;
}

double GraspEnergy::evaluate(const std::vector<Pose>& X_OL, DistanceSource source,
                             std::vector<ContactApproach>& scratch) const {
  approach(X_OL, source, scratch);
  return kind_ == EnergyKind::wrench ? wrench_energy(scratch) : contact_energy(scratch);
}

}  // namespace eigengrasp
