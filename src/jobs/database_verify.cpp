// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/jobs/database_verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/kinematics/forward_kinematics.hpp"
#include "eigengrasp/planning/finger_closing.hpp"
#include "eigengrasp/planning/grasp_energy.hpp"
#include "eigengrasp/planning/pregrasp_rating.hpp"

namespace eigengrasp {

namespace {

constexpr double same_joint = 1e-3;    // [rad or m]
constexpr double same_place = 2e-4;    // [m]
constexpr double same_epsilon = 1e-3;  // and a hundredth of it

/// Why a grasp does not come out again; empty where it does.
std::string difference(const CollisionModel& model, const Grasp& g) {
  const HandModel& hand = *model.scene().hand;
  std::vector<Pose> X_OL;
  compute_link_poses(hand, joint_values(hand, g.pregrasp_dofs), g.X_OH_pregrasp, X_OL);
  if (const Legality legality = model.check_exact(X_OL); legality != Legality::legal)
    return fmt::format("the pre-grasp {}", describe(legality));
  const ClosedHand closed = close_fingers(model, g.X_OH_pregrasp, g.pregrasp_dofs);
  const double off = (closed.dofs - g.grasp_dofs).cwiseAbs().maxCoeff();
  if (!(off <= same_joint)) return fmt::format("closing ends {:.3g} rad from the stored posture", off);
  const auto contacts = find_contacts(model, closed.X_OL, {}, &closed.proximity);
  std::vector<ContactPoint> points;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    points.push_back(contacts[i].point);
    if (contacts.size() != g.contacts.size()) continue;  // a point more or less shows in epsilon
    const double shift = (contacts[i].point.p_OC - g.contacts[i].point.p_OC).norm();
    if (!(shift <= same_place)) return fmt::format("contact {} lies {:.3g} m from the stored one", i, shift);
  }
  const GraspEnergy energy(model, {});
  const WrenchSpaceQuality quality = compute_epsilon(points, energy.wrench_space());
  if (!(std::abs(quality.epsilon - g.epsilon) <= same_epsilon + 0.01 * g.epsilon))
    return fmt::format("has epsilon {:.6g}, stored is {:.6g}", quality.epsilon, g.epsilon);
  if (quality.form_closure != g.form_closure)
    return quality.form_closure ? "is form-closed, stored is that it is not"
                                : "is not form-closed, stored is that it is";
  return {};
}

bool is_ours(const Grasp& g, const HandModel& hand) {
  return g.pregrasp_dofs.size() == hand.n_dof() && g.grasp_dofs.size() == hand.n_dof() &&
         !g.grasp_joints.empty();
}

/// The same scene without distance fields.
std::unique_ptr<const CollisionModel> without_fields(const CollisionModel& model, const PreparedHand& hand) {
  CollisionModel::Options options;
  options.fast = false;
  options.threads = 1;
  return std::make_unique<const CollisionModel>(model.scene(), options,
                                                CollisionModel::Prepared{hand.surfaces, {}});
}

class Verification {
 public:
  Verification(GraspStore& store, const VerifyOptions& options) : store_(store), options_(options) {
    for (const auto& hand : options.hands)
      hands_.push_back(prepare_hand(hand, options.threads, options.cache.get()));
  }

  VerifyReport run();

 private:
  void verify_object(const StoredModel& model, VerifyReport& report);
  void verify_with(const PreparedHand& hand, const StoredModel& model,
                   std::unique_ptr<PreparedObject>& object, VerifyReport& report);

  GraspStore& store_;
  const VerifyOptions& options_;
  std::vector<PreparedHand> hands_;
};

void Verification::verify_with(const PreparedHand& hand, const StoredModel& model,
                               std::unique_ptr<PreparedObject>& object, VerifyReport& report) {
  std::unique_ptr<const CollisionModel> collision, bare;
  double scale = 0.0;
  const std::vector<StoredGrasp> grasps = store_.grasps(model.name, hand.model->name);
  for (std::size_t i = 0; i < grasps.size(); i += static_cast<std::size_t>(options_.every)) {
    const Grasp& g = grasps[i].grasp;
    if (!is_ours(g, *hand.model)) {
      ++report.foreign;
      continue;
    }
    const UnitKey key{model.name, g.object_scale, hand.model->name};
    ++report.grasps;
    try {
      if (!object) object = std::make_unique<PreparedObject>(model);
      if (!collision || scale != g.object_scale) {
        collision = object->collision_model(hand, g.object_scale);
        bare = without_fields(*collision, hand);
      }
      scale = g.object_scale;
      const bool transferred = g.provenance.planner.starts_with(kTransferPlanner);
      if (std::string why = difference(transferred ? *bare : *collision, g); !why.empty())
        report.bad.push_back({key, grasps[i].id, std::move(why)});
    } catch (const Error& e) {
      report.bad.push_back({key, grasps[i].id, e.what()});
    }
  }
}

void Verification::verify_object(const StoredModel& model, VerifyReport& report) {
  std::unique_ptr<PreparedObject> object;
  for (const PreparedHand& hand : hands_) verify_with(hand, model, object, report);
}

VerifyReport Verification::run() {
  std::vector<StoredModel> models = store_.models();
  if (!options_.objects.empty())
    std::erase_if(models, [&](const StoredModel& m) {
      return std::find(options_.objects.begin(), options_.objects.end(), m.name) == options_.objects.end();
    });
  std::vector<VerifyReport> reports(models.size());
  std::mutex telling;
  std::size_t n_done = 0;
  parallel_for(models.size(), options_.threads, [&](std::size_t i, int) {
    if (options_.stop != nullptr && options_.stop->stop_requested()) return;
    verify_object(models[i], reports[i]);
    const std::scoped_lock lock(telling);
    ++n_done;
    if (options_.progress)
      options_.progress(static_cast<double>(n_done) / static_cast<double>(models.size()));
  });
  VerifyReport all;
  all.stopped = n_done < models.size();
  for (const VerifyReport& r : reports) {
    all.grasps += r.grasps;
    all.foreign += r.foreign;
    all.bad.insert(all.bad.end(), r.bad.begin(), r.bad.end());
  }
  return all;
}

}  // namespace

VerifyReport verify_grasps(GraspStore& store, const VerifyOptions& options) {
  if (options.every < 1) fail("every is {}, expected 1 or more", options.every);
  return Verification(store, options).run();
}

}  // namespace eigengrasp
