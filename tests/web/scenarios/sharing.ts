// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { readFileSync } from "node:fs";
import { eventually, expect, expect_near } from "../support/expect.ts";
import type { Stage } from "../support/stage.ts";

async function slide(stage: Stage, id: string, value: number): Promise<void> {
  await stage.page.locator(`#${id}`).evaluate((slider, to) => {
    (slider as HTMLInputElement).value = String(to);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, value);
}

/** Wished values go to the planner while the box is ticked, and only then. */
export async function shared_control(stage: Stage): Promise<void> {
  const { page, wire } = stage;
  await stage.go("#interactive");
  await eventually(() => wire.view?.phase === "approach", "the planner takes the wrist");
  await page.click("#shared-control > summary");
  const dofs = await page.locator('[id^="wish-dof-"]').count();
  expect(dofs === 20, `every degree of freedom of the human hand has a slider, found ${dofs}`);
  await slide(stage, "wish-distance-0", 50);
  await page.waitForTimeout(300);
  expect(wire.targets === undefined, "nothing is sent before the box is ticked");
  await page.check("#wish-send");
  await eventually(() => wire.targets?.length === 1, "the target is sent");
  const [distance] = wire.targets!;
  expect(distance!.variable === "distance", "it is the distance");
  expect_near(distance!.value, 0.05, 0.002, "in metres");
  expect_near(distance!.confidence ?? 1, 0.5, 1e-9, "half sure at first");
  await slide(stage, "wish-amplitude-1", 1.5);
  await slide(stage, "sure-amplitude-1", 1);
  await slide(stage, "wish-dof-3", 0.4);
  await eventually(() => wire.targets?.length === 3, "all targets are sent together");
  expect(
    wire.targets!.some((one) => one.variable === "amplitude" && one.index === 1 && one.confidence === 1),
    "sure",
  );
  await page.locator("#shared-control").scrollIntoViewIfNeeded();
  await stage.shot("wishes");
  await page.selectOption("#hand", "barrett-metal");
  await eventually(
    async () => (await page.locator('[id^="wish-dof-"]').count()) === 4,
    "four sliders for four DOFs",
    30,
  );
  await eventually(() => wire.targets?.length === 0, "what was wished of the first hand is dropped");
  await slide(stage, "wish-dof-0", 1);
  await eventually(() => wire.targets?.length === 1, "the second hand takes targets");
  await page.uncheck("#wish-send");
  await eventually(() => wire.targets?.length === 0, "without the box there are none");
  const { view } = wire;
  await eventually(() => wire.view !== view, "the planner goes on");
}

/** The log of the session that the server keeps. */
export async function server_log(stage: Stage): Promise<void> {
  const { page, wire } = stage;
  await stage.go("#interactive");
  await eventually(() => wire.view?.phase === "approach", "the planner takes the wrist");
  await page.waitForTimeout(2000);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#server-log")]);
  const lines = readFileSync((await download.path())!, "utf8")
    .trimEnd()
    .split("\n");
  const kept = lines.map((line) => JSON.parse(line) as { in?: { type: string }; out?: { type: string } });
  expect(download.suggestedFilename().endsWith(".jsonl"), "it has the server's own name");
  expect(
    kept.some((line) => line.in?.type === "online.start"),
    "it holds what the page sent",
  );
  expect(
    kept.some((line) => line.out?.type === "view"),
    "and what it was answered",
  );
}
