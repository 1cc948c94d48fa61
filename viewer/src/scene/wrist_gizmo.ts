// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Object3D } from "three";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";
import { from_parts, position_of, rotation_of } from "../core/pose";
import type { Pose } from "../wire/messages";
import type { Stage } from "./stage";

/** Arrows and rings at the wrist, to be dragged. */
export class WristGizmo {
  private readonly handle = new Object3D();
  private readonly controls: TransformControls;
  private readonly helper: Object3D;

  constructor(
    private readonly stage: Stage,
    on_drag: (pose: Pose) => void,
  ) {
    this.controls = new TransformControls(stage.camera, stage.renderer.domElement);
    this.controls.setSize(0.8);
    this.controls.setColors("#ff5d73", "#3ddc97", "#58a6ff", "#ffd866");
    this.controls.setSpace("local");
    this.controls.attach(this.handle);
    this.helper = this.controls.getHelper();
    this.controls.addEventListener("dragging-changed", (event) => {
      stage.orbit.enabled = event.value !== true;
    });
    this.controls.addEventListener("change", () => stage.request());
    this.controls.addEventListener("objectChange", () =>
      on_drag(from_parts(this.handle.position, this.handle.quaternion)),
    );
    stage.world.add(this.handle);
    stage.scene.add(this.helper);
    this.show(false);
  }

  get dragging(): boolean {
    return this.controls.dragging;
  }

  get turns(): boolean {
    return this.controls.mode === "rotate";
  }

  set turns(on: boolean) {
    this.controls.setMode(on ? "rotate" : "translate");
    this.stage.request();
  }

  show(on: boolean): void {
    this.helper.visible = on;
    this.controls.enabled = on;
    this.stage.request();
  }

  place(pose: Pose): void {
    position_of(pose, this.handle.position);
    rotation_of(pose, this.handle.quaternion);
    this.stage.request();
  }
}
