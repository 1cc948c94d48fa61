// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

const missing = "–";

/** A figure with a fixed number of decimals; a dash where there is none. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return missing;
  const text = value.toFixed(decimals);
  return Number(text) === 0 && text.startsWith("-") ? text.slice(1) : text;
}

/** 1234567 -> "1.23 M", 45678 -> "45.7 k": three figures, to be read at a glance. */
export function short_count(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return missing;
  const steps: [number, string][] = [
    [1e9, " G"],
    [1e6, " M"],
    [1e3, " k"],
  ];
  for (const [size, suffix] of steps) {
    if (Math.abs(value) >= size * 0.9995) return three_figures(value / size) + suffix;
  }
  return Number.isInteger(value) ? String(value) : three_figures(value);
}

function three_figures(value: number): string {
  const size = Math.abs(value);
  return value.toFixed(size >= 99.95 ? 0 : size >= 9.995 ? 1 : 2);
}

/** Seconds as "12 ms", "3.4 s" or "2 min 05 s". */
export function duration(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return missing;
  if (seconds < 0.9995) return `${(seconds * 1e3).toFixed(seconds < 0.00995 ? 1 : 0)} ms`;
  if (seconds < 59.95) return `${seconds.toFixed(1)} s`;
  const whole = Math.round(seconds);
  return `${Math.floor(whole / 60)} min ${String(whole % 60).padStart(2, "0")} s`;
}

export const millimetres = (metres: number, decimals = 0): string => `${fixed(metres * 1e3, decimals)} mm`;
export const degrees = (radians: number, decimals = 0): string => `${fixed((radians * 180) / Math.PI, decimals)}°`;
