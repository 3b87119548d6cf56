/** The message bar: one sentence about what went wrong, until it is dismissed or overtaken. */

import { byId } from "../dom";
import { store } from "../store";

export function mountMessage(): void {
  const dismiss = () => store.update({ message: null });
  byId("message-close").addEventListener("click", () => {
    dismiss();
    byId("overlay").focus({ preventScroll: true });
  });
  store.watch(
    ({ message }) => [message],
    ({ message }) => {
      byId("message").hidden = message === null;
      byId("message-text").textContent = message ?? "";
    },
  );
  // What was wrong with the last pair or the last run says nothing about the next.
  store.watch(({ source }) => [source], dismiss);
  store.watch(
    ({ running }) => [running],
    ({ running }) => running && dismiss(),
  );
}
