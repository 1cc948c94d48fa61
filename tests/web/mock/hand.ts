// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { readFileSync } from "node:fs";
import path from "node:path";
import { Matrix4, Quaternion, Vector3, Euler } from "three";
import { read_obj, type Surface } from "./mesh.ts";
import type { Hand, LinkPoses, Pose, Vec3 } from "../../../viewer/src/wire/messages.ts";

interface Joint {
  name: string;
  parent: string;
  child: string;
  X_PJ: Matrix4;
  axis: Vector3;
  prismatic: boolean;
  fixed: boolean;
  lower: number;
  upper: number;
  mimic: { joint: string; ratio: number; offset: number } | undefined;
}

export interface Dof {
  joint: string;
  speed: number;
  rest: number;
}

/** Just as much of a hand as it takes to draw it: a tree of links from its URDF, and how it closes. */
export class MockHand {
  readonly links: string[];
  readonly shapes = new Map<string, Surface>();
  readonly dofs: Dof[];
  readonly approach: { point: Vector3; direction: Vector3 };
  private readonly joints: Joint[];
  private readonly title: string;

  constructor(
    readonly name: string,
    folder: string,
    private readonly uploaded = false,
  ) {
    const yaml = readFileSync(path.join(folder, "hand.yaml"), "utf8");
    const urdf = readFileSync(path.join(folder, /^urdf: *(\S+)/m.exec(yaml)![1]!), "utf8");
    this.title = /^title: *(.+)/m.exec(yaml)?.[1] ?? name;
    this.links = [...urdf.matchAll(/<link name="([^"]+)"/g)].map((match) => match[1]!);
    this.joints = read_joints(urdf);
    this.dofs = [...yaml.matchAll(/- \{joint: *(\w+), *closing_speed: *([-\d.]+)(?:.*?rest: *([-\d.]+))?/g)].map(
      (match) => ({
        joint: match[1]!,
        speed: Number(match[2]),
        rest: Number(match[3] ?? 0),
      }),
    );
    const vector = (key: string) =>
      new Vector3(...(new RegExp(`^  ${key}: *\\[([^\\]]+)\\]`, "m").exec(yaml)![1]!.split(",").map(Number) as Vec3));
    this.approach = { point: vector("point"), direction: vector("direction").normalize() };
    for (const match of urdf.matchAll(/<link name="([^"]+)">(.*?)<\/link>/gs)) {
      const file = /<mesh filename="([^"]+)"/.exec(match[2]!)?.[1];
      if (file) this.shapes.set(match[1]!, read_obj(path.join(folder, file)));
    }
  }

  limits(joint: string): [number, number] {
    const found = this.joints.find((one) => one.name === joint);
    return found ? [found.lower, found.upper] : [0, 0];
  }

  /** Links that move with a joint. */
  beyond(joint: string): string[] {
    const first = this.joints.filter((one) => one.name === joint || one.mimic?.joint === joint).map((one) => one.child);
    const found = new Set(first);
    for (const one of this.joints) if (found.has(one.parent)) found.add(one.child);
    return [...found];
  }

  poses(X_OH: Matrix4, dofs: ReadonlyMap<string, number>): LinkPoses {
    const placed = new Map<string, Matrix4>([[this.links[0]!, X_OH]]);
    for (const joint of this.joints) {
      const value = joint.mimic
        ? joint.mimic.ratio * (dofs.get(joint.mimic.joint) ?? 0) + joint.mimic.offset
        : (dofs.get(joint.name) ?? 0);
      const motion = joint.fixed
        ? new Matrix4()
        : joint.prismatic
          ? new Matrix4().setPosition(joint.axis.clone().multiplyScalar(value))
          : new Matrix4().makeRotationAxis(joint.axis, value);
      placed.set(joint.child, placed.get(joint.parent)!.clone().multiply(joint.X_PJ).multiply(motion));
    }
    return this.links.map((link) => to_pose(placed.get(link)!)) as LinkPoses;
  }

  rest(): Map<string, number> {
    return new Map(this.dofs.map((dof) => [dof.joint, dof.rest]));
  }

  describe(): Hand {
    return {
      name: this.name,
      title: this.title,
      n_dof: this.dofs.length,
      n_links: this.links.length,
      eigengrasps: 2,
      links: this.links as Hand["links"],
      rest: this.poses(new Matrix4(), this.rest()),
      reach: 0.23,
      approach_point: this.approach.point.toArray(),
      approach_direction: this.approach.direction.toArray(),
      dofs: this.dofs.map(({ joint }) => {
        const [min, max] = this.limits(joint);
        return { name: joint, min, max };
      }),
      amplitudes: ["first", "second"].map((name) => ({ name, min: -4, max: 4 })),
      uploaded: this.uploaded,
    };
  }
}

export function to_pose(matrix: Matrix4): Pose {
  const p = new Vector3();
  const q = new Quaternion();
  matrix.decompose(p, q, new Vector3());
  const sign = q.w < 0 ? -1 : 1;
  return [p.x, p.y, p.z, sign * q.w, sign * q.x, sign * q.y, sign * q.z];
}

export function to_matrix(pose: Pose): Matrix4 {
  return new Matrix4().compose(
    new Vector3(pose[0], pose[1], pose[2]),
    new Quaternion(pose[4], pose[5], pose[6], pose[3]),
    new Vector3(1, 1, 1),
  );
}

/** Joints, each after that of its parent. */
function read_joints(urdf: string): Joint[] {
  const numbers = (text: string | undefined) => (text ?? "0 0 0").trim().split(/\s+/).map(Number) as Vec3;
  const list = [...urdf.matchAll(/<joint name="([^"]+)" type="([^"]+)">(.*?)<\/joint>/gs)].map(
    ([, name, type, body]) => {
      const value = (pattern: RegExp) => pattern.exec(body!)?.[1];
      const mimic = value(/<mimic joint="([^"]+)"/);
      const turn = numbers(value(/<origin[^>]*rpy="([^"]+)"/));
      const X_PJ = new Matrix4().makeRotationFromEuler(new Euler(turn[0], turn[1], turn[2], "ZYX"));
      return {
        name: name!,
        parent: value(/<parent link="([^"]+)"/)!,
        child: value(/<child link="([^"]+)"/)!,
        X_PJ: X_PJ.setPosition(new Vector3(...numbers(value(/<origin[^>]*xyz="([^"]+)"/)))),
        axis: new Vector3(...numbers(value(/<axis xyz="([^"]+)"/) ?? "0 0 1")).normalize(),
        prismatic: type === "prismatic",
        fixed: type === "fixed",
        lower: Number(value(/lower="([^"]+)"/) ?? 0),
        upper: Number(value(/upper="([^"]+)"/) ?? 0),
        mimic: mimic
          ? {
              joint: mimic,
              ratio: Number(value(/multiplier="([^"]+)"/) ?? 1),
              offset: Number(value(/offset="([^"]+)"/) ?? 0),
            }
          : undefined,
      };
    },
  );
  const ordered: Joint[] = [];
  const known = new Set([/<link name="([^"]+)"/.exec(urdf)![1]!]);
  while (ordered.length < list.length) {
    for (const joint of list) {
      if (known.has(joint.child) || !known.has(joint.parent)) continue;
      ordered.push(joint);
      known.add(joint.child);
    }
  }
  return ordered;
}
