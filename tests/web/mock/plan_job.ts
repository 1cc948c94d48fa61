// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Vector3 } from "three";
import { facing_pose, make_grasp, random_stream } from "./grasping.ts";
import type { World } from "./world.ts";
import type { Grasp, PlanStart, ServerMessage } from "../../../viewer/src/wire/messages.ts";

/** A plan that takes about two seconds: a falling energy, milestones, then grasps from many sides. */
export class PlanJob {
  private readonly random: () => number;
  private readonly timer: NodeJS.Timeout;
  private readonly total: number;
  private readonly steps: number;
  private readonly grasps: Grasp[] = [];
  private step = 0;
  private energy = 3;

  constructor(
    readonly id: string,
    private readonly world: World,
    private readonly order: PlanStart,
    private readonly send: (message: ServerMessage) => void,
  ) {
    this.steps = Math.max(24, Math.round((order.options?.iterations ?? 0) / 3000));
    this.random = random_stream(order.options?.seed ?? 1);
    this.total = order.options?.iterations ?? 70000;
    send({ type: "plan.started", id, hand: order.hand, object: order.object });
    this.timer = setInterval(() => this.advance(), 80);
  }

  stop(): void {
    clearInterval(this.timer);
  }

  finish(early: boolean): void {
    this.stop();
    const grasps = [...this.grasps].sort(
      (a, b) => Number(b.form_closure) - Number(a.form_closure) || b.epsilon - a.epsilon,
    );
    const closed = grasps.filter((grasp) => grasp.form_closure).length;
    this.send({
      type: "plan.result",
      id: this.id,
      status: closed ? "found" : "none_closed",
      stopped_early: early,
      grasps,
      explanation: `Found ${closed} form-closure grasps among ${grasps.length} pre-grasps that were closed.`,
      counts: {
        states: this.iterations,
        legal: Math.round(this.iterations * 0.4),
        tested: grasps.length,
        form_closed: closed,
        not_closed: grasps.length - closed,
        no_contact: 0,
        penetrating: 0,
      },
      timings: { prepare: 0.05, search: this.step * 0.08, close: 0.02, volume: 0.01, total: this.step * 0.08 + 0.1 },
    });
  }

  private get iterations(): number {
    return Math.round((this.total * this.step) / this.steps);
  }

  private advance(): void {
    this.step += 1;
    const hand = this.world.hands.get(this.order.hand)!;
    const center = this.world.center(this.order.object);
    const from = new Vector3(this.random() - 0.5, this.random() - 0.5, 0.6 * this.random() - 0.1).normalize();
    const grasp = make_grasp(
      hand,
      this.world.objects.get(this.order.object)!.surface,
      center,
      facing_pose(hand, center, from, (this.random() - 0.5) * 0.8, 0.035 + 0.03 * this.random()),
      this.random,
    );
    if (this.grasps.length < (this.order.options?.grasps ?? 20)) this.grasps.push(grasp);
    this.energy *= 0.8 + 0.2 * this.random();
    this.send({
      type: "plan.progress",
      id: this.id,
      iterations: this.iterations,
      total: this.total,
      seconds: this.step * 0.08,
      best_energy: this.energy,
    });
    if (this.step % 3 === 1) {
      this.send({
        type: "plan.milestone",
        id: this.id,
        iteration: this.iterations,
        energy: this.energy,
        link_poses: grasp.closing[0],
      });
    }
    if (this.step === this.steps) this.finish(false);
  }
}
