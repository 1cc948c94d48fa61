// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Matrix4, Quaternion, Vector3 } from "three";
import { type MockHand, to_matrix } from "./hand.ts";
import type { Surface } from "./mesh.ts";
import type { Contact, Grasp, LinkPoses, Vec3 } from "../../../viewer/src/wire/messages.ts";

type Random = () => number;

/** A stream of numbers in [0, 1) that is the same for the same seed. */
export function random_stream(seed: number): Random {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** A hand pose whose palm faces the object from some direction, its approach point so far from the centre. */
export function facing_pose(hand: MockHand, center: Vector3, from: Vector3, roll: number, away: number): Matrix4 {
  const turn = new Quaternion().setFromUnitVectors(hand.approach.direction, from.clone().negate());
  turn.premultiply(new Quaternion().setFromAxisAngle(from, roll));
  const place = center.clone().addScaledVector(from, away).sub(hand.approach.point.clone().applyQuaternion(turn));
  return new Matrix4().compose(place, turn, new Vector3(1, 1, 1));
}

export function distance_to(surface: Surface, p: Vector3): { distance: number; point: Vector3 } {
  let best = Infinity;
  let at = 0;
  const { points } = surface;
  for (let i = 0; i < points.length; i += 9) {
    const d = (points[i]! - p.x) ** 2 + (points[i + 1]! - p.y) ** 2 + (points[i + 2]! - p.z) ** 2;
    if (d < best) [best, at] = [d, i];
  }
  return { distance: Math.sqrt(best), point: new Vector3(points[at], points[at + 1], points[at + 2]) };
}

/** Closes each finger until the middle of one of its links is near the surface. */
export function close_hand(hand: MockHand, surface: Surface, X_OH: Matrix4): { path: LinkPoses[]; touching: string[] } {
  const steps = 16;
  const values = hand.rest();
  const middles = new Map([...hand.shapes].map(([link, shape]) => [link, middle(shape)]));
  const stopped = new Set<string>();
  const touching = new Set<string>();
  const path = [hand.poses(X_OH, values)];
  for (let step = 0; step < steps; ++step) {
    for (const dof of hand.dofs) {
      const [lower, upper] = hand.limits(dof.joint);
      const open = stopped.has(dof.joint) ? 0 : dof.speed;
      values.set(dof.joint, Math.min(upper, Math.max(lower, values.get(dof.joint)! + (open * 1.5) / steps)));
    }
    const poses = hand.poses(X_OH, values);
    path.push(poses);
    for (const [link, point] of middles) {
      const place = point.clone().applyMatrix4(to_matrix(poses[hand.links.indexOf(link)]!));
      if (distance_to(surface, place).distance > 0.0125) continue;
      if (link !== hand.links[0]) touching.add(link);
      for (const dof of hand.dofs) if (hand.beyond(dof.joint).includes(link)) stopped.add(dof.joint);
    }
  }
  return { path, touching: [...touching] };
}

/** A grasp that looks like one; its figures are made up. */
export function make_grasp(hand: MockHand, surface: Surface, center: Vector3, X_OH: Matrix4, random: Random): Grasp {
  const { path, touching } = close_hand(hand, surface, X_OH);
  const last = path[path.length - 1]!;
  const contacts = touching.map((link, patch): Contact => {
    const place = middle(hand.shapes.get(link)!).applyMatrix4(to_matrix(last[hand.links.indexOf(link)]!));
    const { point } = distance_to(surface, place);
    const normal = point.clone().sub(place).normalize();
    return {
      point: point.toArray(),
      normal: (normal.lengthSq() > 0 ? normal : center.clone().sub(point).normalize()).toArray() as Vec3,
      friction: 0.6 + 0.4 * random(),
      torsion_length: 0.004,
      link,
      patch,
    };
  });
  const form_closure = contacts.length >= 3;
  return {
    form_closure,
    epsilon: form_closure ? 0.02 + 0.2 * random() : 0,
    volume: form_closure ? random() : 0,
    energy: 0.2 + random(),
    max_penetration: 2e-4 * random(),
    closing: path as unknown as Grasp["closing"],
    contacts,
  };
}

function middle(shape: Surface): Vector3 {
  const sum = new Vector3();
  for (let i = 0; i < shape.points.length; i += 3)
    sum.add(new Vector3(shape.points[i], shape.points[i + 1], shape.points[i + 2]));
  return sum.divideScalar(shape.points.length / 3);
}
