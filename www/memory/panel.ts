/** What this device keeps, how much that is, and a way to be rid of it. */

import { announce, byId } from "../dom";
import { store } from "../store";
import { text } from "../text";
import { MOST_BYTES, sizeOf } from "./database";
import { empty } from "./remember";

export function mountKept(): void {
  const button = byId<HTMLButtonElement>("forget");
  button.addEventListener("click", async () => {
    await empty();
    announce(text.kept.forgotten);
  });
  store.watch(
    ({ memory }) => [memory],
    ({ memory }) => {
      const most = Math.round(MOST_BYTES / 2 ** 20);
      button.disabled = !memory?.length;
      if (!memory) {
        byId("kept").textContent = text.kept.never;
        return;
      }
      const size = memory.reduce((sum, session) => sum + sizeOf(session), 0) / 2 ** 20;
      byId("kept").textContent =
        memory.length === 0
          ? text.kept.nothing(most)
          : text.kept.pairs(memory.length, size.toFixed(1), most);
    },
  );
}
