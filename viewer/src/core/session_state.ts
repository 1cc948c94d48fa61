// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

/** What a page wants to find again after a reload of the tab. Storage that is full or forbidden is no error. */
export function remember(key: string, value: unknown): void {
  try {
    sessionStorage.setItem(`eigengrasp.${key}`, JSON.stringify(value));
  } catch {
    forget(key);
  }
}

export function recall<T>(key: string): T | undefined {
  try {
    const text = sessionStorage.getItem(`eigengrasp.${key}`);
    return text === null ? undefined : (JSON.parse(text) as T);
  } catch {
    return undefined;
  }
}

export function forget(key: string): void {
  try {
    sessionStorage.removeItem(`eigengrasp.${key}`);
  } catch {
    // Without storage there is nothing to forget.
  }
}
