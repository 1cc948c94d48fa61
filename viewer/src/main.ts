// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import "./style.css";
import { App, first_token } from "./app";
import { recall, remember } from "./core/session_state";
import { InteractivePage } from "./pages/interactive_page";
import type { Page } from "./pages/page";
import { PlanPage } from "./pages/plan_page";
import { ReplayPage } from "./pages/replay_page";
import type { CameraPlace } from "./scene/stage";
import { h } from "./ui/dom";
import { setup_panel } from "./ui/setup_panel";
import { banners, header, link_state } from "./ui/shell";

function begin(): void {
  const token = first_token();
  const view = h("div", { class: "view" });
  const app = new App(view, token);
  const pages: Record<"plan" | "interactive" | "replay", Page> = {
    plan: new PlanPage(app),
    interactive: new InteractivePage(app),
    replay: new ReplayPage(app),
  };
  lay_out(app, view, pages);
  keep_camera(app);
  app.choice.watch((choice) => {
    if (choice && app.page.value !== "replay") void app.show_scene(choice);
  });
  app.status.watch(() => {
    if (app.choice.value && app.page.value !== "replay") void app.show_scene(app.choice.value);
  });
  app.scene.watch((scene) => {
    view.dataset["ready"] = String(scene !== undefined);
  });
  app.connection.open();
}

/** Puts the columns up and shows the page that the address names. */
function lay_out(app: App, view: HTMLElement, pages: Record<string, Page>): void {
  const right = h("aside", { class: "right", "aria-label": "Page" });
  const charts = h("div", { class: "charts" });
  const over = h("div", {});
  const legend = h("div", { class: "legend" });
  view.append(over, legend, view_tools(app));
  document.body.append(
    header(app, link_state(app)),
    banners(app),
    h("main", {}, setup_panel(app), h("div", { class: "centre" }, view, charts), right),
  );
  let current: Page | undefined;
  app.page.watch((name) => {
    const next = pages[name];
    if (!next || next === current) return;
    current?.leave();
    current = next;
    right.replaceChildren(next.panel);
    charts.replaceChildren(next.charts);
    over.replaceChildren(next.hud);
    legend.replaceChildren(...next.legend.map(([text, colour]) => h("span", { style: `--dot: var(${colour})` }, text)));
    next.enter();
  });
}

function view_tools(app: App): HTMLElement {
  return h(
    "div",
    { class: "view-tools" },
    h(
      "button",
      { type: "button", title: "Frame hand and object", id: "view-home", onclick: () => app.bench.look_home() },
      "Home",
    ),
  );
}

/** The operator finds his view again after a reload. */
function keep_camera(app: App): void {
  const place = recall<CameraPlace>("camera");
  if (place) {
    app.stage.place = place;
    app.bench.keep_view();
  }
  let rest: number | undefined;
  app.stage.orbit.addEventListener("change", () => {
    window.clearTimeout(rest);
    rest = window.setTimeout(() => remember("camera", app.stage.place), 120);
  });
}

begin();
