// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Signal } from "./core/signal";
import { parse_hash, page_route } from "./core/route";
import { recall, remember } from "./core/session_state";
import { ModelLibrary } from "./scene/models";
import { quality_choice } from "./scene/frame_budget";
import { Stage } from "./scene/stage";
import { type BenchScene, Workbench } from "./scene/workbench";
import { Api } from "./wire/api";
import { Connection, socket_url } from "./wire/connection";
import type { Hand, Object as SceneObject, Status } from "./wire/messages";

/** What the operator chose to grasp with and to grasp. */
export interface SceneChoice {
  hand: string;
  object: string;
  scale: number;
  table: boolean;
}

/** All that the pages share. */
export class App {
  readonly page = page_route();
  readonly api = new Api();
  readonly connection: Connection;
  readonly status = new Signal<Status | undefined>(undefined);
  readonly choice = new Signal<SceneChoice | undefined>(recall<SceneChoice>("choice"));
  /** What stands in the 3-D view, once its models are there. */
  readonly scene = new Signal<BenchScene | undefined>(undefined);
  /** A sentence that asks for attention; empty: none. */
  readonly notice = new Signal<string>("");
  readonly stage: Stage;
  readonly bench: Workbench;
  readonly models = new ModelLibrary(this.api);

  constructor(view: HTMLElement, token: string | undefined) {
    this.api.token = token;
    this.connection = new Connection(socket_url(location), token);
    this.stage = new Stage(view, quality_choice(location.search));
    this.bench = new Workbench(this.stage, this.models);
    this.choice.watch((choice) => remember("choice", choice));
    this.connection.state.watch((state) => {
      if (state.kind === "online") void this.refresh();
    });
  }

  use_token(token: string): void {
    remember("token", token);
    this.api.token = token;
    this.connection.use_token(token);
  }

  /** What the server has now, and a choice that is among it. */
  async refresh(): Promise<void> {
    try {
      const status = await this.api.status();
      this.status.set(status);
      this.choice.set(sound_choice(this.choice.value, status));
    } catch (problem) {
      this.report(problem);
    }
  }

  /** Puts up a hand and an object; the log's on the replay page, else what was chosen. */
  async show_scene(choice: SceneChoice): Promise<void> {
    const hand = this.hand(choice.hand);
    const object = this.object(choice.object);
    if (!hand || !object) return;
    if (this.stage_shows(choice)) return;
    this.scene.set(undefined);
    const scene: BenchScene = { hand, object, scale: choice.scale, table: choice.table };
    try {
      if (await this.bench.set_scene(scene)) this.scene.set(scene);
    } catch (problem) {
      this.report(problem);
    }
  }

  private stage_shows(choice: SceneChoice): boolean {
    const shown = this.scene.value;
    return (
      shown?.hand.name === choice.hand &&
      shown.object.name === choice.object &&
      shown.scale === choice.scale &&
      shown.table === choice.table
    );
  }

  report(problem: unknown): void {
    this.notice.set(problem instanceof Error ? problem.message : String(problem));
  }

  hand(name: string): Hand | undefined {
    return this.status.value?.hands.find((hand) => hand.name === name);
  }

  object(name: string): SceneObject | undefined {
    return this.status.value?.objects.find((object) => object.name === name);
  }
}

/** The choice as far as the server has it; else what the server begins with. */
export function sound_choice(choice: SceneChoice | undefined, status: Status): SceneChoice | undefined {
  const pick = (names: (string | undefined)[], list: readonly { name: string }[]) =>
    names.find((wanted) => list.some((entry) => entry.name === wanted)) ?? list[0]?.name;
  const hand = pick([choice?.hand, status.default_hand, "human"], status.hands);
  const object = pick([choice?.object, status.default_object, "glass"], status.objects);
  if (hand === undefined || object === undefined) return undefined;
  const scale = choice && choice.object === object ? choice.scale : 1;
  return { hand, object, scale, table: choice?.table ?? false };
}

/** The token of the address, else of this tab. It is taken out of the address at once. */
export function first_token(): string | undefined {
  const given = parse_hash(location.hash).token;
  if (given !== undefined) remember("token", given);
  return given ?? recall<string>("token");
}
