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
    let ((x, fx), (y, fy), (z, fz)) = (split(p.x), split(p.y), split(p.z));
    let f = DVec3::new(fx, fy, fz);
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
        let g = &GRADIENTS[h as usize & 15];
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

/// Noise over the plane at `(x, y)` that repeats every `period` cells, a power of two.
pub fn plane_noise(x: f64, y: f64, period: u32, seed: u32) -> f64 {
    let ((ix, fx), (iy, fy)) = (split(x), split(y));
    let corner = |i: u32, j: u32| {
        let (cx, cy) = ((ix.wrapping_add(i)) % period, (iy.wrapping_add(j)) % period);
        let h = cx.wrapping_mul(0x8da6_b343)
            ^ cy.wrapping_mul(0xd816_3841)
            ^ seed.wrapping_mul(0x9e37_79b9);
        let g = &PLANE_GRADIENTS[(mix(h) & 7) as usize];
        g[0] * (fx - f64::from(i)) + g[1] * (fy - f64::from(j))
    };
    let weight = |f: f64| f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let row = |j: u32| {
        let a = corner(0, j);
        a + weight(fx) * (corner(1, j) - a)
    };
    let top = row(0);
    top + weight(fy) * (row(1) - top)
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
    let mut q = p / scale;
    for octave in 0..MOST {
        let weight = strength * (cell / footprint - 1.0).clamp(0.0, 1.0);
        power += strength * strength;
        if weight > 0.0 {
            sum += weight * gradient_noise(q, seed.wrapping_add(octave));
        } else {
            break;
        }
        cell *= 0.5;
        q *= 2.0;
        strength *= gain;
    }
    sum / power.sqrt()
}

/// The whole number below `v`, modulo 2³², and what `v` exceeds it by. Spelt out because `floor` is a call where the processor
/// may be old.
pub fn split(v: f64) -> (u32, f64) {
    let cut = v as i32;
    let cell = cut - i32::from(v < f64::from(cut));
    (cell as u32, v - f64::from(cell))
}

fn mix(h: u32) -> u32 {
    // The top bits of a product depend on all bits below them; one round is plenty for sixteen
    // directions.
    (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d) >> 28
}
