/** A dialog over the page: a title, what it is about, and a row of buttons; errors are said in it, since the page is out of reach. */

import { byId, icon, make } from "../dom";
import { store } from "../store";
import { text } from "../text";

export interface Sheet {
  dialog: HTMLDialogElement;
  /** Where the contents go. */
  body: HTMLElement;
  /** Where buttons go, the main one last. */
  foot: HTMLElement;
  /** A line that is read out when it changes. */
  say: (text: string) => void;
  close: () => void;
}

/** Closes the one that is open: files may be pasted meanwhile. */
let closePresent = () => {};

/** Opens an empty dialog; `closed` is called once it is gone, however that came about. */
export function openSheet(id: string, title: string, closed: () => void): Sheet {
  closePresent();
  const heading = make("h2", { id: `${id}-title` }, title);
  const close = make("button", { type: "button", class: "quiet icon-only" });
  close.append(icon("close"), make("span", { class: "visually-hidden" }, text.page.close));
  const wrong = make("p", { class: "sheet-wrong", role: "alert", hidden: true });
  const status = make("p", { class: "sheet-status", role: "status" });
  const body = make("div", { class: "sheet-body" });
  const foot = make("div", { class: "sheet-foot" });
  const head = make("header", { class: "sheet-head" }, heading, close);
  const dialog = make("dialog", { id, class: "sheet", "aria-labelledby": heading.id });
  dialog.append(head, wrong, body, status, foot);

  store.update({ message: null });
  const unwatch = store.watch(
    ({ message }) => [message],
    ({ message }) => {
      wrong.textContent = message ?? "";
      wrong.hidden = message === null;
    },
  );
  const opener = document.activeElement;
  let open = true;
  const shut = () => {
    if (!open) return;
    open = false;
    closePresent = () => {};
    dialog.close();
    dialog.remove();
    unwatch();
    closed();
    (placeOf(opener) ?? byId("overlay")).focus({ preventScroll: true });
  };
  closePresent = shut;
  close.addEventListener("click", shut);
  // By the Escape key.
  dialog.addEventListener("close", shut);
  document.body.append(dialog);
  dialog.showModal();
  return { dialog, body, foot, say: (text) => (status.textContent = text), close: shut };
}

/** Where the keyboard goes back to. */
function placeOf(opener: Element | null): HTMLElement | null {
  // A panel that was drawn anew has another button in its place.
  const again = opener?.isConnected ? opener : opener?.id && document.getElementById(opener.id);
  if (!(again instanceof HTMLElement) || again === document.body) return null;
  // One that has closed meanwhile is opened again by its own button.
  const closed = again.closest("[popover]:not(:popover-open)");
  return closed ? document.querySelector(`[popovertarget="${closed.id}"]`) : again;
}

export function button(name: string, press: () => unknown, kind = ""): HTMLButtonElement {
  const element = make("button", { type: "button", class: kind || null }, name);
  element.addEventListener("click", () => void press());
  return element;
}
