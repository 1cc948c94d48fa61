// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { Logs, Status, UploadReply } from "./messages";

export type Units = "m" | "cm" | "mm" | "in";

/** The HTTP side of the server. Failures are `Error`s whose message is the server's own sentence. */
export class Api {
  token: string | undefined;

  async status(): Promise<Status> {
    return this.json<Status>("api/status");
  }

  async logs(): Promise<Logs> {
    return this.json<Logs>("api/logs");
  }

  async log(name: string): Promise<string> {
    return (await this.fetch(`api/logs/${encodeURIComponent(name)}`)).text();
  }

  async model(kind: "hands" | "objects", name: string): Promise<ArrayBuffer> {
    return (await this.fetch(`api/${kind}/${encodeURIComponent(name)}/model.glb`)).arrayBuffer();
  }

  async plan_file(plan: string, file: string): Promise<Blob> {
    return (await this.fetch(`api/plans/${encodeURIComponent(plan)}/${encodeURIComponent(file)}`)).blob();
  }

  async upload_object(file: File, units: Units): Promise<UploadReply> {
    return this.upload("api/objects", { name: file.name, units }, file);
  }

  /** @param file an archive of a hand's folder */
  async upload_hand(file: File): Promise<UploadReply> {
    return this.upload("api/hands", { name: file.name }, file);
  }

  private async upload(path: string, query: Record<string, string>, file: File): Promise<UploadReply> {
    const answer = await this.fetch(`${path}?${new URLSearchParams(query)}`, { method: "POST", body: file });
    return (await answer.json()) as UploadReply;
  }

  private async json<T>(path: string): Promise<T> {
    return (await (await this.fetch(path)).json()) as T;
  }

  private async fetch(path: string, init: RequestInit = {}): Promise<Response> {
    const headers = this.token ? { Authorization: `Bearer ${this.token}` } : undefined;
    const answer = await fetch(path, { ...init, headers });
    if (!answer.ok) throw new Error(await failure_sentence(answer));
    return answer;
  }
}

async function failure_sentence(answer: Response): Promise<string> {
  try {
    const body: unknown = await answer.json();
    if (typeof body === "object" && body !== null && "error" in body) return String(body.error);
  } catch {
    // Not ours: a proxy or a server that stops.
  }
  return `The server answered ${answer.status} ${answer.statusText}`.trim();
}
