// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <string>
#include <utility>

#include "eigengrasp/planning/grasp_planner.hpp"
#include "json_text.hpp"

namespace eigengrasp {

/// The names that an enumeration has in files.
template <typename Enum, std::size_t n>
struct EnumNames {
  std::array<std::pair<Enum, const char*>, n> pairs;

  std::string name(Enum value) const {
    for (const auto& [v, text] : pairs)
      if (v == value) return text;
    return "";
  }
  Enum read(const JsonView& view) const {
    const std::string text = view.text();
    std::string all;
    for (const auto& [v, name] : pairs) {
      if (text == name) return v;
      all += (all.empty() ? "" : ", ") + std::string(name);
    }
    view.refuse("one of " + all);
  }
};

inline constexpr EnumNames<SearchKind, 5> kSearchNames{{{{SearchKind::paper, "paper"},
                                                         {SearchKind::staged, "staged"},
                                                         {SearchKind::tempering, "tempering"},
                                                         {SearchKind::enhanced, "enhanced"},
                                                         {SearchKind::transfer, "transfer"}}}};
inline constexpr EnumNames<EnergyKind, 2> kEnergyNames{
    {{{EnergyKind::contact, "contact"}, {EnergyKind::wrench, "wrench"}}}};
inline constexpr EnumNames<WrenchNorm, 2> kNormNames{{{{WrenchNorm::l1, "l1"}, {WrenchNorm::linf, "linf"}}}};
inline constexpr EnumNames<ConeModel, 2> kConeNames{
    {{{ConeModel::edges, "edges"}, {ConeModel::exact, "exact"}}}};
inline constexpr EnumNames<PlanStatus, 3> kStatusNames{{{{PlanStatus::found, "found"},
                                                         {PlanStatus::none_closed, "none_closed"},
                                                         {PlanStatus::nothing_legal, "nothing_legal"}}}};

}  // namespace eigengrasp
