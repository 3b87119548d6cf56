// Frames that tell their focal length: three walls, one behind the other, before a camera that turns.

/** 1/Z of each wall, and the part of the first frame that it fills: left, top, right, bottom. */
const WALLS = /** @type {const} */ ([
  [1, 0.35, 0.2, 0.7, 0.6],
  [0.6, -1, -1, 0.3, 2],
  [0.3, -9, -9, 9, 9],
]);
/** What a wall at 1 moves by to the right, and what every wall does to the right and down, in widths. */
const [SHIFT, RIGHT, DOWN] = [0.03, 0.1, 0.05];

/**
 * Brightness at a pixel of the first frame (`t` = 0) or of the second (1), 4 : 3; `focal` in widths.
 * @param {number} width
 * @param {number} focal
 * @param {0 | 1} t
 */
export function walls(width, focal, t) {
  const [cx, cy] = [(width - 1) / 2, (0.75 * width - 1) / 2];
  /** What the camera saw in a direction before it turned. @param {number[]} ray */
  const back = ([x = 0, y = 0, z = 0]) => {
    const [right, down] = [(t * RIGHT) / focal, (t * DOWN) / focal];
    const [py, pz] = [
      Math.cos(down) * y - Math.sin(down) * z,
      Math.sin(down) * y + Math.cos(down) * z,
    ];
    return [
      Math.cos(right) * x - Math.sin(right) * pz,
      py,
      Math.sin(right) * x + Math.cos(right) * pz,
    ];
  };
  const [shiftX = 0, shiftY = 0, shiftZ = 0] = back([(t * SHIFT) / focal, 0, 0]);
  return (/** @type {number} */ px, /** @type {number} */ py) => {
    const ray = [(px - cx) / (focal * width), (py - cy) / (focal * width), 1];
    const [rayX = 0, rayY = 0, rayZ = 1] = back(ray);
    for (const [k, [rho, left, top, right, bottom]] of WALLS.entries()) {
      const along = (1 / rho + shiftZ) / rayZ;
      const x = 0.5 + focal * rho * (along * rayX - shiftX);
      const y = 0.375 + focal * rho * (along * rayY - shiftY);
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
