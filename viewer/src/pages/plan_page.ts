// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { App } from "../app";
import { duration, fixed, short_count } from "../core/format";
import { home_pose, open_hand } from "../core/home_pose";
import { broken_plan, compact_plan, next_plan, type PlanState, trace_rows } from "../core/plan_state";
import { forget, recall, remember } from "../core/session_state";
import type { BenchScene } from "../scene/workbench";
import { h, set_text, toggle } from "../ui/dom";
import { Figures, save_file, section } from "../ui/parts";
import type { Grasp, ServerMessage } from "../wire/messages";
import { Gallery } from "./gallery";
import { GraspPanel } from "./grasp_panel";
import type { Page } from "./page";
import { PlanCharts } from "./plan_charts";
import { PlanOptionsForm } from "./plan_options";

type Focus = { kind: "newest" } | { kind: "milestone"; index: number } | { kind: "grasp"; number: number };

/** Plans grasps without an operator: energy trace, best states as they come, gallery of grasps. */
export class PlanPage implements Page {
  readonly panel: HTMLElement;
  readonly charts: HTMLElement;
  readonly hud = h("div", { class: "hud" });
  readonly legend = [
    ["hand", "--hand"],
    ["object", "--object"],
    ["friction cones", "--contact"],
  ] as const;
  private plan = recall<PlanState>("plan");
  private focus: Focus = recall<Focus>("plan.focus") ?? { kind: "newest" };
  private shown = false;
  private readonly start = h(
    "button",
    { type: "button", class: "main grow", id: "plan-start", onclick: () => this.start_or_stop() },
    "Plan grasps",
  );
  private readonly progress = h("progress", { max: 1, value: 0, "aria-label": "Progress" });
  private readonly figures = new Figures({
    iterations: "Iterations",
    best: "Best energy",
    time: "Time",
    closed: "Form-closed grasps",
  });
  private readonly explanation = h("p", { class: "note", id: "explanation" });
  private readonly options = new PlanOptionsForm();
  private readonly gallery: Gallery;
  private readonly gallery_section: HTMLElement;
  private readonly grasp_panel: GraspPanel;
  private readonly chart = new PlanCharts((index) => this.set_focus({ kind: "milestone", index }));

  constructor(private readonly app: App) {
    this.gallery = new Gallery(app.models, (_grasp, number) => this.set_focus({ kind: "grasp", number }));
    this.gallery_section = section("Grasps, by epsilon", this.gallery.element);
    this.grasp_panel = new GraspPanel(app.bench, this.downloads());
    this.panel = h(
      "div",
      {},
      section(
        "Search",
        h("div", { class: "row" }, this.start),
        h("div", { style: "margin:10px 0 8px" }, this.progress),
        this.figures.element,
        this.explanation,
        this.options.element,
      ),
      this.grasp_panel.element,
      this.gallery_section,
    );
    this.charts = this.chart.element;
    app.connection.messages.on((message) => this.receive(message));
    app.connection.state.watch((state) => {
      this.start.disabled = state.kind !== "online";
      if (state.kind !== "online") this.update(broken_plan(this.plan));
    });
    app.scene.watch((scene) => this.scene_changed(scene));
    this.show_figures();
  }

  enter(): void {
    this.shown = true;
    this.draw();
  }

  leave(): void {
    this.shown = false;
    this.grasp_panel.hide();
    this.app.bench.clear_marks();
  }

  private start_or_stop(): void {
    const { choice, connection } = this.app;
    if (this.plan?.running) {
      connection.send({ type: "plan.stop" });
    } else if (choice.value && this.options.sound) {
      this.set_focus({ kind: "newest" });
      const sent = connection.send({ type: "plan.start", ...choice.value, options: this.options.value });
      this.start.disabled = sent;
    }
  }

  private receive(message: ServerMessage): void {
    if (message.type === "error" && message.of?.startsWith("plan.")) {
      this.start.disabled = false;
      this.app.report(message.message);
      this.update(broken_plan(this.plan));
      return;
    }
    const choice = this.app.choice.value;
    if (choice) this.update(next_plan(this.plan, message, choice));
  }

  private update(plan: PlanState | undefined): void {
    if (plan === this.plan) return;
    const had_result = this.plan?.result;
    const began = plan?.id !== this.plan?.id;
    this.plan = plan;
    if (began) forget("plan");
    if (plan && plan.result !== had_result) this.finished(plan);
    if (began && !plan?.result) void this.gallery.show(undefined, undefined);
    this.show_figures();
    if (this.focus.kind === "newest" && this.shown) this.draw();
  }

  private finished(plan: PlanState): void {
    remember("plan", compact_plan(plan));
    void this.gallery.show(plan.result, this.app.scene.value);
    if (plan.result && plan.result.grasps.length > 0) this.set_focus({ kind: "grasp", number: 1 });
  }

