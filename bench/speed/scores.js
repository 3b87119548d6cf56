// How far a picture is from the truth, and which pass has the first usable one.

/** @typedef {{ aee: number, wrong: number }} Score mean end-point error in px, share of wrong labels */

/** A usable picture has this share of wrong labels at most, and this AEE over the final one. */
const [MOST_WRONG, MOST_AEE] = [0.03, 1.5];

/**
 * @param {{ labels: Uint8Array, u: Float32Array, v: Float32Array }} found
 * @param {{ labels: Uint8Array, flow: Float32Array }} truth flow as u, v, u, v, …
 * @returns {Score}
 */
export function score(found, truth) {
  let [wrong, sum] = [0, 0];
  const pixels = truth.labels.length;
  for (let i = 0; i < pixels; i++) {
    if (found.labels[i] !== truth.labels[i]) wrong += 1;
    const [u, v] = [
      at(found.u, i) - at(truth.flow, 2 * i),
      at(found.v, i) - at(truth.flow, 2 * i + 1),
    ];
    sum += Math.hypot(u, v);
  }
  return { aee: sum / pixels, wrong: wrong / pixels };
}

/**
 * A value; what is not known counts as none.
 * @param {Float32Array} values
 * @param {number} i
 */
function at(values, i) {
  const value = values[i] ?? 0;
  return Number.isFinite(value) ? value : 0;
}

/**
 * The first usable pass, counted from 1, or null; the final pass's score is the last.
 * @param {Score[]} scores
 */
export function firstUsable(scores) {
  const last = scores.at(-1);
  if (!last) return null;
  const pass = scores.findIndex((s) => s.wrong <= MOST_WRONG && s.aee <= MOST_AEE * last.aee);
  return pass < 0 ? null : pass + 1;
}
