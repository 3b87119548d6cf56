//! Step 2, descent on Z, equation (9): it never climbs, and what the two diffusivities do to an edge.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::interpretation::NEAREST_FARTHEST;
use relievo::options::Diffusion;
use relievo::paper::{DepthDescent, Smoothness};

const BOTH: [Diffusion; 2] = [Diffusion::Anisotropic, Diffusion::Isotropic];

/// Whole numbers from −100 to 100 that look like noise.
fn noise(i: usize, salt: usize) -> f64 {
    ((i * 7919 + salt * 104_729 + i * i * 31) % 201) as f64 - 100.0
}

fn grid(width: usize, height: usize, f: impl Fn(usize) -> f64) -> Grid<f32> {
    Grid::from_fn(width, height, |x, y| f(y * width + x) as f32)
}

/// g(r) of (11) or (12), and g'(r)/r.
fn g(diffusion: Diffusion, r: f64) -> (f64, f64) {
    let e = (1.0 + r * r).sqrt();
    match diffusion {
        Diffusion::Anisotropic => (2.0 * e - 2.0, 2.0 / e),
        Diffusion::Isotropic => (r * r, 2.0),
    }
}

#[test]
fn g_and_its_diffusivity_are_those_of_the_paper() {
    let mu = 7.0;
    for diffusion in BOTH {
        for epsilon in [0.05, 1.0, 3.0] {
            let smoothness = Smoothness::new(diffusion, mu, epsilon);
            assert_eq!(smoothness.at(0.0).0, 0.0);
            for r in [0.03, 0.1, 1.0, 8.0, 300.0] {
                let found = smoothness.at((r * r * epsilon * epsilon) as f32);
                let (value, diffusivity) = g(diffusion, r);
                let near = |found: f32, exact: f64| (f64::from(found) / exact - 1.0).abs() < 1e-5;
                assert!(near(found.0, mu * value), "{diffusion:?} at {r}");
                assert!(near(found.1, mu * diffusivity / epsilon.powi(2)));
            }
        }
    }
}

/// Descends from `z` by `steps` steps with ε = 0.05.
fn descend(
    [slope, offset]: [&Grid<f32>; 2],
    (diffusion, mu): (Diffusion, f64),
    z: &mut Grid<f32>,
    steps: usize,
) {
    let mut descent = DepthDescent::new(z.width(), z.height());
    descent.slope = slope.clone();
    descent.offset = offset.clone();
    descent.run(&Smoothness::new(diffusion, mu, 0.05), z, steps);
}

/// E(Z) as printed, for the same.
fn energy(
    [slope, offset]: [&Grid<f32>; 2],
    (diffusion, mu): (Diffusion, f64),
    z: &Grid<f32>,
) -> f64 {
    let value = |at| f64::from(z[at]);
    let mut sum = 0.0;
    for y in 0..z.height() {
        for x in 0..z.width() {
            let here = value((x, y));
            let dx = value(((x + 1).min(z.width() - 1), y)) - here;
            let dy = value((x, (y + 1).min(z.height() - 1))) - here;
            let psi = f64::from(slope[(x, y)]) / here + f64::from(offset[(x, y)]);
            sum += psi * psi + mu * g(diffusion, dx.hypot(dy) / 0.05).0;
        }
    }
    sum
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
    let mut z = Grid::new(32, 12, 1.25f32);
    descend([&slope, &offset], (diffusion, 1.0), &mut z, 400);
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
                let mut z = grid(width, height, |i| 1.0 + 0.004 * noise(i, salt + 20));
                let mut energies = vec![energy([&slope, &offset], (diffusion, mu), &z)];
                for _ in 0..25 {
                    descend([&slope, &offset], (diffusion, mu), &mut z, 1);
                    energies.push(energy([&slope, &offset], (diffusion, mu), &z));
                }
                let falls = energies.is_sorted_by(|a, b| *b <= (1.0 + 1e-6) * a);
                assert!(falls, "{energies:?}");
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
    let mut z = Grid::new(20, 16, 1.25f32);
    descend([&none, &none], (Diffusion::Anisotropic, 1.0), &mut z, 20);
    assert!(z.data().iter().all(|&z| z == 1.25));
}