  /** What was planned belongs to the scene that it was planned in. */
  private scene_changed(scene: BenchScene | undefined): void {
    if (!scene || this.app.page.value === "replay") return;
    const plan = this.plan;
    const same =
      plan &&
      plan.hand === scene.hand.name &&
      plan.object === scene.object.name &&
      plan.scale === scene.scale &&
      plan.table === scene.table;
    if (plan && !same) {
      if (plan.running) this.app.connection.send({ type: "plan.stop" });
      this.plan = undefined;
      forget("plan");
      this.focus = { kind: "newest" };
    }
    void this.gallery.show(this.plan?.result, scene).then(() => this.mark_focus());
    this.show_figures();
    if (this.shown) this.draw();
  }

  private set_focus(focus: Focus): void {
    this.focus = focus;
    remember("plan.focus", focus);
    if (this.shown) this.draw();
  }

  private mark_focus(): void {
    this.gallery.mark(this.focus.kind === "grasp" ? this.focus.number : undefined);
  }

  private draw(): void {
    const scene = this.app.scene.value;
    if (!scene) return;
    this.mark_focus();
    const grasp = this.focused_grasp;
    const states = this.plan?.milestones ?? [];
    const index = this.focus.kind === "milestone" ? this.focus.index : states.length - 1;
    this.chart.show(this.plan, this.focus.kind === "milestone" ? index : undefined);
    if (grasp && this.focus.kind === "grasp") {
      this.grasp_panel.show(grasp, `Grasp ${this.focus.number}`);
      set_text(
        this.hud,
        `Grasp ${this.focus.number} · ε ${fixed(grasp.epsilon, 4)} · ${grasp.contacts.length} contacts`,
      );
      return;
    }
    this.grasp_panel.hide();
    const state = states[index];
    this.app.bench.pose_hand(
      state?.link_poses ?? open_hand(scene.hand, home_pose(scene.hand, scene.object, scene.scale)),
    );
    set_text(
      this.hud,
      state
        ? `Best state ${index + 1} of ${states.length} · iteration ${short_count(state.iteration)} · energy ${fixed(state.energy, 4)}`
        : `${scene.hand.title} · ${scene.object.name}`,
    );
  }

  private get focused_grasp(): Grasp | undefined {
    return this.focus.kind === "grasp" ? this.plan?.result?.grasps[this.focus.number - 1] : undefined;
  }

  private show_figures(): void {
    const plan = this.plan;
    const best = plan && trace_rows(plan.trace, plan.milestones).at(-1)?.best;
    const done = plan?.result ? plan.result.counts.states : plan?.iterations;
    this.figures.set({
      iterations: plan ? `${short_count(done)} / ${short_count(plan.total || done)}` : "–",
      best: fixed(best, 4),
      time: duration(plan?.seconds),
      closed: plan?.result ? `${plan.result.counts.form_closed} of ${plan.result.counts.tested}` : "–",
    });
    this.progress.value = plan?.result ? 1 : plan && plan.total > 0 ? plan.iterations / plan.total : 0;
    this.start.disabled = this.app.connection.state.value.kind !== "online";
    set_text(this.start, plan?.running ? "Stop" : "Plan grasps");
    this.start.className = plan?.running ? "stop grow" : "main grow";
    set_text(this.explanation, plan?.result?.explanation ?? (plan && !plan.running ? "The plan was broken off." : ""));
    toggle(this.gallery_section, (plan?.result?.grasps.length ?? 0) > 0);
    this.chart.show(plan, this.focus.kind === "milestone" ? this.focus.index : undefined);
  }

  private downloads(): HTMLElement {
    const file = (text: string, id: string, name: () => string, of: () => Promise<Blob>) =>
      h(
        "button",
        {
          type: "button",
          id,
          onclick: () => {
            of().then(
              (blob) => save_file(blob, name()),
              (problem: unknown) => this.app.report(problem),
            );
          },
        },
        text,
      );
    const id = () => this.plan?.id ?? "";
    const number = () => (this.focus.kind === "grasp" ? this.focus.number : 1);
    const stem = () => `${this.plan?.object ?? "object"}-${this.plan?.hand ?? "hand"}`;
    return h(
      "div",
      { class: "row", style: "margin-top:6px" },
      file(
        "JSON",
        "save-json",
        () => `${stem()}-grasps.json`,
        () => this.app.api.plan_file(id(), "grasps.json"),
      ),
      file(
        "CSV",
        "save-csv",
        () => `${stem()}-grasps.csv`,
        () => this.app.api.plan_file(id(), "grasps.csv"),
      ),
      file(
        "GLB",
        "save-glb",
        () => `${stem()}-grasp-${number()}.glb`,
        () => this.app.api.plan_file(id(), `grasp-${number()}.glb`),
      ),
      file(
        "Picture",
        "save-png",
        () => `${stem()}-grasp-${number()}.png`,
        () => this.app.stage.picture(),
      ),
    );
  }
}
