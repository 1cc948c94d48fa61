// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { readFileSync } from "node:fs";

export interface Surface {
  points: Float32Array;
  triangles: Uint32Array;
}

export function read_obj(file: string): Surface {
  return parse_obj(readFileSync(file, "utf8"), 1);
}

/** Vertices and triangles of a Wavefront file. */
export function parse_obj(text: string, scale: number): Surface {
  const points: number[] = [];
  const triangles: number[] = [];
  for (const line of text.split("\n")) {
    const [kind, ...words] = line.trim().split(/\s+/);
    if (kind === "v") points.push(...words.slice(0, 3).map((word) => Number(word) * scale));
    if (kind === "f") {
      const corners = words.map((word) => Number(word.split("/")[0]) - 1);
      for (let i = 2; i < corners.length; ++i) triangles.push(corners[0]!, corners[i - 1]!, corners[i]!);
    }
  }
  if (points.length === 0) throw new Error("the file has no vertices");
  return { points: new Float32Array(points), triangles: new Uint32Array(triangles) };
}

export function box_of(surface: Surface): { low: number[]; high: number[] } {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  surface.points.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3]!, value);
    high[i % 3] = Math.max(high[i % 3]!, value);
  });
  return { low, high };
}

/** A binary glTF file with one node for each surface, below a root. */
export function write_glb(surfaces: ReadonlyMap<string, Surface>): Buffer {
  const chunks: Buffer[] = [];
  let length = 0;
  const append = (bytes: ArrayBufferView): number => {
    chunks.push(Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength));
    length += bytes.byteLength;
    return length - bytes.byteLength;
  };
  const json = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name: "root", children: [] as number[] }] as object[],
    meshes: [] as object[],
    accessors: [] as object[],
    bufferViews: [] as object[],
    buffers: [] as object[],
  };
  const children = (json.nodes[0] as { children: number[] }).children;
  for (const [name, surface] of surfaces) {
    const { low, high } = box_of(surface);
    const index = json.meshes.length;
    json.bufferViews.push(
      { buffer: 0, byteOffset: append(surface.points), byteLength: surface.points.byteLength, target: 34962 },
      { buffer: 0, byteOffset: append(surface.triangles), byteLength: surface.triangles.byteLength, target: 34963 },
    );
    json.accessors.push(
      {
        bufferView: 2 * index,
        componentType: 5126,
        count: surface.points.length / 3,
        type: "VEC3",
        min: low,
        max: high,
      },
      { bufferView: 2 * index + 1, componentType: 5125, count: surface.triangles.length, type: "SCALAR" },
    );
    json.meshes.push({ name, primitives: [{ attributes: { POSITION: 2 * index }, indices: 2 * index + 1 }] });
    children.push(json.nodes.length);
    json.nodes.push({ name, mesh: index });
  }
  json.buffers.push({ byteLength: length });
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 0x20)]);
  const head = Buffer.alloc(20);
  head.write("glTF", 0, "latin1");
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + 8 + padded.length + 8 + length, 8);
  head.writeUInt32LE(padded.length, 12);
  head.writeUInt32LE(0x4e4f534a, 16);
  const binary = Buffer.alloc(8);
  binary.writeUInt32LE(length, 0);
  binary.writeUInt32LE(0x004e4942, 4);
  return Buffer.concat([head, padded, binary, ...chunks]);
}
