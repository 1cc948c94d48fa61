// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { mkdirSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import type { Browser, BrowserContext, Page, WebSocket } from "playwright-core";
import { Complaints } from "./browser.ts";
import type { Target } from "./target.ts";
import type { Pose, ServerMessage, Targets, View, Wrist } from "../../../viewer/src/wire/messages.ts";

const output = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../output");

/** What went over the WebSocket, as the browser saw it. */
export class Wire {
  readonly wrists: Wrist[] = [];
  readonly types: string[] = [];
  view: View | undefined;
  /** The list of targets that was sent last. */
  targets: Targets["targets"] | undefined;

  attach(socket: WebSocket): void {
    socket.on("framesent", ({ payload }) => {
      const message = JSON.parse(String(payload)) as { type: string };
      this.types.push(`> ${message.type}`);
      if (message.type === "targets") this.targets = (message as Targets).targets;
      if (message.type === "wrist") this.wrists.push(message as Wrist);
    });
    socket.on("framereceived", ({ payload }) => {
      const message = JSON.parse(String(payload)) as ServerMessage;
      this.types.push(`< ${message.type}`);
      if (message.type === "view") this.view = message;
    });
  }

  get wrist(): Pose {
    const last = this.wrists.at(-1);
    if (!last) throw new Error("no wrist pose was sent");
    return last.pose;
  }
}

/** A page of the app in a tab of its own, with all that a scenario needs. */
export class Stage {
  readonly wire = new Wire();
  readonly complaints: Complaints;

  private constructor(
    readonly page: Page,
    readonly target: Target,
    private readonly context: BrowserContext,
    private readonly scenario: string,
  ) {
    this.complaints = new Complaints(page);
    page.on("websocket", (socket) => this.wire.attach(socket));
  }

  static async open(
    browser: Browser,
    target: Target,
    scenario: string,
    size = { width: 1280, height: 720 },
  ): Promise<Stage> {
    const context = await browser.newContext({ viewport: size, acceptDownloads: true });
    // The compiler of these scripts wraps functions in a helper of its own, which the page does not have.
    await context.addInitScript("globalThis.__name = (f) => f");
    const page = await context.newPage();
    page.setDefaultTimeout(20_000);
    return new Stage(page, target, context, scenario);
  }

  /** Opens a page of the app and waits until the hand and the object stand there. */
  async go(hash = ""): Promise<void> {
    await this.page.goto(`${this.target.address}?quality=fast${hash}`);
    await this.page.waitForSelector('.link[data-kind="online"]');
    await this.settled();
  }

  /** Waits until the scene is loaded and drawn. */
  async settled(): Promise<void> {
    await this.page.waitForSelector('.view[data-ready="true"]');
    await this.page.waitForTimeout(250);
  }

  /** Keeps a picture of the page, and makes sure that nothing on it stands out of its column. */
  async shot(name: string): Promise<void> {
    const outside = await this.page.evaluate(() =>
      [...document.querySelectorAll("aside")].flatMap((column) => {
        const edge = column.getBoundingClientRect();
        return [...column.querySelectorAll("*")]
          .filter((part) => {
            const box = part.getBoundingClientRect();
            return box.width > 1 && (box.right > edge.right + 1 || box.left < edge.left - 1);
          })
          .map((part) => `${part.tagName} ${part.className} "${part.textContent?.slice(0, 40)}"`);
      }),
    );
    if (outside.length > 0 && name !== "failed") throw new Error(`out of its column: ${outside[0]}`);
    mkdirSync(path.join(output, this.target.name), { recursive: true });
    await this.page.screenshot({ path: path.join(output, this.target.name, `${this.scenario}-${name}.png`) });
  }

  async text(selector: string): Promise<string> {
    return (await this.page.locator(selector).first().innerText()).trim();
  }

  async number(selector: string): Promise<number> {
    return Number.parseFloat(await this.text(selector));
  }

  /** Share of the 3-D view that differs between two pictures of it. */
  async changed(before: Buffer, after: Buffer): Promise<number> {
    return this.page.evaluate(
      async ([a, b]) => {
        const pixels = async (text: string) => {
          const image = new Image();
          image.src = text;
          await image.decode();
          const canvas = document.createElement("canvas");
          canvas.width = image.width;
          canvas.height = image.height;
          const brush = canvas.getContext("2d")!;
          brush.drawImage(image, 0, 0);
          return brush.getImageData(0, 0, image.width, image.height).data;
        };
        const [one, two] = [await pixels(a!), await pixels(b!)];
        let different = 0;
        for (let i = 0; i < one.length; i += 4) {
          if (
            Math.abs(one[i]! - two[i]!) + Math.abs(one[i + 1]! - two[i + 1]!) + Math.abs(one[i + 2]! - two[i + 2]!) >
            24
          )
            different += 1;
        }
        return different / (one.length / 4);
      },
      [before, after].map((picture) => `data:image/png;base64,${picture.toString("base64")}`),
    );
  }

  view_picture(): Promise<Buffer> {
    return this.page.locator(".view canvas").screenshot();
  }

  /** The 3-D view once it stands still. */
  async picture_at_rest(): Promise<Buffer> {
    let last = await this.view_picture();
    for (let attempt = 0; attempt < 40; ++attempt) {
      await this.page.waitForTimeout(200);
      const next = await this.view_picture();
      if ((await this.changed(last, next)) < 0.0005) return next;
      last = next;
    }
    throw new Error("the 3-D view does not come to rest");
  }

  async close(): Promise<void> {
    await this.context.close();
  }
}
