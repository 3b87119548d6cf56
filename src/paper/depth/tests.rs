#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use crate::options::Diffusion;

const MU: f64 = 3.0;
const EPSILON: f64 = 0.05;

/// E(Z) as printed.
fn energy(diffusion: Diffusion, [a, b, z]: [&Grid<f64>; 3]) -> f64 {
    let mut sum = 0.0;
    for y in 0..z.height() {
        for x in 0..z.width() {
            let here = z[(x, y)];
            let dx = z[((x + 1).min(z.width() - 1), y)] - here;
            let dy = z[(x, (y + 1).min(z.height() - 1))] - here;
            let r2 = (dx * dx + dy * dy) / (EPSILON * EPSILON);
            let g = match diffusion {
                Diffusion::Anisotropic => 2.0 * (1.0 + r2).sqrt() - 2.0,
                Diffusion::Isotropic => r2,
            };
            sum += (a[(x, y)] / here + b[(x, y)]).powi(2) + MU * g;
        }
    }
    sum
}

#[test]
fn energy_and_gradient_are_those_of_9() {
    let (width, height) = (11, 6);
    let noise = |salt: usize| {
        Grid::from_fn(width, height, |x, y| {
            let i = y * width + x;
            ((i * 7919 + salt * 104_729 + i * i * 31) % 201) as f64 - 100.0
        })
    };
    let a = noise(1).map(|n| 0.1 * n);
    let b = noise(2).map(|n| 0.05 * n);
    for steepness in [1e-4, 1e-3, 4e-3] {
        let z = noise(3).map(|n| 1.5 + steepness * n);
        for diffusion in [Diffusion::Anisotropic, Diffusion::Isotropic] {
            let smoothness = Smoothness::new(diffusion, MU, EPSILON);
            let [sa, sb, sz] = [&a, &b, &z].map(|grid| grid.map(|v| v as f32));
            let mut gradient = Grid::new(width, height, 0.0f32);
            let found = Rows::new(width).evaluate(&smoothness, &sa, &sb, &sz, |y, g, _| {
                gradient.row_mut(y).copy_from_slice(g);
            });
            let exact = energy(diffusion, [&a, &b, &z]);
            assert!((found / exact - 1.0).abs() < 1e-5, "{found}, {exact}");
            let largest = gradient.data().iter().fold(0.0f32, |m, g| m.max(g.abs()));
            for i in 0..z.len() {
                let at = |h: f64| {
                    let mut moved = z.clone();
                    moved.data_mut()[i] += h;
                    energy(diffusion, [&a, &b, &moved])
                };
                let numeric = (at(1e-5) - at(-1e-5)) / 2e-5;
                let found = f64::from(gradient.data()[i]);
                // Relative to the gradient, not to one that happens to vanish at a pixel.
                let scale = found.abs().max(0.01 * f64::from(largest));
                assert!(
                    (found - numeric).abs() < 1e-3 * scale,
                    "{found} against {numeric} at {i}, {diffusion:?}"
                );
            }
        }
    }
}
