// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

/** One of the three pages: what stands right of the view and below it, and what it does while it is shown. */
export interface Page {
  readonly panel: HTMLElement;
  readonly charts: HTMLElement;
  /** A line over the 3-D view. */
  readonly hud: HTMLElement;
  readonly legend: readonly (readonly [string, string])[];
  enter(): void;
  leave(): void;
}
