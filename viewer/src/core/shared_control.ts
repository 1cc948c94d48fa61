// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { Hand, OnlineOptions, Target } from "../wire/messages";

const degree = Math.PI / 180;
const most_targets = 64;

/** A variable of the search that the operator can wish a value for. */
export interface WishRow {
  key: string;
  variable: Target["variable"];
  index: number;
  name: string;
  min: number;
  max: number;
  /** Before anything is wished. */
  start: number;
  /** From the shown unit to that of the wire. */
  factor: number;
}

/** A value as it is shown, and how sure the operator is of it: 0 says nothing, 1 is certain. */
export interface Wish {
  value: number;
  confidence: number;
}

function row(
  variable: Target["variable"],
  name: string,
  range: readonly [number, number],
  factor = 1,
  index = 0,
): WishRow {
  const [min, max] = range;
  const start = Math.min(max, Math.max(min, 0));
  return { key: `${variable}-${index}`, variable, index, name, min, max, start, factor };
}

/** What can be wished for of a hand: the approach, the amplitudes that are searched, the degrees of freedom. */
export function wish_rows(hand: Hand, options: OnlineOptions): WishRow[] {
  const back = options.step_back ?? 0.03;
  const ahead = options.look_ahead ?? 0.4;
  const cone = options.cone_half_angle ?? 45 * degree;
  const searched = hand.amplitudes.slice(0, options.amplitudes ?? 2);
  return [
    row("distance", "Distance [mm]", [-back * 1e3, ahead * 1e3], 1e-3),
    row("theta", "Theta [°]", [0, cone / degree], degree),
    row("phi", "Phi [°]", [-180, 180], degree),
    ...searched.map((one, i) => row("amplitude", `Amplitude ${i + 1}: ${one.name}`, [one.min, one.max], 1, i)),
    ...hand.dofs.map((one, i) => row("dof", one.name, [one.min, one.max], 1, i)),
  ];
}

/** The targets that say something, as they go to the planner. */
export function targets_of(rows: readonly WishRow[], wishes: ReadonlyMap<string, Wish>): Target[] {
  return rows
    .flatMap(({ key, variable, index, min, max, factor }): Target[] => {
      const wish = wishes.get(key);
      if (!wish || !(wish.confidence > 0)) return [];
      const value = Math.min(max, Math.max(min, wish.value)) * factor;
      return [{ variable, index, value, confidence: Math.min(1, wish.confidence) }];
    })
    .slice(0, most_targets);
}
