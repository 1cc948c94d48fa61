// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { BoxGeometry, type BufferGeometry, Group, type Material, Mesh, PlaneGeometry, ShadowMaterial } from "three";
import { position_of, rotation_of } from "../core/pose";
import type { LinkPoses } from "../wire/messages";
import { ground_grid } from "./grid";
import type { Shapes } from "./models";
import { table_material } from "./palette";

/** A hand: one mesh a link, each at its own pose. */
export class HandFigure extends Group {
  private links: (Mesh | undefined)[] = [];

  constructor(
    private readonly look: Material,
    private readonly solid = true,
  ) {
    super();
  }

  build(shapes: Shapes, names: readonly string[]): void {
    this.clear();
    this.links = names.map((name) => {
      const geometry = shapes.get(name);
      if (!geometry) return undefined;
      const mesh = new Mesh(geometry, this.look);
      mesh.castShadow = this.solid;
      mesh.receiveShadow = this.solid;
      mesh.renderOrder = this.solid ? 0 : 2;
      this.add(mesh);
      return mesh;
    });
  }

  pose(poses: LinkPoses): void {
    poses.forEach((pose, i) => {
      const link = this.links[i];
      if (!link) return;
      position_of(pose, link.position);
      rotation_of(pose, link.quaternion);
    });
  }
}

export function object_mesh(geometry: BufferGeometry, look: Material, scale: number): Mesh {
  const mesh = new Mesh(geometry, look);
  mesh.scale.setScalar(scale);
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return mesh;
}

/** What is below: a floor that takes shadows and has lines, and a table's top where there is one. */
export class Ground extends Group {
  private readonly floor = new Mesh(new PlaneGeometry(8, 8), new ShadowMaterial({ opacity: 0.45 }));
  private readonly grid = ground_grid();
  private readonly table = new Mesh(new BoxGeometry(0.9, 0.9, 0.03), table_material());

  constructor() {
    super();
    this.floor.receiveShadow = true;
    this.table.receiveShadow = true;
    this.table.castShadow = true;
    this.add(this.floor, this.grid, this.table);
  }

  /** @param height of the lowest point of the object, or of the table's top [m] */
  set(height: number, table: boolean): void {
    const drop = table ? 0.03 + 0.32 : 0;
    this.table.visible = table;
    this.table.position.z = height - 0.015 - 0.0004;
    this.grid.position.z = height - drop - 0.0004;
    this.floor.position.z = height - drop - 0.0008;
  }
}
