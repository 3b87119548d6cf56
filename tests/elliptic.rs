//! The solver of depth's linear system.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::depth::Elliptic;

/// A grid with uneven weights: data at few pixels, edges over three orders of magnitude.
fn uneven(width: usize, height: usize) -> (Vec<f32>, Vec<f32>, Vec<f32>) {
    let hash = |i: usize, salt: usize| ((i * 7919 + salt * 104_729) % 1009) as f32 / 1009.0;
    let at = |i: usize| (i % width, i / width);
    let n = width * height;
    let data = (0..n).map(|i| if hash(i, 1) > 0.7 { hash(i, 2) } else { 0.0 });
    let edge = |i, salt| 10f32.powf(3.0 * hash(i, salt) - 2.0);
    let right = (0..n).map(|i| if at(i).0 + 1 < width { edge(i, 3) } else { 0.0 });
    let below = (0..n).map(|i| {
        if at(i).1 + 1 < height {
            edge(i, 4)
        } else {
            0.0
        }
    });
    (data.collect(), right.collect(), below.collect())
}

#[test]
fn recovers_known_solutions_in_every_lane() {
    let (width, height) = (61, 47);
    let (data, right, below) = uneven(width, height);
    let truth =
        |i: usize, lane: usize| ((i % width) as f32 * 0.1 * (lane as f32 + 1.0)).sin() + 2.0;
    let mut b = vec![[0.0f32; 3]; width * height];
    for i in 0..b.len() {
        for lane in 0..3 {
            let t = |j: usize| truth(j, lane);
            let mut sum = data[i] * t(i) + right[i] * (t(i) - t((i + 1).min(b.len() - 1)));
            if i + width < b.len() {
                sum += below[i] * (t(i) - t(i + width));
            }
            if i % width > 0 {
                sum += right[i - 1] * (t(i) - t(i - 1));
            }
            if i >= width {
                sum += below[i - width] * (t(i) - t(i - width));
            }
            b[i][lane] = sum;
        }
    }
    let operator = Elliptic::new(width, height, data, right, below);
    let mut x = vec![[0.0f32; 3]; b.len()];
    let iterations = operator.solve(&b, &mut x, 1e-5, 200);
    assert!(iterations < 120, "{iterations} iterations");
    for (i, x) in x.iter().enumerate() {
        for (lane, x) in x.iter().enumerate() {
            assert!((x - truth(i, lane)).abs() < 5e-3, "{x} at {i}, lane {lane}");
        }
    }
}

#[test]
fn iterations_hardly_grow_with_the_frame() {
    let iterations = |side: usize| {
        let n = side * side;
        let mut data = vec![0.0; n];
        data[n / 2] = 1.0;
        let right = (0..n).map(|i| if i % side + 1 < side { 1.0 } else { 0.0 });
        let below = (0..n).map(|i| if i / side + 1 < side { 1.0 } else { 0.0 });
        let (right, below) = (right.collect(), below.collect());
        let operator = Elliptic::new(side, side, data, right, below);
        let mut b = vec![[0.0f32; 1]; n];
        b[n / 3] = [1.0];
        let mut x = vec![[0.0f32; 1]; n];
        operator.solve(&b, &mut x, 1e-4, 1000)
    };
    let (small, large) = (iterations(32), iterations(256));
    assert!(
        large < 1000 && large <= 4 * small,
        "{small} and {large} iterations"
    );
}
