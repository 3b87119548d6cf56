/** The button that opens all there is to take away; the dialog is fetched when it is pressed. */

import { byId } from "../dom";
import { store } from "../store";

export function mountExport(): void {
  const button = byId<HTMLButtonElement>("export");
  button.addEventListener("click", async () => {
    const { openExport } = await import("./dialog");
    openExport();
  });
  store.watch(
    ({ frames }) => [frames === null],
    ({ frames }) => (button.disabled = frames === null),
  );
}
