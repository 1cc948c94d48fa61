// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import {
  AdditiveBlending,
  BufferGeometry,
  ConeGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import { to_vector } from "../core/pose";
import type { Contact, SearchCone } from "../wire/messages";
import { palette } from "./palette";

const up = new Vector3(0, 1, 0);

/** Half angle of the friction cone [rad]. */
export function cone_half_angle(friction: number): number {
  return Math.atan(Math.max(0, friction));
}

/** Contacts: a dot at the point and the friction cone, which opens into the object. */
export class ContactMarks extends Group {
  private readonly surface = new MeshStandardMaterial({
    color: palette.contact,
    emissive: palette.contact.clone().multiplyScalar(0.35),
    transparent: true,
    opacity: 0.5,
    side: DoubleSide,
    depthWrite: false,
    roughness: 0.6,
  });
  /** What of the cones is hidden, shown faintly. */
  private readonly hidden = new MeshBasicMaterial({
    color: palette.contact,
    transparent: true,
    opacity: 0.16,
    side: DoubleSide,
    depthWrite: false,
    depthTest: false,
  });
  private readonly dot = new MeshBasicMaterial({ color: "#ffd0d6", depthTest: false, transparent: true });

  /** @param height of the cones [m] */
  show(contacts: readonly Contact[], height: number): void {
    for (const child of this.children) if (child instanceof Mesh) (child.geometry as BufferGeometry).dispose();
    this.clear();
    if (contacts.length === 0) return;
    const cone = new ConeGeometry(1, 1, 28, 1, true).translate(0, -0.5, 0).rotateX(Math.PI);
    const cones = new InstancedMesh(cone, this.surface, contacts.length);
    const hidden = new InstancedMesh(cone, this.hidden, contacts.length);
    const dots = new InstancedMesh(new SphereGeometry(height * 0.07, 12, 8), this.dot, contacts.length);
    contacts.forEach((contact, i) => {
      const place = contact_matrix(contact, height);
      cones.setMatrixAt(i, place);
      hidden.setMatrixAt(i, place);
      dots.setMatrixAt(i, new Matrix4().setPosition(to_vector(contact.point)));
    });
    cones.renderOrder = 3;
    dots.renderOrder = 4;
    hidden.renderOrder = 3;
    this.add(cones, hidden, dots);
  }
}

/** The unit cone (tip at the origin, opening towards +y) at a contact. A wide cone is drawn with the same slant. */
export function contact_matrix(contact: Contact, slant: number): Matrix4 {
  const angle = cone_half_angle(contact.friction);
  const rotation = new Quaternion().setFromUnitVectors(up, to_vector(contact.normal).normalize());
  const radius = Math.max(slant * Math.sin(angle), slant * 0.02);
  return new Matrix4().compose(
    to_vector(contact.point),
    rotation,
    new Vector3(radius, slant * Math.cos(angle), radius),
  );
}

/** The region ahead of the wrist that is searched: a cone cut off by a ball about its apex. */
export class SearchConeMark extends Group {
  private readonly skin = new Mesh(
    new BufferGeometry(),
    new MeshBasicMaterial({
      color: palette.cone,
      transparent: true,
      opacity: 0.09,
      side: DoubleSide,
      depthWrite: false,
      blending: AdditiveBlending,
    }),
  );
  private readonly edges = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ color: palette.cone, transparent: true, opacity: 0.55 }),
  );
  private shape = "";

  constructor() {
    super();
    this.skin.renderOrder = 1;
    this.add(this.skin, this.edges);
  }

  show(cone: SearchCone): void {
    const shape = [cone.half_angle, cone.nearest, cone.farthest].map((value) => value.toFixed(5)).join();
    if (shape !== this.shape) this.reshape(cone.half_angle, cone.farthest);
    this.shape = shape;
    to_vector(cone.apex, this.position);
    this.quaternion.setFromUnitVectors(up, to_vector(cone.axis).normalize());
  }

  private reshape(half_angle: number, length: number): void {
    const skin = cone_surface(Math.min(half_angle, Math.PI * 0.95), Math.max(length, 1e-3));
    this.skin.geometry.dispose();
    this.edges.geometry.dispose();
    this.skin.geometry = skin;
    this.edges.geometry = cone_lines(Math.min(half_angle, Math.PI * 0.95), Math.max(length, 1e-3));
  }
}

function on_ball(angle: number, turn: number, radius: number): [number, number, number] {
  return [
    radius * Math.sin(angle) * Math.cos(turn),
    radius * Math.cos(angle),
    radius * Math.sin(angle) * Math.sin(turn),
  ];
}

/** Side and round cap, tip at the origin, along +y. */
function cone_surface(half_angle: number, length: number): BufferGeometry {
  const turns = 48;
  const rings = 6;
  const points: number[] = [];
  for (let i = 0; i < turns; ++i) {
    const a = (2 * Math.PI * i) / turns;
    const b = (2 * Math.PI * (i + 1)) / turns;
    points.push(0, 0, 0, ...on_ball(half_angle, a, length), ...on_ball(half_angle, b, length));
    for (let k = 0; k < rings; ++k) {
      const inner = (half_angle * k) / rings;
      const outer = (half_angle * (k + 1)) / rings;
      points.push(...on_ball(inner, a, length), ...on_ball(outer, a, length), ...on_ball(outer, b, length));
      points.push(...on_ball(inner, a, length), ...on_ball(outer, b, length), ...on_ball(inner, b, length));
    }
  }
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
}

/** Axis, four sides and two rings. */
function cone_lines(half_angle: number, length: number): BufferGeometry {
  const points: number[] = [0, 0, 0, 0, length, 0];
  for (let i = 0; i < 4; ++i) points.push(0, 0, 0, ...on_ball(half_angle, (Math.PI * i) / 2, length));
  for (const radius of [length, length / 2]) {
    for (let i = 0; i < 48; ++i) {
      points.push(...on_ball(half_angle, (2 * Math.PI * i) / 48, radius));
      points.push(...on_ball(half_angle, (2 * Math.PI * (i + 1)) / 48, radius));
    }
  }
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
}
