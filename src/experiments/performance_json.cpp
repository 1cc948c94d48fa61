// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/performance.hpp"
#include "experiments/record_json.hpp"

namespace eigengrasp {

namespace {

OrderedJson scene_json(const ScenePerformance& scene) {
  OrderedJson json{{"hand", scene.hand},
                   {"object", scene.object},
                   {"triangles", scene.triangles},
                   {"runs", scene.runs},
                   {"legal_share", scene.legal_share},
                   {"judged_states_per_second", scene.judged_per_second},
                   {"candidates", scene.candidates},
                   {"closed_on_the_way", scene.closed_on_the_way},
                   {"contacts_mean", scene.contacts},
                   {"microseconds",
                    {{"close", 1e6 * scene.steps.close},
                     {"contacts", 1e6 * scene.steps.contacts},
                     {"closure", 1e6 * scene.steps.closure},
                     {"epsilon", 1e6 * scene.steps.epsilon}}},
                   {"peak_memory_bytes", scene.peak_memory},
                   {"threads", OrderedJson::array()}};
  for (const ThreadedPerformance& by : scene.by_threads)
    json["threads"].push_back({{"threads", by.threads},
                               {"states_per_second", by.states_per_second},
                               {"candidates_per_second", by.candidates_per_second},
                               {"prepare_seconds", by.prepare},
                               {"prepare_object_seconds", by.prepare_object},
                               {"prepare_cached_seconds", by.prepare_cached},
                               {"run_seconds", by.run},
                               {"paper_run_seconds", by.paper_run}});
  return json;
}

}  // namespace

std::string performance_json(const PerformanceReport& report) {
  OrderedJson json{{"format", "eigengrasp-bench"}, {"version", 1}};
  json.update(record_json(report.record));
  json["search"] = report.options.search == SearchKind::paper ? "paper" : "staged";
  json["iterations"] = report.options.iterations;
  json["wrench_space_microseconds"] = {{"epsilon_8_contacts", 1e6 * report.wrench.epsilon},
                                       {"closure_8_contacts", 1e6 * report.wrench.closure}};
  json["scenes"] = OrderedJson::array();
  for (const ScenePerformance& scene : report.scenes) json["scenes"].push_back(scene_json(scene));
  return pretty_text(json);
}

}  // namespace eigengrasp
