// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { LinkFollower } from "../core/follower";
import type { LinkPoses, View } from "../wire/messages";
import type { Workbench } from "./workbench";

export type GhostKind = "grasp" | "pregrasp" | "none";

/** Shows views of the online planner; what moves goes on smoothly between them. */
export class ViewPlayer {
  ghost: GhostKind = "grasp";
  cone = true;
  private readonly hand = new LinkFollower();
  private readonly offered = new LinkFollower(0.06);
  private offer_id: number | undefined;
  private off: (() => void) | undefined;

  constructor(private readonly bench: Workbench) {}

  start(): void {
    this.off ??= this.bench.stage.frames.on((seconds) => this.advance(seconds));
  }

  stop(): void {
    this.off?.();
    this.off = undefined;
    this.offer_id = undefined;
    this.bench.clear_marks();
  }

  /** @param jump shows it as it is, without a way there */
  show(view: View, jump = false): void {
    if (view.phase === "waiting") return;
    if (jump) this.hand.jump(view.link_poses);
    else this.hand.aim(view.link_poses);
    this.bench.warn(view.blocked && view.phase === "approach");
    this.aim_ghost(view, jump);
    this.bench.cone.visible = this.cone && view.phase === "approach";
    if (this.bench.cone.visible) this.bench.cone.show(view.cone);
    if (this.hand.pose) this.bench.pose_hand(this.hand.pose);
    this.bench.stage.request();
  }

  private aim_ghost(view: View, jump: boolean): void {
    const wanted = this.ghost_of(view);
    this.bench.ghost.visible = wanted !== undefined;
    if (!wanted || !view.offer) {
      this.offer_id = undefined;
      return;
    }
    if (jump || this.offer_id === undefined) this.offered.jump(wanted);
    else this.offered.aim(wanted);
    this.offer_id = view.offer.id;
    if (this.offered.pose) this.bench.pose_ghost(this.offered.pose);
  }

  private ghost_of(view: View): LinkPoses | undefined {
    if (this.ghost === "none" || view.phase !== "approach") return undefined;
    return this.ghost === "grasp" ? view.offer?.grasp : view.offer?.pregrasp;
  }

  private advance(seconds: number): void {
    const hand_moves = this.hand.advance(seconds);
    const ghost_moves = this.bench.ghost.visible && this.offered.advance(seconds);
    if (hand_moves && this.hand.pose) this.bench.pose_hand(this.hand.pose);
    if (ghost_moves && this.offered.pose) this.bench.pose_ghost(this.offered.pose);
    if (hand_moves || ghost_moves) this.bench.stage.request();
  }
}
