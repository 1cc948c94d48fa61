// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { type ChildProcess, spawn } from "node:child_process";
import { createServer } from "node:net";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { MockServer } from "../mock/server.ts";

/** A server that the tests can stop and start again at the same address. */
export interface Target {
  readonly name: string;
  readonly address: string;
  start(): Promise<void>;
  /** Ends it at once, as when it is killed. */
  stop(): Promise<void>;
  /** Takes away what it left on the disk. */
  dispose(): void;
}

export async function free_port(): Promise<number> {
  return new Promise((resolve) => {
    const probe = createServer();
    probe.listen(0, "127.0.0.1", () => {
      const address = probe.address();
      probe.close(() => resolve(typeof address === "object" && address ? address.port : 0));
    });
  });
}

export class MockTarget implements Target {
  readonly name = "mock";
  readonly address: string;
  private server: MockServer | undefined;

  constructor(
    private readonly app: string,
    private readonly port: number,
    private readonly token?: string,
  ) {
    this.address = `http://127.0.0.1:${port}/`;
  }

  async start(): Promise<void> {
    this.server = new MockServer(this.app, this.token);
    await this.server.listen(this.port);
  }

  async stop(): Promise<void> {
    await this.server?.close();
  }

  dispose(): void {}
}

/** The real thing: a program that is started as `PROGRAM serve --port N`. */
export class ProgramTarget implements Target {
  readonly name = "eigengrasp";
  readonly address: string;
  private readonly logs = mkdtempSync(path.join(tmpdir(), "eigengrasp-web-"));
  private child: ChildProcess | undefined;
  private output = "";

  constructor(
    private readonly program: string,
    private readonly app: string,
    private readonly port: number,
    private readonly token?: string,
  ) {
    this.address = `http://127.0.0.1:${port}/`;
  }

  async start(): Promise<void> {
    const words = [
      "serve",
      "--port",
      String(this.port),
      "--app",
      this.app,
      "--log",
      this.logs,
      ...(this.token ? ["--token", this.token] : []),
    ];
    const child = spawn(this.program, words, { stdio: ["ignore", "pipe", "pipe"] });
    this.child = child;
    const keep = (text: Buffer) => {
      this.output = (this.output + String(text)).slice(-4000);
    };
    child.stdout?.on("data", keep);
    child.stderr?.on("data", keep);
    for (let attempt = 0; attempt < 200; ++attempt) {
      if (child.exitCode !== null) throw new Error(`${this.program} ${words.join(" ")} ended: ${this.output}`);
      if (
        await fetch(`${this.address}api/status`).then(
          (answer) => answer.ok,
          () => false,
        )
      )
        return;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error(`no answer of ${this.program}: ${this.output}`);
  }

  async stop(): Promise<void> {
    const { child } = this;
    if (!child || child.exitCode !== null) return;
    const ended = new Promise((resolve) => child.once("exit", resolve));
    child.kill("SIGKILL");
    await ended;
  }

  dispose(): void {
    rmSync(this.logs, { recursive: true, force: true });
  }
}
