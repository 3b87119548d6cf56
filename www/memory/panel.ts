/** What this device keeps, how much that is, and a way to be rid of it. */

import { announce, byId } from "../dom";
import { store } from "../store";
import { MOST_BYTES, sizeOf } from "./database";
import { empty } from "./remember";

export function mountKept(): void {
  const button = byId<HTMLButtonElement>("forget");
  button.addEventListener("click", async () => {
    await empty();
    announce("This device keeps nothing any more.");
  });
  store.watch(
    ({ memory }) => [memory],
    ({ memory }) => {
      const most = Math.round(MOST_BYTES / 2 ** 20);
      button.disabled = !memory?.length;
      if (!memory) {
        byId("kept").textContent =
          "This browser keeps nothing for the page: frames, curves and results are gone once it is closed.";
        return;
      }
      const pairs = memory.length === 1 ? "1 pair" : `${memory.length} pairs`;
      const size = memory.reduce((sum, session) => sum + sizeOf(session), 0) / 2 ** 20;
      byId("kept").textContent =
        memory.length === 0
          ? `Nothing is kept. Frames, curves, settings, passes and results will be, on this device only, up to ${most}\u00a0MB.`
          : `Kept on this device, and nowhere else: ${pairs} with curves, settings, passes and results, ${size.toFixed(1)} of at most ${most}\u00a0MB.`;
    },
  );
}
