// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { App, SceneChoice } from "../app";
import { short_count } from "../core/format";
import type { Units } from "../wire/api";
import type { Object as SceneObject } from "../wire/messages";
import { h, set_text, toggle } from "./dom";
import { field, Figures, options_of, section, tick } from "./parts";
import { upload_area } from "./upload_area";

const units: readonly (readonly [Units, string])[] = [
  ["m", "metre"],
  ["cm", "centimetre"],
  ["mm", "millimetre"],
  ["in", "inch"],
];

/** Left column: what is grasped with, and what is grasped. */
export function setup_panel(app: App): HTMLElement {
  const change = (part: Partial<SceneChoice>) => {
    const choice = app.choice.value;
    if (choice) app.choice.set({ ...choice, ...part });
  };
  const lock = h(
    "fieldset",
    { style: "border:0;margin:0;padding:0;min-width:0" },
    hand_section(app, change),
    object_section(app, change),
    scene_section(app, change),
  );
  const hint = h("p", { class: "note", style: "padding:0 14px" }, "The scene is that of the log.");
  app.page.watch((page) => {
    lock.disabled = page === "replay";
    toggle(hint, page === "replay");
  });
  return h("aside", { class: "left", "aria-label": "Scene" }, hint, lock);
}

type Change = (part: Partial<SceneChoice>) => void;

function hand_section(app: App, change: Change): HTMLElement {
  const list = h("select", { id: "hand", "aria-label": "Hand", onchange: () => change({ hand: list.value }) });
  const title = h("p", { class: "note" });
  const facts = h("p", { class: "note" });
  const show = () => {
    const status = app.status.value;
    const hand = app.hand(app.choice.value?.hand ?? "");
    if (!status || !hand) return;
    list.replaceChildren(
      ...options_of(
        status.hands.map((one) => [one.name, one.uploaded ? `${one.name} (yours)` : one.name] as const),
        hand.name,
      ),
    );
    set_text(title, hand.title);
    set_text(
      facts,
      `${hand.n_dof} DOF · ${hand.eigengrasps} eigengrasps · ${hand.n_links} links · reach ${(hand.reach * 1e3).toFixed(0)} mm`,
    );
  };
  app.status.watch(show);
  app.choice.watch(show);
  const drop = upload_area("Drop a hand: .zip, .tar.gz", ".zip,.tar,.gz,.tgz", async (file) => {
    const reply = await app.api.upload_hand(file);
    app.models.forget("hands", reply.name);
    app.scene.set(undefined);
    await app.refresh();
    change({ hand: reply.name });
    return reply;
  });
  drop.id = "drop-hand";
  return section("Hand", list, title, facts, drop);
}

function object_section(app: App, change: Change): HTMLElement {
  const list = h("div", { class: "choices", id: "objects" });
  const figures = new Figures({ size: "Size [mm]", triangles: "Triangles" });
  const unit = h("select", { id: "units" }, ...options_of(units, "m"));
  const drop = upload_area("Drop a mesh or a scan here, or choose a file", ".obj,.stl,.ply,.off,.glb,.pcd", async (file) => {
    const reply = await app.api.upload_object(file, unit.value as Units);
    app.models.forget("objects", reply.name);
    app.scene.set(undefined);
    await app.refresh();
    change({ object: reply.name, scale: 1 });
    return reply;
  });
  drop.id = "drop-object";

  const show = () => {
    const choice = app.choice.value;
    const object = app.object(choice?.object ?? "");
    if (!app.status.value || !choice || !object) return;
    list.replaceChildren(
      ...app.status.value.objects.map((one) =>
        object_button(one, one.name === choice.object, () => change({ object: one.name, scale: 1 })),
      ),
    );
    list.querySelector('[aria-pressed="true"]')?.scrollIntoView({ block: "nearest" });
    figures.set({
      size: object.size.map((side) => (side * choice.scale * 1e3).toFixed(0)).join(" × "),
      triangles: short_count(object.triangles),
    });
  };
  app.status.watch(show);
  app.choice.watch(show);
  figures.element.style.marginTop = "8px";
  const units_field = field("Units of a file", unit);
  units_field.style.marginTop = "8px";
  return section("Object", list, figures.element, units_field, drop);
}

function object_button(object: SceneObject, chosen: boolean, on_click: () => void): HTMLElement {
  const longest = Math.max(...object.size) * 1e3;
  return h(
    "button",
    { type: "button", "data-object": object.name, "aria-pressed": String(chosen), onclick: on_click },
    h("span", {}, object.name),
    h("small", {}, object.uploaded ? "yours" : `${longest.toFixed(0)} mm`),
  );
}

function scene_section(app: App, change: Change): HTMLElement {
  const scale = h("input", {
    type: "number",
    id: "scale",
    min: 0.001,
    max: 1000,
    step: "any",
    onchange: () => {
      if (scale.checkValidity() && scale.value !== "") change({ scale: Number(scale.value) });
    },
  });
  const table = tick("Object stands on a table", false, (on) => change({ table: on }));
  const box = table.querySelector("input");
  app.choice.watch((choice) => {
    if (!choice) return;
    scale.value = String(choice.scale);
    if (box) box.checked = choice.table;
  });
  return section("Scene", field("Scale", scale), table);
}
