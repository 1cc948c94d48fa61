// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Vector3 } from "three";
import type { App } from "../app";
import { duration } from "../core/format";
import { History, sample_of } from "../core/history";
import { home_pose } from "../core/home_pose";
import { Gamepads } from "../input/gamepad";
import { Glide } from "../input/glide";
import { type Action, Keyboard } from "../input/keyboard";
import { add_wishes, is_still, moved, still } from "../input/wrist_motion";
import { type GhostKind, ViewPlayer } from "../scene/view_player";
import { WristGizmo } from "../scene/wrist_gizmo";
import { h, set_text } from "../ui/dom";
import { field, Figures, options_of, section, tick } from "../ui/parts";
import { ViewFigures } from "../ui/view_figures";
import type { Closed, Pose, View } from "../wire/messages";
import { key_help } from "./key_help";
import { Lift } from "./lift";
import { OnlineCharts } from "./online_charts";
import { OnlineOptionsForm } from "./online_options";
import { OnlineSession } from "./online_session";
import type { Page } from "./page";
import { SessionLogs } from "./session_logs";
import { SharedControl } from "./shared_control";

/** The operator moves the wrist, the planner offers a grasp, one key closes the hand (section IV of the paper). */
export class InteractivePage implements Page {
  readonly panel: HTMLElement;
  readonly charts: HTMLElement;
  readonly hud = h("div", { class: "hud", id: "hud" });
  readonly legend = [
    ["hand", "--hand"],
    ["object", "--object"],
    ["offered grasp", "--good"],
    ["search cone", "--cone"],
  ] as const;
  private readonly session: OnlineSession;
  private readonly player: ViewPlayer;
  private readonly gizmo: WristGizmo;
  private readonly lifting: Lift;
  private readonly gamepads = new Gamepads((action) => this.act(action));
  private readonly glide = new Glide();
  private readonly history = new History();
  private readonly figures = new ViewFigures();
  private readonly chart = new OnlineCharts("latency");
  private readonly options = new OnlineOptionsForm(() => {
    this.session.options = this.options.value;
    this.show_wishes();
    this.session.restart();
  });
  private readonly link = new Figures({
    latency: "Wrist to view, median",
    tail: "99th percentile",
    server: "In the server, median",
  });
  private readonly buttons = {
    close: this.button("close", "Close", "C", "main grow"),
    lift: this.button("lift", "Lift", "L", "grow"),
    open: this.button("open", "Open", "O", "grow"),
  };
  private readonly to_offer = this.button("offer", "Go to offer", "T", "");
  private readonly closed_text = h("p", { class: "note", id: "closed" });
  private readonly logs: SessionLogs;
  private readonly wishes: SharedControl;
  private readonly modes = [false, true].map((turns) =>
    h(
      "button",
      { type: "button", id: turns ? "gizmo-turn" : "gizmo-move", onclick: () => this.set_gizmo(turns) },
      turns ? "Turn" : "Move",
    ),
  );
  private keyboard: Keyboard | undefined;
  private shown = false;
  private chart_due = 0;
  private off: (() => void)[] = [];

  constructor(private readonly app: App) {
    this.session = new OnlineSession(app);
    this.session.options = this.options.value;
    this.logs = new SessionLogs(app, this.session);
    this.wishes = new SharedControl((targets) => this.session.aim(targets));
    this.player = new ViewPlayer(app.bench);
    this.lifting = new Lift(app.bench, () => this.show_buttons());
    this.gizmo = new WristGizmo(app.stage, (pose) => this.session.move(pose));
    this.panel = this.lay_out();
    this.charts = this.chart.element;
    this.session.views.on(({ view, latency }) => this.take(view, latency));
    this.session.closed.watch((closed) => this.show_closed(closed));
    this.session.stage.watch(() => this.show_stage());
    window.addEventListener("gamepadconnected", () => app.stage.request());
  }

  enter(): void {
    this.shown = true;
    this.player.start();
    this.keyboard = new Keyboard(
      (action) => this.act(action),
      () => this.app.stage.request(),
    );
    this.off = [
      this.app.scene.watch((scene) => {
        this.history.clear();
        this.show_wishes();
        this.session.want(scene);
      }),
      this.app.stage.frames.on((seconds) => this.frame(seconds)),
    ];
    this.show_stage();
  }

  leave(): void {
    this.shown = false;
    this.off.forEach((end) => end());
    this.keyboard?.dispose();
    this.session.want(undefined);
    this.gizmo.show(false);
    this.lifting.drop();
    this.player.stop();
  }

  private act(action: Action): void {
    if (!this.shown) return;
    const scene = this.app.scene.value;
    const can_act = this.session.stage.value === "on";
    if (action === "gizmo") this.set_gizmo(!this.gizmo.turns);
    else if (!can_act) return;
    else if (action === "home" && scene && !this.holding) this.go_to(home_pose(scene.hand, scene.object, scene.scale));
    else if (action === "offer" && this.session.view?.offer) this.go_to(this.session.view.offer.pregrasp[0]);
    else if (action === "close" && !this.holding) this.session.command("close");
    else if (action === "open") this.lifting.lower(() => this.session.command("open"));
    else if (action === "forget") this.session.command("forget");
    else if (action === "lift" && this.holds) this.lifting.toggle();
  }

