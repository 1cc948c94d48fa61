// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/contact/material.hpp"

#include <array>
#include <string_view>

namespace eigengrasp {
namespace {

constexpr std::array<std::string_view, 6> kNames = {"glass", "metal", "wood", "plastic", "rubber", "stone"};
constexpr std::size_t kWood = 2;

// Static coefficients of GraspIt! 4 (material.cpp), symmetric.
constexpr double kFriction[6][6] = {
    {0.2, 0.2, 0.3, 0.2, 1.0, 0.4},  // glass
    {0.2, 0.2, 0.3, 0.2, 1.0, 0.4},  // metal
    {0.3, 0.3, 0.4, 0.4, 1.0, 0.6},  // wood
    {0.2, 0.2, 0.4, 0.3, 1.0, 0.6},  // plastic
    {1.0, 1.0, 1.0, 1.0, 2.0, 1.5},  // rubber
    {0.4, 0.4, 0.6, 0.6, 1.5, 0.7},  // stone
};

std::size_t table_row(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return i;
  }
  return kWood;
}

}  // namespace

double table_friction(const std::string& a, const std::string& b) {
  if (a == "frictionless" || b == "frictionless") return 0.0;
  return kFriction[table_row(a)][table_row(b)];
}

double contact_friction(const Material& hand, const Material& object) {
  if (hand.friction) return *hand.friction;
  if (object.friction) return *object.friction;
  return table_friction(hand.name, object.name);
}

}  // namespace eigengrasp
