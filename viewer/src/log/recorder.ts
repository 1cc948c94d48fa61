// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { ClientMessage, LogLine, ServerMessage } from "../wire/messages";

const longest = 200_000;

/** Keeps what goes to and comes from the server, in the form of a session log. */
export class Recorder {
  private lines: string[] = [];
  private began: number | undefined;

  constructor(private readonly now: () => number = () => performance.now() / 1e3) {}

  get running(): boolean {
    return this.began !== undefined;
  }

  get count(): number {
    return this.lines.length;
  }

  /** @param first what set the scene: a log must begin with it */
  start(first: ClientMessage): void {
    this.lines = [];
    this.began = this.now();
    this.keep({ t: 0, in: first });
  }

  sent(message: ClientMessage): void {
    if (this.began !== undefined && message.type !== "hello") this.keep({ t: this.now() - this.began, in: message });
  }

  received(message: ServerMessage): void {
    if (this.began !== undefined) this.keep({ t: this.now() - this.began, out: message });
  }

  /** Ends the recording and returns it. */
  stop(): string {
    this.began = undefined;
    return this.lines.map((line) => line + "\n").join("");
  }

  private keep(line: LogLine): void {
    if (this.lines.length < longest) this.lines.push(JSON.stringify(line));
  }
}
