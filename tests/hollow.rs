//! Which way a surface bends as a whole.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::depth::hollow;

const W: usize = 60;
const H: usize = 48;

/// A disc around (`x0`, `y0`), cut off at the frame.
fn disc(x0: f32, y0: f32) -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| {
        f32::from((x as f32 - x0).hypot(y as f32 - y0) < 16.0)
    })
}

/// A surface that bulges around (`x0`, `y0`) like a ball, or with three faces like a block seen on edge, on a slope.
fn bulging(x0: f32, y0: f32, faces: bool, slope: f32) -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| {
        let (dx, dy) = ((x as f32 - x0) / 16.0, (y as f32 - y0) / 16.0);
        let back = if faces {
            (-dy).max(0.4 * dx + 0.2 * dy).max(-0.6 * dx + 0.2 * dy)
        } else {
            0.5 * (dx * dx + dy * dy)
        };
        1.0 - 0.1 * back + slope * (x as f32 + 0.5 * y as f32)
    })
}

#[test]
fn balls_and_blocks_bulge_and_their_mirror_images_are_hollow_wherever_they_are() {
    for (x0, y0) in [(30.0, 24.0), (8.0, 40.0), (50.0, 6.0)] {
        let region = disc(x0, y0);
        for faces in [false, true] {
            for slope in [0.0, 0.01, -0.02] {
                let surface = bulging(x0, y0, faces, slope);
                assert!(!hollow(&surface, &region), "{x0} {y0} {faces} {slope}");
                let mirrored = surface.map(|rho| 2.0 - rho);
                assert!(hollow(&mirrored, &region), "{x0} {y0} {faces} {slope}");
            }
        }
    }
}

#[test]
fn what_lies_beyond_the_region_does_not_count() {
    let region = disc(30.0, 24.0);
    let surface = bulging(30.0, 24.0, false, 0.0);
    let torn = Grid::from_fn(W, H, |x, y| {
        if region[(x, y)] > 0.0 {
            surface[(x, y)]
        } else {
            9.0
        }
    });
    assert!(!hollow(&torn, &region));
    assert!(hollow(&torn, &Grid::new(W, H, 1.0)));
}
