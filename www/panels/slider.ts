/**
 * Where an option's value stands on a slider of whole steps, and back.
 *
 * Logarithmic where the option says so: its lowest step is the least value (often 0), the others run
 * through the decades below the greatest.
 */

import type { OptionEntry } from "../worker/protocol";

type Ranged = Extract<OptionEntry, { kind: "number" | "integer" }>;

export const STEPS = 200;
/** Decades that a logarithmic slider shows when the least value is 0. */
const DECADES = 8;

const isLogarithmic = (descriptor: Ranged) =>
  descriptor.kind === "number" && descriptor.logarithmic;

function floor({ min, max }: Ranged): number {
  return min > 0 ? min : max * 10 ** -DECADES;
}

export function toSlider(descriptor: Ranged, value: number): number {
  const { min, max } = descriptor;
  if (!isLogarithmic(descriptor)) return Math.round(((value - min) / (max - min)) * STEPS);
  const least = floor(descriptor);
  if (value < least) return 0;
  return Math.round(1 + (Math.log(value / least) / Math.log(max / least)) * (STEPS - 1));
}

export function fromSlider(descriptor: Ranged, position: number): number {
  const { min, max, kind } = descriptor;
  let value: number;
  if (!isLogarithmic(descriptor)) {
    value = min + (position / STEPS) * (max - min);
  } else if (position === 0) {
    value = min;
  } else {
    const least = floor(descriptor);
    value = least * (max / least) ** ((position - 1) / (STEPS - 1));
  }
  return kind === "integer" ? Math.round(value) : Number(value.toPrecision(3));
}
