// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { BackSide, Color, DoubleSide, MeshPhysicalMaterial, MeshStandardMaterial } from "three";

/** Colours of the 3-D view; the style sheet has the same ones for the legend. */
export const palette = {
  background: new Color("#12161c"),
  hand: new Color("#6a9fd8"),
  object: new Color("#e09b45"),
  table: new Color("#454e59"),
  ghost: new Color("#3ddc97"),
  pregrasp: new Color("#5aa9ff"),
  cone: new Color("#8f7bff"),
  contact: new Color("#ff5d73"),
  blocked: new Color("#ff7a6b"),
};

export const hand_material = (): MeshPhysicalMaterial =>
  new MeshPhysicalMaterial({
    color: palette.hand,
    roughness: 0.48,
    metalness: 0,
    clearcoat: 0.3,
    clearcoatRoughness: 0.45,
  });

export const object_material = (): MeshStandardMaterial =>
  new MeshStandardMaterial({
    color: palette.object,
    roughness: 0.62,
    metalness: 0.0,
    side: DoubleSide,
    shadowSide: BackSide,
  });

export const table_material = (): MeshStandardMaterial =>
  new MeshStandardMaterial({ color: palette.table, roughness: 0.9, metalness: 0.0 });

export const ghost_material = (color: Color, opacity: number): MeshStandardMaterial =>
  new MeshStandardMaterial({
    color,
    roughness: 0.4,
    transparent: true,
    opacity,
    depthWrite: false,
    emissive: color.clone().multiplyScalar(0.25),
  });
