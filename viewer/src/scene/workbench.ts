// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Box3, Mesh, type MeshStandardMaterial, Sphere, Vector3 } from "three";
import { home_pose, open_hand } from "../core/home_pose";
import type { Hand, LinkPoses, Object as SceneObject } from "../wire/messages";
import { Ground, HandFigure, object_mesh } from "./figures";
import { ContactMarks, SearchConeMark } from "./marks";
import type { ModelLibrary } from "./models";
import { ghost_material, hand_material, object_material, palette } from "./palette";
import type { Stage } from "./stage";

export interface BenchScene {
  hand: Hand;
  object: SceneObject;
  scale: number;
  table: boolean;
}

/** What stands in the 3-D view: the hand, its ghosts, the object, the marks. Pages say what is shown of it. */
export class Workbench {
  readonly hand: HandFigure;
  readonly ghost: HandFigure;
  readonly contacts = new ContactMarks();
  readonly cone = new SearchConeMark();
  private readonly hand_look = hand_material();
  private readonly object_look: MeshStandardMaterial = object_material();
  private readonly ground = new Ground();
  private object: Mesh | undefined;
  private shown: BenchScene | undefined;
  private framed = "";
  private turn = 0;

  constructor(
    readonly stage: Stage,
    private readonly models: ModelLibrary,
  ) {
    this.hand = new HandFigure(this.hand_look);
    this.ghost = new HandFigure(ghost_material(palette.ghost, 0.34), false);
    stage.world.add(this.hand, this.ghost, this.contacts, this.cone);
    stage.scene.add(this.ground);
    this.clear_marks();
  }

  get scene(): BenchScene | undefined {
    return this.shown;
  }

  /** Loads the models and puts them up; of several calls the last one wins. Tells whether this one did. */
  async set_scene(scene: BenchScene): Promise<boolean> {
    const turn = ++this.turn;
    const [hand, object] = await Promise.all([
      this.models.hand(scene.hand.name),
      this.models.object(scene.object.name),
    ]);
    if (turn !== this.turn) return false;
    this.hand.build(hand, scene.hand.links);
    this.ghost.build(hand, scene.hand.links);
    if (this.object) this.stage.world.remove(this.object);
    const surface = object.values().next().value;
    this.object = surface ? object_mesh(surface, this.object_look, scene.scale) : undefined;
    if (this.object) this.stage.world.add(this.object);
    this.shown = scene;
    this.ground.set(this.bottom, scene.table);
    this.aim(scene);
    this.stage.request();
    return true;
  }

  pose_hand(poses: LinkPoses | undefined): void {
    this.hand.visible = poses !== undefined;
    if (poses) this.hand.pose(poses);
    this.stage.request();
  }

  pose_ghost(poses: LinkPoses | undefined): void {
    this.ghost.visible = poses !== undefined;
    if (poses) this.ghost.pose(poses);
    this.stage.request();
  }

  /** See-through, so that the cones inside show. */
  see_through(on: boolean): void {
    if (this.object_look.transparent === on) return;
    this.object_look.transparent = on;
    this.object_look.opacity = on ? 0.5 : 1;
    this.object_look.depthWrite = !on;
    this.object_look.needsUpdate = true;
    this.stage.request();
  }

  warn(blocked: boolean): void {
    this.hand_look.color.copy(blocked ? palette.blocked : palette.hand);
  }

  /** How far the object, with the hand that holds it, stands above its place [m]. The view goes along. */
  lift(height: number): void {
    this.stage.raise_view((height - this.stage.world.position.z) * 0.75);
    this.stage.world.position.z = height;
    this.stage.request();
  }

  clear_marks(): void {
    this.pose_hand(undefined);
    this.pose_ghost(undefined);
    this.contacts.visible = false;
    this.cone.visible = false;
    this.warn(false);
    this.see_through(false);
    this.lift(0);
  }

  /** Height of the object's lowest point [m]. */
  get bottom(): number {
    if (!this.shown) return 0;
    const { object, scale } = this.shown;
    return (object.center[2] - object.size[2] / 2) * scale;
  }

  get center(): Vector3 {
    return this.shown ? new Vector3(...this.shown.object.center).multiplyScalar(this.shown.scale) : new Vector3();
  }

  /** Radius of the ball about the object's centre in which all happens [m]. */
  get radius(): number {
    if (!this.shown) return 0.3;
    const half = new Vector3(...this.shown.object.size).multiplyScalar(this.shown.scale / 2).length();
    return half + this.shown.hand.reach * 0.55;
  }

  /** Sees the object and the hand at the place where it begins. */
  look_home(): void {
    if (!this.shown) return;
    const { hand, object, scale } = this.shown;
    const box = new Box3();
    const links = open_hand(hand, home_pose(hand, object, scale));
    for (const link of links) box.expandByPoint(new Vector3(link[0], link[1], link[2]));
    const palm = new Vector3(links[0][0], links[0][1], links[0][2]);
    const wrist = palm.clone().addScaledVector(palm.clone().sub(this.center).normalize(), 0.06);
    box.expandByPoint(wrist);
    const half = new Vector3(...object.size).multiplyScalar(scale / 2);
    box.expandByPoint(this.center.add(half)).expandByPoint(this.center.sub(half));
    const ball = box.getBoundingSphere(new Sphere());
    this.stage.frame_ball(ball.center, ball.radius * 1.02);
  }

  /** The camera moves only where another object or hand came, so that an operator keeps the view of his choice. */
  private aim(scene: BenchScene): void {
    this.stage.light_ball(this.center, this.radius + scene.hand.reach);
    const key = [scene.hand.name, scene.object.name, scene.scale].join("|");
    if (this.framed !== key && this.framed !== "kept") this.look_home();
    this.framed = key;
  }

  /** The view was restored: the next scene leaves it. */
  keep_view(): void {
    this.framed = "kept";
  }
}
