// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { recall, remember } from "../core/session_state";
import { h } from "../ui/dom";
import { field, number_input } from "../ui/parts";
import type { OnlineOptions } from "../wire/messages";

const degree = Math.PI / 180;
const defaults = { cone: 45, ahead: 400, epsilon: 0.001, amplitudes: 2, seed: 1 };
type Shown = typeof defaults & { friction?: number };

/** The options of the online planner, as a fold of fields; a change begins a new session. */
export class OnlineOptionsForm {
  readonly element: HTMLElement;
  private readonly cone = number_input("cone", 1, 180, "any");
  private readonly ahead = number_input("ahead", 5, 2000, "any");
  private readonly epsilon = number_input("epsilon-min", 0, 10, "any");
  private readonly amplitudes = number_input("online-amplitudes", 0, 64, 1);
  private readonly friction = number_input("online-friction", 0, 10, "any", false);
  private readonly seed = number_input("online-seed", 0, Number.MAX_SAFE_INTEGER, 1);

  constructor(on_change: () => void) {
    this.friction.placeholder = "materials";
    this.fill({ ...defaults, ...recall<Shown>("online.options") });
    const changed = () => {
      if (!this.inputs.every((input) => input.reportValidity())) return;
      remember("online.options", this.shown);
      on_change();
    };
    this.element = h(
      "details",
      { onchange: changed },
      h("summary", {}, "Options"),
      field("Cone, half angle [°]", this.cone),
      field("Look ahead [mm]", this.ahead),
      field("Least ε of an offer", this.epsilon),
      field("Eigengrasps", this.amplitudes),
      field("Friction", this.friction),
      field("Seed", this.seed),
    );
  }

  get value(): OnlineOptions {
    const { cone, ahead, epsilon, amplitudes, seed, friction } = this.shown;
    return {
      cone_half_angle: cone * degree,
      look_ahead: ahead * 1e-3,
      epsilon_min: epsilon,
      amplitudes,
      seed,
      ...(friction === undefined ? {} : { friction }),
    };
  }

  private get inputs(): HTMLInputElement[] {
    return [this.cone, this.ahead, this.epsilon, this.amplitudes, this.friction, this.seed];
  }

  private get shown(): Shown {
    return {
      cone: Number(this.cone.value),
      ahead: Number(this.ahead.value),
      epsilon: Number(this.epsilon.value),
      amplitudes: Number(this.amplitudes.value),
      seed: Number(this.seed.value),
      ...(this.friction.value === "" ? {} : { friction: Number(this.friction.value) }),
    };
  }

  private fill(options: Shown): void {
    this.cone.value = String(options.cone);
    this.ahead.value = String(options.ahead);
    this.epsilon.value = String(options.epsilon);
    this.amplitudes.value = String(options.amplitudes);
    this.seed.value = String(options.seed);
    this.friction.value = options.friction === undefined ? "" : String(options.friction);
  }
}
