// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "database/unit_state.hpp"

#include "eigengrasp/core/error.hpp"

namespace eigengrasp {

UnitState parse_unit_state(std::string_view word, const std::string& where) {
  for (const UnitState state : {UnitState::waiting, UnitState::claimed, UnitState::done, UnitState::failed})
    if (word == to_string(state)) return state;
  fail("{}: found the state '{}', expected waiting, claimed, done or failed", where, word);
}

}  // namespace eigengrasp
