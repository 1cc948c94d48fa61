// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Matrix4, Quaternion, Vector3 } from "three";
import type { Hand, LinkPoses, Object as SceneObject, Pose } from "../wire/messages";
import { compose, from_parts, to_vector } from "./pose";

const clearance = 0.1;

/**
 * Where an operator would begin: the palm faces the middle of the object from its side, the fingers point away
 * from the viewer; from above where the object is flat.
 */
export function home_pose(hand: Hand, object: SceneObject, scale: number): Pose {
  const size = to_vector(object.size).multiplyScalar(scale);
  const flat = size.z < 0.45 * Math.min(size.x, size.y);
  const toward = flat ? new Vector3(0, 0, -1) : new Vector3(-1, 0, -0.25).normalize();
  const away = (flat ? size.z : Math.max(size.x, size.y)) / 2 + clearance;
  const palm = to_vector(hand.approach_direction).normalize();
  const rotation = turn(palm, finger_direction(hand, palm), toward, new Vector3(0, 1, 0));
  const point = to_vector(object.center).multiplyScalar(scale).addScaledVector(toward, -away);
  return from_parts(point.sub(to_vector(hand.approach_point).applyQuaternion(rotation)), rotation);
}

/** The links of the open hand with its base at a pose. */
export function open_hand(hand: Hand, base: Pose): LinkPoses {
  return hand.rest.map((link) => compose(base, link)) as LinkPoses;
}

/** From the base to the middle of the links, across the palm's normal. */
function finger_direction(hand: Hand, palm: Vector3): Vector3 {
  const middle = new Vector3();
  for (const link of hand.rest) middle.add(new Vector3(link[0], link[1], link[2]));
  middle.addScaledVector(palm, -middle.dot(palm));
  if (middle.length() > 0.01 * hand.rest.length) return middle.normalize();
  const other = Math.abs(palm.x) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
  return other.addScaledVector(palm, -other.dot(palm)).normalize();
}

/** The rotation that takes a to x and, as far as that allows, b to y. @pre a and b are at a right angle */
function turn(a: Vector3, b: Vector3, x: Vector3, y: Vector3): Quaternion {
  const across = y.clone().addScaledVector(x, -y.dot(x)).normalize();
  const from = new Matrix4().makeBasis(a, b, a.clone().cross(b));
  const to = new Matrix4().makeBasis(x, across, x.clone().cross(across));
  return new Quaternion().setFromRotationMatrix(to.multiply(from.transpose()));
}
