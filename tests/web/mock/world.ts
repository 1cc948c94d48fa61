// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { Vector3 } from "three";
import { MockHand } from "./hand.ts";
import { box_of, read_obj, type Surface, write_glb } from "./mesh.ts";
import type { Object as SceneObject, Vec3 } from "../../../viewer/src/wire/messages.ts";

const data = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../../../data");

/** Hands and objects of the repository, read when they are asked for first. */
export class World {
  readonly hands = new Map(
    ["human", "barrett-metal", "dlr", "robonaut"].map((name) => [
      name,
      new MockHand(name, path.join(data, "hands", name)),
    ]),
  );
  readonly objects = new Map<string, { surface: Surface; uploaded: boolean }>();
  private readonly files = new Map<string, Buffer>();

  constructor() {
    for (const file of readdirSync(path.join(data, "objects")).filter((name) => name.endsWith(".obj"))) {
      this.objects.set(file.replace(/\.obj$/, ""), {
        surface: read_obj(path.join(data, "objects", file)),
        uploaded: false,
      });
    }
  }

  /** Takes the folder of a hand in, packed as .tar.gz. Returns its name. */
  add_hand(archive: Buffer): string {
    const folder = mkdtempSync(path.join(tmpdir(), "eigengrasp-mock-"));
    try {
      execFileSync("tar", ["xzf", "-", "-C", folder], { input: archive, stdio: ["pipe", "ignore", "ignore"] });
      const inner = path.join(folder, readdirSync(folder)[0] ?? "");
      if (!existsSync(path.join(inner, "hand.yaml"))) throw new Error("the archive holds no hand.yaml, expected one");
      const name = /^name: *(\S+)/m.exec(readFileSync(path.join(inner, "hand.yaml"), "utf8"))?.[1] ?? "hand";
      this.hands.set(name, new MockHand(name, inner, true));
      return name;
    } finally {
      rmSync(folder, { recursive: true });
    }
  }

  describe_objects(): SceneObject[] {
    return [...this.objects].map(([name, { surface, uploaded }]) => {
      const { low, high } = box_of(surface);
      return {
        name,
        title: name,
        triangles: surface.triangles.length / 3,
        uploaded,
        size: high.map((value, i) => value - low[i]!) as Vec3,
        center: high.map((value, i) => (value + low[i]!) / 2) as Vec3,
      };
    });
  }

  center(name: string): Vector3 {
    const { low, high } = box_of(this.objects.get(name)!.surface);
    return new Vector3(...(high.map((value, i) => (value + low[i]!) / 2) as Vec3));
  }

  model(kind: string, name: string): Buffer | undefined {
    const key = `${kind}/${name}`;
    const shapes =
      kind === "hands"
        ? this.hands.get(name)?.shapes
        : this.objects.has(name)
          ? new Map([["object", this.objects.get(name)!.surface]])
          : undefined;
    if (!this.files.has(key) && shapes) this.files.set(key, write_glb(shapes));
    return this.files.get(key);
  }
}
