// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "planning/state_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "eigengrasp/core/parallel.hpp"
#include "planning/kernel_workspace.hpp"

namespace eigengrasp {

namespace {

kernel::Transform transform_of(const Pose& X) {
  kernel::Transform t;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.R[3 * i + j] = static_cast<float>(X.linear()(i, j));
    t.p[i] = static_cast<float>(X.translation()[i]);
  }
  return t;
}

void put(const Vec3& v, float out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

/// Rotation that takes z to the axis.
Mat3 turn_z_to(const Vec3& axis) {
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
}

/// Appends the words of a grid, see kernel::FieldView. @return what a bit of a distance stands for
double add_words(const FieldGrid& grid, std::vector<std::int32_t>& words) {
  float most = std::numeric_limits<float>::min();
  for (const float value : grid.values) most = std::max(most, std::abs(value));
  constexpr int largest = 32767;
  const double quantum = static_cast<double>(most) / largest;
  const auto rounded = [&](std::size_t node) {
    const long n = std::lround(static_cast<double>(grid.values[node]) / quantum);
    return static_cast<std::uint16_t>(static_cast<std::int16_t>(n));
  };
  const auto layer = static_cast<std::size_t>(grid.nodes.x() * grid.nodes.y());
  for (std::size_t node = 0; node < grid.values.size(); ++node) {
    const std::size_t next = node + layer < grid.values.size() ? node + layer : node;
    words.push_back(
        static_cast<std::int32_t>(rounded(node) | static_cast<std::uint32_t>(rounded(next)) << 16));
  }
  return quantum;
}

kernel::GridView grid_view(const FieldGrid& grid, double scale, double quantum, std::size_t first) {
  kernel::GridView v;
  put(scale * grid.origin, v.origin);
  for (int i = 0; i < 3; ++i) v.last[i] = static_cast<float>(grid.nodes[i] - 1);
  v.cell = static_cast<float>(scale * grid.cell);
  v.inverse_cell = static_cast<float>(1.0 / (scale * grid.cell));
  v.quantum = static_cast<float>(scale * quantum / 65536.0);
  v.row = static_cast<float>(grid.nodes.x());
  v.layer = static_cast<float>(grid.nodes.x() * grid.nodes.y());
  v.first = static_cast<float>(first);
  return v;
}

}  // namespace

StateProgram::StateProgram(const CollisionModel& model, const EigengraspSpace& postures, double alpha) {
  const Scene& scene = model.scene();
  const HandModel& hand = *scene.hand;
  add_postures(hand, postures);
  add_bodies(hand);
  part_of_link_.assign(hand.links.size(), -1);
  for (int i = 0; i < hand.n_links(); ++i)
    if (!model.surfaces().links[static_cast<std::size_t>(i)].empty()) add_part(model, i);
  add_pairs(hand);
  add_contacts(hand);
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k)
    obstacles_.push_back({view(model.obstacle_field(k)), transform_of(scene.obstacles[k].X_OB.inverse())});

  program_.n_dofs = hand.n_dof();
  program_.n_amplitudes = postures.size();
  program_.n_bodies = static_cast<int>(bodies_.size());
  program_.n_parts = static_cast<int>(parts_.size());
  program_.n_pairs = static_cast<int>(pairs_.size());
  program_.n_contacts = static_cast<int>(contacts_.size());
  program_.n_obstacles = static_cast<int>(obstacles_.size());
  program_.origin = origin_.data();
  program_.basis = basis_.data();
  program_.dof_min = dof_min_.data();
  program_.dof_max = dof_max_.data();
  put(hand.approach_point_H, program_.approach_point);
  program_.bodies = bodies_.data();
  program_.parts = parts_.data();
  program_.n_cores = packs_.n_cores();
  program_.cores = packs_.cores();
  program_.core_packs = packs_.core_packs();
  program_.clusters = packs_.clusters();
  program_.balls = packs_.balls();
  program_.pairs = pairs_.data();
  program_.contacts = contacts_.data();
  program_.object = {view(model.object_field()), transform_of(Pose::Identity())};
  program_.obstacles = obstacles_.data();
  program_.refuse_depth = static_cast<float>(model.options().refuse_depth);
  program_.alpha = static_cast<float>(alpha);
}

void StateProgram::add_postures(const HandModel& hand, const EigengraspSpace& postures) {
  const auto to_floats = [](const VecX& v) {
    const Eigen::VectorXf f = v.cast<float>();
    return std::vector<float>(f.data(), f.data() + f.size());
  };
  origin_ = to_floats(postures.origin());
  dof_min_ = to_floats(hand.dof_min());
  dof_max_ = to_floats(hand.dof_max());
  for (int d = 0; d < hand.n_dof(); ++d)
    for (int i = 0; i < postures.size(); ++i) basis_.push_back(static_cast<float>(postures.basis()(d, i)));
}

void StateProgram::add_bodies(const HandModel& hand) {
  body_of_link_.assign(hand.links.size(), 0);
  X_BL_.assign(hand.links.size(), Pose::Identity());
  bodies_.push_back({-1, -1, false, 0.0f, 0.0f, transform_of(Pose::Identity())});
  for (std::size_t j = 0; j < hand.joints.size(); ++j) {
    const HandJoint& joint = hand.joints[j];
    const auto parent = static_cast<std::size_t>(joint.parent_link);
    const Pose X_BJ = X_BL_[parent] * joint.X_PJ;
    if (joint.type == JointType::fixed) {
      body_of_link_[j + 1] = body_of_link_[parent];
      X_BL_[j + 1] = X_BJ;
      continue;
    }
    Pose turn = Pose::Identity();
    turn.linear() = turn_z_to(joint.axis_J);
    body_of_link_[j + 1] = static_cast<int>(bodies_.size());
    X_BL_[j + 1] = turn.inverse();
    bodies_.push_back({body_of_link_[parent], joint.dof, joint.type == JointType::prismatic,
                       static_cast<float>(joint.ratio), static_cast<float>(joint.offset),
                       transform_of(X_BJ * turn)});
  }
}

