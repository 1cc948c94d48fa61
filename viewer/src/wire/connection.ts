// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Signal, Topic } from "../core/signal";
import { reconnect_delay } from "./backoff";
import type { ClientMessage, ServerMessage, Welcome } from "./messages";
import { parse_server_message } from "./parse";

export const protocol_version = 1;

export type LinkState =
  | { kind: "connecting"; attempt: number }
  | { kind: "online"; welcome: Welcome }
  | { kind: "waiting"; attempt: number; retry_at: number }
  | { kind: "token" }
  | { kind: "incompatible"; server: number };

/** The WebSocket to the server: says hello, hands messages on, and comes back by itself when the link breaks. */
export class Connection {
  readonly state = new Signal<LinkState>({ kind: "connecting", attempt: 0 });
  readonly messages = new Topic<ServerMessage>();
  private socket: WebSocket | undefined;
  private timer: number | undefined;
  private attempt = 0;

  constructor(
    private readonly url: string,
    private token: string | undefined,
  ) {}

  open(): void {
    window.clearTimeout(this.timer);
    this.socket?.close();
    this.state.set({ kind: "connecting", attempt: this.attempt });
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.onopen = () => socket.send(JSON.stringify(this.hello()));
    socket.onmessage = (event: MessageEvent<unknown>) => {
      if (socket === this.socket && typeof event.data === "string") this.receive(event.data);
    };
    socket.onclose = () => {
      if (socket === this.socket) this.lost();
    };
  }

  use_token(token: string): void {
    this.token = token;
    this.attempt = 0;
    this.open();
  }

  /** Tells whether the message went out; nothing is kept for later, since a session ends with its connection. */
  send(message: ClientMessage): boolean {
    if (this.state.value.kind !== "online" || this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** Bytes that wait in the browser: high where the network is slower than what is sent. */
  get backlog(): number {
    return this.socket?.bufferedAmount ?? 0;
  }

  private hello(): ClientMessage {
    return { type: "hello", protocol: protocol_version, role: "app", ...(this.token ? { token: this.token } : {}) };
  }

  private receive(text: string): void {
    const message = parse_server_message(text);
    if (!message) return;
    if (message.type === "welcome") {
      this.attempt = 0;
      this.state.set(
        message.protocol === protocol_version
          ? { kind: "online", welcome: message }
          : { kind: "incompatible", server: message.protocol },
      );
    } else if (message.type === "error" && message.code === "not_allowed" && this.state.value.kind === "connecting") {
      this.state.set({ kind: "token" });
    }
    this.messages.emit(message);
  }

  private lost(): void {
    this.socket = undefined;
    if (this.state.value.kind === "token" || this.state.value.kind === "incompatible") return;
    const delay = reconnect_delay(this.attempt, Math.random());
    this.state.set({ kind: "waiting", attempt: this.attempt, retry_at: performance.now() + delay * 1e3 });
    this.attempt += 1;
    this.timer = window.setTimeout(() => this.open(), delay * 1e3);
  }
}

export function socket_url(place: Location): string {
  const url = new URL("ws", place.href.split("#")[0]);
  url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  return url.href;
}
