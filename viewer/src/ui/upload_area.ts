// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { h, set_text } from "./dom";
import { drop_area } from "./parts";
import type { UploadReply } from "../wire/messages";

/** An area that takes a file to the server, and says below what became of it. */
export function upload_area(text: string, accept: string, upload: (file: File) => Promise<UploadReply>): HTMLElement {
  const note = h("p", { class: "note" });
  const take = async (file: File): Promise<void> => {
    note.className = "note";
    set_text(note, `Loading ${file.name} …`);
    try {
      const reply = await upload(file);
      set_text(note, [`Loaded ${reply.name}.`, ...reply.warnings].join(" "));
    } catch (problem) {
      note.className = "note bad";
      set_text(note, problem instanceof Error ? problem.message : String(problem));
    }
  };
  return h(
    "div",
    {},
    drop_area(text, accept, (file) => void take(file)),
    note,
  );
}
