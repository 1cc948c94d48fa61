// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { eventually, expect } from "../support/expect.ts";
import type { Stage } from "../support/stage.ts";

const hands = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../../../data/hands");

/** A shipped hand under a name of its own, packed; without the file that describes it where that is asked for. */
function packed_hand(name: string, with_description: boolean): Buffer {
  const folder = mkdtempSync(path.join(tmpdir(), "eigengrasp-hand-"));
  try {
    cpSync(path.join(hands, "barrett-metal"), path.join(folder, name), { recursive: true });
    const file = path.join(folder, name, "hand.yaml");
    if (with_description) writeFileSync(file, readFileSync(file, "utf8").replace(/^name: .*/m, `name: ${name}`));
    else rmSync(file);
    return execFileSync("tar", ["czf", "-", "-C", folder, name], { maxBuffer: 1 << 26 });
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** A hand that is dropped on the page plans and grasps like the others. */
export async function drop_hand(stage: Stage): Promise<void> {
  const { page } = stage;
  await stage.go();
  const before = await stage.picture_at_rest();
  const content = packed_hand("three-fingers", true).toString("base64");
  await page.locator("#drop-hand .drop").evaluate((area, text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const data = new DataTransfer();
    data.items.add(new File([bytes], "three-fingers.tar.gz"));
    area.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  }, content);
  await eventually(
    async () => (await page.locator("#hand").inputValue()) === "three-fingers",
    "the dropped hand is chosen",
    20,
  );
  await stage.settled();
  expect((await stage.changed(before, await stage.picture_at_rest())) > 0.01, "the dropped hand is shown");
  expect((await stage.text("#drop-hand .note")).includes("three-fingers"), "the page says that it was loaded");
  await stage.shot("shown");
  await page.click("#plan-start");
  await page.waitForSelector("#gallery button", { timeout: 60_000 });
  await stage.shot("planned");
  await page.click('nav [data-page="interactive"]');
  await eventually(() => stage.wire.view?.phase === "approach", "the planner takes the wrist of the dropped hand", 30);
  await stage.shot("interactive");
}

export async function refused_hand(stage: Stage): Promise<void> {
  const { page } = stage;
  await stage.go();
  const chosen = await page.locator("#hand").inputValue();
  await page.locator("#drop-hand input").setInputFiles({
    name: "nothing.tar.gz",
    mimeType: "application/gzip",
    buffer: packed_hand("nothing", false),
  });
  await page.waitForSelector("#drop-hand .note.bad");
  expect((await stage.text("#drop-hand .note.bad")).includes("hand.yaml"), "the sentence names what is missing");
  expect((await page.locator("#hand").inputValue()) === chosen, "the hand stays as it was");
  await stage.shot("refused");
  stage.complaints.forgive(/status of 4\d\d/);
}
