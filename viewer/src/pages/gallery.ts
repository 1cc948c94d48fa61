// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { fixed } from "../core/format";
import { ranked } from "../core/plan_state";
import type { ModelLibrary } from "../scene/models";
import { Thumbnails } from "../scene/thumbnails";
import type { BenchScene } from "../scene/workbench";
import { h } from "../ui/dom";
import type { Grasp, PlanResult } from "../wire/messages";

/** The grasps of a plan as small pictures, best first. */
export class Gallery {
  readonly element = h("div", { class: "gallery", id: "gallery" });
  private readonly thumbnails: Thumbnails;
  private turn = 0;

  constructor(
    models: ModelLibrary,
    private readonly on_pick: (grasp: Grasp, number: number) => void,
  ) {
    this.thumbnails = new Thumbnails(models);
  }

  async show(result: PlanResult | undefined, scene: BenchScene | undefined): Promise<void> {
    const turn = ++this.turn;
    this.thumbnails.forget_waiting();
    this.element.replaceChildren();
    if (!result || !scene) return;
    await this.thumbnails.set_scene(scene);
    if (turn !== this.turn) return;
    this.element.replaceChildren(
      ...ranked(result.grasps).map(({ grasp, number }, place) => this.entry(grasp, number, place + 1)),
    );
  }

  mark(number: number | undefined): void {
    for (const entry of this.element.children)
      entry.setAttribute("aria-pressed", String(entry.getAttribute("data-grasp") === String(number)));
  }

  private entry(grasp: Grasp, number: number, place: number): HTMLElement {
    const last = grasp.closing[grasp.closing.length - 1] ?? grasp.closing[0];
    const rating = grasp.form_closure
      ? h("b", {}, `ε ${fixed(grasp.epsilon, 4)}`)
      : h("span", { class: "open" }, "no closure");
    return h(
      "button",
      { type: "button", "data-grasp": number, "aria-pressed": "false", onclick: () => this.on_pick(grasp, number) },
      this.thumbnails.picture(last),
      h("i", {}, `#${place}`),
      h("div", {}, rating, h("span", { class: "open" }, `E ${fixed(grasp.energy, 2)}`)),
    );
  }
}
