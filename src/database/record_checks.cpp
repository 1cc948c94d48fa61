// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/record_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

const char* to_string(UnitState state) {
  switch (state) {
    case UnitState::waiting:
      return "waiting";
    case UnitState::claimed:
      return "claimed";
    case UnitState::done:
      return "done";
    default:
      return "failed";
  }
}

std::string scaled_model_name(const std::string& model, double scale) {
  const auto bar = model.rfind('_');
  const bool numbered = bar != std::string::npos && bar > 0 && bar + 1 < model.size() &&
                        model.find_first_not_of("0123456789", bar + 1) == std::string::npos;
  if (!numbered) return fmt::format("{}_{}", model, scale);
  return fmt::format("{}_{}{}", model.substr(0, bar), scale, model.substr(bar));
}

std::string describe(const UnitKey& key) {
  return fmt::format("{} at scale {} with {}", key.object, key.scale, key.hand);
}

namespace {

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; });
}

/// Decodes UTF-8 far enough to tell whether every character is whole.
bool is_utf8(const std::string& text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int more = lead < 0x80                     ? 0
                     : (lead >= 0xC2 && lead < 0xE0) ? 1
                     : (lead >= 0xE0 && lead < 0xF0) ? 2
                     : (lead >= 0xF0 && lead < 0xF5) ? 3
                                                     : -1;
    if (more < 0) return false;
    for (int k = 1; k <= more; ++k)
      if (i + static_cast<std::size_t>(k) >= text.size() ||
          (static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]) & 0xC0) != 0x80)
        return false;
    i += static_cast<std::size_t>(more) + 1;
  }
  return true;
}

void require_text(const std::string& text, const char* what) {
  if (has_control_character(text) || !is_utf8(text))
    fail("{} holds control characters or is not UTF-8; expected one line of plain text", what);
}

void require_finite(double value, const char* what, const std::string& whose) {
  if (!std::isfinite(value)) fail("{} of {} is {}, expected a finite number", what, whose, value);
}

void require_finite(const NamedValues& values, const char* what, const std::string& whose) {
  for (const auto& [name, value] : values) {
    require_text(name, "a joint's name");
    require_finite(value, what, whose);
  }
}

void require_finite(const Grasp& g, const std::string& whose) {
  if (!g.X_OH.matrix().allFinite() || !g.X_OH_pregrasp.matrix().allFinite())
    fail("the pose of {} is not finite, expected finite numbers", whose);
  if (!g.pregrasp_dofs.allFinite() || !g.grasp_dofs.allFinite() || !g.amplitudes.allFinite())
    fail("the posture of {} is not finite, expected finite numbers", whose);
  require_finite(g.pregrasp_joints, "a joint of the pre-grasp", whose);
  require_finite(g.grasp_joints, "a joint", whose);
  for (const GraspContact& c : g.contacts) {
    require_text(c.link, "a link's name");
    if (!c.point.p_OC.allFinite() || !c.point.n_OC.allFinite())
      fail("a contact of {} is not finite, expected finite numbers", whose);
    require_finite(c.point.mu, "mu of a contact", whose);
    require_finite(c.point.torsion_length, "the torsion length of a contact", whose);
  }
  for (const double value : {g.energy, g.epsilon, g.volume, g.max_penetration})
    require_finite(value, "energy, epsilon, volume or penetration", whose);
  for (const std::string* text : {&g.provenance.planner, &g.provenance.options_digest, &g.provenance.version})
    require_text(*text, "the provenance of a grasp");
}

}  // namespace

void require_name(const std::string& name, const char* what) {
  if (name.empty() || name.size() > 200)
    fail("the name of {} has {} bytes, expected 1 to 200", what, name.size());
  require_text(name, fmt::format("the name of {}", what).c_str());
}

