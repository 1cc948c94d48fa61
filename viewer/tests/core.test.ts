// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { padded_range } from "../src/charts/range";
import { LinkFollower } from "../src/core/follower";
import { degrees, duration, fixed, millimetres, short_count } from "../src/core/format";
import { History, sample_of } from "../src/core/history";
import { home_pose, open_hand } from "../src/core/home_pose";
import { compact_plan, ranked, thinned } from "../src/core/plan_state";
import {
  along_path,
  compose,
  interpolate_pose,
  links_apart,
  position_of,
  rotation_of,
  to_matrix,
} from "../src/core/pose";
import { parse_hash } from "../src/core/route";
import { SenderClock, Spread } from "../src/core/sender_clock";
import { Signal } from "../src/core/signal";
import { shaped, wish_of_pad } from "../src/input/gamepad";
import { Glide } from "../src/input/glide";
import { wish_of_keys } from "../src/input/keyboard";
import { add_wishes, moved, still } from "../src/input/wrist_motion";
import { newest_at, parse_log } from "../src/log/session_log";
import { FrameBudget, quality_choice } from "../src/scene/frame_budget";
import { cone_half_angle, contact_matrix } from "../src/scene/marks";
import type { Contact, Grasp, Pose } from "../src/wire/messages";
import { barrett_like, glass_like, human_like, links_at, plate_like, view_at } from "./samples";

const quarter: Pose = [1, 2, 3, Math.SQRT1_2, 0, 0, Math.SQRT1_2];

describe("poses", () => {
  it("compose as matrices do", () => {
    const other: Pose = [0.3, -0.2, 0.5, 0.5, 0.5, -0.5, 0.5];
    const product = to_matrix(quarter).multiply(to_matrix(other));
    to_matrix(compose(quarter, other)).elements.forEach((value, i) =>
      expect(value).toBeCloseTo(product.elements[i]!, 12),
    );
  });

  it("go the shorter way round between q and -q", () => {
    const [x, y, z, w, a, b, c] = quarter;
    const half = interpolate_pose(quarter, [x, y, z, -w, -a, -b, -c], 0.5);
    half.forEach((value, i) => expect(value).toBeCloseTo(quarter[i]!, 12));
  });

  it("along a path: ends, middles and beyond", () => {
    const path = [links_at(0), links_at(1), links_at(3)];
    expect([-1, 0, 0.25, 0.5, 0.75, 1, 2].map((t) => along_path(path, t)![0][0])).toEqual([0, 0, 0.5, 1, 2, 3, 3]);
    expect(along_path([], 0.5)).toBeUndefined();
  });
});

describe("following views", () => {
  it("arrives, never overshoots, and is at the same place at 30 and at 120 frames a second", () => {
    const place = (rate: number) => {
      const follower = new LinkFollower(0.05);
      follower.jump(links_at(0));
      follower.aim(links_at(1));
      for (let i = 0; i < rate / 10; ++i) follower.advance(1 / rate);
      return follower.pose![0][0];
    };
    expect(place(30)).toBeCloseTo(1 - Math.exp(-0.1 / 0.05), 6);
    expect(place(120)).toBeCloseTo(place(30), 6);
  });

  it("comes to rest", () => {
    const follower = new LinkFollower(0.05);
    follower.jump(links_at(0));
    follower.aim(links_at(1));
    let frames = 0;
    while (follower.advance(1 / 60) && frames < 200) frames += 1;
    expect(frames).toBeLessThan(100);
    expect(links_apart(follower.pose!, links_at(1))).toBe(0);
  });
});

