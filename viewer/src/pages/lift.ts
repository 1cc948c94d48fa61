// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { Workbench } from "../scene/workbench";

const height = 0.14; // [m]
const seconds_up = 1.1;

/** The object rises with the hand that holds it, and is put down again. */
export class Lift {
  private place = 0;
  private goal = 0;
  private then: (() => void) | undefined;

  constructor(
    private readonly bench: Workbench,
    private readonly on_change: () => void,
  ) {}

  get up(): boolean {
    return this.goal > 0;
  }

  get moving(): boolean {
    return this.place !== this.goal;
  }

  toggle(): void {
    this.go(this.up ? 0 : 1);
  }

  /** Puts the object down first, where it is not, and does something then. */
  lower(then: () => void): void {
    this.go(0, then);
    if (!this.moving) this.arrive();
  }

  /** Down at once. */
  drop(): void {
    this.place = this.goal = 0;
    this.then = undefined;
    this.bench.lift(0);
    this.on_change();
  }

  advance(seconds: number): void {
    if (!this.moving) return;
    const step = seconds / seconds_up;
    this.place =
      this.goal > this.place ? Math.min(this.goal, this.place + step) : Math.max(this.goal, this.place - step);
    this.bench.lift(height * eased(this.place));
    if (!this.moving) this.arrive();
  }

  private go(goal: number, then?: () => void): void {
    this.goal = goal;
    this.then = then;
    this.on_change();
    this.bench.stage.request();
  }

  private arrive(): void {
    const { then } = this;
    this.then = undefined;
    then?.();
  }
}

/** From 0 to 1, slowly at both ends. */
export function eased(t: number): number {
  return t * t * (3 - 2 * t);
}