void StateProgram::add_part(const CollisionModel& model, int link) {
  const auto i = static_cast<std::size_t>(link);
  const auto& surface = model.surfaces().links[i];
  kernel::Part part{};
  part.body = body_of_link_[i];
  put(X_BL_[i] * surface.bound.center, part.center);
  part.reach = static_cast<float>(surface.bound.radius);
  part.body_in_link = transform_of(X_BL_[i].inverse());
  part.field = view(surface.field);
  add_balls(surface, X_BL_[i], part);
  part_of_link_[i] = static_cast<int>(parts_.size());
  parts_.push_back(part);
}

void StateProgram::add_balls(const HandSurfaces::LinkSurface& surface, const Pose& X_BL, kernel::Part& part) {
  std::vector<Sphere> balls = surface.inner_spheres;
  for (Sphere& s : balls) s.center = X_BL * s.center;
  packs_.add(std::move(balls), part);
}

// The part with fewer balls is looked up in the field of the other.
void StateProgram::add_pairs(const HandModel& hand) {
  for (const auto& [a, b] : hand.collision_pairs) {
    const int pa = part_of_link_[static_cast<std::size_t>(a)];
    const int pb = part_of_link_[static_cast<std::size_t>(b)];
    if (pa < 0 || pb < 0) continue;
    const bool fewer =
        parts_[static_cast<std::size_t>(pa)].n_cores <= parts_[static_cast<std::size_t>(pb)].n_cores;
    pairs_.push_back(fewer ? kernel::Pair{pa, pb} : kernel::Pair{pb, pa});
  }
}

void StateProgram::add_contacts(const HandModel& hand) {
  for (const VirtualContact& c : hand.virtual_contacts) {
    const Pose& X_BL = X_BL_[static_cast<std::size_t>(c.link)];
    kernel::Contact contact{};
    contact.body = body_of_link_[static_cast<std::size_t>(c.link)];
    put(X_BL * c.p_LC, contact.p);
    put(X_BL.linear() * c.n_LC, contact.n);
    contacts_.push_back(contact);
  }
}

void StateProgram::add_posture_grid(const EigengraspSpace& postures, const kernel::Functions& functions,
                                    int threads) {
  if (postures.size() < 1 || postures.size() > 2 || pairs_.empty()) return;
  constexpr int most_nodes = 65;
  kernel::PostureGrid grid{};
  double step[2] = {1.0, 1.0};
  for (int i = 0; i < 2; ++i) {
    grid.nodes[i] = i < postures.size() ? most_nodes : 1;
    if (i >= postures.size()) continue;
    const double range = std::max(postures[i].max - postures[i].min, 1e-6);
    step[i] = range / (most_nodes - 1);
    grid.low[i] = static_cast<float>(postures[i].min);
    grid.per_amplitude[i] = static_cast<float>(1.0 / step[i]);
  }
  const std::size_t n_nodes =
      static_cast<std::size_t>(grid.nodes[0]) * static_cast<std::size_t>(grid.nodes[1]);
  posture_clearance_.assign(n_nodes, 0.0f);
  parallel_for((n_nodes + kernel::n_lanes - 1) / kernel::n_lanes, threads, [&](std::size_t batch, int) {
    const KernelWorkspace memory(program_);
    const kernel::Workspace& work = memory.work();
    const auto node_of = [&](int lane) {
      return std::min(batch * kernel::n_lanes + static_cast<std::size_t>(lane), n_nodes - 1);
    };
    for (int lane = 0; lane < kernel::n_lanes; ++lane) {
      const int node = static_cast<int>(node_of(lane));
      const int place[2] = {node % grid.nodes[0], node / grid.nodes[0]};
      for (int i = 0; i < postures.size(); ++i)
        work.amplitudes[i * kernel::n_lanes + lane] =
            static_cast<float>(postures[i].min + place[i] * step[i]);
    }
    functions.clear_itself(program_, work);
    for (int lane = 0; lane < kernel::n_lanes; ++lane) posture_clearance_[node_of(lane)] = work.energy[lane];
  });
  grid.clearance = posture_clearance_.data();
  program_.postures = grid;
}

kernel::FieldView StateProgram::view(const DistanceField& field) {
  if (field.empty()) throw std::logic_error("the collision model was prepared without distance fields");
  const FieldGrid& fine = field.fine();
  const FieldGrid& coarse = field.coarse();
  if (fine.values.size() + coarse.values.size() > kernel::most_words)
    throw std::logic_error("a distance field has too many nodes to be searched");
  std::vector<std::int32_t>& words = field_words_.emplace_back();
  words.reserve(fine.values.size() + coarse.values.size());
  const double fine_quantum = add_words(fine, words);
  const double coarse_quantum = add_words(coarse, words);
  return {words.data(), grid_view(fine, field.scale(), fine_quantum, 0),
          grid_view(coarse, field.scale(), coarse_quantum, fine.values.size())};
}

}  // namespace eigengrasp
