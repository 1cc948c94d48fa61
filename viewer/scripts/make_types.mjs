// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Makes src/wire/messages.ts from the wire schema. With --print the text goes to standard output instead.
import { readFileSync, writeFileSync } from "node:fs";
import { compile } from "json-schema-to-typescript";

const schema_file = new URL("../../schema/wire.schema.json", import.meta.url);
const types_file = new URL("../src/wire/messages.ts", import.meta.url);
const header = [
  "// SPDX-License-Identifier: Apache-2.0",
  "// SPDX-FileCopyrightText: The eigengrasp authors",
  "// Made by `npm run types` from schema/wire.schema.json. Change that file instead of this one.",
  "",
].join("\n");

/** The compiler merges a description beside a $ref into the wrong type, so such neighbours are left out. */
function plain_references(node) {
  if (Array.isArray(node)) return node.map(plain_references);
  if (node === null || typeof node !== "object") return node;
  if (typeof node.$ref === "string") return { $ref: node.$ref };
  return Object.fromEntries(Object.entries(node).map(([key, value]) => [key, plain_references(value)]));
}

export async function make_types() {
  const { $defs, title, description } = plain_references(JSON.parse(readFileSync(schema_file, "utf8")));
  const text = await compile(
    { title: "Wire", description: `${title}. ${description}`, type: "object", $defs },
    "Wire",
    {
      additionalProperties: false,
      bannerComment: header,
      unreachableDefinitions: true,
      maxItems: 7,
      style: { printWidth: 110 },
    },
  );
  return text
    .replace(/^ \* (via the `definition`|This interface was referenced by|@m(in|ax)Items).*\n/gm, "")
    .replace(/^( +\*\n)+(?= +\*\/)/gm, "")
    .replace(/^\/\*\*\n( \*\n)* \*\/\n/gm, "");
}

if (process.argv[1] === new URL(import.meta.url).pathname) {
  const text = await make_types();
  if (process.argv.includes("--print")) process.stdout.write(text);
  else writeFileSync(types_file, text);
}
