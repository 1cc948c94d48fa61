// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { createServer, type IncomingMessage, type Server, type ServerResponse } from "node:http";
import { existsSync, readFileSync, statSync } from "node:fs";
import path from "node:path";
import { type WebSocket, WebSocketServer } from "ws";
import { OnlineJob } from "./online_job.ts";
import { PlanJob } from "./plan_job.ts";
import { World } from "./world.ts";
import { parse_obj } from "./mesh.ts";
import type { ClientMessage, ServerMessage, Status } from "../../../viewer/src/wire/messages.ts";

const limits = { message_bytes: 65536, messages_per_second: 500, upload_bytes: 64 << 20, uploads: 16 };
const types: Record<string, string> = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
};

/** Speaks the wire protocol with made-up grasps, so that the web app can be tried without the planner. */
export class MockServer {
  private readonly world = new World();
  private readonly server: Server;
  private readonly sockets = new WebSocketServer({ noServer: true });
  private readonly log: string[] = [];
  private readonly began = performance.now();
  private newest: OnlineJob | undefined;
  private plans = 0;
  private sessions = 0;

  constructor(
    private readonly app: string,
    private readonly token?: string,
  ) {
    this.server = createServer((request, answer) => void this.answer(request, answer));
    this.server.on("upgrade", (request, socket, head) => {
      this.sockets.handleUpgrade(request, socket, head, (client) => this.serve(client));
    });
  }

  listen(port: number): Promise<number> {
    return new Promise((resolve) =>
      this.server.listen(port, "127.0.0.1", () => {
        const address = this.server.address();
        resolve(typeof address === "object" && address ? address.port : port);
      }),
    );
  }

  close(): Promise<void> {
    for (const client of this.sockets.clients) client.terminate();
    this.server.closeAllConnections();
    return new Promise((resolve) => this.server.close(() => resolve()));
  }

  private async answer(request: IncomingMessage, answer: ServerResponse): Promise<void> {
    const url = new URL(request.url ?? "/", "http://localhost");
    const allowed = !this.token || request.headers.authorization === `Bearer ${this.token}`;
    const json = (code: number, value: unknown) =>
      answer.writeHead(code, { "Content-Type": "application/json" }).end(JSON.stringify(value));
    if (url.pathname === "/api/status") return void json(200, this.status(allowed));
    if (url.pathname.startsWith("/api/") && !allowed) return void json(401, { error: "a token is needed" });
    const model = /^\/api\/(hands|objects)\/([^/]+)\/model\.glb$/.exec(url.pathname);
    const glb = model && this.world.model(model[1]!, decodeURIComponent(model[2]!));
    if (glb) return void answer.writeHead(200, { "Content-Type": "model/gltf-binary" }).end(glb);
    if (url.pathname === "/api/objects" && request.method === "POST") {
      return void (await this.upload(url, request).then(
        (reply) => json(200, reply),
        (problem: Error) => json(400, { error: problem.message }),
      ));
    }
    if (url.pathname === "/api/hands" && request.method === "POST") {
      return void (await this.upload_hand(request).then(
        (reply) => json(200, reply),
        (problem: Error) => json(400, { error: problem.message }),
      ));
    }
    if (/^\/api\/plans\/plan-\d+\/(grasps\.json|grasps\.csv|grasp-\d+\.glb)$/.test(url.pathname)) {
      return void answer
        .writeHead(200, { "Content-Type": "application/octet-stream" })
        .end(url.pathname.endsWith(".glb") ? this.world.model("objects", "glass") : "{}");
    }
    if (url.pathname === "/api/logs")
      return void json(200, { logs: [{ name: "session-1.jsonl", bytes: this.log.join("\n").length }] });
    if (url.pathname === "/api/logs/session-1.jsonl") return void answer.writeHead(200).end(this.log.join("\n"));
    const file = path.join(this.app, url.pathname === "/" ? "index.html" : path.normalize(url.pathname));
    if (!url.pathname.startsWith("/api") && existsSync(file) && statSync(file).isFile()) {
      return void answer
        .writeHead(200, { "Content-Type": types[path.extname(file)] ?? "application/octet-stream" })
        .end(readFileSync(file));
    }
    json(404, { error: `there is nothing at ${url.pathname}` });
  }

  private status(allowed: boolean): Status {
    return {
      program: "eigengrasp",
      version: "mock",
      protocol: 1,
      token_required: this.token !== undefined,
      limits,
      logs: true,
      hands: allowed ? [...this.world.hands.values()].map((hand) => hand.describe()) : [],
      objects: allowed ? this.world.describe_objects() : [],
      default_hand: "human",
      default_object: "glass",
    };
  }

  private async upload(url: URL, request: IncomingMessage): Promise<{ name: string; warnings: string[] }> {
    const body: Buffer[] = [];
    for await (const part of request) body.push(part as Buffer);
    const file = url.searchParams.get("name") ?? "part.obj";
    if (!file.endsWith(".obj"))
      throw new Error(`cannot read '${file}': a mesh file was expected, such as .obj, .stl or .ply`);
    const scale = { m: 1, cm: 0.01, mm: 0.001, in: 0.0254 }[url.searchParams.get("units") ?? "m"] ?? 1;
    const name = file.replace(/\.obj$/, "");
    this.world.objects.set(name, { surface: parse_obj(Buffer.concat(body).toString(), scale), uploaded: true });
    return { name, warnings: [] };
  }

  private async upload_hand(request: IncomingMessage): Promise<{ name: string; warnings: string[] }> {
    const body: Buffer[] = [];
    for await (const part of request) body.push(part as Buffer);
    return { name: this.world.add_hand(Buffer.concat(body)), warnings: [] };
  }

  private serve(client: WebSocket): void {
    const session = `session-${++this.sessions}`;
    let plan: PlanJob | undefined;
    let online: OnlineJob | undefined;
    let tracker = false;
    const keep = (line: object) =>
      this.log.length < 20000 && this.log.push(JSON.stringify({ t: (performance.now() - this.began) / 1e3, ...line }));
    const send = (message: ServerMessage) => {
      keep({ out: message });
      if (client.readyState === client.OPEN) client.send(JSON.stringify(message));
    };
    client.on("close", () => {
      plan?.stop();
      online?.stop();
    });
    client.on("message", (data) => {
      const message = JSON.parse(String(data)) as ClientMessage;
      keep({ in: message });
      if (message.type === "hello") {
        if (this.token && message.token !== this.token) {
          send({ type: "error", code: "not_allowed", message: "this server asks for a token", of: "hello" });
          return client.close(1008);
        }
        tracker = message.role === "tracker";
        send({
          type: "welcome",
          program: "eigengrasp",
          version: "mock",
          protocol: 1,
          role: message.role,
          session,
          limits,
        });
      } else if (message.type === "plan.start") {
        plan?.stop();
        plan = new PlanJob(`plan-${++this.plans}`, this.world, message, send);
      } else if (message.type === "plan.stop") plan?.finish(true);
      else if (message.type === "online.start") {
        online?.stop();
        online = new OnlineJob(session, this.world, message, send);
        this.newest = online;
      } else if (message.type === "online.stop") {
        online?.stop();
        online = undefined;
        send({ type: "online.stopped", session });
      } else (tracker ? this.newest : online)?.handle(message);
    });
  }
}
