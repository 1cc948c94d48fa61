// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/planning/grasp_energy.hpp"

#include <cmath>
#include <limits>

#include "eigengrasp/contact/material.hpp"

namespace eigengrasp {

namespace {

/// The friction cones of the virtual contacts that count, scaled as eq. (8) does; coordinate by coordinate,
/// for vector registers.
struct ScaledCones {
  enum Row { weight, friction, n_x, n_y, n_z, arm_x, arm_y, arm_z, n_rows };
  std::size_t size = 0;
  std::vector<double> rows[n_rows];
  std::vector<double> reaches;

  void assign(const std::vector<ContactApproach>& approaches, const std::vector<double>& frictions,
              double alpha, const WrenchSpaceOptions& options) {
    size = 0;
    for (std::vector<double>& row : rows) row.resize(approaches.size());
    reaches.resize(approaches.size());
    for (std::size_t i = 0; i < approaches.size(); ++i) {
      const ContactApproach& a = approaches[i];
      const double scale = 1.0 - a.delta(alpha);
      if (scale <= 0.0) continue;
      const Vec3 arm = (a.p_OC - options.torque_origin_O) / options.torque_scale;
      const double values[n_rows] = {scale,      frictions[i], a.n_OC.x(), a.n_OC.y(),
                                     a.n_OC.z(), arm.x(),      arm.y(),    arm.z()};
      for (std::size_t k = 0; k < n_rows; ++k) rows[k][size] = values[k];
      ++size;
    }
  }

  /// How far the wrench space reaches in a direction, with true friction cones: at least as far as with their
  /// edges.
  double reach(const Vec6& u) {
    const auto row = [&](Row r) { return rows[r].data(); };
    const double *w = row(weight), *mu = row(friction), *nx = row(n_x), *ny = row(n_y), *nz = row(n_z),
                 *ax = row(arm_x), *ay = row(arm_y), *az = row(arm_z);
    double* out = reaches.data();
    for (std::size_t i = 0; i < size; ++i) {
      const double gx = u[0] + (u[4] * az[i] - u[5] * ay[i]);
      const double gy = u[1] + (u[5] * ax[i] - u[3] * az[i]);
      const double gz = u[2] + (u[3] * ay[i] - u[4] * ax[i]);
      const double along = gx * nx[i] + gy * ny[i] + gz * nz[i];
      const double across2 = gx * gx + gy * gy + gz * gz - along * along;
      out[i] = w[i] * (along + mu[i] * std::sqrt(across2 > 0.0 ? across2 : 0.0));
    }
    double h = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < size; ++i) h = std::max(h, out[i]);
    return h;
  }
};

}  // namespace

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
  thread_local ScaledCones cones;
  if (!weak.all().empty()) cones.assign(approaches, friction_, alpha_, wrench_space_);
  for (const Vec6& u : weak.all()) {
    const double h = cones.reach(u);
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

double GraspEnergy::evaluate(const std::vector<Pose>& X_OL, DistanceSource source,
                             std::vector<ContactApproach>& scratch) const {
  approach(X_OL, source, scratch);
  return kind_ == EnergyKind::wrench ? wrench_energy(scratch) : contact_energy(scratch);
}

}  // namespace eigengrasp
