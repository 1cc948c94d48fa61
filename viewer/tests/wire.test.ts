// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { Ajv2020 } from "ajv/dist/2020.js";
import { describe, expect, it } from "vitest";
import { home_pose } from "../src/core/home_pose";
import { next_plan, trace_rows } from "../src/core/plan_state";
import { Recorder } from "../src/log/recorder";
import { parse_log } from "../src/log/session_log";
import { reconnect_delay } from "../src/wire/backoff";
import type { ClientMessage, Hand, Object as SceneObject, ServerMessage } from "../src/wire/messages";
import { is_server_message, parse_server_message } from "../src/wire/parse";
import { barrett_like, glass_like, view_at } from "./samples";

const schema_file = new URL("../../schema/wire.schema.json", import.meta.url);
const schema = JSON.parse(readFileSync(schema_file, "utf8")) as {
  $id: string;
  $defs: Record<string, { oneOf?: { $ref: string }[] }>;
};
const ajv = new Ajv2020({ allErrors: true, strict: false });
ajv.addSchema(schema);

function complaints(definition: string, value: unknown): string[] {
  const check = ajv.getSchema(`${schema.$id}#/$defs/${definition}`);
  if (!check) throw new Error(`the schema has no ${definition}`);
  return check(value) === true ? [] : (check.errors ?? []).map((error) => `${error.instancePath} ${error.message}`);
}

describe("types and schema", () => {
  it("types are those of the schema: else run npm run types", () => {
    const made = execFileSync(process.execPath, ["scripts/make_types.mjs", "--print"], { encoding: "utf8" });
    expect(readFileSync("src/wire/messages.ts", "utf8")).toBe(made);
  });

  it("every type of server message that the schema has is understood, and no other", () => {
    const names = schema.$defs["ServerMessage"]!.oneOf!.map((one) => one.$ref.split("/").at(-1)!);
    const types = names.map(
      (name) => (schema.$defs[name] as { properties: { type: { const: string } } }).properties.type.const,
    );
    expect(types.length).toBeGreaterThan(5);
    for (const type of types) expect(is_server_message({ type })).toBe(true);
    expect(is_server_message({ type: "toString" })).toBe(false);
  });
});

describe("messages that the app sends fit the schema", () => {
  const pose = home_pose(barrett_like, glass_like, 1);
  const messages: ClientMessage[] = [
    { type: "hello", protocol: 1, role: "app", token: "secret" },
    {
      type: "plan.start",
      hand: "human",
      object: "glass",
      scale: 1.5,
      table: true,
      options: {
        iterations: 70000,
        grasps: 20,
        seed: 1,
        search: "staged",
        energy: "contact",
        amplitudes: 2,
        friction: 0.5,
      },
    },
    { type: "plan.stop" },
    { type: "online.start", hand: "human", object: "glass", scale: 1, table: false },
    { type: "online.stop" },
    { type: "wrist", time: 12.5, pose },
    { type: "command", command: "close" },
    { type: "solution.get", id: 3 },
  ];
  it.each(messages.map((message) => [message.type, message] as const))("%s", (_type, message) => {
    expect(complaints("ClientMessage", message)).toEqual([]);
  });

  it("and the check tells of one that does not", () => {
    expect(complaints("ClientMessage", { type: "wrist", time: 1, pose: [0, 0, 0] })).not.toEqual([]);
  });
});

