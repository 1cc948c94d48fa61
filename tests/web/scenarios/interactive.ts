// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { readFileSync } from "node:fs";
import { Quaternion, Vector3 } from "three";
import { WebSocket } from "ws";
import { eventually, expect, expect_near } from "../support/expect.ts";
import { gizmo_axes, projector } from "../support/project.ts";
import type { Stage } from "../support/stage.ts";
import type { Pose } from "../../../viewer/src/wire/messages.ts";

async function begin(stage: Stage): Promise<void> {
  await stage.go("#interactive");
  await eventually(() => stage.wire.view?.phase === "approach", "the planner takes the wrist");
}

async function offer(stage: Stage): Promise<void> {
  await eventually(() => stage.wire.view?.offer !== undefined, "a grasp is offered", 40);
  await eventually(async () => (await stage.number('[data-figure="offered"] strong')) > 0, "its epsilon is shown");
}

/** Turns the view a little, so that the page keeps its camera and the test knows it. */
async function keep_camera(stage: Stage): Promise<void> {
  const box = (await stage.page.locator(".view canvas").boundingBox())!;
  await stage.page.mouse.move(box.x + 40, box.y + box.height - 60);
  await stage.page.mouse.down();
  await stage.page.mouse.move(box.x + 60, box.y + box.height - 62, { steps: 3 });
  await stage.page.mouse.up();
  await stage.page.waitForTimeout(900);
  await stage.page.mouse.wheel(0, 1);
  await stage.page.waitForTimeout(900);
}

export async function drag(stage: Stage): Promise<void> {
  await begin(stage);
  await keep_camera(stage);
  const project = await projector(stage);
  const { base, axes } = await gizmo_axes(stage);
  const start = project(base);
  const ends = axes.map((axis) => project(base.clone().add(axis)));
  const lengths = ends.map((end) => Math.hypot(end.x - start.x, end.y - start.y));
  const longest = lengths.indexOf(Math.max(...lengths));
  const end = ends[longest]!;
  await stage.page.mouse.move(end.x, end.y);
  await stage.page.waitForTimeout(150);
  await stage.page.mouse.down();
  await stage.page.mouse.move(end.x + (end.x - start.x), end.y + (end.y - start.y), { steps: 12 });
  await stage.shot("dragging");
  await stage.page.mouse.up();
  await stage.page.waitForTimeout(300);
  const [x, y, z] = stage.wire.wrist;
  const way = new Vector3(x, y, z).sub(base);
  expect(way.length() > 0.01, `the wrist was dragged, by ${(way.length() * 1e3).toFixed(1)} mm`);
  expect(way.angleTo(axes[longest]!) < 0.02, "along the arrow");
  await eventually(
    () => stage.wire.view?.wrist !== undefined && Math.abs(stage.wire.view.wrist.pose[0] - x) < 1e-6,
    "the planner has the new place",
  );
}

/** Holds a key until something came about. */
async function hold(stage: Stage, key: string, done: () => boolean, what: string): Promise<void> {
  await stage.page.keyboard.down(key);
  await eventually(done, what, 10);
  await stage.page.keyboard.up(key);
  await stage.page.waitForTimeout(300);
}

export async function keyboard(stage: Stage): Promise<void> {
  await begin(stage);
  const before = stage.wire.wrist;
  expect(await stage.page.locator("#do-lift").isDisabled(), "what is not held cannot be lifted");
  await hold(stage, "KeyR", () => stage.wire.wrist[2] - before[2] > 0.02, "R raises the wrist");
  const after = stage.wire.wrist;
  expect_near(Math.hypot(after[0] - before[0], after[1] - before[1]), 0, 1e-9, "straight up");
  const turn_of = (pose: Pose) => new Quaternion(pose[4], pose[5], pose[6], pose[3]);
  const turned = () => turn_of(after).angleTo(turn_of(stage.wire.wrist)) > 0.05;
  await hold(stage, "ArrowLeft", turned, "an arrow key turns it");
  expect(
    new Set(stage.wire.wrists.map((one) => one.time)).size === stage.wire.wrists.length,
    "no two poses have the same time",
  );
  await stage.page.keyboard.press("KeyH");
  await eventually(() => Math.abs(stage.wire.wrist[2] - before[2]) < 1e-9, "H goes back to the start place");
}

