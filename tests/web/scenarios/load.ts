// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { eventually, expect } from "../support/expect.ts";
import type { Stage } from "../support/stage.ts";

export async function load(stage: Stage): Promise<void> {
  const { page } = stage;
  await stage.go();
  expect((await page.locator("#objects button").count()) >= 6, "all objects of the server are listed");
  expect((await page.locator("#hand option").count()) >= 4, "all hands of the server are listed");
  await stage.shot("1280");
  let before = await stage.picture_at_rest();
  for (const object of ["shoe", "glass"]) {
    await page.click(`[data-object="${object}"]`);
    await stage.settled();
    await eventually(
      async () => (await stage.changed(before, await stage.view_picture())) > 0.01,
      `the ${object} is shown`,
    );
    before = await stage.picture_at_rest();
    await stage.shot(object);
  }
  await page.selectOption("#hand", "barrett-metal");
  await stage.settled();
  await page.check("text=Object stands on a table");
  await stage.settled();
  await stage.shot("table");
  const fits = () =>
    page.evaluate(() => {
      const wide = [...document.querySelectorAll("aside, header, .centre, .charts, .banner")].filter(
        (box) => box.scrollWidth > box.clientWidth + 1,
      );
      return (
        document.documentElement.scrollWidth <= window.innerWidth &&
        document.documentElement.scrollHeight <= window.innerHeight &&
        wide.length === 0
      );
    });
  expect(await fits(), "nothing is wider than its place at 1280 x 720");
  await page.setViewportSize({ width: 1920, height: 1080 });
  await page.waitForTimeout(400);
  expect(await fits(), "nothing is wider than its place at 1920 x 1080");
  await stage.shot("1920");
}

export async function orbit(stage: Stage): Promise<void> {
  const { page } = stage;
  await stage.go();
  const before = await stage.picture_at_rest();
  const box = (await page.locator(".view canvas").boundingBox())!;
  await page.mouse.move(box.x + box.width * 0.3, box.y + box.height * 0.6);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.5, { steps: 6 });
  await page.mouse.up();
  const turned = await stage.picture_at_rest();
  await page.waitForTimeout(300);
  expect((await stage.changed(before, turned)) > 0.03, "dragging turns the view");
  await stage.shot("turned");
  await page.reload();
  await stage.settled();
  expect((await stage.changed(turned, await stage.picture_at_rest())) < 0.01, "the view is the same after a reload");
  await page.click("#view-home");
  expect((await stage.changed(before, await stage.picture_at_rest())) < 0.01, "Home goes back to the first view");
}

/** A box of 40 x 60 x 100 mm, as text of a Wavefront file in millimetres. */
function box_file(): string {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => `v ${i & 1 ? 20 : -20} ${i & 2 ? 30 : -30} ${i & 4 ? 50 : -50}`);
  const faces = [
    [1, 3, 4, 2],
    [5, 6, 8, 7],
    [1, 2, 6, 5],
    [3, 7, 8, 4],
    [1, 5, 7, 3],
    [2, 4, 8, 6],
  ].flatMap(([a, b, c, d]) => [`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`]);
  return [...corners, ...faces].join("\n") + "\n";
}

export async function upload(stage: Stage): Promise<void> {
  const { page } = stage;
  await stage.go();
  await page.selectOption("#units", "mm");
  const input = page.locator("#drop-object input");
  await input.setInputFiles({ name: "box.obj", mimeType: "model/obj", buffer: Buffer.from(box_file()) });
  await page.waitForSelector('[data-object="box"][aria-pressed="true"]');
  await stage.settled();
  expect(
    (await stage.text('[data-figure="size"]')) === "40 × 60 × 100",
    "the size of a file in millimetres is read as such",
  );
  await stage.shot("box");
  await input.setInputFiles({ name: "notes.obj", mimeType: "text/plain", buffer: Buffer.from("nothing of a mesh\n") });
  await page.waitForSelector("#drop-object .note.bad");
  expect((await stage.text("#drop-object .note.bad")).length > 10, "a file that is no mesh is refused with a sentence");
  await stage.shot("refused");
  stage.complaints.forgive(/status of 4\d\d/);
}
