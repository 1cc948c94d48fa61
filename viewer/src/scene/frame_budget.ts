// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

/** How finely to draw. */
export interface Quality {
  pixel_ratio: number;
  shadow_size: number;
  /** Light from all around, as a room gives it. */
  surroundings: boolean;
}

/** From fine to fast; the last one is for machines that draw without a graphics card. */
export function qualities(device_ratio: number): Quality[] {
  return [
    { pixel_ratio: Math.min(device_ratio, 2), shadow_size: 2048, surroundings: true },
    { pixel_ratio: 1, shadow_size: 1024, surroundings: true },
    { pixel_ratio: 0.8, shadow_size: 512, surroundings: false },
    { pixel_ratio: 0.6, shadow_size: 0, surroundings: false },
  ];
}

const most_ms = 40;
const enough = 6;

/** Where the processor draws, each pixel counts. */
export const software_level = 2;

export type QualityChoice = "fine" | "fast" | "auto";

/** The part of an address after "?": "quality=fine" and "quality=fast" keep to one level, whatever frames cost. */
export function quality_choice(search: string): QualityChoice {
  const value = new URLSearchParams(search).get("quality");
  return value === "fine" || value === "fast" ? value : "auto";
}

export function draws_by_software(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** Decides from the cost of frames when to draw less finely: when most of the last few took too long. */
export class FrameBudget {
  private costs: number[] = [];

  constructor(
    private readonly lowest: number,
    public level = 0,
  ) {}

  /** Tells whether the level changed. */
  add(cost_ms: number): boolean {
    this.costs = [...this.costs.slice(-(enough - 1)), cost_ms];
    const slow = this.costs.filter((cost) => cost > most_ms).length;
    if (slow < enough || this.level >= this.lowest) return false;
    this.level += 1;
    this.costs = [];
    return true;
  }
}

/** Calls back with the time from now until the graphics card has done all that it was told [ms]. */
export function when_drawn(gl: WebGL2RenderingContext, done: (ms: number) => void): void {
  const began = performance.now();
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!fence) return;
  gl.flush();
  const look = () => {
    const status = gl.clientWaitSync(fence, 0, 0);
    if (status === gl.TIMEOUT_EXPIRED && performance.now() - began < 2000) {
      window.setTimeout(look, 4);
      return;
    }
    gl.deleteSync(fence);
    done(performance.now() - began);
  };
  window.setTimeout(look, 4);
}
