// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { h } from "../ui/dom";

const keys: readonly (readonly [string, string])[] = [
  ["W A S D", "on the level, as the camera looks"],
  ["R F", "up and down"],
  ["← → ↑ ↓", "yaw and pitch"],
  ["Q E", "roll"],
  ["Shift", "slowly"],
  ["G", "arrows or rings"],
  ["X", "forget the solutions"],
];

/** The keys that are not written on a button. */
export function key_help(): HTMLElement {
  const cells = keys.flatMap(([names, text]) => [
    h("span", {}, ...names.split(" ").flatMap((name) => [h("kbd", {}, name), " "])),
    h("span", {}, text),
  ]);
  return h(
    "div",
    {},
    h("div", { class: "keys", style: "margin-top:10px" }, ...cells),
    h(
      "p",
      { class: "note" },
      "Gamepad: left stick and triggers move, right stick and shoulders turn; A closes, B opens, X lifts, Back goes to the offer. A tracker moves the wrist through the server.",
    ),
  );
}
