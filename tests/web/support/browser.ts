// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { existsSync } from "node:fs";
import { type Browser, chromium, type Page } from "playwright-core";

const places = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

export function browser_program(): string {
  const found = [process.env["EIGENGRASP_BROWSER"], ...places].find((place) => place && existsSync(place));
  if (!found) throw new Error("no Chromium was found: apt-get install chromium, or name one in EIGENGRASP_BROWSER");
  return found;
}

/** Chromium without a window; draws with the processor, so that no graphics card is needed. */
export function open_browser(): Promise<Browser> {
  return chromium.launch({
    executablePath: browser_program(),
    headless: true,
    args: [
      "--no-sandbox",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
      "--disable-dev-shm-usage",
    ],
  });
}

/** Complaints of a page: errors and warnings of its console, exceptions, requests that failed. */
export class Complaints {
  private list: string[] = [];
  /** While the server is away on purpose, the browser itself complains of the lost connection. */
  server_away = false;
  private forgiven: RegExp[] = [];

  constructor(page: Page) {
    page.on("console", (message) => {
      if (message.type() !== "error" && message.type() !== "warning") return;
      this.add(`${message.type()}: ${message.text()}`);
    });
    page.on("pageerror", (problem) => this.add(`exception: ${problem.stack ?? problem.message}`));
  }

  /** What a scenario brings about on purpose, such as an answer of code 401. */
  forgive(text: RegExp): void {
    this.forgiven.push(text);
  }

  take(): string[] {
    const list = this.list.filter((text) => !this.forgiven.some((one) => one.test(text)));
    this.list = [];
    return list;
  }

  private add(text: string): void {
    if (this.server_away && /WebSocket connection|ERR_CONNECTION_REFUSED|Failed to load resource/.test(text)) return;
    if (/GPU stall due to ReadPixels|Automatic fallback to software WebGL/.test(text)) return;
    this.list.push(text);
  }
}
