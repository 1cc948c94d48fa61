// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Serves the built web app with made-up grasps: npm run mock -- [PORT] [TOKEN]
import path from "node:path";
import { fileURLToPath } from "node:url";
import { MockServer } from "./server.ts";

const app = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../../../viewer/dist");
const port = await new MockServer(app, process.argv[3]).listen(Number(process.argv[2] ?? 8090));
console.log(`http://127.0.0.1:${port}/`);
