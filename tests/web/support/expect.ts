// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

export function expect(holds: boolean, what: string): asserts holds {
  if (!holds) throw new Error(what);
}

export function expect_near(found: number, wanted: number, within: number, what: string): void {
  if (!(Math.abs(found - wanted) <= within)) throw new Error(`${what}: ${found} instead of ${wanted} ± ${within}`);
}

/** Asks again and again until something holds. */
export async function eventually(ask: () => Promise<boolean> | boolean, what: string, seconds = 20): Promise<void> {
  const end = performance.now() + seconds * 1e3;
  while (performance.now() < end) {
    if (await ask()) return;
    await new Promise((resolve) => setTimeout(resolve, 60));
  }
  throw new Error(`not within ${seconds} s: ${what}`);
}
