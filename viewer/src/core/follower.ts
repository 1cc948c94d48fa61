// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { LinkPoses } from "../wire/messages";
import { interpolate_links } from "./pose";

/**
 * Follows postures that come at an uneven rate, so that what is drawn moves evenly: every frame goes the same
 * share of the rest of the way, whatever the frame rate is.
 */
export class LinkFollower {
  private shown: LinkPoses | undefined;
  private goal: LinkPoses | undefined;

  /** @param time_constant after which 63 % of the way is done [s] */
  constructor(private readonly time_constant = 0.035) {}

  aim(goal: LinkPoses): void {
    this.goal = goal;
    if (this.shown === undefined || this.shown.length !== goal.length) this.shown = goal;
  }

  jump(goal: LinkPoses): void {
    this.goal = goal;
    this.shown = goal;
  }

  get pose(): LinkPoses | undefined {
    return this.shown;
  }

  /** Goes on by some time; tells whether anything still moves. */
  advance(seconds: number): boolean {
    if (!this.shown || !this.goal || this.shown === this.goal) return false;
    const share = 1 - Math.exp(-Math.max(0, seconds) / this.time_constant);
    this.shown = interpolate_links(this.shown, this.goal, share);
    if (settled(this.shown, this.goal)) this.shown = this.goal;
    return true;
  }
}

function settled(a: LinkPoses, b: LinkPoses): boolean {
  return b.every((to, i) => a[i]?.every((value, k) => Math.abs(value - (to[k] ?? value)) < 1e-5) ?? false);
}
