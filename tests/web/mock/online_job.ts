// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Quaternion, Vector3 } from "three";
import { to_matrix } from "./hand.ts";
import { make_grasp, random_stream } from "./grasping.ts";
import type { World } from "./world.ts";
import type {
  ClientMessage,
  Closed,
  Grasp,
  LinkPoses,
  OnlineStart,
  ServerMessage,
  View,
  Wrist,
} from "../../../viewer/src/wire/messages.ts";

/** Stands in for the online planner: half a second after the wrist came to rest, it offers a grasp ahead of it. */
export class OnlineJob {
  private readonly began = performance.now();
  private readonly random = random_stream(7);
  private readonly timer: NodeJS.Timeout;
  private wrist: Wrist | undefined;
  private moved = performance.now();
  private offer: { id: number; grasp: Grasp } | undefined;
  private held: Grasp | undefined;
  private frame = 0;
  private found = 0;

  constructor(
    session: string,
    private readonly world: World,
    private readonly order: OnlineStart,
    private readonly send: (message: ServerMessage) => void,
  ) {
    send({ type: "online.ready", session, hand: order.hand, object: order.object, seconds: 0.02 });
    this.timer = setInterval(() => this.show(), 33);
  }

  stop(): void {
    clearInterval(this.timer);
  }

  handle(message: ClientMessage): void {
    if (message.type === "wrist") {
      const far = this.wrist && this.apart(this.wrist, message) > 0.01;
      if (!this.wrist || far) this.moved = performance.now();
      if (far) this.offer = undefined;
      this.wrist = message;
      this.show(0.4);
    }
    if (message.type === "command") this.command(message.command);
    if (message.type === "solution.get") {
      this.send({
        type: "solution",
        id: message.id,
        ...(this.offer?.id === message.id ? { grasp: this.offer.grasp } : {}),
      });
    }
  }

  private command(command: "close" | "open" | "forget"): void {
    if (command === "close") {
      const grasp = this.offer?.grasp;
      const answer: Closed = {
        type: "closed",
        message: grasp
          ? `The grasp holds: epsilon ${grasp.epsilon.toFixed(4)}, ${grasp.contacts.length} contacts.`
          : "Nothing to close on: move nearer.",
        ...(grasp ? { grasp } : {}),
      };
      this.held = grasp;
      this.send(answer);
    } else {
      this.held = undefined;
      if (command === "forget") this.offer = undefined;
    }
    this.show();
  }

  /** From the wrist to the offered grasp along the approach. */
  private ahead(axis: Vector3): number {
    const there = this.offer?.grasp.closing[0][0];
    const here = this.wrist?.pose;
    return there && here ? axis.dot(new Vector3(there[0] - here[0], there[1] - here[1], there[2] - here[2])) : 0;
  }

  private apart(a: Wrist, b: Wrist): number {
    return Math.hypot(a.pose[0] - b.pose[0], a.pose[1] - b.pose[1], a.pose[2] - b.pose[2]);
  }

  private search(): void {
    if (!this.wrist || this.offer || this.held || performance.now() - this.moved < 500) return;
    const hand = this.world.hands.get(this.order.hand)!;
    const center = this.world.center(this.order.object);
    const X_OH = to_matrix(this.wrist.pose);
    const direction = hand.approach.direction.clone().transformDirection(X_OH);
    const turn = new Quaternion().setFromRotationMatrix(X_OH);
    const target = X_OH.clone();
    const exact = center
      .clone()
      .addScaledVector(direction, -0.045)
      .sub(hand.approach.point.clone().applyQuaternion(turn));
    target.setPosition(exact);
    const grasp = make_grasp(hand, this.world.objects.get(this.order.object)!.surface, center, target, this.random);
    this.offer = {
      id: ++this.found,
      grasp: { ...grasp, form_closure: true, epsilon: Math.max(grasp.epsilon, 0.05 + 0.1 * this.random()) },
    };
  }

  private show(server_ms?: number): void {
    this.search();
    const hand = this.world.hands.get(this.order.hand)!;
    const X_OH = this.wrist ? to_matrix(this.wrist.pose) : undefined;
    const time = (performance.now() - this.began) / 1e3;
    const apex = X_OH ? hand.approach.point.clone().applyMatrix4(X_OH) : new Vector3();
    const axis = X_OH ? hand.approach.direction.clone().transformDirection(X_OH) : new Vector3(0, 0, 1);
    const solutions = this.offer
      ? [
          {
            id: this.offer.id,
            epsilon: this.offer.grasp.epsilon,
            distance: this.ahead(axis),
            angle: 0.1,
            offset: 0.004,
            age: 0.5,
          },
        ]
      : [];
    const view: View = {
      type: "view",
      frame: ++this.frame,
      time,
      phase: this.held ? "holding" : this.wrist ? "approach" : "waiting",
      blocked: false,
      ...(this.wrist ? { wrist: { time: this.wrist.time, pose: this.wrist.pose } } : {}),
      link_poses: this.held
        ? (this.held.closing[this.held.closing.length - 1] as LinkPoses)
        : hand.poses(X_OH ?? to_matrix([0, 0, 1, 1, 0, 0, 0]), hand.rest()),
      preshape: this.offer ? 0.4 : 0,
      solutions,
      ...(this.offer && !this.held
        ? {
            offer: {
              id: this.offer.id,
              pregrasp: this.offer.grasp.closing[0],
              grasp: this.offer.grasp.closing[this.offer.grasp.closing.length - 1] as LinkPoses,
            },
            epsilon_now: this.offer.grasp.epsilon * 0.8,
          }
        : {}),
      cone: { apex: apex.toArray(), axis: axis.toArray(), half_angle: 0.52, nearest: -0.03, farthest: 0.2 },
      rates: {
        postures_per_second: this.wrist ? 5e5 * (0.95 + 0.1 * this.random()) : 0,
        candidates_per_second: this.wrist ? 2000 * (0.9 + 0.2 * this.random()) : 0,
        postures: Math.round(time * 5e5),
        candidates: Math.round(time * 2000),
        form_closed: this.found,
        time_to_first_grasp: this.offer ? 0.03 : 0,
      },
      ...(server_ms === undefined ? {} : { server_ms }),
      message: this.held
        ? "Holding."
        : this.offer
          ? "A grasp is offered: move on or close."
          : "Searching ahead of the wrist.",
    };
    this.send(view);
  }
}
