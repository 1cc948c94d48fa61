// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors

/** The log of a session among those of the server, TIME-SESSION.jsonl: the newest, since names come again after a restart. */
export function own_log(logs: readonly { name: string }[], session: string | undefined): string | undefined {
  if (session === undefined || session === "") return undefined;
  const file = `${session}.jsonl`;
  return logs
    .map(({ name }) => name)
    .filter((name) => name === file || name.endsWith(`-${file}`))
    .sort()
    .at(-1);
}

/** A log that is still being written may end within a line. */
export function whole_lines(text: string): string {
  return text.slice(0, text.lastIndexOf("\n") + 1);
}
