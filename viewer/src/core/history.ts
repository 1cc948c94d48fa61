// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import type { View } from "../wire/messages";

export interface Sample {
  time: number;
  offered: number | null;
  now: number | null;
  postures: number;
  candidates: number;
  latency: number | null;
}

export function sample_of(view: View, latency: number | undefined): Sample {
  const offered = view.offer ? view.solutions.find((one) => one.id === view.offer?.id)?.epsilon : undefined;
  const now = view.epsilon_now === undefined ? null : Math.max(0, view.epsilon_now);
  return {
    time: view.time,
    offered: offered ?? null,
    now,
    postures: view.rates.postures_per_second,
    candidates: view.rates.candidates_per_second,
    latency: latency === undefined ? null : latency * 1e3,
  };
}

/** What happened in the last while: at most one sample for each tick, the latencies of a tick kept at their worst. */
export class History {
  private list: Sample[] = [];

  constructor(
    private readonly span = 30,
    private readonly tick = 0.1,
  ) {}

  add(sample: Sample): void {
    const last = this.list[this.list.length - 1];
    if (last && sample.time < last.time) this.list = [];
    if (last && sample.time - last.time < this.tick && sample.time >= last.time) {
      const latency = sample.latency === null ? last.latency : Math.max(sample.latency, last.latency ?? 0);
      this.list[this.list.length - 1] = { ...sample, time: last.time, latency };
      return;
    }
    this.list.push(sample);
    const oldest = sample.time - this.span;
    while (this.list.length > 0 && this.list[0]!.time < oldest) this.list.shift();
  }

  clear(): void {
    this.list = [];
  }

  get samples(): readonly Sample[] {
    return this.list;
  }
}
