//! Gradient noise in space: smooth, without direction, the same on every machine.
//!
//! Random unit-cube-edge gradients sit at whole coordinates and are blended by the quintic
//! 6s⁵ − 15s⁴ + 10s³. Values lie within about ±1 and vary over about one unit.

use glam::DVec3;

const GRADIENTS: [[f64; 3]; 16] = [
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [-1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, 1.0],
    [0.0, 1.0, -1.0],
    [0.0, -1.0, -1.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, 1.0],
    [0.0, -1.0, -1.0],
];

const PLANE_GRADIENTS: [[f64; 2]; 8] = [
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.0, 1.0],
    [0.0, -1.0],
    [0.8, 0.6],
    [-0.8, 0.6],
    [0.6, -0.8],
    [-0.6, -0.8],
];

/// Noise at `p`, with mean 0 and standard deviation about 0.3.
pub fn gradient_noise(p: DVec3, seed: u32) -> f64 {
    let cell = p.floor();
    let f = p - cell;
    let (x, y, z) = (
        cell.x as i64 as u32,
        cell.y as i64 as u32,
        cell.z as i64 as u32,
    );
    // The hash is a sum of one product per axis, so each is worked out once for eight corners.
    let hx = [x, x.wrapping_add(1)].map(|v| v.wrapping_mul(0x8da6_b343));
    let hy = [y, y.wrapping_add(1)].map(|v| v.wrapping_mul(0xd816_3841));
    let hz = [z, z.wrapping_add(1)].map(|v| v.wrapping_mul(0xcb1a_b31f));
    let s = seed.wrapping_mul(0x9e37_79b9);
    let fx = [f.x, f.x - 1.0];
    let fy = [f.y, f.y - 1.0];
    let fz = [f.z, f.z - 1.0];
    let corner = |i: usize, j: usize, k: usize| {
        let h = mix(hx[i] ^ hy[j] ^ hz[k] ^ s);
        let g = &GRADIENTS[(h & 15) as usize];
        g[0] * fx[i] + g[1] * fy[j] + g[2] * fz[k]
    };
    let w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let along_x = |j: usize, k: usize| {
        let a = corner(0, j, k);
        a + w.x * (corner(1, j, k) - a)
    };
    let along_y = |k: usize| {
        let a = along_x(0, k);
        a + w.y * (along_x(1, k) - a)
    };
    let a = along_y(0);
    a + w.z * (along_y(1) - a)
}

/// Noise over the plane at `(x, y)`: its value, of standard deviation about 0.35, and its slopes
/// along x and y.
pub fn plane_noise(x: f64, y: f64, seed: u32) -> [f64; 3] {
    let (cx, cy) = (x.floor(), y.floor());
    let (fx, fy) = (x - cx, y - cy);
    let (ix, iy) = (cx as i64 as u32, cy as i64 as u32);
    let hx = [ix, ix.wrapping_add(1)].map(|v| v.wrapping_mul(0x8da6_b343));
    let hy = [iy, iy.wrapping_add(1)].map(|v| v.wrapping_mul(0xd816_3841));
    let s = seed.wrapping_mul(0x9e37_79b9);
    let corner = |i: usize, j: usize| {
        let g = &PLANE_GRADIENTS[(mix(hx[i] ^ hy[j] ^ s) & 7) as usize];
        let value = g[0] * (fx - i as f64) + g[1] * (fy - j as f64);
        [value, g[0], g[1]]
    };
    let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
    let weight = |f: f64| f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let slope = |f: f64| 30.0 * f * f * (f * (f - 2.0) + 1.0);
    let (wx, wy) = (weight(fx), weight(fy));
    let blend = |k: usize| {
        let top = a[k] + wx * (b[k] - a[k]);
        top + wy * (c[k] + wx * (d[k] - c[k]) - top)
    };
    let twist = a[0] - b[0] - c[0] + d[0];
    [
        blend(0),
        blend(1) + slope(fx) * (b[0] - a[0] + wy * twist),
        blend(2) + slope(fy) * (c[0] - a[0] + wx * twist),
    ]
}

/// A sum of octaves of [`gradient_noise`], the coarsest with cells of size `scale`, each next half as
/// large and `gain` times as strong, brought back to a standard deviation of about 0.3.
///
/// `footprint` is the size of a pixel where `p` is: octaves with cells below two pixels fade, those
/// below one are left out, so that nothing finer than the picture can show is ever drawn, while a
/// larger picture of the same scene gets its finer octaves.
pub fn octaves(p: DVec3, scale: f64, gain: f64, footprint: f64, seed: u32) -> f64 {
    const MOST: u32 = 7;
    let (mut sum, mut power) = (0.0, 0.0);
    let (mut cell, mut strength) = (scale, 1.0);
    for octave in 0..MOST {
        let weight = strength * (cell / footprint - 1.0).clamp(0.0, 1.0);
        power += strength * strength;
        if weight > 0.0 {
            sum += weight * gradient_noise(p / cell, seed.wrapping_add(octave));
        } else {
            break;
        }
        cell *= 0.5;
        strength *= gain;
    }
    sum / power.sqrt()
}

fn mix(mut h: u32) -> u32 {
    h ^= h >> 15;
    h = h.wrapping_mul(0x2c1b_3c6d);
    h ^= h >> 12;
    h = h.wrapping_mul(0x297a_2d39);
    h ^ (h >> 15)
}
