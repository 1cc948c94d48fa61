// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { describe, expect, it } from "vitest";
import { targets_of, wish_rows } from "../src/core/shared_control";
import { own_log, whole_lines } from "../src/log/own_log";
import { barrett_like } from "./samples";

describe("shared control", () => {
  const rows = wish_rows(barrett_like, { look_ahead: 0.3, cone_half_angle: Math.PI / 6, amplitudes: 5 });

  it("has a row for the approach, each searched amplitude and each degree of freedom", () => {
    expect(rows.map((row) => row.key)).toEqual(["distance-0", "theta-0", "phi-0", "amplitude-0", "dof-0", "dof-1"]);
    expect(wish_rows(barrett_like, { amplitudes: 0 }).some((row) => row.variable === "amplitude")).toBe(false);
  });

  it("starts at zero, or at the nearest limit", () => {
    expect(rows.find((row) => row.key === "dof-0")!.start).toBe(0);
    expect(rows.find((row) => row.key === "dof-1")!.start).toBe(0.5);
    for (const { min, max } of rows) expect(min).toBeLessThan(max);
  });

  it("sends what has a confidence, in the units of the wire", () => {
    const wishes = new Map([
      ["distance-0", { value: 250, confidence: 0.5 }],
      ["theta-0", { value: 90, confidence: 2 }],
      ["phi-0", { value: 90, confidence: 0 }],
      ["dof-1", { value: 1, confidence: 0.25 }],
      ["of another hand", { value: 1, confidence: 1 }],
    ]);
    const targets = targets_of(rows, wishes);
    expect(targets.map((one) => [one.variable, one.index, one.confidence])).toEqual([
      ["distance", 0, 0.5],
      ["theta", 0, 1],
      ["dof", 1, 0.25],
    ]);
    expect(targets[0]!.value).toBeCloseTo(0.25, 12);
    expect(targets[1]!.value).toBeCloseTo(Math.PI / 6, 12); // no farther than the cone
    expect(targets_of(rows, new Map())).toEqual([]);
  });

  it("sends no more targets than a message holds", () => {
    const dofs = Array.from({ length: 100 }, (_, i) => ({ name: `d${i}`, min: 0, max: 1 }));
    const many = wish_rows({ ...barrett_like, dofs }, {});
    expect(targets_of(many, new Map(many.map((row) => [row.key, { value: 0, confidence: 1 }])))).toHaveLength(64);
  });
});

describe("the server's log of a session", () => {
  it("is the newest of that session", () => {
    const logs = ["20260102T030405-s1.jsonl", "20260103T030405-s1.jsonl", "20260104T030405-s11.jsonl", "s2.jsonl"];
    const list = logs.map((name) => ({ name }));
    expect(own_log(list, "s1")).toBe("20260103T030405-s1.jsonl");
    expect(own_log(list, "s2")).toBe("s2.jsonl");
    for (const none of ["s3", "", undefined]) expect(own_log(list, none)).toBeUndefined();
  });

  it("is cut after its last whole line", () => {
    expect(whole_lines('{"t":0}\n{"t":1}\n{"t":')).toBe('{"t":0}\n{"t":1}\n');
    expect(whole_lines('{"t":')).toBe("");
  });
});
