// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { PerspectiveCamera, Quaternion, Vector3 } from "three";
import type { Stage } from "./stage.ts";

/** Where points of the object frame are seen on the page: the camera is what the app keeps for a reload. */
export async function projector(stage: Stage): Promise<(point: Vector3) => { x: number; y: number }> {
  const kept = await stage.page.evaluate(() => sessionStorage.getItem("eigengrasp.camera"));
  if (!kept) throw new Error("the camera was not kept");
  const place = JSON.parse(kept) as { position: number[]; target: number[] };
  const box = (await stage.page.locator(".view canvas").boundingBox())!;
  const camera = new PerspectiveCamera(38, box.width / box.height, 0.01, 20);
  camera.up.set(0, 0, 1);
  camera.position.fromArray(place.position);
  camera.lookAt(new Vector3().fromArray(place.target));
  camera.updateMatrixWorld();
  return (point) => {
    const seen = point.clone().project(camera);
    return { x: box.x + ((seen.x + 1) / 2) * box.width, y: box.y + ((1 - seen.y) / 2) * box.height };
  };
}

/** The wrist's own axes, as long as the arrows of the gizmo are on the page, in object coordinates. */
export async function gizmo_axes(stage: Stage): Promise<{ base: Vector3; axes: Vector3[] }> {
  const kept = JSON.parse((await stage.page.evaluate(() => sessionStorage.getItem("eigengrasp.camera")))!) as {
    position: number[];
  };
  const [x, y, z, w, a, b, c] = stage.wire.wrist;
  const base = new Vector3(x, y, z);
  const turn = new Quaternion(a, b, c, w);
  const distance = base.distanceTo(new Vector3().fromArray(kept.position));
  const length = distance * 1.9 * Math.tan((Math.PI * 38) / 360) * (0.8 / 4) * 0.42;
  return {
    base,
    axes: [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ].map((axis) => new Vector3().fromArray(axis).applyQuaternion(turn).multiplyScalar(length)),
  };
}
