// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { Action } from "./keyboard";
import { type Wish, still } from "./wrist_motion";

const dead_zone = 0.12;
/** Buttons of the standard layout. */
const buttons: readonly (readonly [number, Action])[] = [
  [0, "close"],
  [1, "open"],
  [2, "lift"],
  [3, "forget"],
  [8, "offer"],
  [9, "home"],
];

export interface PadState {
  axes: readonly number[];
  buttons: readonly { pressed: boolean; value: number }[];
}

/** Left stick: on the level; triggers: down and up; right stick: yaw and pitch; shoulders: roll. */
export function wish_of_pad(pad: PadState): Wish {
  const axis = (index: number) => shaped(pad.axes[index] ?? 0);
  const button = (index: number) => pad.buttons[index]?.value ?? 0;
  return {
    ...still,
    right: axis(0),
    ahead: -axis(1) || 0,
    up: shaped(button(7) - button(6)),
    yaw: -axis(2) || 0,
    pitch: -axis(3) || 0,
    roll: button(5) - button(4),
  };
}

/** Nothing in the middle, fine near it. */
export function shaped(value: number): number {
  const size = Math.max(0, (Math.abs(value) - dead_zone) / (1 - dead_zone));
  return Math.sign(value) * Math.min(1, size) ** 2 || 0;
}

/** Reads the first gamepad; buttons count when they go down. */
export class Gamepads {
  private down = new Set<number>();

  constructor(private readonly on_action: (action: Action) => void) {}

  read(): Wish | undefined {
    const pad = navigator.getGamepads().find((one) => one?.connected);
    if (!pad) return undefined;
    for (const [index, action] of buttons) {
      const pressed = pad.buttons[index]?.pressed ?? false;
      if (pressed && !this.down.has(index)) this.on_action(action);
      if (pressed) this.down.add(index);
      else this.down.delete(index);
    }
    return wish_of_pad(pad);
  }
}