describe("where the wrist begins", () => {
  it.each([
    ["human", human_like, glass_like, 1],
    ["gripper", barrett_like, glass_like, 2],
    ["human from above", human_like, plate_like, 1],
    ["gripper from above", barrett_like, plate_like, 0.5],
  ] as const)("%s: the palm faces the middle of the object and is off it", (_name, hand, object, scale) => {
    const pose = home_pose(hand, object, scale);
    const palm = new Vector3(...hand.approach_direction).applyQuaternion(rotation_of(pose));
    const point = new Vector3(...hand.approach_point).applyQuaternion(rotation_of(pose)).add(position_of(pose));
    const center = new Vector3(...object.center).multiplyScalar(scale);
    expect(palm.angleTo(center.clone().sub(point))).toBeLessThan(1e-6);
    expect(center.distanceTo(point)).toBeGreaterThan((Math.min(...object.size) * scale) / 2 + 0.05);
    expect(Math.hypot(...pose.slice(3))).toBeCloseTo(1, 12);
  });

  it("fingers point away from the viewer", () => {
    const links = open_hand(human_like, home_pose(human_like, glass_like, 1));
    expect(links[1]![1] - links[0][1]).toBeGreaterThan(0.15);
  });
});

describe("moving the wrist", () => {
  const looking_north = new Vector3(0, 1, -1);
  it("keys are as the camera looks, on the level", () => {
    const ahead = moved([0, 0, 0, 1, 0, 0, 0], wish_of_keys(new Set(["KeyW"])), looking_north, 1);
    expect(ahead[0]).toBeCloseTo(0, 12);
    expect(ahead[1]).toBeGreaterThan(0.05);
    expect(ahead[2]).toBeCloseTo(0, 12);
    expect(moved([0, 0, 0, 1, 0, 0, 0], wish_of_keys(new Set(["KeyD"])), looking_north, 1)[0]).toBeGreaterThan(0.05);
  });

  it("keys that oppose cancel, Shift is slower", () => {
    expect(wish_of_keys(new Set(["KeyW", "KeyS"]))).toEqual(still);
    expect(wish_of_keys(new Set(["KeyW", "ShiftLeft"])).ahead).toBe(0.25);
  });

  it("yaw turns about the vertical and leaves the place", () => {
    const turned = moved([1, 2, 3, 1, 0, 0, 0], { ...still, yaw: 1 }, looking_north, 0.5);
    expect(turned.slice(0, 3)).toEqual([1, 2, 3]);
    expect(turned[6]).toBeGreaterThan(0.2);
    expect(turned[4]).toBeCloseTo(0, 12);
  });

  it("the middle of a stick does nothing, its end all", () => {
    expect([-0.1, 0, 0.1].map(shaped)).toEqual([0, 0, 0]);
    expect([shaped(1), shaped(-1)]).toEqual([1, -1]);
    const buttons = Array.from({ length: 16 }, () => ({ pressed: false, value: 0 }));
    expect(wish_of_pad({ axes: [0, -1, 0, 0], buttons })).toEqual({ ...still, ahead: 1 });
  });

  it("two devices together do not exceed one", () => {
    expect(add_wishes({ ...still, up: 0.8 }, { ...still, up: 0.8 }).up).toBe(1);
  });
});

describe("gliding", () => {
  it("goes straight and evenly, and ends exactly at the goal", () => {
    const glide = new Glide();
    glide.begin([0.12, 0, 0, 1, 0, 0, 0]);
    let place: Pose = [0, 0, 0, 1, 0, 0, 0];
    const steps: number[] = [];
    while (glide.running && steps.length < 1000) {
      const next = glide.next(place, 0.05);
      steps.push(next[0] - place[0]);
      place = next;
    }
    expect(place).toEqual([0.12, 0, 0, 1, 0, 0, 0]);
    expect(Math.max(...steps) - Math.min(...steps.slice(0, -1))).toBeLessThan(1e-9);
    expect(steps.length).toBeGreaterThan(10);
  });
});

describe("latency", () => {
  it("is counted once a pose, for poses of ours alone", () => {
    let now = 10;
    const clock = new SenderClock(() => now);
    const first = clock.stamp();
    const second = clock.stamp();
    expect(second).toBeGreaterThan(first);
    now = 10.02;
    expect(clock.latency_of(second)).toBeCloseTo(0.02, 5);
    expect(clock.latency_of(second)).toBeUndefined();
    expect(clock.latency_of(first)).toBeUndefined();
    expect(clock.latency_of(123.4)).toBeUndefined();
    expect(clock.latency_of(undefined)).toBeUndefined();
  });

  it("quantiles of 1 to 100", () => {
    const spread = new Spread(100);
    for (let i = 0; i <= 100; ++i) spread.add(i);
    expect(spread.quantile(0.5)).toBe(51);
    expect(spread.quantile(0.99)).toBe(100);
    expect(new Spread().quantile(0.5)).toBeUndefined();
  });
});

