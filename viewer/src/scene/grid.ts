// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Color, DoubleSide, Mesh, PlaneGeometry, ShaderMaterial } from "three";

const vertex = /* glsl */ `
  varying vec2 place;
  void main() {
    place = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }
`;

const fragment = /* glsl */ `
  varying vec2 place;
  uniform vec3 ink;
  uniform float reach;
  float lines(float step, float width) {
    vec2 cell = place / step;
    vec2 slope = fwidth(cell);
    vec2 off = abs(fract(cell - 0.5) - 0.5);
    vec2 line = 1.0 - smoothstep(slope * (width - 0.5), slope * (width + 0.5), off);
    vec2 crowded = smoothstep(0.25, 0.6, slope);
    line *= 1.0 - crowded;
    return max(line.x, line.y);
  }
  void main() {
    float fade = 1.0 - smoothstep(0.25 * reach, reach, length(place));
    float strength = max(0.3 * lines(0.05, 0.5), 0.6 * lines(0.25, 0.7)) * fade;
    if (strength < 0.004) discard;
    gl_FragColor = vec4(ink, strength);
    #include <colorspace_fragment>
  }
`;

/** Lines on the ground every 50 mm, stronger ones every 250 mm, that fade away from the middle. */
export function ground_grid(): Mesh<PlaneGeometry, ShaderMaterial> {
  const reach = 1.6;
  const material = new ShaderMaterial({
    vertexShader: vertex,
    fragmentShader: fragment,
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
    uniforms: { ink: { value: new Color("#5a6b7f") }, reach: { value: reach } },
  });
  const grid = new Mesh(new PlaneGeometry(2 * reach, 2 * reach), material);
  grid.renderOrder = -1;
  return grid;
}
