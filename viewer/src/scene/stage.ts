// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import {
  DirectionalLight,
  Group,
  HemisphereLight,
  NeutralToneMapping,
  PCFShadowMap,
  PerspectiveCamera,
  PMREMGenerator,
  Scene,
  type Texture,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";
import { Topic } from "../core/signal";
import {
  draws_by_software,
  FrameBudget,
  qualities,
  type QualityChoice,
  software_level,
  when_drawn,
} from "./frame_budget";
import { palette } from "./palette";

export interface CameraPlace {
  position: [number, number, number];
  target: [number, number, number];
}

/** The 3-D view: renderer, camera, lights. Draws only when something changed; z is up. */
export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(38, 1, 0.01, 20);
  readonly renderer: WebGLRenderer;
  readonly orbit: OrbitControls;
  /** What stands in the object frame; rises when the object is lifted. */
  readonly world = new Group();
  /** Seconds since the frame before. A listener that wants to go on calls `request`. */
  readonly frames = new Topic<number>();
  private readonly sun = new DirectionalLight("#fff6ea", 2.3);
  private readonly levels = qualities(window.devicePixelRatio);
  private readonly budget: FrameBudget;
  private readonly sky = new HemisphereLight("#e4eeff", "#3c424b", 0.3);
  private surroundings: Texture | null = null;
  private measuring = false;
  private wanted = false;
  /** The last frame asked for the next one: the time between them is that of a motion. */
  private flowing = false;
  private last = 0;

  constructor(
    private readonly box: HTMLElement,
    private readonly quality: QualityChoice = "auto",
  ) {
    const plain = quality === "fast" || (quality === "auto" && draws_by_software());
    this.budget = new FrameBudget(this.levels.length - 1, plain ? software_level : 0);
    this.renderer = new WebGLRenderer({ antialias: !plain, powerPreference: "high-performance" });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.domElement.tabIndex = 0;
    this.renderer.domElement.setAttribute("aria-label", "3-D view");
    box.append(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.orbit = new OrbitControls(this.camera, this.renderer.domElement);
    this.orbit.enableDamping = !plain;
    this.orbit.dampingFactor = 0.15;
    this.orbit.minDistance = 0.08;
    this.orbit.maxDistance = 4;
    this.orbit.addEventListener("change", () => this.request());
    this.dress();
    this.apply_quality();
    this.scene.add(this.world);
    new ResizeObserver(() => this.fit()).observe(box);
  }

  /** Asks for a frame; any number of calls make one. */
  request(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame((now) => this.draw(now));
  }

  /** Looks at a ball from the front right, a little from above. */
  frame_ball(center: Vector3, radius: number): void {
    const away = (radius / Math.sin((this.camera.fov * Math.PI) / 360)) * 1.05;
    this.camera.position.copy(center).addScaledVector(new Vector3(0.62, -0.85, 0.5).normalize(), away);
    this.orbit.target.copy(center);
    this.orbit.update();
    this.request();
  }

  /** Shadows are sharp where the scene is. */
  light_ball(center: Vector3, radius: number): void {
    this.sun.position.copy(center).add(new Vector3(0.5, -0.45, 1.1).multiplyScalar(radius * 2.2));
    this.sun.target.position.copy(center);
    const box = this.sun.shadow.camera;
    box.left = box.bottom = -radius * 1.6;
    box.right = box.top = radius * 1.6;
    box.near = 0.01;
    box.far = radius * 7;
    box.updateProjectionMatrix();
    this.request();
  }

  raise_view(by: number): void {
    if (by === 0) return;
    this.camera.position.z += by;
    this.orbit.target.z += by;
  }

  get place(): CameraPlace {
    return { position: this.camera.position.toArray(), target: this.orbit.target.toArray() };
  }

  set place(place: CameraPlace) {
    this.camera.position.fromArray(place.position);
    this.orbit.target.fromArray(place.target);
    this.orbit.update();
    this.request();
  }

  /** What is seen now, as a PNG. */
  picture(): Promise<Blob> {
    this.renderer.render(this.scene, this.camera);
    return new Promise((resolve, reject) => {
      this.renderer.domElement.toBlob((blob) =>
        blob ? resolve(blob) : reject(new Error("The picture could not be made")),
      );
    });
  }

  private dress(): void {
    this.scene.background = palette.background;
    const maker = new PMREMGenerator(this.renderer);
    this.surroundings = maker.fromScene(new RoomEnvironment(), 0.04).texture;
    this.scene.environmentIntensity = 0.38;
    maker.dispose();
    this.sun.shadow.radius = 5;
    this.sun.shadow.bias = -0.0004;
    const fill = new DirectionalLight("#9fc4ff", 0.55);
    fill.position.set(-1.2, 0.8, 0.6);
    this.scene.add(this.sun, this.sun.target, fill, this.sky);
  }

  private draw(now: number): void {
    this.wanted = false;
    const seconds = this.flowing ? Math.min(0.25, Math.max(0.001, (now - this.last) / 1e3)) : 1 / 60;
    this.last = now;
    this.frames.emit(seconds);
    if (this.orbit.update()) this.request();
    this.flowing = this.wanted;
    this.renderer.render(this.scene, this.camera);
    this.measure();
  }

  private measure(): void {
    const gl = this.renderer.getContext();
    if (this.quality !== "auto" || this.measuring || !(gl instanceof WebGL2RenderingContext)) return;
    this.measuring = true;
    when_drawn(gl, (ms) => {
      this.measuring = false;
      if (this.budget.add(ms)) this.apply_quality();
    });
  }

  private apply_quality(): void {
    const { pixel_ratio, shadow_size, surroundings } = this.levels[this.budget.level]!;
    this.renderer.setPixelRatio(pixel_ratio);
    this.sun.castShadow = shadow_size > 0;
    this.scene.environment = surroundings ? this.surroundings : null;
    this.sky.intensity = surroundings ? 0.3 : 2.2;
    if (shadow_size > 0) {
      this.sun.shadow.normalBias = 3.2 / shadow_size;
      this.sun.shadow.mapSize.set(shadow_size, shadow_size);
      this.sun.shadow.map?.dispose();
      this.sun.shadow.map = null;
    }
    this.request();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.request();
  }
}
