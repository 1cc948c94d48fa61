// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

/** The clock of the wrist poses that this page sends, and how long each takes until a view shows it. */
export class SenderClock {
  private sent: number[] = [];
  private shown = -Infinity;

  /** @param now seconds of any steady clock */
  constructor(private readonly now: () => number = () => performance.now() / 1e3) {}

  /** A time for the next pose, later than all before it. */
  stamp(): number {
    const last = this.sent[this.sent.length - 1] ?? -Infinity;
    const time = Math.max(this.now(), last + 1e-6);
    this.sent = [...this.sent.slice(-599), time];
    return time;
  }

  is_ours(time: number): boolean {
    return this.sent.some((one) => Math.abs(one - time) < 5e-7);
  }

  /** Seconds from sending a pose of ours to now, when the first view that shows it arrives; none otherwise. */
  latency_of(time: number | undefined): number | undefined {
    if (time === undefined || time <= this.shown || !this.is_ours(time)) return undefined;
    this.shown = time;
    return this.now() - time;
  }
}

/** Median and 99th percentile of the newest values. */
export class Spread {
  private values: number[] = [];

  constructor(private readonly most = 300) {}

  add(value: number): void {
    this.values = [...this.values.slice(-(this.most - 1)), value];
  }

  quantile(share: number): number | undefined {
    if (this.values.length === 0) return undefined;
    const sorted = [...this.values].sort((a, b) => a - b);
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
  }
}
