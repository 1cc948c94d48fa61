// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { App } from "../app";
import { own_log, whole_lines } from "../log/own_log";
import { h, set_text, toggle } from "../ui/dom";
import { save_file } from "../ui/parts";
import type { OnlineSession } from "./online_session";

/** Keeping what happens: a recording of this page, and the log that the server keeps of the session. */
export class SessionLogs {
  readonly element: HTMLElement;
  private readonly record = h(
    "button",
    { type: "button", id: "record", onclick: () => this.toggle_recording() },
    "Record",
  );
  private readonly count = h("small", { class: "note", style: "margin:0" });
  private readonly download = h(
    "button",
    { type: "button", id: "server-log", hidden: true, onclick: () => void this.save_server_log() },
    "Log of the server",
  );

  constructor(
    private readonly app: App,
    private readonly session: OnlineSession,
  ) {
    this.download.title = "Downloads what the server has kept of this session so far (eigengrasp serve --log FOLDER)";
    this.element = h("div", { class: "row", style: "margin-top:10px" }, this.record, this.download, this.count);
    app.status.watch((status) => toggle(this.download, status?.logs ?? false));
    session.stage.watch(() => this.show());
  }

  show_count(): void {
    if (this.session.recorder.running) set_text(this.count, `${this.session.recorder.count} lines`);
  }

  private show(): void {
    const on = this.session.stage.value === "on";
    this.record.disabled = !on && !this.session.recorder.running;
    this.download.disabled = !on;
  }

  private toggle_recording(): void {
    const { recorder } = this.session;
    if (recorder.running)
      save_file(recorder.stop(), `eigengrasp-session-${new Date().toISOString().replace(/[:.]/g, "-")}.jsonl`);
    else this.session.record();
    set_text(this.record, recorder.running ? "Stop and save" : "Record");
    this.record.classList.toggle("stop", recorder.running);
    set_text(this.count, "");
    this.show();
  }

  private async save_server_log(): Promise<void> {
    const link = this.app.connection.state.value;
    if (link.kind !== "online") return;
    this.download.disabled = true;
    try {
      const name = own_log((await this.app.api.logs()).logs, link.welcome.session);
      if (name === undefined)
        throw new Error("The server has no log of this session yet; it begins with the first wrist pose.");
      save_file(whole_lines(await this.app.api.log(name)), name);
    } catch (problem) {
      this.app.report(problem);
    }
    this.show();
  }
}
