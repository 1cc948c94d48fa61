// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "experiments/figure12_progress.hpp"

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/version.hpp"
#include "report/json_text.hpp"

namespace eigengrasp {

namespace {

std::string head_line(const Figure12Options& options) {
  OrderedJson head{{"eigengrasp", "figure12"},       {"version", version()},
                   {"neighbors", options.neighbors}, {"candidates", options.candidates},
                   {"seed", options.seed},           {"hands", OrderedJson::array()}};
  for (const auto& hand : options.hands) head["hands"].push_back(hand->name);
  return head.dump();
}

std::string model_line(const Figure12Model& model) {
  OrderedJson line{{"model", model.name}, {"prepare", model.prepare_seconds}, {"runs", OrderedJson::array()}};
  for (const auto& runs : model.runs)
    for (const Figure12Run& run : runs)
      line["runs"].push_back({{"epsilons", run.epsilons},
                              {"distinct", run.distinct},
                              {"candidates", run.candidates},
                              {"seconds", run.seconds}});
  return line.dump();
}

Figure12Model read_model(const OrderedJson& line, std::size_t n_hands) {
  Figure12Model model;
  line.at("model").get_to(model.name);
  line.at("prepare").get_to(model.prepare_seconds);
  const OrderedJson& runs = line.at("runs");
  for (std::size_t h = 0; h < n_hands; ++h)
    for (std::size_t m = 0; m < 4; ++m) {
      if (m == 0) model.runs.emplace_back();
      const OrderedJson& from = runs.at(4 * h + m);
      Figure12Run& run = model.runs.back()[m];
      from.at("epsilons").get_to(run.epsilons);
      from.at("distinct").get_to(run.distinct);
      from.at("candidates").get_to(run.candidates);
      from.at("seconds").get_to(run.seconds);
    }
  return model;
}

}  // namespace

Figure12Progress::Figure12Progress(const Figure12Options& options) {
  if (options.progress_file.empty()) return;
  const std::string head = head_line(options);
  std::ifstream in(options.progress_file);
  std::string text;
  if (std::getline(in, text) && text == head)
    while (std::getline(in, text)) {
      const OrderedJson line = OrderedJson::parse(text, nullptr, false);
      if (line.is_discarded()) continue;
      Figure12Model model = read_model(line, options.hands.size());
      done_.emplace(model.name, std::move(model));
    }
  file_.open(options.progress_file, std::ios::trunc);
  file_ << head << '\n';
  for (const auto& [name, model] : done_) file_ << model_line(model) << '\n';
  file_.flush();
  if (!file_) fail("{}: cannot be written", options.progress_file.string());
}

std::optional<Figure12Model> Figure12Progress::find(const std::string& model) const {
  const auto known = done_.find(model);
  if (known == done_.end()) return std::nullopt;
  return known->second;
}

void Figure12Progress::add(const Figure12Model& model) {
  if (file_.is_open()) file_ << model_line(model) << '\n' << std::flush;
}

}  // namespace eigengrasp
