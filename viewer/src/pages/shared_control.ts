// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { targets_of, type Wish, type WishRow, wish_rows } from "../core/shared_control";
import { h, set_text, toggle } from "../ui/dom";
import { tick } from "../ui/parts";
import type { Hand, OnlineOptions, Target } from "../wire/messages";

const first_confidence = 0.5;
const explanation =
  "Stands for a decoder or a glove that knows only some of the hand: the planner is drawn towards each value, the more " +
  "the higher its confidence. At 0 a value says nothing, at 1 the search keeps to it.";

/** Wished values and confidences for variables of the search, sent to the planner while the box is ticked. */
export class SharedControl {
  readonly element: HTMLElement;
  private readonly list = h("div", { class: "wishes" });
  private readonly count = h("p", { class: "note", id: "wish-count" });
  private readonly wishes = new Map<string, Wish>();
  private readonly box: HTMLInputElement;
  private rows: WishRow[] = [];
  private hand = "";

  /** @param send hears all targets whenever they change */
  constructor(private readonly send: (targets: Target[]) => void) {
    const switch_on = tick("Send targets to the planner", false, () => this.changed());
    this.box = switch_on.querySelector("input")!;
    this.box.id = "wish-send";
    this.element = h(
      "details",
      { id: "shared-control" },
      h("summary", {}, "Shared control"),
      h("p", { class: "note" }, explanation),
      switch_on,
      this.count,
      this.list,
    );
    this.changed();
  }

  /** Lays out the rows of a hand. What was wished of another hand is forgotten. */
  show(hand: Hand, options: OnlineOptions): void {
    if (hand.name !== this.hand) this.wishes.clear();
    this.hand = hand.name;
    this.rows = wish_rows(hand, options);
    this.list.replaceChildren(
      h("div", { class: "wish head" }, h("span", {}, "Value (DOFs [rad or m])"), h("span", {}, "Confidence")),
      ...this.rows.map((row) => this.lay_out(row)),
    );
    this.changed();
  }

  private lay_out(row: WishRow): HTMLElement {
    const wish = this.wishes.get(row.key) ?? { value: row.start, confidence: 0 };
    const slider = (id: string, min: number, max: number, value: number) =>
      h("input", { type: "range", id, min, max, step: (max - min) / 200, value });
    const value = slider(`wish-${row.key}`, row.min, row.max, wish.value);
    const confidence = slider(`sure-${row.key}`, 0, 1, wish.confidence);
    value.setAttribute("aria-label", row.name);
    confidence.setAttribute("aria-label", `Confidence of ${row.name}`);
    const figure = h("output", {});
    const show = () => {
      const now = { value: Number(value.value), confidence: Number(confidence.value) };
      const idle = now.confidence === 0;
      set_text(
        figure,
        idle ? "–" : `${now.value.toFixed(row.max - row.min > 20 ? 0 : 2)}, ${(now.confidence * 100).toFixed(0)} %`,
      );
      if (idle) this.wishes.delete(row.key);
      else this.wishes.set(row.key, now);
    };
    value.addEventListener("input", () => {
      if (Number(confidence.value) === 0) confidence.value = String(first_confidence);
      show();
      this.changed();
    });
    confidence.addEventListener("input", () => {
      show();
      this.changed();
    });
    show();
    return h("div", { class: "wish" }, h("span", { title: row.name }, row.name), figure, value, confidence);
  }

  private changed(): void {
    const targets = targets_of(this.rows, this.wishes);
    toggle(this.count, this.box.checked);
    const none = "No value has a confidence yet; move a slider.";
    set_text(this.count, targets.length === 0 ? none : `${targets.length} targets are sent.`);
    this.send(this.box.checked ? targets : []);
  }
}
