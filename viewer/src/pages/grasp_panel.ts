// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { fixed, millimetres } from "../core/format";
import { along_path } from "../core/pose";
import type { Workbench } from "../scene/workbench";
import { h, set_text, toggle } from "../ui/dom";
import { Figures, section, tick } from "../ui/parts";
import type { Grasp } from "../wire/messages";

/** One grasp: its figures, its contacts, and a slider from the pre-grasp to the grasp. */
export class GraspPanel {
  readonly element: HTMLElement;
  private readonly figures = new Figures({
    epsilon: "Epsilon",
    volume: "Volume",
    energy: "Energy",
    contacts: "Contacts",
    friction: "Friction cones",
    penetration: "Deepest penetration",
  });
  private readonly title: HTMLElement;
  private readonly slider = h("input", {
    type: "range",
    id: "closing",
    min: 0,
    max: 1,
    step: 0.001,
    value: 1,
    "aria-label": "From pre-grasp to grasp",
    oninput: () => {
      this.playing = false;
      this.draw();
    },
  });
  private readonly play = h(
    "button",
    { type: "button", id: "play-closing", title: "Close the hand", onclick: () => this.start() },
    "▶",
  );
  private grasp: Grasp | undefined;
  private cones = true;
  private playing = false;

  constructor(
    private readonly bench: Workbench,
    ...more: HTMLElement[]
  ) {
    this.element = section(
      "Grasp",
      this.figures.element,
      h(
        "div",
        { class: "row", style: "margin-top:10px" },
        this.play,
        h("small", {}, "pre-grasp"),
        this.slider,
        h("small", {}, "grasp"),
      ),
      tick("Contacts and friction cones", true, (on) => {
        this.cones = on;
        this.draw();
      }),
      ...more,
    );
    this.title = this.element.querySelector("h2")!;
    bench.stage.frames.on((seconds) => this.advance(seconds));
    toggle(this.element, false);
  }

  show(grasp: Grasp, name: string): void {
    this.grasp = grasp;
    set_text(this.title, name);
    this.figures.set({
      epsilon: grasp.form_closure ? fixed(grasp.epsilon, 4) : "no form closure",
      volume: grasp.volume.toPrecision(3),
      energy: fixed(grasp.energy, 3),
      penetration: millimetres(grasp.max_penetration, 2),
      contacts: `${grasp.contacts.length} on ${new Set(grasp.contacts.map((contact) => contact.link)).size} links`,
      friction: cone_range(grasp),
    });
    toggle(this.element, true);
    this.bench.contacts.show(grasp.contacts, 0.022);
    this.draw();
  }

  hide(): void {
    this.grasp = undefined;
    this.playing = false;
    this.bench.contacts.visible = false;
    this.bench.see_through(false);
    toggle(this.element, false);
  }

  draw(): void {
    if (!this.grasp) return;
    const place = Number(this.slider.value);
    this.bench.pose_hand(along_path(this.grasp.closing, place));
    this.bench.contacts.visible = this.cones && this.grasp.contacts.length > 0;
    this.bench.see_through(this.bench.contacts.visible);
  }

  private start(): void {
    if (Number(this.slider.value) >= 1) this.slider.value = "0";
    this.playing = true;
    this.bench.stage.request();
  }

  private advance(seconds: number): void {
    if (!this.playing || !this.grasp) return;
    const place = Math.min(1, Number(this.slider.value) + seconds / 1.4);
    this.slider.value = String(place);
    this.playing = place < 1;
    this.draw();
  }
}

/** Half angles atan(mu) of the cones, in degrees. */
function cone_range(grasp: Grasp): string {
  const angles = grasp.contacts.map((contact) => (Math.atan(contact.friction) * 180) / Math.PI);
  if (angles.length === 0) return "–";
  const [low, high] = [Math.min(...angles).toFixed(0), Math.max(...angles).toFixed(0)];
  return low === high ? `±${low}°` : `±${low}° to ±${high}°`;
}
