//! Halving frames and cameras.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::frames::{halved, halved_camera};
use relievo::{Camera, Grid};

#[test]
fn a_coarse_pixel_looks_where_its_four_fine_ones_do_on_average() {
    let fine = Camera::new(137.0, 41.3, 28.9).unwrap();
    let coarse = halved_camera(&fine);
    for (x, y) in [(0, 0), (7, 3), (20, 14)] {
        let (fx, fy) = (f64::from(2 * x), f64::from(2 * y));
        let four = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        let mean = four
            .map(|(i, j)| 0.25 * fine.ray(fx + i, fy + j))
            .into_iter()
            .reduce(|a, b| a + b)
            .unwrap();
        let ray = coarse.ray(f64::from(x), f64::from(y));
        assert!((ray - mean).length() < 1e-12, "{ray} for {mean}");
    }
    // Twice as coarse, the same motion covers half as many pixels.
    let motion = relievo::RigidMotion {
        translation: [0.02, 0.01, -0.03].into(),
        rotation: [0.01, -0.02, 0.005].into(),
    };
    let (u, v) = fine.displacement(&motion, 20.5, 8.5, 0.8).unwrap();
    let (cu, cv) = coarse.displacement(&motion, 10.0, 4.0, 0.8).unwrap();
    assert!((2.0 * cu - u).abs() < 1e-9 && (2.0 * cv - v).abs() < 1e-9);
}

#[test]
fn halving_drops_an_odd_row_and_column() {
    let sizes = [((40, 30), (20, 15)), ((41, 31), (20, 15)), ((2, 3), (1, 1))];
    for ((width, height), small) in sizes {
        let half = halved(&Grid::new(width, height, 7.0));
        assert_eq!((half.width(), half.height()), small);
        assert!(half.data().iter().all(|v| (v - 7.0).abs() < 1e-5));
    }
}

#[test]
fn ramps_stay_ramps() {
    let ramp = |x: f32, y: f32| 3.0 + 0.5 * x - 0.8 * y;
    for (width, height) in [(40, 30), (41, 31)] {
        let fine = Grid::from_fn(width, height, |x, y| ramp(x as f32, y as f32));
        let half = halved(&fine);
        for y in 3..half.height() - 3 {
            for x in 3..half.width() - 3 {
                let centre = ramp(2.0 * x as f32 + 0.5, 2.0 * y as f32 + 0.5);
                assert!((half[(x, y)] - centre).abs() < 1e-4);
            }
        }
    }
}

#[test]
fn what_the_coarse_grid_cannot_hold_is_smoothed_away() {
    let stripes = Grid::from_fn(40, 30, |x, _| if x % 3 == 0 { 100.0 } else { 0.0 });
    let half = halved(&stripes);
    for y in 3..12 {
        for x in 3..17 {
            // Their mean is 33⅓; without smoothing they would come back as stripes of 0 and 50.
            assert!((half[(x, y)] - 33.3).abs() < 9.0, "{}", half[(x, y)]);
        }
    }
}
