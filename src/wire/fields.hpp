// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/wire/messages.hpp"
#include "eigengrasp/wire/replies.hpp"

/// The members of each struct of the wire, once for reading and writing: `f(name, member)` for each.
namespace eigengrasp::wire {

template <class F>
void fields(F& f, Hello& m) {
  f("protocol", m.protocol), f("role", m.role), f("token", m.token), f("session", m.session);
}
template <class F>
void fields(F& f, PlanStart::Options& m) {
  f("iterations", m.iterations), f("grasps", m.grasps), f("seed", m.seed), f("search", m.search);
  f("energy", m.energy), f("amplitudes", m.amplitudes), f("friction", m.friction);
}
template <class F>
void fields(F& f, PlanStart& m) {
  f("hand", m.hand), f("object", m.object), f("scale", m.scale), f("table", m.table), f("options", m.options);
}
template <class F>
void fields(F&, PlanStop&) {}
template <class F>
void fields(F& f, OnlineStart::Options& m) {
  f("seed", m.seed), f("amplitudes", m.amplitudes), f("cone_half_angle", m.cone_half_angle);
  f("look_ahead", m.look_ahead), f("step_back", m.step_back), f("epsilon_min", m.epsilon_min);
  f("preshape_begins", m.preshape_begins), f("friction", m.friction);
}
template <class F>
void fields(F& f, OnlineStart& m) {
  f("hand", m.hand), f("object", m.object), f("scale", m.scale), f("table", m.table), f("options", m.options);
}
template <class F>
void fields(F&, OnlineStop&) {}
template <class F>
void fields(F& f, Wrist& m) {
  f("time", m.time), f("pose", m.pose), f("session", m.session);
}
template <class F>
void fields(F& f, Target& m) {
  f("variable", m.variable), f("index", m.index), f("value", m.value), f("confidence", m.confidence);
}
template <class F>
void fields(F& f, Targets& m) {
  f("targets", m.targets), f("session", m.session);
}
template <class F>
void fields(F& f, Command& m) {
  f("command", m.command), f("session", m.session);
}
template <class F>
void fields(F& f, SolutionGet& m) {
  f("id", m.id);
}

template <class F>
void fields(F& f, Limits& m) {
  f("message_bytes", m.message_bytes), f("messages_per_second", m.messages_per_second);
  f("upload_bytes", m.upload_bytes), f("uploads", m.uploads);
}
template <class F>
void fields(F& f, Welcome& m) {
  f("program", m.program), f("version", m.version), f("protocol", m.protocol), f("role", m.role);
  f("session", m.session), f("limits", m.limits);
}
template <class F>
void fields(F& f, ErrorMessage& m) {
  f("code", m.code), f("message", m.message), f("of", m.of);
}
template <class F>
void fields(F& f, Contact& m) {
  f("point", m.point), f("normal", m.normal), f("friction", m.friction);
  f("torsion_length", m.torsion_length), f("link", m.link), f("patch", m.patch);
}
template <class F>
void fields(F& f, GraspShape& m) {
  f("form_closure", m.form_closure), f("epsilon", m.epsilon), f("volume", m.volume), f("energy", m.energy);
  f("max_penetration", m.max_penetration), f("closing", m.closing), f("contacts", m.contacts);
}
template <class F>
void fields(F& f, PlanStarted& m) {
  f("id", m.id), f("hand", m.hand), f("object", m.object);
}
template <class F>
void fields(F& f, PlanProgressMessage& m) {
  f("id", m.id), f("iterations", m.iterations), f("total", m.total), f("seconds", m.seconds);
  f("best_energy", m.best_energy);
}
template <class F>
void fields(F& f, PlanMilestone& m) {
  f("id", m.id), f("iteration", m.iteration), f("energy", m.energy), f("link_poses", m.link_poses);
}
template <class F>
void fields(F& f, PlanResultMessage::Counts& m) {
  f("states", m.states), f("legal", m.legal), f("tested", m.tested), f("form_closed", m.form_closed);
  f("not_closed", m.not_closed), f("no_contact", m.no_contact), f("penetrating", m.penetrating);
}
template <class F>
void fields(F& f, PlanResultMessage::Timings& m) {
  f("prepare", m.prepare), f("search", m.search), f("close", m.close), f("volume", m.volume);
  f("total", m.total);
}
template <class F>
void fields(F& f, PlanResultMessage& m) {
  f("id", m.id), f("status", m.status), f("stopped_early", m.stopped_early), f("explanation", m.explanation);
  f("grasps", m.grasps), f("counts", m.counts), f("timings", m.timings);
}
template <class F>
void fields(F& f, OnlineReady& m) {
  f("session", m.session), f("hand", m.hand), f("object", m.object), f("table_height", m.table_height);
  f("seconds", m.seconds);
}
template <class F>
void fields(F& f, OnlineStopped& m) {
  f("session", m.session);
}
template <class F>
void fields(F& f, OnlineSolution& m) {
  f("id", m.id), f("epsilon", m.epsilon), f("distance", m.distance), f("angle", m.angle);
  f("offset", m.offset), f("age", m.age);
}
template <class F>
void fields(F& f, View::Sample& m) {
  f("time", m.time), f("pose", m.pose);
}
template <class F>
void fields(F& f, View::Offer& m) {
  f("id", m.id), f("pregrasp", m.pregrasp), f("grasp", m.grasp);
}
template <class F>
void fields(F& f, View::Cone& m) {
  f("apex", m.apex), f("axis", m.axis), f("half_angle", m.half_angle), f("nearest", m.nearest);
  f("farthest", m.farthest);
}
template <class F>
void fields(F& f, OnlineRates& m) {
  f("postures_per_second", m.postures_per_second), f("candidates_per_second", m.candidates_per_second);
  f("postures", m.postures), f("candidates", m.candidates), f("form_closed", m.form_closed);
  f("time_to_first_grasp", m.time_to_first_grasp);
}
template <class F>
void fields(F& f, View& m) {
  f("frame", m.frame), f("time", m.time), f("phase", m.phase), f("wrist", m.wrist), f("blocked", m.blocked);
  f("link_poses", m.link_poses), f("preshape", m.preshape), f("offer", m.offer);
  f("solutions", m.solutions), f("cone", m.cone), f("rates", m.rates), f("epsilon_now", m.epsilon_now);
  f("server_ms", m.server_ms), f("message", m.message);
}
template <class F>
void fields(F& f, Closed& m) {
  f("grasp", m.grasp), f("message", m.message);
}
template <class F>
void fields(F& f, SolutionReply& m) {
  f("id", m.id), f("grasp", m.grasp);
}

template <class F>
void fields(F& f, HandEntry::Range& m) {
  f("name", m.name), f("min", m.min), f("max", m.max);
}
template <class F>
void fields(F& f, HandEntry& m) {
  f("name", m.name), f("title", m.title), f("n_dof", m.n_dof), f("n_links", m.n_links);
  f("eigengrasps", m.eigengrasps), f("links", m.links), f("rest", m.rest);
  f("approach_point", m.approach_point), f("approach_direction", m.approach_direction), f("reach", m.reach);
  f("dofs", m.dofs), f("amplitudes", m.amplitudes), f("uploaded", m.uploaded);
}
template <class F>
void fields(F& f, ObjectEntry& m) {
  f("name", m.name), f("title", m.title), f("triangles", m.triangles), f("size", m.size);
  f("center", m.center), f("uploaded", m.uploaded);
}
template <class F>
void fields(F& f, Status& m) {
  f("program", m.program), f("version", m.version), f("protocol", m.protocol);
  f("token_required", m.token_required), f("hands", m.hands), f("objects", m.objects);
  f("default_hand", m.default_hand), f("default_object", m.default_object), f("limits", m.limits);
  f("logs", m.logs);
}
template <class F>
void fields(F& f, UploadReply& m) {
  f("name", m.name), f("warnings", m.warnings);
}
template <class F>
void fields(F& f, ErrorReply& m) {
  f("error", m.error);
}
template <class F>
void fields(F& f, LogEntry& m) {
  f("name", m.name), f("bytes", m.bytes);
}
template <class F>
void fields(F& f, LogList& m) {
  f("logs", m.logs);
}

}  // namespace eigengrasp::wire
