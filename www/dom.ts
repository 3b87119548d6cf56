/** The few words needed to speak to the document. */

/** The element with this id; the page's own markup is at fault when there is none. */
export function byId<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element #${id}`);
  return found as T;
}

type Attributes = Record<string, string | number | boolean | null | undefined>;

/** A new element: attributes (true = present, false or null = absent), then children. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string | null)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** A drawing from the sprite in index.html. */
export function icon(name: string): SVGSVGElement {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const use = document.createElementNS(space, "use");
  use.setAttribute("href", `#i-${name}`);
  svg.append(use);
  return svg;
}

/** A colour of the stylesheet, for canvases. */
export function themeColour(name: string): string {
  return probe(name);
}

let swatch: HTMLElement | null = null;

/** Canvases do not resolve light-dark(): let an element do it. */
function probe(name: string): string {
  if (!swatch) {
    swatch = make("span", { hidden: true });
    document.body.append(swatch);
  }
  swatch.style.color = `var(${name})`;
  return getComputedStyle(swatch).color;
}

/** Says something to those who listen rather than look. */
export function announce(text: string): void {
  byId("announcer").textContent = text;
}
