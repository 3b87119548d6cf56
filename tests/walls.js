// Frames that tell their focal length: three walls, one behind the other, before a camera that turns.

/** 1/Z of each wall, and the part of the first frame that it fills: left, top, right, bottom. */
const WALLS = /** @type {const} */ ([
  [1, 0.35, 0.2, 0.7, 0.6],
  [0.6, -1, -1, 0.3, 2],
  [0.3, -9, -9, 9, 9],
]);
/** How far the camera shifts and turns: what a wall at 1, and every wall, move by, in widths. */
const [SHIFT, TURN] = [0.03, 0.035];

/**
 * Brightness at a pixel of the first frame (`t` = 0) or of the second (1), 4 : 3; `focal` in widths.
 * @param {number} width
 * @param {number} focal
 * @param {0 | 1} t
 */
export function walls(width, focal, t) {
  const height = (3 * width) / 4;
  const angle = (t * TURN) / focal;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const shift = (t * SHIFT) / focal;
  /** Turns back about the y axis. @param {number} x @param {number} z */
  const back = (x, z) => [cos * x - sin * z, sin * x + cos * z];
  return (/** @type {number} */ px, /** @type {number} */ py) => {
    const row = (py - (height - 1) / 2) / (focal * width);
    const [rayX = 0, rayZ = 1] = back((px - (width - 1) / 2) / (focal * width), 1);
    const [shiftX = 0, shiftZ = 0] = back(shift, 0);
    for (const [k, [rho, left, top, right, bottom]] of WALLS.entries()) {
      const along = (1 / rho + shiftZ) / rayZ;
      const x = 0.5 + focal * rho * (along * rayX - shiftX);
      const y = 0.375 + focal * rho * along * row;
      if (x >= left && x < right && y >= top && y < bottom)
        return texture(320 * x + 500 * k, 320 * y);
    }
    return 0;
  };
}

/**
 * Detail at several scales and without a period.
 * @param {number} x
 * @param {number} y
 */
const texture = (x, y) =>
  120 +
  22 * Math.sin(0.11 * x + 0.05 * y + 2 * Math.sin(0.043 * y)) +
  22 * Math.cos(0.13 * y - 0.04 * x + 2 * Math.cos(0.037 * x)) +
  14 * Math.sin(0.5 * x - 0.37 * y + 3 * Math.sin(0.05 * x)) +
  14 * Math.cos(0.43 * y + 0.41 * x + 3 * Math.cos(0.045 * y));
