// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { TraceChart } from "../charts/trace_chart";
import { short_count } from "../core/format";
import type { Sample } from "../core/history";
import { h } from "../ui/dom";

/** What the right-hand chart shows: how fast the link is, or (for a log, which knows no latency) the planner. */
export type SpeedKind = "latency" | "postures";

/** Quality of what is offered, and speed, over time. */
export class OnlineCharts {
  readonly element: HTMLElement;
  private readonly quality: TraceChart;
  private readonly speed: TraceChart;
  private times: number[] = [];

  constructor(
    private readonly kind: SpeedKind,
    on_pick?: (time: number) => void,
  ) {
    const pick =
      on_pick &&
      ((index: number) => {
        const time = this.times[index];
        if (time !== undefined) on_pick(time);
      });
    this.quality = new TraceChart(
      {
        x_label: "time [s]",
        x_span: 4,
        y_label: "ε",
        y_floor: 0,
        traces: [
          { label: "offered", colour: "#3ddc97", decimals: 3, steps: true },
          { label: "if closed", colour: "#58a6ff", decimals: 3 },
        ],
      },
      pick,
    );
    this.speed = new TraceChart(
      kind === "latency"
        ? {
            x_label: "time [s]",
            x_span: 4,
            y_label: "latency [ms]",
            y_floor: 0,
            traces: [{ label: "wrist to view", colour: "#f0b429", decimals: 1, unit: "ms", points: true, gaps: true }],
          }
        : {
            x_label: "time [s]",
            x_span: 4,
            y_label: "postures/s",
            y_floor: 0,
            y_format: short_count,
            traces: [{ label: "postures a second", colour: "#8f7bff", decimals: 0 }],
          },
      pick,
    );
    this.element = h(
      "div",
      { class: "page-charts" },
      h("div", { class: "chart-box" }, this.quality.element),
      h("div", { class: "chart-box" }, this.speed.element),
    );
  }

  show(samples: readonly Sample[]): void {
    this.times = samples.map((one) => one.time);
    this.quality.set_data(
      this.times,
      samples.map((one) => one.offered),
      samples.map((one) => one.now),
    );
    this.speed.set_data(
      this.times,
      samples.map((one) => (this.kind === "latency" ? one.latency : one.postures)),
    );
  }
}
