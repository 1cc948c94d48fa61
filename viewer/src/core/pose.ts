// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Matrix4, Quaternion, Vector3 } from "three";
import type { LinkPoses, Pose, Vec3 } from "../wire/messages";

export const identity_pose: Pose = [0, 0, 0, 1, 0, 0, 0];
const unit_scale = new Vector3(1, 1, 1);

export function position_of(pose: Pose, out = new Vector3()): Vector3 {
  return out.set(pose[0], pose[1], pose[2]);
}

export function rotation_of(pose: Pose, out = new Quaternion()): Quaternion {
  return out.set(pose[4], pose[5], pose[6], pose[3]).normalize();
}

export function to_vector(p: Vec3, out = new Vector3()): Vector3 {
  return out.set(p[0], p[1], p[2]);
}

export function to_matrix(pose: Pose, out = new Matrix4()): Matrix4 {
  return out.compose(position_of(pose), rotation_of(pose), unit_scale);
}

/** Of unit length and with w >= 0, as everywhere in eigengrasp. */
export function from_parts(position: Vector3, rotation: Quaternion): Pose {
  const q = rotation.clone().normalize();
  const sign = q.w < 0 ? -1 : 1;
  return [position.x, position.y, position.z, sign * q.w, sign * q.x, sign * q.y, sign * q.z];
}

/** The product a * b: b is given in the frame of a. */
export function compose(a: Pose, b: Pose): Pose {
  const rotation = rotation_of(a);
  const position = position_of(b).applyQuaternion(rotation).add(position_of(a));
  return from_parts(position, rotation.multiply(rotation_of(b)));
}

/** On the way from a (0) to b (1): straight in position, the shorter way round in rotation. */
export function interpolate_pose(a: Pose, b: Pose, t: number): Pose {
  const position = position_of(a).lerp(position_of(b), t);
  return from_parts(position, rotation_of(a).slerp(rotation_of(b), t));
}

export function interpolate_links(a: LinkPoses, b: LinkPoses, t: number): LinkPoses {
  if (t <= 0) return a;
  if (t >= 1) return b;
  return b.map((to, i) => interpolate_pose(a[i] ?? to, to, t)) as LinkPoses;
}

/** A place on a path of several postures: 0 is the first, 1 the last. */
export function along_path(path: readonly LinkPoses[], t: number): LinkPoses | undefined {
  const place = Math.min(1, Math.max(0, t)) * (path.length - 1);
  const index = Math.min(Math.floor(place), Math.max(0, path.length - 2));
  const from = path[index];
  const to = path[index + 1] ?? from;
  return from && to ? interpolate_links(from, to, place - index) : undefined;
}

/** Greatest distance between the origins of two sets of links [m]. */
export function links_apart(a: LinkPoses, b: LinkPoses): number {
  let most = 0;
  a.forEach((from, i) => {
    const to = b[i];
    if (to) most = Math.max(most, Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]));
  });
  return most;
}