  private go_to(pose: Pose): void {
    this.glide.begin(pose);
    this.app.stage.request();
  }

  /** The hand is closed, and the grasp withstands any disturbance: it can be lifted. */
  private get holds(): boolean {
    return this.holding && this.session.closed.value?.grasp?.form_closure === true;
  }

  private get holding(): boolean {
    return this.session.view?.phase === "holding";
  }

  /** Held keys and sticks move the wrist, or it glides to a place; each asks for the next frame. */
  private frame(seconds: number): void {
    this.lifting.advance(seconds);
    const pad = this.gamepads.read();
    const wish = add_wishes(this.keyboard?.read() ?? still, pad ?? still);
    if (pad) this.app.stage.request();
    if (!is_still(wish) || this.gizmo.dragging || this.holding) this.glide.end();
    if ((is_still(wish) && !this.glide.running) || !this.session.wrist || this.holding || this.gizmo.dragging) return;
    this.app.stage.request();
    const direction = this.app.stage.camera.getWorldDirection(new Vector3());
    this.session.move(
      this.glide.running
        ? this.glide.next(this.session.wrist, seconds)
        : moved(this.session.wrist, wish, direction, seconds),
    );
    this.gizmo.place(this.session.wrist);
  }

  private take(view: View, latency: number | undefined): void {
    if (!this.shown) return;
    this.player.show(view);
    this.history.add(sample_of(view, latency));
    this.gizmo.show(view.phase !== "holding");
    if (!this.gizmo.dragging && this.session.wrist) this.gizmo.place(this.session.wrist);
    if (view.phase !== "holding" && !this.lifting.moving) this.lifting.drop();
    this.app.bench.contacts.visible =
      view.phase === "holding" && (this.session.closed.value?.grasp?.contacts.length ?? 0) > 0;
    this.figures.show(view);
    set_text(this.hud, (this.session.tracked ? "Tracker: " : "") + view.message);
    this.show_buttons();
    if (performance.now() < this.chart_due) return;
    this.chart_due = performance.now() + 120;
    this.chart.show(this.history.samples);
    this.link.set({
      latency: duration(this.session.latency.quantile(0.5)),
      tail: duration(this.session.latency.quantile(0.99)),
      server: duration(this.session.server_time.quantile(0.5)),
    });
    this.logs.show_count();
  }

  private show_closed(closed: Closed | undefined): void {
    const grasp = closed?.grasp;
    set_text(this.closed_text, closed?.message ?? "");
    this.closed_text.className = closed && !grasp?.form_closure ? "note bad" : "note";
    this.app.bench.contacts.show(grasp?.contacts ?? [], 0.018);
    this.app.stage.request();
  }

  private show_stage(): void {
    const stage = this.session.stage.value;
    if (stage === "starting") set_text(this.hud, "Preparing the planner …");
    if (stage === "off") set_text(this.hud, "The planner rests.");
    if (stage !== "on" && this.shown) this.lifting.drop();
    if (this.shown && this.session.wrist) this.gizmo.place(this.session.wrist);
    this.gizmo.show(this.shown && stage === "on");
    this.show_buttons();
  }

  private show_buttons(): void {
    const on = this.session.stage.value === "on";
    this.buttons.close.disabled = !on || this.holding;
    this.buttons.lift.disabled = !on || !this.holds;
    this.to_offer.disabled = !on || this.holding || !this.session.view?.offer;
    this.buttons.open.disabled = !on || !this.holding;
    set_text(this.buttons.lift.firstChild as Element, this.lifting.up ? "Put down" : "Lift");
  }

  private set_gizmo(turns: boolean): void {
    this.gizmo.turns = turns;
    this.modes.forEach((button, i) => button.classList.toggle("on", (i === 1) === turns));
  }

  private show_wishes(): void {
    const hand = this.app.scene.value?.hand;
    if (hand) this.wishes.show(hand, this.session.options);
  }

  private button(action: Action, text: string, key: string, look: string): HTMLButtonElement {
    return h(
      "button",
      { type: "button", class: look, id: `do-${action}`, onclick: () => this.act(action) },
      h("span", {}, text),
      h("kbd", {}, key),
    );
  }

  private lay_out(): HTMLElement {
    const ghost = h(
      "select",
      {
        id: "ghost",
        onchange: () => {
          this.player.ghost = ghost.value as GhostKind;
          if (this.session.view) this.player.show(this.session.view);
        },
      },
      ...options_of<GhostKind>(
        [
          ["grasp", "grasp"],
          ["pregrasp", "pre-grasp"],
          ["none", "none"],
        ],
        "grasp",
      ),
    );
    const cone = tick("Search cone", true, (on) => {
      this.player.cone = on;
      if (this.session.view) this.player.show(this.session.view);
    });
    this.set_gizmo(false);
    return h(
      "div",
      {},
      section(
        "Hand",
        h("div", { class: "row" }, this.buttons.close, this.buttons.lift, this.buttons.open),
        this.closed_text,
      ),
      this.figures.offer,
      section("Link", this.link.element, this.logs.element),
      this.figures.solutions,
      section("Show", field("Ghost", ghost), cone, this.options.element, this.wishes.element),
      section(
        "Move the wrist",
        h("div", { class: "row" }, ...this.modes, this.button("home", "Start", "H", ""), this.to_offer),
        key_help(),
      ),
    );
  }
}
