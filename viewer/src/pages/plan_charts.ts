// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { TraceChart } from "../charts/trace_chart";
import { short_count } from "../core/format";
import { type PlanState, trace_rows } from "../core/plan_state";
import { h, set_text, toggle } from "../ui/dom";

/** Energy over iterations with the best states as dots, and a slider through those (Fig. 2 of the paper). */
export class PlanCharts {
  readonly element: HTMLElement;
  private readonly chart = new TraceChart(
    {
      x_label: "iteration",
      y_label: "energy",
      x_format: (value) => short_count(value),
      traces: [
        { label: "chains now", colour: "#5d6b7b", steps: true, decimals: 3 },
        { label: "best so far", colour: "#58a6ff", steps: true, decimals: 3, fill: true },
        { label: "best states", colour: "#e0a458", dots: true, decimals: 3 },
      ],
    },
    (index) => this.pick_near(index),
  );
  private readonly slider = h("input", {
    type: "range",
    id: "milestones",
    min: 0,
    max: 0,
    step: 1,
    "aria-label": "Best states",
    oninput: () => this.on_pick(Number(this.slider.value)),
  });
  private readonly text = h("output", { for: "milestones" });
  private readonly strip: HTMLElement;
  private readonly empty = h("p", { class: "chart-empty" }, "Plan grasps: the energy of the search is drawn here.");
  private count = 0;
  private x: number[] = [];
  private places: number[] = [];

  constructor(private readonly on_pick: (milestone: number) => void) {
    const step = (by: number) => () => {
      const next = Math.min(this.count - 1, Math.max(0, Number(this.slider.value) + by));
      this.slider.value = String(next);
      on_pick(next);
    };
    this.strip = h(
      "div",
      { class: "strip" },
      h("button", { type: "button", title: "Previous best state", onclick: step(-1) }, "◀"),
      this.slider,
      h("button", { type: "button", title: "Next best state", onclick: step(1) }, "▶"),
      this.text,
    );
    this.element = h(
      "div",
      { class: "page-charts" },
      this.empty,
      h("div", { class: "chart-box" }, this.chart.element, this.strip),
    );
    this.show(undefined, undefined);
  }

  show(plan: PlanState | undefined, milestone: number | undefined): void {
    const states = plan?.milestones ?? [];
    const rows = trace_rows(plan?.trace ?? [], states);
    this.x = rows.map((row) => row.iteration);
    this.places = states.map((state) => state.iteration);
    this.chart.set_data(
      this.x,
      rows.map((row) => row.now),
      rows.map((row) => row.best),
      rows.map((row) => row.state),
    );
    toggle(this.empty, rows.length === 0);
    toggle(this.chart.element.parentElement ?? this.chart.element, rows.length > 0);
    this.count = states.length;
    toggle(this.strip, states.length > 0);
    this.slider.max = String(Math.max(0, states.length - 1));
    const shown = milestone ?? states.length - 1;
    if (states.length > 0) this.slider.value = String(shown);
    set_text(this.text, `best state ${shown + 1} of ${states.length}`);
  }

  private pick_near(index: number): void {
    const iteration = this.x[index];
    if (iteration === undefined || this.places.length === 0) return;
    let nearest = 0;
    this.places.forEach((place, i) => {
      if (Math.abs(place - iteration) < Math.abs(this.places[nearest]! - iteration)) nearest = i;
    });
    this.on_pick(nearest);
  }
}
