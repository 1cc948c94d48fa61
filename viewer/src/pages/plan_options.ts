// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { recall, remember } from "../core/session_state";
import { h } from "../ui/dom";
import { field, number_input, options_of } from "../ui/parts";
import type { PlanOptions } from "../wire/messages";

const defaults = { iterations: 70000, grasps: 20, seed: 1, amplitudes: 2 };

/** The options of a plan, as a fold of fields. */
export class PlanOptionsForm {
  readonly element: HTMLElement;
  private readonly iterations = number_input("iterations", 100, 10_000_000, 1);
  private readonly grasps = number_input("grasps", 1, 100, 1);
  private readonly seed = number_input("seed", 0, Number.MAX_SAFE_INTEGER, 1);
  private readonly amplitudes = number_input("amplitudes", 0, 64, 1);
  private readonly friction = number_input("friction", 0, 10, "any", false);
  private readonly search = h(
    "select",
    { id: "search" },
    ...options_of(
      [
        ["staged", "staged"],
        ["paper", "as in the paper"],
      ],
      "staged",
    ),
  );
  private readonly energy = h(
    "select",
    { id: "energy" },
    ...options_of(
      [
        ["contact", "contact"],
        ["wrench", "wrench"],
      ],
      "contact",
    ),
  );

  constructor() {
    this.friction.placeholder = "materials";
    this.fill({ ...defaults, ...recall<PlanOptions>("plan.options") });
    this.element = h(
      "details",
      { onchange: () => remember("plan.options", this.value) },
      h("summary", {}, "Options"),
      field("Iterations", this.iterations),
      field("Grasps kept", this.grasps),
      field("Search", this.search),
      field("Energy", this.energy),
      field("Eigengrasps", this.amplitudes),
      field("Friction", this.friction),
      field("Seed", this.seed),
    );
  }

  get sound(): boolean {
    return [this.iterations, this.grasps, this.seed, this.amplitudes, this.friction].every((input) =>
      input.reportValidity(),
    );
  }

  get value(): PlanOptions {
    return {
      iterations: Number(this.iterations.value),
      grasps: Number(this.grasps.value),
      seed: Number(this.seed.value),
      amplitudes: Number(this.amplitudes.value),
      search: this.search.value === "paper" ? "paper" : "staged",
      energy: this.energy.value === "wrench" ? "wrench" : "contact",
      ...(this.friction.value === "" ? {} : { friction: Number(this.friction.value) }),
    };
  }

  private fill(options: PlanOptions): void {
    this.iterations.value = String(options.iterations);
    this.grasps.value = String(options.grasps);
    this.seed.value = String(options.seed);
    this.amplitudes.value = String(options.amplitudes);
    this.friction.value = options.friction === undefined ? "" : String(options.friction);
    this.search.value = options.search ?? "staged";
    this.energy.value = options.energy ?? "contact";
  }
}
