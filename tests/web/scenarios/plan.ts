// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { readFileSync } from "node:fs";
import { eventually, expect } from "../support/expect.ts";
import type { Stage } from "../support/stage.ts";

export async function plan(stage: Stage): Promise<void> {
  const { page } = stage;
  await stage.go();
  const before = await stage.view_picture();
  await page.click("#plan-start");
  await eventually(async () => (await stage.number('[data-figure="best"]')) > -1e9, "an energy is shown");
  await page.waitForSelector("#gallery button", { timeout: 60_000 });
  expect((await stage.changed(before, await stage.view_picture())) > 0.01, "the grasp is shown");
  await eventually(async () => (await page.locator("#plan-start").innerText()) === "Plan grasps", "the plan ended");
  expect((await page.locator("#milestones").getAttribute("max")) !== "0", "there are best states to go through");
  await thumbnails_are_drawn(stage);
  await stage.shot("gallery");
  await sorted_by_epsilon(stage);
  await slider(stage);
  await milestones(stage);
  await downloads(stage);
}

async function thumbnails_are_drawn(stage: Stage): Promise<void> {
  const count = () =>
    stage.page.evaluate(
      () =>
        [...document.querySelectorAll<HTMLCanvasElement>("#gallery canvas")].filter((canvas) => {
          const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
          return data.some((value, i) => i % 4 !== 3 && value > 90);
        }).length,
    );
  const all = await stage.page.locator("#gallery canvas").count();
  await eventually(async () => (await count()) === all, "every grasp of the gallery has its picture", 40);
}

async function sorted_by_epsilon(stage: Stage): Promise<void> {
  const texts = await stage.page.locator("#gallery b").allInnerTexts();
  const values = texts.map((text) => Number.parseFloat(text.replace("ε", "")));
  expect(values.length > 0, "there are form-closed grasps");
  values.forEach((value, i) =>
    expect(i === 0 || value <= values[i - 1]!, `grasp ${i + 1} is no better than the one before it`),
  );
}

async function slider(stage: Stage): Promise<void> {
  const { page } = stage;
  await page.locator("#gallery button").nth(1).click();
  await page.waitForTimeout(300);
  const closed = await stage.view_picture();
  await stage.shot("grasp");
  await page.locator("#closing").fill("0");
  await page.waitForTimeout(300);
  expect((await stage.changed(closed, await stage.view_picture())) > 0.001, "the slider opens the hand");
  await stage.shot("pregrasp");
  await page.click("#play-closing");
  await eventually(async () => (await page.locator("#closing").inputValue()) === "1", "the hand closes by itself");
  await page.waitForTimeout(300);
  expect((await stage.changed(closed, await stage.view_picture())) < 0.002, "and stands as before");
}

async function milestones(stage: Stage): Promise<void> {
  const { page } = stage;
  await page.locator("#milestones").fill("0");
  await page.waitForTimeout(300);
  const first = await stage.view_picture();
  expect((await stage.text(".hud")).startsWith("Best state 1 of"), "the first of the best states is named");
  await stage.shot("first-state");
  await page.locator("#milestones").press("End");
  await page.waitForTimeout(300);
  expect(
    (await stage.changed(first, await stage.view_picture())) > 0.005,
    "the last of the best states is another one",
  );
}

async function downloads(stage: Stage): Promise<void> {
  const { page } = stage;
  await page.locator("#gallery button").first().click();
  const fetch = async (button: string) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  const json = await fetch("#save-json");
  const text = json.bytes.toString();
  expect(json.name.endsWith(".json") && typeof JSON.parse(text) === "object", "JSON is saved");
  const glb = await fetch("#save-glb");
  expect(glb.name.endsWith(".glb") && glb.bytes.toString("latin1", 0, 4) === "glTF", "GLB is saved");
  const png = await fetch("#save-png");
  expect(png.bytes.toString("latin1", 1, 4) === "PNG" && png.bytes.length > 10_000, "a picture is saved");
  if (stage.target.name !== "mock") {
    const file = JSON.parse(text) as { format: string; grasps: { epsilon: number }[] };
    expect(file.format === "eigengrasp-grasps" && file.grasps.length > 0, "the JSON is a grasp file");
    const shown = Number.parseFloat((await stage.text("#gallery b")).replace("ε", ""));
    expect(Math.abs(file.grasps[0]!.epsilon - shown) < 1e-4, "the first grasp of the file is the first of the gallery");
  }
}

export async function stop_early(stage: Stage): Promise<void> {
  const { page } = stage;
  await stage.go();
  await page.click("details summary");
  await page.locator("#iterations").fill("10000000");
  await page.click("#plan-start");
  await eventually(async () => (await page.locator("#plan-start").innerText()) === "Stop", "the plan runs");
  await eventually(async () => (await stage.number('[data-figure="best"]')) > -1e9, "an energy is shown");
  await page.waitForTimeout(700);
  await stage.shot("running");
  await page.click("#plan-start");
  await eventually(async () => (await page.locator("#plan-start").innerText()) === "Plan grasps", "Stop ends it", 30);
  expect((await stage.text("#explanation")).length > 10, "and what was found is told");
}
