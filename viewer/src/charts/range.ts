// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

/** Some air above and below; a flat or an empty line gets a range too. */
export function padded_range(low: number | null, high: number | null, floor?: number): [number, number] {
  let from = Math.min(low ?? 0, floor ?? Infinity);
  let to = Math.max(high ?? 1, floor ?? -Infinity);
  if (!(to > from)) {
    from -= 0.5;
    to += 0.5;
  }
  const air = (to - from) * 0.08;
  return [from === floor ? from : from - air, to + air];
}

/** From the first to the last, and at least so far. */
export function spanned_range(low: number | null, high: number | null, span = 0): [number, number] {
  const from = low ?? 0;
  return [from, Math.max(high ?? 1, from + (span || 1e-9))];
}
