// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { type BufferGeometry, Mesh, type Object3D } from "three";
import { type GLTF, GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { mergeGeometries, toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Api } from "../wire/api";

/** Surfaces by the name of their node: the links of a hand, or "object". */
export type Shapes = ReadonlyMap<string, BufferGeometry>;

const crease_angle = (35 * Math.PI) / 180;

/** Models as the server sends them, each fetched once. */
export class ModelLibrary {
  private readonly kept = new Map<string, Promise<Shapes>>();
  private readonly loader = new GLTFLoader();

  constructor(private readonly api: Api) {}

  hand(name: string): Promise<Shapes> {
    return this.load("hands", name);
  }

  object(name: string): Promise<Shapes> {
    return this.load("objects", name);
  }

  /** The server has another model under a name that is known here. */
  forget(kind: "hands" | "objects", name: string): void {
    this.kept.delete(`${kind}/${name}`);
  }

  private load(kind: "hands" | "objects", name: string): Promise<Shapes> {
    const key = `${kind}/${name}`;
    const known = this.kept.get(key);
    if (known) return known;
    const loading = this.fetch(kind, name);
    this.kept.set(key, loading);
    loading.catch(() => this.kept.delete(key));
    return loading;
  }

  private async fetch(kind: "hands" | "objects", name: string): Promise<Shapes> {
    const file = await this.loader.parseAsync(await this.api.model(kind, name), "");
    const parts = new Map<string, BufferGeometry[]>();
    file.scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const owner = node_name(file, node);
      parts.set(owner, [...(parts.get(owner) ?? []), smooth(node.geometry as BufferGeometry)]);
    });
    const shapes = new Map<string, BufferGeometry>();
    for (const [owner, list] of parts) shapes.set(owner, list.length === 1 ? list[0]! : mergeGeometries(list));
    return shapes;
  }
}

/** Name of the node that a mesh belongs to, as the file has it: the loader's own names are changed to be unique. */
function node_name(file: GLTF, mesh: Mesh): string {
  const nodes = (file.parser.json as { nodes: { name?: string }[] }).nodes;
  for (let place: Object3D | null = mesh; place; place = place.parent) {
    const index = file.parser.associations.get(place)?.nodes;
    const name = index === undefined ? undefined : nodes[index]?.name;
    if (name !== undefined) return name;
  }
  return mesh.name;
}

/** Round surfaces are shaded smoothly, edges stay sharp. Vertices are matched at a hundredth of a unit: a scale of
 *  metres is too coarse for that. */
function smooth(source: BufferGeometry): BufferGeometry {
  const bare = source.clone();
  for (const name of Object.keys(bare.attributes)) if (name !== "position") bare.deleteAttribute(name);
  const fine = 1e4;
  return toCreasedNormals(bare.scale(fine, fine, fine), crease_angle).scale(1 / fine, 1 / fine, 1 / fine);
}
