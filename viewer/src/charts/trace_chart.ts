// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { padded_range, spanned_range } from "./range";

export interface TraceStyle {
  label: string;
  colour: string;
  unit?: string;
  steps?: boolean;
  points?: boolean;
  /** Points alone, no line. */
  dots?: boolean;
  decimals?: number;
  fill?: boolean;
  /** Nothing is drawn where there is no value. */
  gaps?: boolean;
}

export interface ChartStyle {
  x_label: string;
  x_decimals?: number;
  y_label: string;
  traces: TraceStyle[];
  /** The horizontal axis is at least so long. */
  x_span?: number;
  /** The vertical axis always holds this value. */
  y_floor?: number;
  x_format?: (value: number) => string;
  y_format?: (value: number) => string;
}

const ink = "#8b97a6";
const grid = { stroke: "#232a33", width: 1 };
const font = "11px system-ui, sans-serif";

/** Lines over a common horizontal axis that fill their box and follow its size. */
export class TraceChart {
  readonly element = document.createElement("div");
  private readonly plot: uPlot;
  private readonly observer: ResizeObserver;

  constructor(style: ChartStyle, on_pick?: (index: number) => void) {
    this.element.className = "chart";
    this.plot = new uPlot(chart_options(style), [[], ...style.traces.map(() => [])], this.element);
    this.observer = new ResizeObserver(() => this.fit());
    this.observer.observe(this.element);
    if (on_pick) {
      this.plot.over.addEventListener("click", () => {
        const index = this.plot.cursor.idx;
        if (index !== null && index !== undefined) on_pick(index);
      });
    }
  }

  /** One array of x and one for each trace, all of the same length. */
  set_data(x: number[], ...y: (number | null)[][]): void {
    this.plot.setData([x, ...y]);
  }

  dispose(): void {
    this.observer.disconnect();
    this.plot.destroy();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    const legend = this.element.querySelector<HTMLElement>(".u-legend")?.offsetHeight ?? 0;
    if (width > 0 && height > legend) this.plot.setSize({ width, height: height - legend });
  }
}

function chart_options(style: ChartStyle): uPlot.Options {
  const x_format = style.x_format ?? ((value: number) => value.toFixed(style.x_decimals ?? 1));
  const { y_format } = style;
  return {
    width: 400,
    height: 120,
    legend: { live: true },
    cursor: { drag: { x: false, y: false }, points: { size: 6 } },
    scales: {
      x: { time: false, range: (_plot, low, high) => spanned_range(low, high, style.x_span) },
      y: { range: (_plot, low, high) => padded_range(low, high, style.y_floor) },
    },
    axes: [
      {
        stroke: ink,
        grid,
        ticks: grid,
        font,
        size: 30,
        gap: 3,
        label: style.x_label,
        labelSize: 14,
        labelFont: font,
        labelGap: -2,
        values: (_plot, ticks) => ticks.map((tick) => x_format(tick)),
      },
      {
        stroke: ink,
        grid,
        ticks: grid,
        font,
        size: 48,
        gap: 4,
        space: 22,
        label: style.y_label,
        labelSize: 16,
        labelFont: font,
        ...(y_format ? { values: (_plot, ticks) => ticks.map((tick) => y_format(tick)) } : {}),
      },
    ],
    series: [
      { label: style.x_label, value: (_plot, value: number | null) => (value === null ? "–" : x_format(value)) },
      ...style.traces.map((trace) => chart_series(trace)),
    ],
  };
}

function chart_series(trace: TraceStyle): uPlot.Series {
  const stepped = trace.steps ? uPlot.paths.stepped?.({ align: 1 }) : undefined;
  return {
    label: trace.label,
    stroke: trace.colour,
    width: 1.6,
    spanGaps: !trace.gaps,
    points: { show: trace.points ?? trace.dots ?? false, size: trace.dots ? 6 : 5, fill: trace.colour },
    value: (_plot, value: number | null) =>
      value === null ? "–" : `${value.toFixed(trace.decimals ?? 2)}${trace.unit ? " " + trace.unit : ""}`,
    ...(trace.dots ? { paths: () => null } : stepped ? { paths: stepped } : {}),
    ...(trace.fill ? { fill: trace.colour + "22" } : {}),
  };
}
