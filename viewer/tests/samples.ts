// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { Hand, LinkPoses, Object as SceneObject, View } from "../src/wire/messages";

/** Palm along z, fingers along z too: no direction of the fingers across the palm. */
export const barrett_like: Hand = {
  name: "gripper",
  title: "Three fingers",
  n_dof: 4,
  n_links: 2,
  eigengrasps: 2,
  links: ["palm", "finger"],
  rest: [
    [0, 0, 0, 1, 0, 0, 0],
    [0, 0, 0.1, 1, 0, 0, 0],
  ],
  approach_point: [0, 0, 0.05],
  approach_direction: [0, 0, 1],
  reach: 0.2,
  dofs: [
    { name: "spread", min: 0, max: 3 },
    { name: "finger", min: 0.5, max: 2.44 },
  ],
  amplitudes: [{ name: "close", min: -4, max: 4 }],
  uploaded: false,
};

/** Palm along -y, fingers along -x. */
export const human_like: Hand = {
  name: "human",
  title: "Hand",
  n_dof: 20,
  n_links: 2,
  eigengrasps: 2,
  links: ["palm", "finger"],
  rest: [
    [0, 0, 0, 1, 0, 0, 0],
    [-0.16, 0, 0, 1, 0, 0, 0],
  ],
  approach_point: [-0.13, -0.015, 0],
  approach_direction: [0, -1, 0],
  reach: 0.23,
  dofs: [],
  amplitudes: [],
  uploaded: false,
};

export const glass_like: SceneObject = {
  name: "glass",
  title: "glass",
  triangles: 12000,
  size: [0.078, 0.078, 0.12],
  center: [0.01, 0, 0.02],
  uploaded: false,
};
export const plate_like: SceneObject = { ...glass_like, name: "plate", size: [0.2, 0.2, 0.02] };

export function links_at(x: number): LinkPoses {
  return [
    [x, 0, 0, 1, 0, 0, 0],
    [x + 0.1, 0, 0, 1, 0, 0, 0],
  ];
}

export function view_at(time: number, more: Partial<View> = {}): View {
  return {
    type: "view",
    frame: Math.round(time * 60),
    time,
    phase: "approach",
    blocked: false,
    link_poses: links_at(time),
    preshape: 0,
    solutions: [],
    cone: { apex: [0, 0, 0], axis: [0, 0, 1], half_angle: 0.5, nearest: -0.03, farthest: 0.2 },
    rates: {
      postures_per_second: 5e5,
      candidates_per_second: 2e3,
      postures: 1,
      candidates: 1,
      form_closed: 0,
      time_to_first_grasp: 0,
    },
    message: "",
    ...more,
  };
}
