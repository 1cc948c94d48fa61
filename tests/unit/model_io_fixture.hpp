// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/written_files.hpp"

namespace eigengrasp::testing {

/// The text with its first `from` replaced; fails the test where there is none.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the test's own text lacks " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A closed cube of that many metres, as OBJ text.
inline std::string cube_obj(double side) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += fmt::format("v {} {} {}\n", (i & 1) ? side / 2 : -side / 2, (i & 2) ? side / 2 : -side / 2,
                        (i & 4) ? side / 2 : -side / 2);
  }
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// A palm with a finger of two coupled joints, a sliding thumb, and the frame of a fingertip.
inline const std::string small_urdf = R"(<robot name="gripper">
  <link name="palm">
    <collision><geometry><mesh filename="cube.obj"/></geometry></collision>
    <inertial><mass value="0.5"/></inertial>
  </link>
  <link name="proximal">
    <collision><origin xyz="0.02 0 0"/><geometry><box size="0.04 0.01 0.01"/></geometry></collision>
  </link>
  <link name="distal">
    <visual><origin xyz="0.02 0 0" rpy="0 1.5707963267948966 0"/><geometry><cylinder radius="0.005" length="0.03"/></geometry></visual>
  </link>
  <link name="finger_tip"/>
  <link name="thumb">
    <collision><geometry><sphere radius="0.01"/></geometry></collision>
    <collision><origin xyz="0 0 0.03"/><geometry><sphere radius="0.01"/></geometry></collision>
  </link>
  <joint name="mcp" type="revolute">
    <parent link="palm"/><child link="proximal"/>
    <origin xyz="0.05 0 0.03" rpy="0 0 0"/><axis xyz="0 2 0"/>
    <limit lower="-0.2" upper="1.6"/>
  </joint>
  <joint name="pip" type="revolute">
    <parent link="proximal"/><child link="distal"/>
    <origin xyz="0.05 0 0"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.9"/>
    <mimic joint="mcp" multiplier="0.5" offset="0.1"/>
  </joint>
  <joint name="tip" type="fixed">
    <parent link="distal"/><child link="finger_tip"/>
    <origin xyz="0.035 0 0"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="palm"/><child link="thumb"/>
    <origin xyz="-0.08 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.03"/>
  </joint>
</robot>
)";

inline const std::string small_yaml = R"(format: eigengrasp-hand
version: 1
name: gripper
title: A gripper for tests
urdf: gripper.urdf
approach:
  point: [0, 0, 0.03]
  direction: [0, 0, 2]
materials:
  skin: {friction: 0.8}
  pad: {friction: 1.2, youngs_modulus: 1.5e6}
link_materials:
  default: skin
  distal: pad
  thumb: rubber
dofs:
  - {joint: slide, closing_speed: -0.1, rest: 0.01}
  - {joint: mcp, closing_speed: 1.0, type: breakaway}
eigengrasps:
  origin: {mcp: 0.4}
  directions:
    - name: close
      range: [-2, 3]
      vector: {mcp: 3.0, slide: 4.0}
virtual_contacts:
  - {link: distal, point: [0.02, 0, -0.005], normal: [0, 0, -2]}
  - {link: finger_tip, point: [0, 0, 0], normal: [1, 0, 0]}
ignore_collisions:
  - [palm, distal]
)";

}  // namespace eigengrasp::testing
