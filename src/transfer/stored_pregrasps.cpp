// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/transfer/stored_pregrasps.hpp"

#include <algorithm>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/database/graspable_size.hpp"
#include "eigengrasp/jobs/prepared_parts.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/kinematics/hand_parts.hpp"

namespace eigengrasp {

std::vector<double> bracketing_scales(double radius, double neighbor_radius,
                                      const std::vector<double>& scales) {
  const auto larger =
      std::find_if(scales.begin(), scales.end(), [&](double s) { return s * neighbor_radius > radius; });
  std::vector<double> used;
  if (larger != scales.begin()) used.push_back(*std::prev(larger));
  if (larger != scales.end()) used.push_back(*larger);
  std::erase_if(used, [&](double s) {
    const double ratio = s * neighbor_radius / radius;
    return ratio > kMostSizeRatio || ratio < 1.0 / kMostSizeRatio;
  });
  return used;
}

Pose neighbor_pose(const Alignment& alignment, double scale) {
  Pose X_ON = Pose::Identity();
  X_ON.linear() = alignment.R;
  X_ON.translation() = alignment.center_target - scale * (alignment.R * alignment.center_model);
  return X_ON;
}

VecX posture_of_other_hand(const HandModel& from, const VecX& amplitudes, const HandModel& to) {
  const EigengraspSpace& source = from.eigengrasps;
  const EigengraspSpace& target = to.eigengrasps;
  VecX mapped = VecX::Zero(target.size());
  const auto common = std::min<Eigen::Index>({amplitudes.size(), source.size(), target.size()});
  for (Eigen::Index i = 0; i < common; ++i) {
    const Eigengrasp& a = source[static_cast<int>(i)];
    const Eigengrasp& b = target[static_cast<int>(i)];
    const double from_end = amplitudes[i] < 0.0 ? a.min : a.max;
    const double to_end = amplitudes[i] < 0.0 ? b.min : b.max;
    mapped[i] = from_end == 0.0 ? 0.0 : amplitudes[i] / from_end * to_end;
  }
  return clamp_posture(to, target.embed(mapped));
}

TransferTarget::TransferTarget(const TransferStore& store, const ObjectModel& object)
    : store_(store),
      shape_(object.seen ? make_alignment_shape(object.mesh, *object.seen)
                         : make_alignment_shape(object.mesh)),
      radius_(approximate_radius(object.mesh, object.center_of_mass)) {}

namespace {

/// Those that can be brought over, the highest epsilon first.
std::vector<StoredGrasp> usable_grasps(GraspStore& store, const std::string& model, const HandModel& hand) {
  std::vector<StoredGrasp> grasps = store.grasps(model, hand.name);
  std::erase_if(grasps, [&](const StoredGrasp& g) {
    return !g.grasp.form_closure || g.grasp.pregrasp_dofs.size() != hand.n_dof();
  });
  std::stable_sort(grasps.begin(), grasps.end(), [](const StoredGrasp& a, const StoredGrasp& b) {
    return a.grasp.epsilon > b.grasp.epsilon;
  });
  return grasps;
}

/// A scan is laid upon the neighbour, with what was seen of it alone.
Alignment aligned(const AlignmentShape& neighbor, const AlignmentShape& object, const std::string& method) {
  if (method == kIcpAlignment && !object.seen.empty()) {
    AlignmentOptions options;
    options.one_sided = true;
    return inverse(align_by_icp(object, neighbor, options));
  }
  return method == kIcpAlignment ? align_by_icp(neighbor, object) : align_by_pca(neighbor, object);
}

}  // namespace

std::vector<TransferTarget::Chosen> TransferTarget::choose(const std::vector<RankedNeighbor>& ranked,
                                                           const HandPair& hands, std::size_t count) const {
  std::vector<Chosen> chosen;
  for (const RankedNeighbor& neighbor : ranked) {
    if (chosen.size() == count) break;
    std::vector<StoredGrasp> grasps = usable_grasps(store_.store(), neighbor.model->name, *hands.from);
    if (!grasps.empty()) chosen.push_back({neighbor, std::move(grasps)});
  }
  return chosen;
}

void TransferTarget::align(const std::vector<Chosen>& chosen, const CandidateOptions& options) {
  std::vector<const StoredModel*> missing;
  for (const Chosen& c : chosen)
    if (!alignments_.contains({options.alignment, c.neighbor.model->name}))
      missing.push_back(c.neighbor.model);
  std::vector<std::optional<Alignment>> made(missing.size());
  parallel_for(missing.size(), options.threads, [&](std::size_t i, int) {
    try {
      made[i] = aligned(make_alignment_shape(load_stored_mesh(*missing[i])), shape_, options.alignment);
    } catch (const Error&) {  // gone since, or changed
    }
  });
  for (std::size_t i = 0; i < missing.size(); ++i)
    alignments_[{options.alignment, missing[i]->name}] = std::move(made[i]);
}

void TransferTarget::add(const Chosen& chosen, const HandPair& hands, const CandidateOptions& options,
                         Candidates& candidates) const {
  const StoredModel& model = *chosen.neighbor.model;
  const Alignment& alignment = *alignments_.at({options.alignment, model.name});
  UsedNeighbor used{model.name, chosen.neighbor.distance, model.approximate_radius, {}, alignment, 0};
  std::vector<double> scales;
  for (const double scale : model.scales)
    if (std::any_of(chosen.grasps.begin(), chosen.grasps.end(),
                    [&](const StoredGrasp& g) { return g.grasp.object_scale == scale; }))
      scales.push_back(scale);
  used.scales = bracketing_scales(radius_, model.approximate_radius, scales);
  const bool same_hand = hands.from == hands.to;
  const Pose X_FH =
      same_hand ? Pose::Identity() : approach_frame(*hands.from) * approach_frame(*hands.to).inverse();
  for (const double scale : used.scales) {
    const Pose X_ON = neighbor_pose(alignment, scale);
    int taken = 0;
    for (const StoredGrasp& g : chosen.grasps) {
      if (g.grasp.object_scale != scale || (options.most > 0 && taken == options.most)) continue;
      ++taken;
      candidates.given.push_back({X_ON * g.grasp.X_OH_pregrasp * X_FH,
                                  same_hand
                                      ? g.grasp.pregrasp_dofs
                                      : posture_of_other_hand(*hands.from, g.grasp.amplitudes, *hands.to)});
      candidates.origins.push_back({candidates.neighbors.size(), g.grasp});
    }
    used.candidates += taken;
  }
  candidates.neighbors.push_back(std::move(used));
}

Candidates TransferTarget::find_candidates(const std::vector<RankedNeighbor>& ranked, const HandPair& hands,
                                           const CandidateOptions& options) {
  const auto wanted = static_cast<std::size_t>(options.neighbors);
  std::vector<RankedNeighbor> left = ranked;
  for (;;) {
    const std::vector<Chosen> chosen = choose(left, hands, wanted);
    if (chosen.empty())
      fail(
          "{}: holds no form-closed grasps with the hand '{}' for any of {} objects; 'eigengrasp db build' "
          "plans them",
          store_.store().place(), hands.from->name, ranked.size());
    align(chosen, options);
    const auto lost = [&](const std::string& name) {
      const auto known = alignments_.find({options.alignment, name});
      return known != alignments_.end() && !known->second;
    };
    if (std::erase_if(left, [&](const RankedNeighbor& n) { return lost(n.model->name); }) > 0) continue;
    Candidates candidates;
    for (const Chosen& c : chosen) add(c, hands, options, candidates);
    return candidates;
  }
}

}  // namespace eigengrasp
