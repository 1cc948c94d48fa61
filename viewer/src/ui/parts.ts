// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { h, set_text } from "./dom";

/** Pairs of a name and a figure, in two columns. */
export class Figures<K extends string> {
  readonly element = h("dl", { class: "figures" });
  private readonly values = new Map<K, HTMLElement>();

  constructor(names: Record<K, string>) {
    for (const key of Object.keys(names) as K[]) {
      const value = h("dd", { "data-figure": key }, "–");
      this.values.set(key, value);
      this.element.append(h("dt", {}, names[key]), value);
    }
  }

  set(figures: Partial<Record<K, string>>): void {
    for (const [key, text] of Object.entries(figures) as [K, string][]) {
      const value = this.values.get(key);
      if (value) set_text(value, text);
    }
  }
}

/** A figure that is read from afar. */
export class BigFigure {
  private readonly value = h("strong", {}, "–");
  readonly element: HTMLElement;

  constructor(name: string, key: string) {
    this.element = h("div", { "data-figure": key }, h("small", {}, name), this.value);
  }

  set(text: string, tone: "good" | "bad" | "" = ""): void {
    set_text(this.value, text);
    if (this.element.className !== tone) this.element.className = tone;
  }
}

export function section(title: string, ...children: (Node | undefined)[]): HTMLElement {
  return h("section", {}, h("h2", {}, title), ...children);
}

export function field(name: string, control: HTMLElement): HTMLLabelElement {
  return h("label", { class: "field" }, h("span", {}, name), control);
}

export function number_input(
  id: string,
  min: number,
  max: number,
  step: number | "any",
  required = true,
): HTMLInputElement {
  return h("input", { type: "number", id, min, max, step, required });
}

export function tick(name: string, checked: boolean, on_change: (checked: boolean) => void): HTMLLabelElement {
  const box = h("input", { type: "checkbox", checked, onchange: () => on_change(box.checked) });
  return h("label", { class: "tick" }, box, name);
}

export function options_of<T extends string>(pairs: readonly (readonly [T, string])[], chosen: T): HTMLOptionElement[] {
  return pairs.map(([value, text]) => h("option", { value, selected: value === chosen }, text));
}

/** Hands a file to the operator. */
export function save_file(content: Blob | string, name: string): void {
  const blob = typeof content === "string" ? new Blob([content], { type: "application/x-ndjson" }) : content;
  const url = URL.createObjectURL(blob);
  h("a", { href: url, download: name }).click();
  window.setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** An area to drop a file on, or to click. */
export function drop_area(text: string, accept: string, on_file: (file: File) => void): HTMLElement {
  const input = h("input", {
    type: "file",
    accept,
    onchange: () => {
      const file = input.files?.[0];
      input.value = "";
      if (file) on_file(file);
    },
  });
  const area = h("label", { class: "drop" }, text, input);
  const over = (on: boolean) => (event: DragEvent) => {
    event.preventDefault();
    area.classList.toggle("over", on);
  };
  area.addEventListener("dragover", over(true));
  area.addEventListener("dragleave", over(false));
  area.addEventListener("drop", (event) => {
    over(false)(event);
    const file = event.dataTransfer?.files[0];
    if (file) on_file(file);
  });
  return area;
}
