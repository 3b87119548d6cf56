/**
 * The panel beside the stage: three tabs, of which one is open. Arrow keys, Home and End go from tab to tab.
 *
 * On a narrow screen the panel is a sheet over the stage: a tab opens it, and the same tab, Escape or a press on the
 * stage closes it again. Then no tab is the chosen one.
 */

import { byId } from "../dom";

export type Tab = "result" | "settings" | "learn";

const TABS: Tab[] = ["result", "settings", "learn"];
/** The same as in `layout.css`. */
const NARROW = matchMedia("(max-width: 559px), (max-width: 799px) and (min-height: 561px)");

const tabOf = (name: Tab) => byId<HTMLButtonElement>(`tab-${name}`);

let open: Tab | null = null;
/** Where the keyboard comes in when no tab is open. */
let last: Tab = "result";

export function mountTabs(): void {
  for (const name of TABS) {
    tabOf(name).addEventListener("click", () =>
      show(NARROW.matches && open === name ? null : name),
    );
  }
  byId("tabs").addEventListener("keydown", (event) => {
    const here = TABS.findIndex((name) => tabOf(name) === document.activeElement);
    const next = stepFrom(here, event.key);
    if (here < 0 || next === null) return;
    event.preventDefault();
    last = TABS[next]!;
    show(NARROW.matches && open === null ? null : last);
    tabOf(last).focus();
  });
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || event.defaultPrevented || !NARROW.matches || !open) return;
    const within = byId(`panel-${open}`).contains(document.activeElement);
    if (within) tabOf(open).focus();
    show(null);
  });
  byId("stage").addEventListener("pointerdown", () => NARROW.matches && show(null));
  NARROW.addEventListener("change", () => show(NARROW.matches ? null : last));
  // A link to a place within a panel.
  addEventListener("hashchange", follow);
  show(NARROW.matches ? null : "result");
  follow();
}

/** Opens a tab, wherever the keyboard is. */
export function openTab(name: Tab): void {
  show(name);
}

function follow(): void {
  const place = document.getElementById(location.hash.slice(1));
  const panel = place?.closest("[role=tabpanel]");
  const name = TABS.find((name) => panel?.id === `panel-${name}`);
  if (!place || !name) return;
  show(name);
  place.scrollIntoView();
}

function stepFrom(here: number, key: string): number | null {
  switch (key) {
    case "ArrowRight":
      return (here + 1) % TABS.length;
    case "ArrowLeft":
      return (here + TABS.length - 1) % TABS.length;
    case "Home":
      return 0;
    case "End":
      return TABS.length - 1;
    default:
      return null;
  }
}

function show(name: Tab | null): void {
  open = name;
  last = name ?? last;
  for (const one of TABS) {
    tabOf(one).ariaSelected = String(one === name);
    tabOf(one).tabIndex = one === last ? 0 : -1;
    byId(`panel-${one}`).hidden = one !== name;
  }
  document.body.dataset["sheet"] = name ?? "";
}