describe("history", () => {
  it("keeps the worst latency of a tick, drops what is old, begins anew with a new planner", () => {
    const history = new History(1, 0.1);
    history.add(sample_of(view_at(0), 0.005));
    history.add(sample_of(view_at(0.05), 0.002));
    expect(history.samples).toHaveLength(1);
    expect(history.samples[0]!.latency).toBeCloseTo(5, 9);
    for (let i = 1; i < 30; ++i) history.add(sample_of(view_at(i / 10), undefined));
    expect(history.samples[0]!.time).toBeGreaterThanOrEqual(1.89);
    history.add(sample_of(view_at(0), undefined));
    expect(history.samples).toHaveLength(1);
  });

  it("a grasp that would not hold counts as zero", () => {
    expect(sample_of(view_at(0, { epsilon_now: -1 }), undefined).now).toBe(0);
    expect(sample_of(view_at(0), undefined).now).toBeNull();
  });
});

describe("grasps", () => {
  const grasp = (form_closure: boolean, epsilon: number, energy: number): Grasp => ({
    form_closure,
    epsilon,
    energy,
    volume: 0,
    max_penetration: 0,
    closing: [links_at(0), links_at(0.123456789)],
    contacts: [],
  });

  it("are ranked by epsilon, those without closure last by energy, numbers kept", () => {
    const list = [grasp(false, 0, 2), grasp(true, 0.1, 1), grasp(false, 0, 1), grasp(true, 0.3, 5)];
    expect(ranked(list).map((one) => one.number)).toEqual([4, 2, 3, 1]);
  });

  it("thinned lists keep their ends", () => {
    expect(thinned([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10], 3)).toEqual([0, 5, 10]);
    expect(thinned([1, 2], 3)).toEqual([1, 2]);
  });

  it("a plan that is kept is small and shows the same within 0.01 mm", () => {
    const closing = Array.from({ length: 33 }, (_, i) => links_at(i / 37)) as Grasp["closing"];
    const plan = {
      id: "p",
      hand: "h",
      object: "o",
      scale: 1,
      table: false,
      running: true,
      iterations: 1,
      total: 1,
      seconds: 1,
      trace: [],
      milestones: [],
      result: {
        type: "plan.result" as const,
        id: "p",
        status: "found" as const,
        stopped_early: false,
        explanation: "",
        grasps: [{ ...grasp(true, 1, 1), closing }],
        counts: { states: 1, legal: 1, tested: 1, form_closed: 1, not_closed: 0, no_contact: 0, penetrating: 0 },
        timings: { prepare: 0, search: 0, close: 0, volume: 0, total: 0 },
      },
    };
    const kept = compact_plan(plan);
    const steps = kept.result!.grasps[0]!.closing;
    expect(kept.running).toBe(false);
    expect(steps.length).toBeLessThan(10);
    expect(links_apart(steps[steps.length - 1]!, closing[32]!)).toBeLessThan(1e-5);
  });
});

describe("friction cones", () => {
  const contact: Contact = {
    point: [0.1, 0.2, 0.3],
    normal: [0, 0, -1],
    friction: 0.75,
    torsion_length: 0,
    link: "tip",
    patch: 0,
  };

  it("have the half angle atan(mu) about the normal, the tip at the contact", () => {
    expect(cone_half_angle(1)).toBeCloseTo(Math.PI / 4, 12);
    const place = contact_matrix(contact, 0.02);
    const tip = new Vector3(0, 0, 0).applyMatrix4(place);
    const middle = new Vector3(0, 1, 0).applyMatrix4(place).sub(tip);
    const rim = new Vector3(1, 1, 0).applyMatrix4(place).sub(tip);
    expect(tip.toArray()).toEqual([0.1, 0.2, 0.3]);
    expect(middle.normalize().z).toBeCloseTo(-1, 12);
    expect(rim.angleTo(new Vector3(0, 0, -1))).toBeCloseTo(Math.atan(0.75), 9);
    expect(rim.length()).toBeCloseTo(0.02, 9);
  });
});

