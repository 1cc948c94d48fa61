// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

const first = 0.5;
const growth = 1.7;
const longest = 8;

/**
 * How long to wait before attempt number n (from 0) to connect again [s]: longer each time, and spread by up to a
 * quarter, so that many pages do not come back at the same moment.
 * @param spread in [0, 1)
 */
export function reconnect_delay(attempt: number, spread: number): number {
  const plain = Math.min(longest, first * growth ** Math.max(0, attempt));
  return plain * (0.75 + 0.25 * spread);
}
