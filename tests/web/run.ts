// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Tests the built web app in Chromium: npm test -- [--program eigengrasp] [--only NAME | --main]
// --main: the scenarios that a change is taken by. A scenario that fails is tried once more, and that is said.
// Without --program it runs against a server with made-up grasps. Screenshots are kept in output/.
import path from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import * as hand_upload from "./scenarios/hand_upload.ts";
import * as interactive from "./scenarios/interactive.ts";
import * as load from "./scenarios/load.ts";
import * as plan from "./scenarios/plan.ts";
import * as sharing from "./scenarios/sharing.ts";
import { token } from "./scenarios/token.ts";
import { open_browser } from "./support/browser.ts";
import { Stage } from "./support/stage.ts";
import { free_port, MockTarget, ProgramTarget, type Target } from "./support/target.ts";

const app = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../../viewer/dist");
const { values } = parseArgs({ options: { program: { type: "string" }, only: { type: "string" }, main: { type: "boolean" } } });
const secret = "correct-horse";

type Scenario = (stage: Stage) => Promise<void>;
const scenarios: Record<string, Scenario> = {
  ...load,
  ...hand_upload,
  ...plan,
  ...interactive,
  ...sharing,
  token: (stage) => token(stage, secret),
};

const main_scenarios = ["load", "plan", "grasp_and_lift", "reload", "server_gone"];

async function make_target(name: string): Promise<Target> {
  const port = await free_port();
  const guarded = name === "token" ? secret : undefined;
  return values.program ? new ProgramTarget(values.program, app, port, guarded) : new MockTarget(app, port, guarded);
}

const browser = await open_browser();

/** Runs a scenario with a server of its own; true where it passed. */
async function passes(name: string, scenario: Scenario): Promise<boolean> {
  const began = performance.now();
  const target = await make_target(name);
  let stage: Stage | undefined;
  let passed = true;
  try {
    await target.start();
    stage = await Stage.open(browser, target, name);
    await scenario(stage);
    const complaints = stage.complaints.take();
    if (complaints.length > 0) throw new Error(`the browser complains:\n${complaints.join("\n")}`);
    console.log(`ok   ${name} (${((performance.now() - began) / 1e3).toFixed(1)} s)`);
  } catch (problem) {
    passed = false;
    console.log(`FAIL ${name}: ${problem instanceof Error ? problem.message : String(problem)}`);
    await stage?.shot("failed").catch(() => undefined);
    for (const complaint of stage?.complaints.take() ?? []) console.log(`     ${complaint}`);
  }
  await stage?.close();
  await target.stop();
  target.dispose();
  return passed;
}

let failures = 0;
for (const [name, scenario] of Object.entries(scenarios)) {
  if (values.only && values.only !== name) continue;
  if (values.main && !main_scenarios.includes(name)) continue;
  if (await passes(name, scenario)) continue;
  console.log(`     once more: ${name}`);
  if (!(await passes(name, scenario))) failures += 1;
}
await browser.close();
console.log(failures === 0 ? "all scenarios passed" : `${failures} scenarios failed`);
process.exit(failures === 0 ? 0 : 1);
