// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { Signal } from "./signal";

export const page_names = ["plan", "interactive", "replay"] as const;
export type PageName = (typeof page_names)[number];

export interface Hash {
  page: PageName;
  token: string | undefined;
}

/** "#interactive", "#token=secret" and "#interactive&token=secret" are understood. */
export function parse_hash(hash: string): Hash {
  let page: PageName = "plan";
  let token: string | undefined;
  for (const part of hash.replace(/^#\/?/, "").split("&")) {
    const known = page_names.find((name) => name === part);
    if (known) page = known;
    if (part.startsWith("token=")) token = decode(part.slice("token=".length)) || undefined;
  }
  return { page, token };
}

function decode(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** The page that is shown, kept in the address. */
export function page_route(): Signal<PageName> {
  const page = new Signal<PageName>(parse_hash(location.hash).page);
  window.addEventListener("hashchange", () => page.set(parse_hash(location.hash).page));
  page.watch((name) => {
    if (parse_hash(location.hash).page !== name || location.hash.includes("token=") || location.hash === "") {
      history.replaceState(null, "", `#${name}`);
    }
  });
  return page;
}