void require_sound(const StoredModel& m) {
  require_name(m.name, "an object");
  require_text(m.geometry_path, "a geometry path");
  require_text(m.thumbnail_path, "a thumbnail path");
  require_text(m.content_hash, "a content hash");
  for (const std::string& tag : m.tags) require_text(tag, "a tag");
  if (!(m.rescale > 0.0) || !std::isfinite(m.rescale))
    fail("the rescale factor of object '{}' is {}, expected more than 0", m.name, m.rescale);
  require_finite(m.approximate_radius, "the approximate radius", m.name);
  if (m.scales.empty()) fail("object '{}' has no scale, expected at least one", m.name);
  for (std::size_t i = 0; i < m.scales.size(); ++i)
    if (!(m.scales[i] > (i == 0 ? 0.0 : m.scales[i - 1])) || !std::isfinite(m.scales[i]))
      fail("the scales of object '{}' hold {}, expected ascending numbers above 0", m.name, m.scales[i]);
}

void require_sound(const StoredHand& hand) {
  require_name(hand.name, "a hand");
  for (const auto* names : {&hand.joints, &hand.dofs, &hand.links})
    for (const std::string& name : *names) require_text(name, "a name of a hand");
}

void require_sound(const UnitKey& key, const std::vector<StoredGrasp>& grasps) {
  for (const StoredGrasp& g : grasps) {
    if (g.grasp.object != key.object || g.grasp.hand != key.hand || g.grasp.object_scale != key.scale)
      fail("a grasp is of {}, expected the unit's: {}",
           describe({g.grasp.object, g.grasp.object_scale, g.grasp.hand}), describe(key));
    require_finite(g.grasp, describe(key));
  }
}

void require_sound(const UnitResult& r) {
  if (r.state != UnitState::done && r.state != UnitState::failed)
    fail("the outcome of {} is '{}', expected done or failed", describe(r.key), to_string(r.state));
  require_text(r.reason, "a reason");
  require_text(r.worker, "a worker's name");
  require_finite(r.seconds, "the time", describe(r.key));
  require_sound(r.key, r.grasps);
}

void require_sound(const StoredDescriptor& d) {
  require_name(d.function, "a descriptor's function");
  require_text(d.route, "a descriptor's route");
  if (!d.center.allFinite()) fail("the centre of the descriptor of '{}' is not finite", d.model);
  if (!(d.radius > 0.0) || !std::isfinite(d.radius))
    fail("the radius of the descriptor of '{}' is {} m, expected more than 0", d.model, d.radius);
  for (const double value : d.invariants) require_finite(value, "an invariant of the descriptor", d.model);
}

void require_sound(const StoredNeighbor& n) {
  require_name(n.distance_function, "a distance function");
  require_finite(n.distance, "the distance of a neighbour", n.model);
}

void require_sound(const StoredAlignment& a) {
  require_name(a.method, "an alignment method");
  if (!a.X_target_model.allFinite()) fail("the alignment of '{}' to '{}' is not finite", a.model, a.target);
}

void require_claim(const std::string& worker, double lease_seconds) {
  require_name(worker, "a worker");
  if (!std::isfinite(lease_seconds)) fail("the lease is {} s, expected a finite number", lease_seconds);
}

void require_same(const StoredModel& there, const StoredModel& added) {
  StoredModel with_scales = added;
  with_scales.scales = there.scales;
  if (there == with_scales) return;
  if (there.content_hash != added.content_hash)
    fail("object '{}' is in the store already, with another geometry ({}); give one of them another name",
         added.name, there.geometry_path);
  fail("object '{}' is in the store already, with another path, thumbnail, size or tags; expected the same",
       added.name);
}

void require_same(const StoredHand& there, const StoredHand& added) {
  if (there != added)
    fail("hand '{}' is in the store already, with other joints or links; give one of them another name",
         added.name);
}

void require_same(const GraspSource& there, const GraspSource& added) {
  if (there != added)
    fail("source '{}' is in the store already as \"{}\"; give one of them another name", added.name,
         there.description);
}

}  // namespace eigengrasp
