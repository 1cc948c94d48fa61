// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Quaternion, Vector3 } from "three";
import { from_parts, position_of, rotation_of } from "../core/pose";
import type { Pose } from "../wire/messages";

/** How the operator wants the wrist to go, each in [-1, 1]: as seen by the camera, on the level. */
export interface Wish {
  right: number;
  ahead: number;
  up: number;
  yaw: number;
  pitch: number;
  roll: number;
}

export const still: Wish = { right: 0, ahead: 0, up: 0, yaw: 0, pitch: 0, roll: 0 };
const speed = 0.18; // [m/s]
const turn_speed = 1.1; // [rad/s]

export function is_still(wish: Wish): boolean {
  return Object.values(wish).every((value) => value === 0);
}

export function add_wishes(a: Wish, b: Wish): Wish {
  const sum = (key: keyof Wish) => Math.max(-1, Math.min(1, a[key] + b[key]));
  return {
    right: sum("right"),
    ahead: sum("ahead"),
    up: sum("up"),
    yaw: sum("yaw"),
    pitch: sum("pitch"),
    roll: sum("roll"),
  };
}

/**
 * The pose some seconds later.
 * @param view_direction of the camera; only its level part counts
 */
export function moved(pose: Pose, wish: Wish, view_direction: Vector3, seconds: number): Pose {
  const ahead = new Vector3(view_direction.x, view_direction.y, 0);
  if (ahead.lengthSq() < 1e-9) ahead.set(0, 1, 0);
  ahead.normalize();
  const right = new Vector3(ahead.y, -ahead.x, 0);
  const up = new Vector3(0, 0, 1);
  const step = right.clone().multiplyScalar(wish.right).addScaledVector(ahead, wish.ahead).addScaledVector(up, wish.up);
  const turn = up.clone().multiplyScalar(wish.yaw).addScaledVector(right, wish.pitch).addScaledVector(ahead, wish.roll);
  const angle = turn.length() * turn_speed * seconds;
  const rotation = rotation_of(pose);
  if (angle > 0) rotation.premultiply(new Quaternion().setFromAxisAngle(turn.normalize(), angle));
  return from_parts(position_of(pose).addScaledVector(step, speed * seconds), rotation);
}
