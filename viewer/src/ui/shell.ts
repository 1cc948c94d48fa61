// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { App } from "../app";
import { duration } from "../core/format";
import { page_names } from "../core/route";
import type { LinkState } from "../wire/connection";
import { h, set_text, toggle } from "./dom";

const titles = { plan: "Plan", interactive: "Interactive", replay: "Replay" };

/** The top of the page: name, pages, link to the server. */
export function header(app: { page: App["page"] }, link: HTMLElement): HTMLElement {
  const tabs = page_names.map((name) =>
    h("button", { type: "button", "data-page": name, onclick: () => app.page.set(name) }, titles[name]),
  );
  app.page.watch((page) =>
    tabs.forEach((tab) => {
      if (tab.dataset["page"] === page) tab.setAttribute("aria-current", "page");
      else tab.removeAttribute("aria-current");
    }),
  );
  return h(
    "header",
    {},
    h("div", { class: "brand" }, h("img", { src: "./icon.svg", alt: "" }), "eigengrasp"),
    h("nav", { "aria-label": "Pages" }, ...tabs),
    h("div", { class: "spring" }),
    link,
  );
}

export function link_state(app: App): HTMLElement {
  const element = h("div", { class: "link", role: "status" });
  app.connection.state.watch((state) => {
    element.dataset["kind"] = state.kind;
    set_text(
      element,
      state.kind === "online"
        ? `${state.welcome.program} ${state.welcome.version} · ${state.welcome.session ?? ""}`
        : { connecting: "connecting …", waiting: "no server", token: "token needed", incompatible: "another version" }[
            state.kind
          ],
    );
  });
  return element;
}

/** Says what is wrong, under the header; nothing where all is well. */
export function banners(app: App): HTMLElement {
  const link_text = h("span", {});
  const retry = h("button", { type: "button", onclick: () => app.connection.open() }, "Retry now");
  const link = h("div", { class: "banner", "data-tone": "bad", role: "alert", id: "link-banner" }, link_text, retry);
  const token = token_banner(app);
  const notice_text = h("span", {});
  const notice = h(
    "div",
    { class: "banner", "data-tone": "warn", role: "alert", id: "notice" },
    notice_text,
    h("button", { type: "button", onclick: () => app.notice.set("") }, "Dismiss"),
  );

  let lost = false;
  const show = (state: LinkState) => {
    if (state.kind === "waiting") lost = true;
    if (state.kind === "online") lost = false;
    toggle(link, (lost && state.kind !== "token") || state.kind === "incompatible");
    toggle(token, state.kind === "token");
    toggle(retry, state.kind === "waiting");
    if (!link.hidden) set_text(link_text, link_sentence(state));
  };
  app.connection.state.watch(show);
  window.setInterval(() => show(app.connection.state.value), 250);
  app.notice.watch((text) => {
    toggle(notice, text !== "");
    set_text(notice_text, text);
  });
  return h("div", {}, link, token, notice);
}

export function link_sentence(state: LinkState, now = performance.now()): string {
  switch (state.kind) {
    case "waiting": {
      const wait = Math.max(0, state.retry_at - now) / 1e3;
      return `The server is gone. Trying again in ${duration(wait)} (attempt ${state.attempt + 1}). Start it with: eigengrasp serve`;
    }
    case "connecting":
      return "The server is gone. Trying to reach it now …";
    case "incompatible":
      return `The server speaks version ${state.server} of the protocol, this page another one: load the page anew.`;
    default:
      return "";
  }
}

function token_banner(app: App): HTMLElement {
  const input = h("input", { type: "password", placeholder: "token", autocomplete: "off", "aria-label": "token" });
  const form = h(
    "form",
    {
      class: "banner",
      "data-tone": "warn",
      id: "token-banner",
      onsubmit: (event) => {
        event.preventDefault();
        if (input.value) app.use_token(input.value.trim());
        input.value = "";
      },
    },
    h("span", {}, "This server asks for a token: it was printed when the server began."),
    input,
    h("button", { type: "submit", class: "main" }, "Connect"),
  );
  return form;
}
