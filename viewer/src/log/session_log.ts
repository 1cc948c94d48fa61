// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { SceneChoice } from "../app";
import type { ClientMessage, Closed, LogLine, View } from "../wire/messages";

export interface LogView {
  t: number;
  view: View;
}

export interface LogEvent {
  t: number;
  text: string;
  closed?: Closed;
}

/** A session that was recorded, ready to be played. Times are seconds from the first view. */
export interface SessionLog {
  scenes: { t: number; choice: SceneChoice }[];
  views: LogView[];
  events: LogEvent[];
  duration: number;
  /** Lines that could not be read. */
  skipped: number;
}

/** Reads the lines of a log. @throws Error where nothing of it can be shown */
export function parse_log(text: string): SessionLog {
  const log: SessionLog = { scenes: [], views: [], events: [], duration: 0, skipped: 0 };
  for (const line of text.split("\n")) {
    if (line.trim() === "") continue;
    const entry = parse_line(line);
    if (!entry) log.skipped += 1;
    else take(log, entry);
  }
  const first = log.views[0];
  if (!first)
    throw new Error("The log has no views: a session log of eigengrasp was expected, one JSON object a line.");
  if (log.scenes.length === 0) throw new Error("The log does not say what was grasped: it has no 'online.start' line.");
  log.views.sort((a, b) => a.t - b.t);
  shift(log, log.views[0]!.t);
  return log;
}

function parse_line(line: string): LogLine | undefined {
  try {
    const value: unknown = JSON.parse(line);
    if (typeof value !== "object" || value === null || !("t" in value) || typeof value.t !== "number") return undefined;
    return "in" in value || "out" in value ? (value as LogLine) : undefined;
  } catch {
    return undefined;
  }
}

function take(log: SessionLog, { t, in: taken, out: sent }: LogLine): void {
  if (taken?.type === "online.start") {
    log.scenes.push({
      t,
      choice: { hand: taken.hand, object: taken.object, scale: taken.scale ?? 1, table: taken.table ?? false },
    });
  }
  if (taken?.type === "command") log.events.push({ t, text: command_text(taken) });
  if (sent?.type === "view") log.views.push({ t, view: sent });
  if (sent?.type === "closed") log.events.push({ t, text: sent.message, closed: sent });
}

function command_text(message: Extract<ClientMessage, { type: "command" }>): string {
  return { close: "Close", open: "Open", forget: "Forget" }[message.command];
}

function shift(log: SessionLog, start: number): void {
  for (const list of [log.scenes, log.views, log.events]) for (const one of list) one.t = Math.max(0, one.t - start);
  log.duration = log.views[log.views.length - 1]!.t;
}

/** Index of the newest entry at a time; -1 where all are later. */
export function newest_at(list: readonly { t: number }[], t: number): number {
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle]!.t <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
