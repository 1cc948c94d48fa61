// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { degrees, duration, fixed, millimetres, short_count } from "../core/format";
import type { Solution, View } from "../wire/messages";
import { h, set_text } from "./dom";
import { BigFigure, Figures, section } from "./parts";

const phases = { waiting: "waiting for the wrist", approach: "approach", holding: "holding" };

/** The figures of a view of the online planner. */
export class ViewFigures {
  readonly offer: HTMLElement;
  readonly solutions: HTMLElement;
  private readonly offered = new BigFigure("ε offered", "offered");
  private readonly closing = new BigFigure("ε if closed now", "now");
  private readonly figures = new Figures({
    phase: "Phase",
    preshape: "Preshape",
    first: "First grasp after",
    postures: "Postures a second",
    candidates: "Candidates a second",
    form_closed: "Form-closed so far",
  });
  private readonly rows = h("tbody");
  private shown = "";

  constructor() {
    this.figures.element.style.marginTop = "10px";
    const heads = ["id", "ε", "ahead", "angle", "aside", "age"].map((name) => h("th", {}, name));
    this.offer = section(
      "Offer",
      h("div", { class: "big" }, this.offered.element, this.closing.element),
      this.figures.element,
    );
    this.solutions = section(
      "Solutions",
      h("table", { id: "solutions" }, h("thead", {}, h("tr", {}, ...heads)), this.rows),
    );
  }

  show(view: View | undefined): void {
    const offer = view?.offer && view.solutions.find((one) => one.id === view.offer?.id);
    this.offered.set(fixed(offer?.epsilon, 3), offer ? "good" : "");
    const now = view?.epsilon_now;
    this.closing.set(
      now !== undefined && now < 0 ? "no hold" : fixed(now, 3),
      now === undefined ? "" : now > 0 ? "good" : "bad",
    );
    this.figures.set({
      phase: view ? phases[view.phase] + (view.blocked && view.phase === "approach" ? ", blocked" : "") : "–",
      preshape: view ? `${fixed(view.preshape * 100, 0)} %` : "–",
      first: view && view.rates.time_to_first_grasp > 0 ? duration(view.rates.time_to_first_grasp) : "–",
      postures: short_count(view && Math.round(view.rates.postures_per_second)),
      candidates: short_count(view && Math.round(view.rates.candidates_per_second)),
      form_closed: short_count(view?.rates.form_closed),
    });
    this.list(view?.solutions ?? [], view?.offer?.id);
  }

  private list(solutions: readonly Solution[], offered: number | undefined): void {
    const rows = solutions
      .slice(0, 6)
      .map((one) => [
        String(one.id),
        fixed(one.epsilon, 3),
        millimetres(one.distance),
        degrees(one.angle),
        millimetres(one.offset),
        duration(Math.round(one.age * 10) / 10),
      ]);
    const text = JSON.stringify([rows, offered]);
    if (text === this.shown) return;
    this.shown = text;
    while (this.rows.children.length > rows.length) this.rows.lastElementChild?.remove();
    while (this.rows.children.length < rows.length) this.rows.append(h("tr", {}, ...rows[0]!.map(() => h("td"))));
    rows.forEach((cells, i) => {
      const row = this.rows.children[i]!;
      row.classList.toggle("offered", solutions[i]?.id === offered);
      cells.forEach((cell, k) => set_text(row.children[k]!, cell));
    });
  }
}
