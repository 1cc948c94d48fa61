// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { interpolate_pose, position_of, rotation_of } from "../core/pose";
import type { Pose } from "../wire/messages";

const speed = 0.12; // [m/s]
const turn_speed = 0.8; // [rad/s]

/** A straight, even way of the wrist to a place. */
export class Glide {
  private goal: Pose | undefined;

  begin(goal: Pose): void {
    this.goal = goal;
  }

  end(): void {
    this.goal = undefined;
  }

  get running(): boolean {
    return this.goal !== undefined;
  }

  /** Where the wrist is some seconds later; ends where it arrives. */
  next(from: Pose, seconds: number): Pose {
    const { goal } = this;
    if (!goal) return from;
    const duration = Math.max(
      position_of(from).distanceTo(position_of(goal)) / speed,
      rotation_of(from).angleTo(rotation_of(goal)) / turn_speed,
    );
    if (duration > seconds) return interpolate_pose(from, goal, seconds / duration);
    this.end();
    return goal;
  }
}