describe("recording", () => {
  it("lines fit the schema and are played back as they were", () => {
    let now = 100;
    const recorder = new Recorder(() => now);
    recorder.start({ type: "online.start", hand: "human", object: "glass", scale: 2, table: true });
    recorder.sent({ type: "hello", protocol: 1, role: "app", token: "secret" });
    for (const t of [0.5, 0.6, 0.9]) {
      now = 100 + t;
      recorder.received(view_at(t));
    }
    recorder.sent({ type: "command", command: "close" });
    recorder.received({ type: "closed", message: "Closed." });
    const text = recorder.stop();
    for (const line of text.trim().split("\n")) expect(complaints("LogLine", JSON.parse(line))).toEqual([]);
    expect(text).not.toContain("secret");
    const log = parse_log(text);
    expect(log.scenes).toEqual([{ t: 0, choice: { hand: "human", object: "glass", scale: 2, table: true } }]);
    expect(log.views.map((one) => Number(one.t.toFixed(6)))).toEqual([0, 0.1, 0.4]);
    expect(log.events.map((event) => event.text)).toEqual(["Close", "Closed."]);
    expect(log.skipped).toBe(0);
  });

  it("is off until it is started", () => {
    const recorder = new Recorder(() => 0);
    recorder.received(view_at(0));
    expect(recorder.count).toBe(0);
  });
});

describe("messages that come in", () => {
  it.each(["", "{", "[]", "null", "3", '{"type":7}', '{"type":"from a newer server"}'])("%j is left aside", (text) => {
    expect(parse_server_message(text)).toBeUndefined();
  });

  it("a view is taken", () => {
    const view = view_at(1);
    expect(complaints("ServerMessage", view)).toEqual([]);
    expect(parse_server_message(JSON.stringify(view))).toEqual(view);
  });
});

describe("reconnecting", () => {
  it("waits longer each time, up to a bound, and never not at all", () => {
    const delays = Array.from({ length: 20 }, (_, attempt) => reconnect_delay(attempt, 0.5));
    delays.forEach((delay, i) => expect(delay).toBeGreaterThanOrEqual(delays[i - 1] ?? 0.3));
    expect(Math.max(...delays)).toBeLessThanOrEqual(8);
    expect(reconnect_delay(5, 0)).toBeLessThan(reconnect_delay(5, 0.99));
  });
});

describe("a plan", () => {
  const order = { scale: 1, table: false };
  const play = (messages: ServerMessage[]) =>
    messages.reduce<ReturnType<typeof next_plan>>((state, message) => next_plan(state, message, order), undefined);
  const links = view_at(0).link_poses;

  it("gathers its trace and keeps milestones in order, better and better", () => {
    const plan = play([
      { type: "plan.started", id: "p1", hand: "human", object: "glass" },
      { type: "plan.progress", id: "p1", iterations: 100, total: 1000, seconds: 0.1 },
      { type: "plan.milestone", id: "p1", iteration: 50, energy: 3, link_poses: links },
      { type: "plan.milestone", id: "p1", iteration: 400, energy: 1, link_poses: links },
      { type: "plan.milestone", id: "p1", iteration: 200, energy: 2, link_poses: links },
      { type: "plan.progress", id: "p1", iterations: 500, total: 1000, seconds: 0.4, best_energy: 1 },
      { type: "plan.progress", id: "another", iterations: 900, total: 1000, seconds: 9, best_energy: 0 },
    ]);
    expect(plan?.milestones.map((one) => [one.iteration, one.energy])).toEqual([
      [50, 3],
      [200, 2],
      [400, 1],
    ]);
    expect(plan?.trace).toEqual([{ iteration: 500, energy: 1 }]);
    expect(plan?.iterations).toBe(500);
    expect(plan?.running).toBe(true);
  });
});

describe("the trace of a plan", () => {
  it("merges progress and best states; the best so far never rises", () => {
    const rows = trace_rows(
      [
        { iteration: 10, energy: 5 },
        { iteration: 30, energy: 7 },
      ],
      [
        { iteration: 20, energy: 4 },
        { iteration: 30, energy: 3 },
      ],
    );
    expect(rows).toEqual([
      { iteration: 10, now: 5, best: 5, state: null },
      { iteration: 20, now: null, best: 4, state: 4 },
      { iteration: 30, now: 7, best: 3, state: 3 },
    ]);
  });
});

// The samples of these tests are sound themselves.
it("samples fit the schema", () => {
  const hand: Hand = barrett_like;
  const object: SceneObject = glass_like;
  expect(complaints("Hand", hand)).toEqual([]);
  expect(complaints("Object", object)).toEqual([]);
});
