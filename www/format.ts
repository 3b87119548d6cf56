/** Numbers as people read them. */

const minus = (text: string) => text.replace("-", "−").replace("e-", "e−");

/** About `digits` significant digits, no exponent between 0.001 and 10 million. */
export function number(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e7) return minus(value.toExponential(Math.max(0, digits - 1)));
  if (size >= 1e4) return minus(count(Math.round(value)));
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return minus(value.toFixed(decimals));
}

/** The marks of a scale, all with as few decimals, up to four, as are true to a seventh of a step between them. */
export function scale(values: number[]): string[] {
  const steps = values.slice(1).map((value, i) => Math.abs(value - values[i]!));
  const slack = Math.min(...steps.filter((step) => step > 0)) / 7;
  if (!Number.isFinite(slack)) return values.map((value) => number(value, 2));
  const enough = (decimals: number) =>
    values.every((value) => Math.abs(Number(value.toFixed(decimals)) - value) <= slack);
  const decimals = [0, 1, 2, 3].find(enough) ?? 4;
  return values.map((value) => (value === 0 ? "0" : fixed(value, decimals)));
}

/** A fixed number of decimals, with a true minus sign. */
export function fixed(value: number, decimals: number): string {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals);
  return minus(Number(text) === 0 ? text.replace("-", "") : text);
}

/** A share between 0 and 1 in percent. */
export function percent(share: number, decimals = 1): string {
  return `${fixed(100 * share, decimals)}\u202f%`;
}

const GROUPED = new Intl.NumberFormat("en");
const COMPACT = new Intl.NumberFormat("en", { notation: "compact", maximumSignificantDigits: 3 });

/** Whole numbers in groups of three. */
export function count(value: number): string {
  return GROUPED.format(value).replaceAll(",", "\u202f");
}

/** Seconds, coarse enough not to flicker. */
export function seconds(value: number): string {
  return value < 10 ? `${fixed(value, 1)}\u00a0s` : `${fixed(value, 0)}\u00a0s`;
}

/** For axes: 1.5M. */
export function compact(value: number): string {
  return minus(COMPACT.format(value));
}
