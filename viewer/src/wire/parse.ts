// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { ServerMessage } from "./messages";

const known: Record<ServerMessage["type"], true> = {
  welcome: true,
  error: true,
  "plan.started": true,
  "plan.progress": true,
  "plan.milestone": true,
  "plan.result": true,
  "online.ready": true,
  "online.stopped": true,
  view: true,
  closed: true,
  solution: true,
};

/** A message of the server; none where the text is not one. Messages of newer servers are left aside. */
export function parse_server_message(text: string): ServerMessage | undefined {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return undefined;
  }
  return is_server_message(value) ? value : undefined;
}

export function is_server_message(value: unknown): value is ServerMessage {
  if (typeof value !== "object" || value === null || !("type" in value)) return false;
  return typeof value.type === "string" && Object.hasOwn(known, value.type);
}
