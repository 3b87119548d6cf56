//! Descent on Z, equation (9): its gradient, and what the two diffusivities do to an edge.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::depth::{DepthDescent, NEAREST_FARTHEST, Smoothness};
use relievo::options::Diffusion;

const BOTH: [Diffusion; 2] = [Diffusion::Anisotropic, Diffusion::Isotropic];

/// Whole numbers from −100 to 100 that look like noise.
fn noise(i: usize, salt: usize) -> f64 {
    ((i * 7919 + salt * 104_729 + i * i * 31) % 201) as f64 - 100.0
}

fn grid(width: usize, height: usize, f: impl Fn(usize) -> f64) -> Grid<f32> {
    Grid::from_fn(width, height, |x, y| f(y * width + x) as f32)
}

#[test]
fn the_gradient_of_9_is_that_of_its_energy() {
    let (width, height) = (7, 6);
    let slope = grid(width, height, |i| 0.1 * noise(i, 1));
    let offset = grid(width, height, |i| 0.05 * noise(i, 2));
    // Multiples of a power of two, so that a step is exact in single precision.
    let h = 2f32.powi(-12);
    for steepness in [1.0f64 / 8.0, 1.0, 4.0] {
        let z = grid(width, height, |i| {
            1.5 + (steepness * noise(i, 3)).round() / 1024.0
        });
        for diffusion in BOTH {
            let descent = DepthDescent {
                slope: &slope,
                offset: &offset,
                smoothness: Smoothness {
                    diffusion,
                    mu: 3.0,
                    epsilon: 0.05,
                },
            };
            let (gradient, _) = descent.gradient(&z);
            let largest = gradient.data().iter().fold(0.0f32, |m, g| m.max(g.abs()));
            for y in 0..height {
                for x in 0..width {
                    let at = |steps: f32| {
                        let mut moved = z.clone();
                        moved[(x, y)] += steps * h;
                        descent.energy(&moved)
                    };
                    let numeric =
                        (at(-2.0) - at(2.0) + 8.0 * (at(1.0) - at(-1.0))) / (12.0 * f64::from(h));
                    let found = f64::from(gradient[(x, y)]);
                    // Relative to the gradient, not to one that happens to vanish at a pixel.
                    let scale = found.abs().max(1e-2 * f64::from(largest));
                    assert!(
                        (found - numeric).abs() < 1e-5 * scale,
                        "{found} against {numeric} at ({x}, {y}), {diffusion:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn diffusivity_is_the_slope_of_g_over_r() {
    for diffusion in BOTH {
        for epsilon in [0.05, 1.0, 3.0] {
            let g = Smoothness {
                diffusion,
                mu: 7.0,
                epsilon,
            };
            assert_eq!(g.energy(0.0), 0.0);
            for r in [1e-3, 0.02, 0.3, 1.0, 8.0] {
                let h = 1e-4 * r;
                let at = |r: f64| g.energy(r * r);
                let slope = (at(r + h) - at(r - h)) / (2.0 * h);
                let found = g.diffusivity(r * r);
                assert!(
                    (found - slope / r).abs() < 1e-6 * found,
                    "{diffusion:?} at {r}"
                );
            }
        }
    }
}

#[test]
fn g_is_that_of_the_paper() {
    let g = |diffusion, epsilon, r: f64| {
        let mu = 2.0;
        Smoothness {
            diffusion,
            mu,
            epsilon,
        }
        .energy(r * r)
    };
    for r in [0.1f64, 1.0, 30.0] {
        let keeps = 2.0 * (2.0 * (1.0 + r * r).sqrt() - 2.0);
        assert!((g(Diffusion::Anisotropic, 1.0, r) - keeps).abs() < 1e-12 * keeps.max(1.0));
        assert!((g(Diffusion::Isotropic, 1.0, r) - 2.0 * r * r).abs() < 1e-12 * r * r);
        // ε is a unit for r.
        for diffusion in BOTH {
            let (a, b) = (g(diffusion, 1.0, r), g(diffusion, 0.05, 0.05 * r));
            assert!((a - b).abs() < 1e-12 * a.max(1.0));
        }
    }
}

/// Depth 1 on the left and 1.5 on the right as s·T = 20 shows it, disturbed by noise.
fn step(width: usize, height: usize) -> (Grid<f32>, Grid<f32>) {
    let slope = Grid::new(width, height, 20.0f32);
    let offset = grid(width, height, |i| {
        let z = if i % width < width / 2 { 1.0 } else { 1.5 };
        -20.0 / z + 0.02 * noise(i, 4)
    });
    (slope, offset)
}

fn descended(diffusion: Diffusion) -> Grid<f32> {
    let (slope, offset) = step(32, 12);
    let descent = DepthDescent {
        slope: &slope,
        offset: &offset,
        smoothness: Smoothness {
            diffusion,
            mu: 1.0,
            epsilon: 0.05,
        },
    };
    let mut z = Grid::new(32, 12, 1.25f32);
    descent.run(&mut z, 400);
    z
}

#[test]
fn edges_are_kept_by_11_and_blurred_by_12() {
    let column = |z: &Grid<f32>, x: usize| (0..12).map(|y| z[(x, y)]).sum::<f32>() / 12.0;
    let jump = |z: &Grid<f32>| column(z, 16) - column(z, 15);
    let rough = |z: &Grid<f32>| {
        let flat = (2..9).flat_map(|x| (0..12).map(move |y| (x, y)));
        let flat: Vec<f32> = flat.map(|at| z[at]).collect();
        let mean = flat.iter().sum::<f32>() / flat.len() as f32;
        (flat.iter().map(|z| (z - mean).powi(2)).sum::<f32>() / flat.len() as f32).sqrt()
    };
    let [keeps, blurs] = BOTH.map(descended);
    assert!(jump(&keeps) > 0.35, "(11) keeps {} of 0.5", jump(&keeps));
    assert!(jump(&blurs) < 0.2, "(12) keeps {} of 0.5", jump(&blurs));
    // Both smooth what is flat: as given, it is rough by 0.05.
    for z in [&keeps, &blurs] {
        assert!(rough(z) < 0.03, "rough by {}", rough(z));
    }
    // Far from the edge both show the depth that is there.
    for z in [&keeps, &blurs] {
        assert!((column(z, 2) - 1.0).abs() < 0.05 && (column(z, 29) - 1.5).abs() < 0.05);
    }
}

#[test]
fn no_step_raises_the_energy() {
    let (width, height) = (20, 16);
    for salt in 0..4 {
        let slope = grid(width, height, |i| 0.3 * noise(i, salt));
        let offset = grid(width, height, |i| 0.2 * noise(i, salt + 10));
        for diffusion in BOTH {
            for mu in [0.0, 1e-3, 1.0, 1e4] {
                let descent = DepthDescent {
                    slope: &slope,
                    offset: &offset,
                    smoothness: Smoothness {
                        diffusion,
                        mu,
                        epsilon: 0.05,
                    },
                };
                let mut z = grid(width, height, |i| 1.0 + 0.004 * noise(i, salt + 20));
                let mut energies = vec![descent.energy(&z)];
                for _ in 0..25 {
                    descent.run(&mut z, 1);
                    energies.push(descent.energy(&z));
                }
                assert!(energies.is_sorted_by(|a, b| b <= a), "{energies:?}");
                assert!(energies[25] < 0.99 * energies[0], "{energies:?}");
                let [nearest, farthest] = NEAREST_FARTHEST;
                let within = |z: &f32| (nearest..=farthest).contains(z);
                assert!(z.data().iter().all(within), "depth left its range");
            }
        }
    }
}

#[test]
fn depth_that_does_not_show_stays_as_it_is() {
    let none = Grid::new(20, 16, 0.0f32);
    let descent = DepthDescent {
        slope: &none,
        offset: &none,
        smoothness: Smoothness {
            diffusion: Diffusion::Anisotropic,
            mu: 1.0,
            epsilon: 0.05,
        },
    };
    let mut z = Grid::new(20, 16, 1.25f32);
    descent.run(&mut z, 20);
    assert!(z.data().iter().all(|&z| z == 1.25));
}
