// What many numbers come to; null of none.

/**
 * The value in the middle, or the mean of the two there.
 * @param {number[]} values
 */
export function median(values) {
  return quantile(values, 0.5);
}

/**
 * The value below which the share `q` of the others lies, between neighbours in proportion.
 * @param {number[]} values
 * @param {number} q
 */
export function quantile(values, q) {
  if (!values.length) return null;
  const sorted = [...values].sort((a, b) => a - b);
  const place = q * (sorted.length - 1);
  const [low = 0, high = 0] = [sorted[Math.floor(place)], sorted[Math.ceil(place)]];
  return low + (high - low) * (place % 1);
}

/**
 * Half the distance between the quartiles, as a share of the median: how much a machine wavers.
 * @param {number[]} values
 */
export function spread(values) {
  const [low, middle, high] = [0.25, 0.5, 0.75].map((q) => quantile(values, q) ?? 0);
  return middle && low !== undefined && high !== undefined ? (high - low) / 2 / middle : null;
}

/**
 * The geometric mean.
 * @param {number[]} values
 */
export function geometricMean(values) {
  if (!values.length) return null;
  return Math.exp(values.reduce((sum, value) => sum + Math.log(value), 0) / values.length);
}

/**
 * The median of a[i] / b[i]: what was measured in the same round met the same machine.
 * @param {(number | null)[]} a
 * @param {(number | null)[]} b
 */
export function medianRatio(a, b) {
  const ratios = a.map((value, i) => (value === null || !b[i] ? null : value / b[i]));
  return median(ratios.filter((ratio) => ratio !== null));
}
