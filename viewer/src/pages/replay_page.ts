// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { App } from "../app";
import { fixed } from "../core/format";
import { type Sample, sample_of } from "../core/history";
import { thinned } from "../core/plan_state";
import { recall, remember } from "../core/session_state";
import { newest_at, parse_log, type SessionLog } from "../log/session_log";
import { ViewPlayer } from "../scene/view_player";
import { h, set_text, toggle } from "../ui/dom";
import { drop_area, field, Figures, options_of, section } from "../ui/parts";
import { ViewFigures } from "../ui/view_figures";
import { OnlineCharts } from "./online_charts";
import type { Page } from "./page";

const speeds = [
  ["0.25", "¼ ×"],
  ["0.5", "½ ×"],
  ["1", "1 ×"],
  ["2", "2 ×"],
  ["4", "4 ×"],
] as const;

/** Plays a session that was recorded. */
export class ReplayPage implements Page {
  readonly panel: HTMLElement;
  readonly charts: HTMLElement;
  readonly hud = h("div", { class: "hud" });
  readonly legend = [
    ["hand", "--hand"],
    ["object", "--object"],
    ["offered grasp", "--good"],
    ["search cone", "--cone"],
  ] as const;
  private readonly player: ViewPlayer;
  private readonly figures = new ViewFigures();
  private readonly chart = new OnlineCharts("postures", (time) => this.seek(time));
  private readonly about = new Figures({ name: "Log", scene: "Scene", length: "Length", views: "Views" });
  private readonly note = h("p", { class: "note", id: "replay-note" });
  private readonly kept = h("div", { class: "choices", id: "logs" });
  private readonly kept_section = section("Logs of the server", this.kept);
  private readonly slider = h("input", {
    type: "range",
    id: "timeline",
    min: 0,
    max: 1,
    step: 0.001,
    value: 0,
    "aria-label": "Time",
    oninput: () => this.seek(Number(this.slider.value)),
  });
  private readonly clock = h("output", { id: "replay-time" }, "0.00 s");
  private readonly play = h("button", { type: "button", id: "replay-play", onclick: () => this.toggle() }, "Play");
  private readonly speed = h("select", { id: "replay-speed" }, ...options_of(speeds, "1"));
  private readonly events = h("div", { class: "choices", id: "events" });
  private readonly loaded: HTMLElement[];
  private log: SessionLog | undefined;
  private time = 0;
  private playing = false;
  private scene_shown = -1;
  private view_shown = -1;
  private off: (() => void)[] = [];

  constructor(private readonly app: App) {
    this.player = new ViewPlayer(app.bench);
    const timeline = section(
      "Timeline",
      h("div", { class: "row" }, this.play, this.clock),
      h("div", { class: "row" }, this.slider),
      field("Speed", this.speed),
      this.events,
    );
    this.loaded = [timeline, this.figures.offer, this.figures.solutions];
    this.panel = h(
      "div",
      {},
      section(
        "Log",
        drop_area("Drop a session log here, or choose a file", ".jsonl,.json,.ndjson", (file) => {
          file.text().then(
            (text) => this.load(text, file.name),
            (problem: unknown) => this.app.report(problem),
          );
        }),
        this.note,
        this.about.element,
      ),
      this.kept_section,
      ...this.loaded,
    );
    this.charts = this.chart.element;
    this.show_loaded();
  }

  enter(): void {
    this.player.start();
    this.off = [
      this.app.stage.frames.on((seconds) => this.advance(seconds)),
      this.app.scene.watch(() => {
        this.view_shown = -1;
        this.draw(true);
      }),
      this.app.status.watch((status) => {
        if (status?.logs) void this.list_logs().then(() => this.restore());
      }),
    ];
    toggle(this.kept_section, this.app.status.value?.logs ?? false);
    set_text(this.hud, this.log ? "" : "Load a log to play it.");
    this.scene_shown = -1;
    this.seek(this.time);
  }

  /** After a reload, the log of the server that was shown before. */
  private restore(): void {
    const name = recall<string>("replay");
    if (name !== undefined && !this.log) void this.fetch(name);
  }

  leave(): void {
    this.off.forEach((end) => end());
    this.playing = false;
    this.player.stop();
    if (this.app.choice.value) void this.app.show_scene(this.app.choice.value);
  }

