// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
import { type Wish, still } from "./wrist_motion";

export type Action = "close" | "lift" | "open" | "forget" | "gizmo" | "home" | "offer";

const motions: Record<string, [keyof Wish, number]> = {
  KeyW: ["ahead", 1],
  KeyS: ["ahead", -1],
  KeyD: ["right", 1],
  KeyA: ["right", -1],
  KeyR: ["up", 1],
  KeyF: ["up", -1],
  ArrowLeft: ["yaw", 1],
  ArrowRight: ["yaw", -1],
  ArrowUp: ["pitch", 1],
  ArrowDown: ["pitch", -1],
  KeyQ: ["roll", -1],
  KeyE: ["roll", 1],
};
const actions: Record<string, Action> = {
  KeyC: "close",
  KeyL: "lift",
  KeyO: "open",
  KeyX: "forget",
  KeyG: "gizmo",
  KeyH: "home",
  KeyT: "offer",
};

/** What is asked for by keys that are held; a quarter of the speed with Shift. */
export function wish_of_keys(held: ReadonlySet<string>): Wish {
  const wish = { ...still };
  const share = held.has("ShiftLeft") || held.has("ShiftRight") ? 0.25 : 1;
  for (const key of held) {
    const motion = motions[key];
    if (motion) wish[motion[0]] = Math.max(-1, Math.min(1, wish[motion[0]] + motion[1] * share));
  }
  return wish;
}

/** Keys of the page; those that go into a field are left alone. */
export class Keyboard {
  private readonly held = new Set<string>();
  /** Pressed since the last reading: a tap between two frames counts too. */
  private fresh: string[] = [];
  private readonly stop = new AbortController();

  constructor(on_action: (action: Action) => void, on_motion: () => void) {
    const options = { signal: this.stop.signal };
    window.addEventListener(
      "keydown",
      (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || in_field(event.target)) return;
        const action = actions[event.code];
        if (action && !event.repeat) on_action(action);
        if (!action && !motions[event.code] && !event.code.startsWith("Shift")) return;
        if (motions[event.code]) event.preventDefault();
        this.held.add(event.code);
        this.fresh.push(event.code);
        on_motion();
      },
      options,
    );
    window.addEventListener("keyup", (event) => this.held.delete(event.code), options);
    window.addEventListener("blur", () => this.held.clear(), options);
  }

  read(): Wish {
    const wish = wish_of_keys(new Set([...this.held, ...this.fresh]));
    this.fresh = [];
    return wish;
  }

  dispose(): void {
    this.stop.abort();
  }
}

function in_field(target: EventTarget | null): boolean {
  return (
    target instanceof HTMLSelectElement ||
    target instanceof HTMLTextAreaElement ||
    (target instanceof HTMLInputElement && target.type !== "checkbox")
  );
}
