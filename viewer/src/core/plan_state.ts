// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { Grasp, LinkPoses, PlanMilestone, PlanResult, ServerMessage } from "../wire/messages";

export interface TracePoint {
  iteration: number;
  energy: number;
}

export interface Milestone extends TracePoint {
  link_poses: LinkPoses;
}

/** How far a plan has come. */
export interface PlanState {
  id: string;
  hand: string;
  object: string;
  scale: number;
  table: boolean;
  running: boolean;
  iterations: number;
  total: number;
  seconds: number;
  trace: TracePoint[];
  milestones: Milestone[];
  result: PlanResult | undefined;
}

export type PlanOrder = Pick<PlanState, "scale" | "table">;

/** The state after a message; the same object where the message does not concern it. */
export function next_plan(
  state: PlanState | undefined,
  message: ServerMessage,
  order: PlanOrder,
): PlanState | undefined {
  if (message.type === "plan.started") return started(message.id, message.hand, message.object, order);
  if (!state || !("id" in message) || message.id !== state.id) return state;
  switch (message.type) {
    case "plan.progress": {
      const { iterations, total, seconds, best_energy } = message;
      const point = best_energy === undefined ? [] : [{ iteration: iterations, energy: best_energy }];
      return { ...state, iterations, total, seconds, trace: [...state.trace, ...point] };
    }
    case "plan.milestone":
      return { ...state, milestones: with_milestone(state.milestones, message) };
    case "plan.result":
      return { ...state, running: false, seconds: message.timings.total, result: message };
    default:
      return state;
  }
}

export interface TraceRow {
  iteration: number;
  /** Best of the chains that run then; the staged search begins new ones on the way. */
  now: number | null;
  /** Best of all until then. */
  best: number;
  /** A best state that was sent. */
  state: number | null;
}

/** Progress and best states, merged in the order of their iterations. */
export function trace_rows(trace: readonly TracePoint[], states: readonly TracePoint[]): TraceRow[] {
  const rows = new Map<number, { now: number | null; state: number | null }>();
  for (const { iteration, energy } of trace) rows.set(iteration, { now: energy, state: null });
  for (const { iteration, energy } of states)
    rows.set(iteration, { now: rows.get(iteration)?.now ?? null, state: energy });
  let best = Infinity;
  return [...rows]
    .sort((a, b) => a[0] - b[0])
    .map(([iteration, { now, state }]) => {
      best = Math.min(best, now ?? Infinity, state ?? Infinity);
      return { iteration, now, best, state };
    });
}

/** The link broke, or the server began anew: the plan is not going on. */
export function broken_plan(state: PlanState | undefined): PlanState | undefined {
  return state?.running ? { ...state, running: false } : state;
}

function started(id: string, hand: string, object: string, order: PlanOrder): PlanState {
  return {
    id,
    hand,
    object,
    ...order,
    running: true,
    iterations: 0,
    total: 0,
    seconds: 0,
    trace: [],
    milestones: [],
    result: undefined,
  };
}

/** Milestones in the order of their iterations, each one better than those before it. */
function with_milestone(list: readonly Milestone[], { iteration, energy, link_poses }: PlanMilestone): Milestone[] {
  const kept = list.filter((one) => one.iteration < iteration && one.energy > energy);
  const later = list.filter((one) => one.iteration > iteration && one.energy < energy);
  return [...kept, { iteration, energy, link_poses }, ...later];
}

/** A copy that is small enough to be kept by the tab: tenths of a millimetre, and few steps of each closing. */
export function compact_plan(state: PlanState): PlanState {
  const { result } = state;
  const milestones = thinned(state.milestones, 40).map((one) => ({ ...one, link_poses: rounded(one.link_poses) }));
  return {
    ...state,
    running: false,
    trace: thinned(state.trace, 400),
    milestones,
    result: result && { ...result, grasps: result.grasps.map(compact_grasp) },
  };
}

function compact_grasp(grasp: Grasp): Grasp {
  return { ...grasp, closing: thinned(grasp.closing, 7).map(rounded) as Grasp["closing"] };
}

function rounded(poses: LinkPoses): LinkPoses {
  return poses.map((pose) => pose.map((value) => Math.round(value * 1e5) / 1e5)) as LinkPoses;
}

/** At most so many, evenly spread, with the first and the last. */
export function thinned<T>(list: readonly T[], most: number): T[] {
  if (list.length <= most) return [...list];
  return Array.from({ length: most }, (_, i) => list[Math.round((i * (list.length - 1)) / (most - 1))]!);
}

/** Form-closed grasps by falling epsilon, then the rest by rising energy; keeps each one's number in the files. */
export function ranked(grasps: readonly Grasp[]): { grasp: Grasp; number: number }[] {
  const order = (a: Grasp, b: Grasp) =>
    Number(b.form_closure) - Number(a.form_closure) || (a.form_closure ? b.epsilon - a.epsilon : a.energy - b.energy);
  return grasps.map((grasp, i) => ({ grasp, number: i + 1 })).sort((a, b) => order(a.grasp, b.grasp));
}