describe("logs", () => {
  it("say what is wrong with them", () => {
    expect(() => parse_log("no log at all")).toThrow(/no views/);
    expect(() => parse_log(JSON.stringify({ t: 0, out: view_at(0) }))).toThrow(/online.start/);
  });

  it("times are looked up as a linear search does", () => {
    const list = [0, 0.5, 0.5, 2].map((t) => ({ t }));
    for (const t of [-1, 0, 0.2, 0.5, 1, 2, 3])
      expect(newest_at(list, t)).toBe(list.filter((one) => one.t <= t).length - 1);
    expect(newest_at([], 1)).toBe(-1);
  });
});

describe("frame budget", () => {
  it.each([
    ["?quality=fine", "fine"],
    ["?quality=fast", "fast"],
    ["", "auto"],
    ["?quality=other", "auto"],
  ])("address %j asks for %s", (search, choice) => {
    expect(quality_choice(search)).toBe(choice);
  });

  it("goes down after several slow frames in a row only, and not below the last level", () => {
    const budget = new FrameBudget(1);
    const feed = (...costs: number[]) => costs.map((cost) => budget.add(cost)).includes(true);
    expect(feed(100, 100, 100, 100, 100, 10, 100, 100, 100, 100, 100)).toBe(false);
    expect(feed(100)).toBe(true);
    expect(budget.level).toBe(1);
    expect(feed(...Array.from({ length: 50 }, () => 500))).toBe(false);
  });
});

describe("figures", () => {
  it.each([
    [0, "0"],
    [999, "999"],
    [1000, "1.00 k"],
    [45678, "45.7 k"],
    [999999, "1.00 M"],
    [1234567, "1.23 M"],
    [2.5e9, "2.50 G"],
    [undefined, "–"],
    [NaN, "–"],
  ])("count %s", (value, text) => expect(short_count(value)).toBe(text));
  it.each([
    [0.0042, "4.2 ms"],
    [0.25, "250 ms"],
    [0.9999, "1.0 s"],
    [12.34, "12.3 s"],
    [125, "2 min 05 s"],
    [119.99, "2 min 00 s"],
    [undefined, "–"],
  ])("duration %s", (value, text) => expect(duration(value)).toBe(text));
  it("no minus before zero, units behind", () => {
    expect(fixed(-0.0001, 2)).toBe("0.00");
    expect(millimetres(0.0123, 1)).toBe("12.3 mm");
    expect(degrees(Math.PI / 2)).toBe("90°");
  });
  it("ranges of charts hold all, with air, and are never empty", () => {
    expect(padded_range(1, 1)[1]).toBeGreaterThan(padded_range(1, 1)[0]);
    expect(padded_range(2, 4, 0)[0]).toBe(0);
    expect(padded_range(2, 4, 0)[1]).toBeGreaterThan(4);
    expect(padded_range(null, null)[1]).toBeGreaterThan(0);
  });
});

describe("address", () => {
  it.each([
    ["", "plan", undefined],
    ["#interactive", "interactive", undefined],
    ["#token=a%20b", "plan", "a b"],
    ["#replay&token=x", "replay", "x"],
    ["#nonsense", "plan", undefined],
    ["#token=%E0%A4%A", "plan", "%E0%A4%A"],
    ["#token=", "plan", undefined],
  ])("%j", (hash, page, token) => {
    expect(parse_hash(hash)).toEqual({ page, token });
  });
});

describe("signals", () => {
  it("tell of changes only, and not after the end", () => {
    const signal = new Signal(1);
    const seen: number[] = [];
    const end = signal.watch((value) => seen.push(value));
    signal.set(1);
    signal.set(2);
    end();
    signal.set(3);
    expect(seen).toEqual([1, 2]);
  });
});
