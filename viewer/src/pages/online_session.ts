// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { App } from "../app";
import { home_pose } from "../core/home_pose";
import { SenderClock, Spread } from "../core/sender_clock";
import { recall, remember } from "../core/session_state";
import { Signal, Topic } from "../core/signal";
import { Recorder } from "../log/recorder";
import type { BenchScene } from "../scene/workbench";
import type {
  ClientMessage,
  Closed,
  Command,
  OnlineOptions,
  OnlineStart,
  Pose,
  ServerMessage,
  Target,
  View,
} from "../wire/messages";

export type SessionStage = "off" | "starting" | "on";

interface KeptWrist {
  scene: string;
  pose: Pose;
}

/** The conversation with the online planner: starts it, sends the wrist, takes views. */
export class OnlineSession {
  readonly stage = new Signal<SessionStage>("off");
  readonly views = new Topic<{ view: View; latency: number | undefined }>();
  readonly closed = new Signal<Closed | undefined>(undefined);
  readonly recorder = new Recorder();
  readonly latency = new Spread();
  readonly server_time = new Spread();
  view: View | undefined;
  wrist: Pose | undefined;
  /** A pose of someone else's clock was shown last. */
  tracked = false;
  options: OnlineOptions = {};
  private readonly clock = new SenderClock();
  private order: OnlineStart | undefined;
  private wanted: BenchScene | undefined;
  private dirty = false;
  private targets: Target[] = [];
  private targets_due = false;
  private timer: number | undefined;

  constructor(private readonly app: App) {
    app.connection.messages.on((message) => this.receive(message));
    app.connection.state.watch((state) => {
      if (state.kind === "online") this.start();
      else this.stage.set("off");
    });
  }

  /** The scene to grasp in; none: the planner rests. */
  want(scene: BenchScene | undefined): void {
    const before = this.wanted;
    this.wanted = scene;
    if (scene) {
      if (!before || key_of(before) !== key_of(scene) || this.stage.value === "off") this.start();
    } else if (before && this.stage.value !== "off") {
      this.send({ type: "online.stop" });
      this.stage.set("off");
    }
  }

  move(pose: Pose): void {
    this.wrist = pose;
    this.tracked = false;
    this.dirty = true;
    this.flush();
  }

  /** Shared control: all targets that the operator has now; a session that begins later gets them too. */
  aim(targets: Target[]): void {
    if (targets.length === 0 && this.targets.length === 0) return;
    this.targets = targets;
    this.targets_due = true;
    this.flush();
  }

  command(command: Command["command"]): void {
    if (command !== "close") this.closed.set(undefined);
    this.send({ type: "command", command });
  }

  record(): void {
    if (this.order) this.recorder.start(this.order);
  }

  /** Begins anew, with the wrist where it is. */
  restart(): void {
    if (this.wanted && this.stage.value !== "off") this.start();
  }

  private start(): void {
    const scene = this.wanted;
    if (!scene || this.app.connection.state.value.kind !== "online") return;
    const kept = recall<KeptWrist>("wrist");
    this.wrist = kept?.scene === key_of(scene) ? kept.pose : home_pose(scene.hand, scene.object, scene.scale);
    this.view = undefined;
    this.closed.set(undefined);
    this.order = {
      type: "online.start",
      hand: scene.hand.name,
      object: scene.object.name,
      scale: scene.scale,
      table: scene.table,
      options: this.options,
    };
    this.stage.set("starting");
    this.send(this.order);
  }

  private receive(message: ServerMessage): void {
    this.recorder.received(message);
    if (message.type === "online.ready") {
      if (!this.wanted || this.stage.value === "off") return;
      this.stage.set("on");
      if (this.targets.length > 0) this.targets_due = true;
      if (this.wrist) this.move(this.wrist);
    } else if (message.type === "view" && this.stage.value === "on") {
      this.take(message);
    } else if (message.type === "closed") {
      this.closed.set(message);
    } else if (
      message.type === "error" &&
      message.code !== "too_fast" &&
      this.stage.value !== "off" &&
      !message.of?.startsWith("plan.")
    ) {
      if (message.of === "online.start") this.stage.set("off");
      this.app.report(message.message);
    }
  }

  private take(view: View): void {
    this.view = view;
    const latency = this.clock.latency_of(view.wrist?.time);
    if (latency !== undefined) this.latency.add(latency);
    if (latency !== undefined && view.server_ms !== undefined) this.server_time.add(view.server_ms / 1e3);
    if (view.wrist && !this.clock.is_ours(view.wrist.time)) {
      this.tracked = true;
      this.wrist = view.wrist.pose;
    }
    this.views.emit({ view, latency });
  }

  /** At most one pose and one list of targets a frame go out, always the newest; fewer where the network is slow. */
  private flush(): void {
    if (this.timer !== undefined) return;
    this.timer = window.setTimeout(() => {
      this.timer = undefined;
      if ((this.dirty || this.targets_due) && this.stage.value === "on") this.flush();
    }, 15);
    if (this.stage.value !== "on" || this.app.connection.backlog > 65536) return;
    if (this.targets_due) this.send({ type: "targets", targets: this.targets });
    this.targets_due = false;
    if (!this.dirty || !this.wrist) return;
    this.dirty = false;
    this.send({ type: "wrist", time: this.clock.stamp(), pose: this.wrist });
    if (this.wanted) remember("wrist", { scene: key_of(this.wanted), pose: this.wrist } satisfies KeptWrist);
  }

  private send(message: ClientMessage): void {
    if (this.app.connection.send(message)) this.recorder.sent(message);
  }
}

function key_of(scene: BenchScene): string {
  return [scene.hand.name, scene.object.name, scene.scale, scene.table].join("|");
}
