// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { expect } from "../support/expect.ts";
import type { Stage } from "../support/stage.ts";

export async function token(stage: Stage, secret: string): Promise<void> {
  const { page } = stage;
  stage.complaints.forgive(/status of 401/);
  await page.goto(stage.target.address);
  await page.waitForSelector("#token-banner:visible");
  await stage.shot("asked");
  await page.fill("#token-banner input", "wrong");
  await page.click("#token-banner button");
  await page.waitForTimeout(500);
  await page.waitForSelector("#token-banner:visible");
  await page.fill("#token-banner input", secret);
  await page.click("#token-banner button");
  await page.waitForSelector('.link[data-kind="online"]');
  await stage.settled();
  await page.reload();
  await stage.settled();
  await page.evaluate(() => sessionStorage.clear());
  await page.goto("about:blank");
  await page.goto(`${stage.target.address}#interactive&token=${secret}`);
  await stage.settled();
  expect(!page.url().includes(secret), "the token does not stay in the address");
}