  private async list_logs(): Promise<void> {
    try {
      const { logs } = await this.app.api.logs();
      this.kept.replaceChildren(
        ...logs
          .slice(-50)
          .reverse()
          .map(({ name, bytes }) =>
            h(
              "button",
              { type: "button", "data-log": name, onclick: () => void this.fetch(name) },
              h("span", {}, name),
              h("small", {}, `${fixed(bytes / 1e6, 1)} MB`),
            ),
          ),
      );
      toggle(this.kept_section, logs.length > 0);
    } catch (problem) {
      this.app.report(problem);
    }
  }

  private async fetch(name: string): Promise<void> {
    try {
      this.load(await this.app.api.log(name), name);
      remember("replay", name);
    } catch (problem) {
      this.app.report(problem);
    }
  }

  private load(text: string, name: string): void {
    try {
      this.log = parse_log(text);
    } catch (problem) {
      this.note.className = "note bad";
      set_text(this.note, problem instanceof Error ? problem.message : String(problem));
      return;
    }
    const { scenes, views, duration, skipped } = this.log;
    this.note.className = "note";
    set_text(this.note, skipped > 0 ? `${skipped} lines could not be read and were left out.` : "");
    const first = scenes[0]!.choice;
    this.about.element.title = name;
    this.about.set({
      name,
      scene: `${first.hand}, ${first.object}`,
      length: `${fixed(duration, 1)} s`,
      views: String(views.length),
    });
    this.chart.show(this.samples());
    this.events.replaceChildren(
      ...this.log.events.map(({ t, text: event }) =>
        h(
          "button",
          { type: "button", title: event, onclick: () => this.seek(t + 0.05) },
          h("span", {}, event),
          h("small", {}, `${fixed(t, 1)} s`),
        ),
      ),
    );
    this.slider.max = String(duration);
    this.scene_shown = -1;
    this.show_loaded();
    this.seek(0);
    if (!this.playing) this.toggle();
  }

  private samples(): Sample[] {
    return thinned(this.log?.views ?? [], 1500).map(({ t, view }) => ({ ...sample_of(view, undefined), time: t }));
  }

  private show_loaded(): void {
    for (const part of this.loaded) toggle(part, this.log !== undefined);
    toggle(this.about.element, this.log !== undefined);
  }

  private toggle(): void {
    if (!this.log) return;
    if (!this.playing && this.time >= this.log.duration) this.time = 0;
    this.playing = !this.playing;
    set_text(this.play, this.playing ? "Pause" : "Play");
    this.app.stage.request();
  }

  private seek(time: number): void {
    this.time = Math.max(0, time);
    this.draw(!this.playing);
  }

  private advance(seconds: number): void {
    if (!this.playing || !this.log) return;
    this.time = Math.min(this.log.duration, this.time + seconds * Number(this.speed.value));
    if (this.time >= this.log.duration) this.toggle();
    this.draw(false);
    this.app.stage.request();
  }

  private draw(jump: boolean): void {
    const { log } = this;
    if (!log) return;
    this.slider.value = String(this.time);
    set_text(this.clock, `${fixed(this.time, 2)} s of ${fixed(log.duration, 2)} s`);
    this.show_scene(log);
    const index = newest_at(log.views, this.time);
    const entry = log.views[index];
    if (!entry || index === this.view_shown) return;
    this.view_shown = index;
    this.player.show(entry.view, jump);
    this.figures.show(entry.view);
    set_text(this.hud, entry.view.message);
    this.show_contacts(log, entry.view.phase === "holding");
  }

  private show_scene(log: SessionLog): void {
    const index = Math.max(0, newest_at(log.scenes, this.time));
    const scene = log.scenes[index];
    if (!scene || index === this.scene_shown) return;
    this.scene_shown = index;
    const known = this.app.hand(scene.choice.hand) && this.app.object(scene.choice.object);
    if (!known)
      this.app.report(
        `The server has no hand '${scene.choice.hand}' or no object '${scene.choice.object}', which the log shows.`,
      );
    else void this.app.show_scene(scene.choice);
  }

  private show_contacts(log: SessionLog, holding: boolean): void {
    const last = log.events.filter((event) => event.t <= this.time && event.closed).at(-1);
    const contacts = (holding && last?.closed?.grasp?.contacts) || [];
    this.app.bench.contacts.show(contacts, 0.018);
    this.app.bench.contacts.visible = contacts.length > 0;
  }
}
