// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "server/plan_store.hpp"

#include <charconv>
#include <optional>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/render/image.hpp"
#include "eigengrasp/render/pictures.hpp"
#include "eigengrasp/report/grasp_file.hpp"
#include "eigengrasp/report/grasp_glb.hpp"
#include "eigengrasp/report/grasp_tables.hpp"

namespace eigengrasp::server {

namespace {

/// N of "grasp-N.glb", from 1.
std::optional<std::size_t> grasp_number(std::string_view name) {
  constexpr std::string_view prefix = "grasp-";
  constexpr std::string_view suffix = ".glb";
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return {};
  name.remove_prefix(prefix.size());
  name.remove_suffix(std::min(suffix.size(), name.size()));
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size() || number < 1) return {};
  return number;
}

HttpReply picture_of(const PlanRecord& plan) {
  if (plan.result.grasps.empty()) return refusal(404, "the plan has no grasps to draw");
  PictureOptions options;
  options.threads = 1;
  return {200, "image/png", encode_png(grasps_picture(plan.model->scene(), plan.result.grasps, options)), ""};
}

HttpReply glb_of(const PlanRecord& plan, std::size_t number, const std::string& name) {
  if (number > plan.result.grasps.size())
    return refusal(404, fmt::format("the plan has {} grasps, expected a number from 1 to that",
                                    plan.result.grasps.size()));
  return {200, "model/gltf-binary", grasp_glb(plan.model->scene(), plan.result.grasps[number - 1]), name};
}

}  // namespace

void PlanStore::add(PlanRecord record) {
  auto shared = std::make_shared<const PlanRecord>(std::move(record));
  const std::lock_guard lock(mutex_);
  records_.push_back(std::move(shared));
  if (records_.size() > kept) records_.pop_front();
}

HttpReply PlanStore::file(const std::string& id, const std::string& name) const {
  std::shared_ptr<const PlanRecord> plan;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& record : records_)
      if (record->id == id) plan = record;
  }
  if (!plan) return refusal(404, "there is no such plan; the server keeps the last 32 that ended");
  if (name == "grasps.json")
    return {200, "application/json",
            grasps_json(make_grasp_file(plan->model->scene(), {.units = "m", .scale = plan->scale},
                                        plan->options, plan->result)),
            name};
  if (name == "grasps.csv") return {200, "text/csv; charset=utf-8", grasps_csv(plan->result.grasps), name};
  if (name == "grasps.png") return picture_of(*plan);
  if (const auto number = grasp_number(name)) return glb_of(*plan, *number, name);
  return refusal(404, "a plan has the files grasps.json, grasps.csv, grasps.png and grasp-N.glb");
}

}  // namespace eigengrasp::server