/** A tracker of its own, beside the page, moves the hand. */
export async function tracker(stage: Stage): Promise<void> {
  await begin(stage);
  const start = stage.wire.wrist;
  const sent = stage.wire.wrists.length;
  const socket = new WebSocket(stage.target.address.replace("http", "ws") + "ws");
  const welcome = new Promise((resolve) => socket.addEventListener("message", resolve, { once: true }));
  await new Promise((resolve) => socket.addEventListener("open", resolve, { once: true }));
  socket.send(JSON.stringify({ type: "hello", protocol: 1, role: "tracker" }));
  await welcome;
  const goal = start[2] + 0.06;
  for (let i = 1; i <= 30; ++i) {
    const [x, y, z, ...turn] = start;
    socket.send(JSON.stringify({ type: "wrist", time: 5000 + i / 60, pose: [x, y, z + (0.06 * i) / 30, ...turn] }));
    await stage.page.waitForTimeout(16);
  }
  await eventually(
    () => Math.abs((stage.wire.view?.wrist?.pose[2] ?? 0) - goal) < 1e-6,
    "the planner follows the tracker",
  );
  await eventually(
    async () => (await stage.text("#hud")).startsWith("Tracker:"),
    "the page says that a tracker moves the hand",
  );
  expect(stage.wire.wrists.length === sent, "the page itself sends nothing meanwhile");
  await stage.shot("moved");
  await stage.page.keyboard.down("KeyF");
  await stage.page.waitForTimeout(300);
  await stage.page.keyboard.up("KeyF");
  await eventually(() => stage.wire.wrists.length > sent, "the keyboard takes over");
  expect(stage.wire.wrist[2] < goal && stage.wire.wrist[2] > start[2] - 0.05, "from where the tracker left the wrist");
  socket.close();
}

export async function grasp_and_lift(stage: Stage): Promise<void> {
  const { page } = stage;
  await begin(stage);
  await offer(stage);
  await page.waitForTimeout(600);
  await stage.shot("offer");
  expect((await stage.number('[data-figure="postures"]')) > 0, "the planner's rate is shown");
  expect((await stage.text('[data-figure="latency"]')).endsWith("ms"), "the latency is shown");
  expect((await page.locator("#solutions tbody tr").count()) > 0, "solutions are listed");
  const with_ghost = await stage.view_picture();
  await page.selectOption("#ghost", "none");
  await page.waitForTimeout(250);
  expect((await stage.changed(with_ghost, await stage.view_picture())) > 0.004, "the ghost is seen");
  await page.selectOption("#ghost", "grasp");
  await approach(stage);
  await stage.shot("near");
  await page.click("#do-close");
  await eventually(() => stage.wire.view?.phase === "holding", "the hand is closed");
  await page.waitForTimeout(600);
  const told = await stage.text("#closed");
  expect(Number.parseFloat(/epsilon ([\d.]+)/.exec(told)?.[1] ?? "0") > 0, `a grasp that holds was made: ${told}`);
  expect(!(await page.locator("#do-lift").isDisabled()), "and can be lifted");
  await stage.shot("closed");
  const low = await stage.view_picture();
  await page.keyboard.press("KeyL");
  await page.waitForTimeout(1600);
  await eventually(
    async () => (await stage.changed(low, await stage.view_picture())) > 0.02,
    "the object rises with the hand",
  );
  await stage.shot("lifted");
  await page.keyboard.press("KeyO");
  await eventually(() => stage.wire.view?.phase === "approach", "the hand is put down and opens");
  await stage.shot("opened");
}

