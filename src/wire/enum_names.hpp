// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "eigengrasp/wire/messages.hpp"

namespace eigengrasp::wire {

/// The names that an enumeration has on the wire.
template <typename Enum>
struct EnumNames;

template <typename Enum, std::size_t n>
using NameTable = std::array<std::pair<Enum, std::string_view>, n>;

template <>
struct EnumNames<Role> {
  static constexpr NameTable<Role, 2> table{{{Role::app, "app"}, {Role::tracker, "tracker"}}};
};
template <>
struct EnumNames<ErrorCode> {
  static constexpr NameTable<ErrorCode, 8> table{{{ErrorCode::bad_message, "bad_message"},
                                                  {ErrorCode::too_large, "too_large"},
                                                  {ErrorCode::too_fast, "too_fast"},
                                                  {ErrorCode::not_allowed, "not_allowed"},
                                                  {ErrorCode::not_known, "not_known"},
                                                  {ErrorCode::no_session, "no_session"},
                                                  {ErrorCode::busy, "busy"},
                                                  {ErrorCode::failed, "failed"}}};
};
template <>
struct EnumNames<SearchKind> {
  static constexpr NameTable<SearchKind, 2> table{
      {{SearchKind::staged, "staged"}, {SearchKind::paper, "paper"}}};
};
template <>
struct EnumNames<EnergyKind> {
  static constexpr NameTable<EnergyKind, 2> table{
      {{EnergyKind::contact, "contact"}, {EnergyKind::wrench, "wrench"}}};
};
template <>
struct EnumNames<VariableTarget::Variable> {
  using V = VariableTarget::Variable;
  static constexpr NameTable<V, 5> table{{{V::distance, "distance"},
                                          {V::theta, "theta"},
                                          {V::phi, "phi"},
                                          {V::amplitude, "amplitude"},
                                          {V::dof, "dof"}}};
};
template <>
struct EnumNames<OperatorCommand> {
  static constexpr NameTable<OperatorCommand, 3> table{{{OperatorCommand::close, "close"},
                                                        {OperatorCommand::open, "open"},
                                                        {OperatorCommand::forget, "forget"}}};
};
template <>
struct EnumNames<PlanStatus> {
  static constexpr NameTable<PlanStatus, 3> table{{{PlanStatus::found, "found"},
                                                   {PlanStatus::none_closed, "none_closed"},
                                                   {PlanStatus::nothing_legal, "nothing_legal"}}};
};
template <>
struct EnumNames<OnlinePhase> {
  static constexpr NameTable<OnlinePhase, 3> table{{{OnlinePhase::waiting, "waiting"},
                                                    {OnlinePhase::approach, "approach"},
                                                    {OnlinePhase::holding, "holding"}}};
};

template <typename Enum>
std::string_view name_of(Enum value) {
  for (const auto& [v, name] : EnumNames<Enum>::table)
    if (v == value) return name;
  throw std::logic_error("an enumeration has a value without a name");
}

/// @pre the schema names the same values
template <typename Enum>
Enum value_of(std::string_view text) {
  for (const auto& [v, name] : EnumNames<Enum>::table)
    if (name == text) return v;
  throw std::logic_error("the schema allows a name that the program does not know");
}

}  // namespace eigengrasp::wire
