// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import {
  Box3,
  Color,
  NeutralToneMapping,
  DirectionalLight,
  HemisphereLight,
  Mesh,
  PerspectiveCamera,
  Scene,
  Sphere,
  Vector3,
  WebGLRenderer,
} from "three";
import type { LinkPoses } from "../wire/messages";
import { HandFigure, object_mesh } from "./figures";
import type { ModelLibrary } from "./models";
import { hand_material, object_material } from "./palette";
import type { BenchScene } from "./workbench";

const width = 288;
const height = 216;

/** Small pictures of grasps, drawn one at a time between frames of the main view. */
export class Thumbnails {
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(30, width / height, 0.01, 10);
  private readonly hand = new HandFigure(hand_material());
  private readonly look = object_material();
  private renderer: WebGLRenderer | undefined;
  private object: Mesh | undefined;
  private bench: BenchScene | undefined;
  private waiting: { canvas: HTMLCanvasElement; poses: LinkPoses }[] = [];
  private busy = false;

  constructor(private readonly models: ModelLibrary) {
    const sun = new DirectionalLight("#fff6ea", 2.4);
    sun.position.set(0.6, -0.7, 1.2);
    this.scene.background = new Color("#0d1117");
    this.scene.add(sun, new HemisphereLight("#dcebff", "#4a505a", 2.2), this.hand);
    this.camera.up.set(0, 0, 1);
  }

  async set_scene(scene: BenchScene): Promise<void> {
    const [hand, object] = await Promise.all([
      this.models.hand(scene.hand.name),
      this.models.object(scene.object.name),
    ]);
    this.hand.build(hand, scene.hand.links);
    if (this.object) this.scene.remove(this.object);
    const surface = object.values().next().value;
    this.object = surface && object_mesh(surface, this.look, scene.scale);
    if (this.object) this.scene.add(this.object);
    this.bench = scene;
  }

  /** A canvas that is filled soon. */
  picture(poses: LinkPoses): HTMLCanvasElement {
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    this.waiting.push({ canvas, poses });
    this.go_on();
    return canvas;
  }

  forget_waiting(): void {
    this.waiting = [];
  }

  private go_on(): void {
    if (this.busy || this.waiting.length === 0) return;
    this.busy = true;
    window.setTimeout(() => {
      const next = this.waiting.shift();
      if (next) this.draw(next.canvas, next.poses);
      this.busy = false;
      this.go_on();
    }, 12);
  }

  private draw(canvas: HTMLCanvasElement, poses: LinkPoses): void {
    if (!this.bench) return;
    this.hand.pose(poses);
    this.aim(poses);
    this.renderer ??= this.make_renderer();
    this.renderer.render(this.scene, this.camera);
    canvas.getContext("2d")?.drawImage(this.renderer.domElement, 0, 0, width, height);
  }

  /** From the side of the fingertips, across the line from the hand to the object, so that both are seen. */
  private aim(poses: LinkPoses): void {
    const { object, scale } = this.bench!;
    const center = new Vector3(...object.center).multiplyScalar(scale);
    const base = new Vector3(poses[0][0], poses[0][1], poses[0][2]);
    const half = new Vector3(...object.size).multiplyScalar(scale / 2);
    const box = new Box3().expandByPoint(center.clone().add(half)).expandByPoint(center.clone().sub(half));
    for (const link of poses) box.expandByPoint(new Vector3(link[0], link[1], link[2]));
    const { center: middle, radius } = box.getBoundingSphere(new Sphere());
    const way = new Vector3(base.x - center.x, base.y - center.y, 0);
    const side = way.length() > 0.02 ? new Vector3(-way.y, way.x, 0).normalize() : new Vector3(0.6, -0.8, 0);
    if (side.y > 0) side.negate();
    const away = (radius * 0.9 + 0.02) / Math.sin((this.camera.fov * Math.PI) / 360);
    this.camera.position.copy(middle).addScaledVector(side.setZ(0.45).normalize(), away);
    this.camera.lookAt(middle);
  }

  private make_renderer(): WebGLRenderer {
    const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.setSize(width, height, false);
    renderer.toneMapping = NeutralToneMapping;
    return renderer;
  }
}
