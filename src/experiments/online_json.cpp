// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include <cmath>

#include "eigengrasp/experiments/online_trial.hpp"
#include "experiments/record_json.hpp"

namespace eigengrasp {

namespace {

/// Seconds; null where there are none.
OrderedJson seconds_json(const std::vector<double>& seconds) {
  OrderedJson json = OrderedJson::array();
  for (const double s : seconds) json.push_back(std::isfinite(s) ? OrderedJson(s) : OrderedJson(nullptr));
  return json;
}

OrderedJson scene_json(const OnlineSceneTrial& scene) {
  OrderedJson json{{"hand", scene.hand},
                   {"object", scene.object},
                   {"postures_per_second", scene.postures_per_second},
                   {"candidates_per_second", scene.candidates_per_second},
                   {"candidates", scene.candidates},
                   {"form_closed", scene.form_closed},
                   {"first_grasp_seconds", seconds_json(scene.first_grasp)},
                   {"approaches", OrderedJson::array()}};
  for (const OnlineApproach& a : scene.approaches)
    json["approaches"].push_back({{"clicked", a.clicked},
                                  {"form_closed", a.form_closed},
                                  {"epsilon", a.epsilon},
                                  {"seconds", a.seconds},
                                  {"directions", a.directions}});
  return json;
}

}  // namespace

std::string online_json(const OnlineReport& report) {
  OrderedJson json{{"format", "eigengrasp-online-bench"}, {"version", 1}};
  json.update(record_json(report.record));
  json["seed"] = report.options.seed;
  json["time_limit_seconds"] = report.options.time_limit;
  json["wire_latency_seconds"] = seconds_json(report.wire_latency);
  json["scenes"] = OrderedJson::array();
  for (const OnlineSceneTrial& scene : report.scenes) json["scenes"].push_back(scene_json(scene));
  return pretty_text(json);
}

}  // namespace eigengrasp
