/** Light or dark: as the system has it, until the button says otherwise. */

import { byId } from "../dom";

const KEY = "relievo-theme";
const system = matchMedia("(prefers-color-scheme: dark)");

/** Told after the colours have changed; canvases must be painted anew. */
export function mountTheme(changed: () => void): void {
  const button = byId<HTMLButtonElement>("theme");
  const show = () => {
    const chosen = remembered();
    if (chosen) document.documentElement.dataset["theme"] = chosen;
    else delete document.documentElement.dataset["theme"];
    button.setAttribute("aria-pressed", String(isDark()));
    changed();
  };
  button.addEventListener("click", () => {
    remember(isDark() ? "light" : "dark");
    show();
  });
  system.addEventListener("change", show);
  show();
}

const isDark = () => (remembered() ?? (system.matches ? "dark" : "light")) === "dark";

/** Storage may be forbidden; then the choice lasts as long as the page. */
let fallback: string | null = null;

function remembered(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return fallback;
  }
}

function remember(theme: string): void {
  fallback = theme;
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Kept in `fallback`.
  }
}