/** Lets the wrist glide to the offered pre-grasp, again where another one is offered on the way, until closing would hold. */
async function approach(stage: Stage): Promise<void> {
  const { page, wire } = stage;
  const there = () => (wire.view?.epsilon_now ?? -1) > 0 && Math.abs(wire.view?.solutions[0]?.distance ?? 1) < 0.005;
  for (let attempt = 0; attempt < 8 && !there(); ++attempt) {
    await page.keyboard.press("KeyT");
    await page.waitForTimeout(2500);
  }
  expect(there(), "the wrist is at the offered grasp, and closing would hold");
}

export async function reload(stage: Stage): Promise<void> {
  const { page } = stage;
  await stage.go();
  await page.click("#plan-start");
  await page.waitForSelector("#gallery button", { timeout: 60_000 });
  const grasps = await page.locator("#gallery button").count();
  await page.click('[data-page="interactive"]');
  await eventually(() => stage.wire.view?.phase === "approach", "the planner takes the wrist");
  await page.keyboard.down("KeyR");
  await page.waitForTimeout(400);
  await page.keyboard.up("KeyR");
  await page.waitForTimeout(300);
  const before = stage.wire.wrist;
  stage.wire.wrists.length = 0;
  stage.wire.view = undefined;
  await page.reload();
  await eventually(() => stage.wire.wrists.length > 0, "after the reload the page goes on by itself");
  stage.wire.wrist.forEach((value, i) => expect_near(value, before[i]!, 1e-9, "the wrist is where it was"));
  expect(page.url().endsWith("#interactive"), "on the same page");
  await offer(stage);
  await stage.shot("after");
  await page.click('[data-page="plan"]');
  await page.waitForSelector("#gallery button");
  expect((await page.locator("#gallery button").count()) === grasps, "the grasps that were planned are still there");
  await page.waitForTimeout(800);
  await stage.shot("plan");
}

export async function server_gone(stage: Stage): Promise<void> {
  const { page, target } = stage;
  await begin(stage);
  await offer(stage);
  stage.complaints.server_away = true;
  await target.stop();
  await page.waitForSelector("#link-banner:visible");
  expect((await stage.text("#link-banner")).includes("server is gone"), "the page says that the server is gone");
  expect(await page.locator("#do-close").isDisabled(), "nothing can be closed meanwhile");
  await page.waitForTimeout(1500);
  await stage.shot("gone");
  stage.wire.view = undefined;
  await target.start();
  await page.waitForSelector("#link-banner", { state: "hidden" });
  stage.complaints.server_away = false;
  await offer(stage);
  await stage.shot("back");
}

export async function replay(stage: Stage): Promise<void> {
  const { page } = stage;
  await begin(stage);
  await page.click("#record");
  await page.keyboard.down("KeyR");
  await page.waitForTimeout(700);
  await page.keyboard.up("KeyR");
  await offer(stage);
  await page.waitForTimeout(300);
  await page.click("#do-close");
  await page.waitForTimeout(900);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#record")]);
  const log = readFileSync(await download.path());
  expect(log.toString().split("\n").length > 20, "the log has lines");
  await page.click('[data-page="replay"]');
  await page
    .locator(".right .drop input")
    .setInputFiles({ name: download.suggestedFilename(), mimeType: "application/x-ndjson", buffer: log });
  await eventually(async () => (await stage.number("#replay-time")) > 0.3, "it plays");
  await stage.shot("playing");
  await page.click("#replay-play");
  const paused = await stage.text("#replay-time");
  await page.waitForTimeout(400);
  expect((await stage.text("#replay-time")) === paused, "and stands still when it is paused");
  await page.locator("#timeline").fill("0");
  await page.waitForTimeout(300);
  const first = await stage.view_picture();
  await page.locator("#timeline").press("End");
  await page.waitForTimeout(300);
  expect((await stage.changed(first, await stage.view_picture())) > 0.005, "the slider goes through it");
  expect((await page.locator("#events button").count()) > 0, "events are listed");
  await stage.shot("end");
  await page
    .locator(".right .drop input")
    .setInputFiles({ name: "notes.txt", mimeType: "text/plain", buffer: Buffer.from("no log") });
  await page.waitForSelector("#replay-note.bad");
}
