//! Depth up to the curve: what a region's rim shares with its neighbours is not taken for its own.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::ops::Range;

use relievo::options::Preset;
use relievo::{Camera, Frame, FramePair, Grid, Options, Shape, Solver, Status};

const SIZE: (usize, usize) = (128, 112);
/// A disc in the first frame: its centre, its radius, and by how much it moves.
const DISC: ([f32; 2], f32) = ([60.0, 56.0], 30.0);
const SHIFT: [f32; 2] = [2.4, 0.7];

/// Numbers from −1 to 1 that look like noise.
fn noise(x: usize, y: usize, t: usize) -> f32 {
    ((x * 7919 + y * 104_729 + x * y * 13 + t * 7793) % 2001) as f32 / 1000.0 - 1.0
}

/// A level disc that moves sideways before a bright wall that stands still.
fn solved() -> Solver {
    let waves = |x: f32, y: f32| {
        (0.55 * x).sin() * (0.47 * y).cos()
            + (0.31 * x + 0.43 * y).sin()
            + (0.27 * x - 0.2 * y).cos()
    };
    let ([cx, cy], radius) = DISC;
    let shot = |t: usize| {
        // Four samples a pixel and way, as a sensor mixes what meets in it.
        Grid::from_fn(SIZE.0, SIZE.1, |x, y| {
            let at = |i: usize| (i as f32 + 0.5) / 4.0 - 0.5;
            let sample = |i: usize| {
                let (px, py) = (x as f32 + at(i % 4), y as f32 + at(i / 4));
                let (bx, by) = (px - t as f32 * SHIFT[0], py - t as f32 * SHIFT[1]);
                if (bx - cx).hypot(by - cy) < radius {
                    80.0 + 8.0 * waves(bx, by)
                } else {
                    150.0 + 12.0 * waves(px + 40.0, py - 17.0)
                }
            };
            (0..16).map(sample).sum::<f32>() / 16.0 + 2.0 * noise(x, y, t)
        })
    };
    let [first, second] = [0, 1].map(|t| Frame::from_grey(shot(t)).unwrap());
    let pair = FramePair::new(first, second).unwrap();
    let camera = Camera::centred(128.0, SIZE.0, SIZE.1).unwrap();
    let circle = Shape::Circle {
        x: f64::from(cx) - 4.0,
        y: f64::from(cy) + 3.0,
        r: 22.0,
    };
    let options = Options::preset(Preset::Best);
    let mut solver = Solver::new(pair, camera, &[circle], options).unwrap();
    while solver.step() == Status::Running {}
    solver
}

#[test]
fn a_level_disc_is_level_up_to_its_curve() {
    let found = solved().interpretation();
    let ([cx, cy], radius) = DISC;
    // The mean of ρ over the region is 1.
    let worst = |ring: Range<f32>| {
        let (mut worst, mut pixels) = (0.0f32, 0);
        for y in 0..SIZE.1 {
            for x in 0..SIZE.0 {
                let inward = radius - (x as f32 - cx).hypot(y as f32 - cy);
                if ring.contains(&inward) && found.labels[(x, y)] == 1 {
                    worst = worst.max((found.depth[(x, y)].recip() - 1.0).abs());
                    pixels += 1;
                }
            }
        }
        (worst, pixels)
    };
    let (at_curve, pixels) = worst(0.0..3.0);
    // The ring has 537 pixels: the curve has to be where the disc ends.
    assert!(pixels > 480, "{pixels} of the disc's outermost pixels");
    assert!(at_curve < 0.08, "{at_curve} off at the curve");
    let (inside, _) = worst(8.0..radius);
    assert!(inside < 0.04, "{inside} off inside");
}
