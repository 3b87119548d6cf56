//! Horn–Schunck against motions that are known.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::horn_schunck::solve;
use relievo::{Frame, FramePair, Grid};

/// A smooth texture, shifted by `(u, v)` pixels.
fn texture(width: usize, height: usize, u: f32, v: f32) -> Frame {
    let grey = Grid::from_fn(width, height, |x, y| {
        let (x, y) = (x as f32 - u, y as f32 - v);
        128.0 + 40.0 * (0.31 * x + 0.12 * y).sin() + 40.0 * (0.09 * x - 0.27 * y).cos()
    });
    Frame::from_grey(grey).unwrap()
}

#[test]
fn a_translation_is_found_away_from_the_border() {
    for (u, v) in [(0.6, -0.4), (-0.3, 0.0), (0.0, 0.8)] {
        let pair = FramePair::new(texture(64, 48, 0.0, 0.0), texture(64, 48, u, v)).unwrap();
        let flow = solve(&pair, 5.0, 300);
        let mut sum = 0.0;
        for y in 8..40 {
            for x in 8..56 {
                let error = (flow.u[(x, y)] - u).hypot(flow.v[(x, y)] - v);
                assert!(error < 0.1, "off by {error} px at ({x}, {y})");
                sum += error;
            }
        }
        assert!(sum / 1536.0 < 0.03, "AEE for ({u}, {v}): {}", sum / 1536.0);
    }
}

#[test]
fn it_starts_from_no_motion_and_each_sweep_counts() {
    let pair = FramePair::new(texture(32, 32, 0.0, 0.0), texture(32, 32, 0.5, 0.0)).unwrap();
    assert!(solve(&pair, 10.0, 0).u.data().iter().all(|&u| u == 0.0));
    let mean = |sweeps| solve(&pair, 10.0, sweeps).u.data().iter().sum::<f32>() / 1024.0;
    let (few, many) = (mean(2), mean(200));
    assert!(few > 0.0 && few < many && many < 0.55, "{few} {many}");
}

#[test]
fn no_weight_and_no_contrast_stay_finite() {
    let mut grey = Grid::new(16, 16, 100.0);
    grey[(8, 8)] = 200.0;
    let first = Frame::from_grey(grey.clone()).unwrap();
    grey[(8, 8)] = 190.0;
    let pair = FramePair::new(first, Frame::from_grey(grey).unwrap()).unwrap();
    let flow = solve(&pair, 0.0, 20);
    assert!(
        flow.u
            .data()
            .iter()
            .chain(flow.v.data())
            .all(|w| w.is_finite())
    );
}
