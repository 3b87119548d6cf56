/**
 * The light of the relief, in the hand.
 *
 * A handle stands where the light comes from: the place on a disc about the middle is the direction's own x and y, its
 * rim is grazing light. It is dragged, or moved by the arrow keys; with Shift the pointer takes the light anywhere.
 */

import { make } from "../dom";
import { text } from "../text";

/** What the light shines on. */
interface Lit {
  /** Whether a pointer that came down there is on it. */
  has(target: EventTarget | null): boolean;
  /** Where light comes from: x to the right, y up, z towards the eye; of length 1. */
  lamp: [number, number, number];
}

export interface Lamp {
  /** Puts the handle where the light is now. */
  follow(): void;
  /** Whether a key moved the light. */
  key(name: string): boolean;
}

/** The disc's radius as a share of the shorter side. */
const DISC = 0.46;
/** Least z: light from the very side shows nothing. */
const LEAST = 0.12;
/** What an arrow key moves, as a share of the disc. */
const STEP = 0.08;

const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-STEP, 0],
  ArrowRight: [STEP, 0],
  ArrowUp: [0, STEP],
  ArrowDown: [0, -STEP],
};

export function mountLamp(place: HTMLElement, lit: Lit): Lamp {
  const handle = make("button", { type: "button", class: "lamp" });
  handle.innerHTML =
    '<svg class="icon" aria-hidden="true" viewBox="0 0 24 24"><circle cx="12" cy="12" r="4.5" /><path d="M12 2v3M12 19v3M2 12h3M19 12h3M4.900 4.900l2.200 2.200M16.900 16.900l2.200 2.200M4.900 19.100l2.200-2.200M16.900 7.100l2.200-2.200" /></svg>';
  place.append(handle);

  const disc = () => {
    const { left, top, width, height } = place.getBoundingClientRect();
    return { x: left + width / 2, y: top + height / 2, r: DISC * Math.min(width, height) };
  };
  const shine = (x: number, y: number) => {
    const far = Math.hypot(x, y);
    const most = Math.sqrt(1 - LEAST ** 2);
    const [a, b] = far > most ? [(x / far) * most, (y / far) * most] : [x, y];
    lit.lamp = [a, b, Math.sqrt(1 - a * a - b * b)];
  };
  const toPointer = ({ clientX, clientY }: PointerEvent) => {
    const { x, y, r } = disc();
    shine((clientX - x) / r, (y - clientY) / r);
  };
  const follow = () => {
    const [x, y, z] = lit.lamp;
    const { r } = disc();
    handle.style.transform = `translate(-50%, -50%) translate(${x * r}px, ${-y * r}px)`;
    handle.classList.toggle("behind", z < 0);
    handle.ariaLabel = text.relief.light(where(x, y));
  };
  const key = (name: string) => {
    const arrow = ARROWS[name];
    if (!arrow) return false;
    const [x, y] = lit.lamp;
    shine(x + arrow[0], y + arrow[1]);
    return true;
  };

  handle.addEventListener("keydown", (event) => {
    if (key(event.key)) event.preventDefault();
  });
  let held = false;
  const take = (event: PointerEvent, on: HTMLElement) => {
    event.preventDefault();
    event.stopPropagation();
    held = true;
    on.setPointerCapture(event.pointerId);
    toPointer(event);
  };
  handle.addEventListener("pointerdown", (event) => {
    handle.focus({ preventScroll: true });
    take(event, handle);
  });
  // Before the controls of the eye hear of it.
  place.addEventListener(
    "pointerdown",
    (event) => {
      if (event.shiftKey && lit.has(event.target)) take(event, place);
    },
    { capture: true },
  );
  place.addEventListener("pointermove", (event) => held && toPointer(event));
  for (const end of ["pointerup", "pointercancel"]) {
    place.addEventListener(end, () => (held = false));
  }
  return { follow, key };
}

function where(x: number, y: number): string {
  if (Math.hypot(x, y) < 0.25) return text.relief.from(0, 0);
  const side = (value: number) => (Math.abs(value) > 0.2 ? Math.sign(value) : 0);
  return text.relief.from(side(x), side(y));
}
