//! Curves and focal lengths that are found rather than given.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::init::{Verdict, displacement, focal_length};
use relievo::scene::{self, Sequence};
use relievo::solver::find_curves;
use relievo::{Camera, Frame, FramePair, Grid, Shape};

const W: usize = 160;
const H: usize = 120;

fn pair(frames: [Frame; 2]) -> FramePair {
    let [first, second] = frames;
    FramePair::new(first, second).unwrap()
}

fn camera() -> Camera {
    Camera::centred(160.0, W, H).unwrap()
}

/// A texture with detail at several scales and without a period.
fn texture(x: f64, y: f64) -> f64 {
    120.0
        + 22.0 * (0.11 * x + 0.05 * y + 2.0 * (0.043 * y).sin()).sin()
        + 22.0 * (0.13 * y - 0.04 * x + 2.0 * (0.037 * x).cos()).cos()
        + 14.0 * (0.5 * x - 0.37 * y + 3.0 * (0.05 * x).sin()).sin()
        + 14.0 * (0.43 * y + 0.41 * x + 3.0 * (0.045 * y).cos()).cos()
}

/// A still texture on which a square of `half` a side around the pixel (70, 60) moves by (u, v). The second frame's
/// brightness is multiplied by `gain`.
fn square(half: f64, (u, v): (f64, f64), gain: f64) -> FramePair {
    let frame = |t: f64, gain: f64| {
        let picture = Grid::from_fn(W, H, |px, py| {
            let (px, py) = (px as f64, py as f64);
            let (dx, dy) = (px - 70.0 - t * u, py - 60.0 - t * v);
            let on = dx.abs() < half && dy.abs() < half;
            let value = if on {
                texture(dx + 400.0, dy + 300.0)
            } else {
                texture(px, py)
            };
            (gain * value) as f32
        });
        Frame::from_grey(picture).unwrap()
    };
    pair([frame(0.0, 1.0), frame(1.0, gain)])
}

/// Intersection over union of what a curve encloses and of where `inside` holds.
fn overlap(curve: &Shape, inside: impl Fn(usize, usize) -> bool) -> f64 {
    let (mut both, mut either) = (0, 0);
    for (x, y) in (0..W * H).map(|i| (i % W, i / W)) {
        let a = curve.signed_distance(x as f64, y as f64) > 0.0;
        let b = inside(x, y);
        both += usize::from(a && b);
        either += usize::from(a || b);
    }
    both as f64 / either as f64
}

fn found(sequence: &Sequence) -> Vec<Shape> {
    find_curves(&pair(sequence.frames.clone()), &sequence.truth.camera)
}

#[test]
fn a_lone_square_is_found_wherever_it_goes_and_however_light_changes() {
    for (motion, gain) in [((1.5, 0.0), 1.0), ((-0.7, 1.1), 1.1), ((0.0, -4.0), 0.9)] {
        let curves = find_curves(&square(22.0, motion, gain), &camera());
        assert_eq!(curves.len(), 1, "{motion:?}");
        let on = |x: usize, y: usize| x.abs_diff(70) < 22 && y.abs_diff(60) < 22;
        let overlap = overlap(&curves[0], on);
        assert!(overlap > 0.7, "{motion:?}: {overlap}");
    }
}

#[test]
fn what_is_too_small_to_be_told_is_not_found() {
    assert_eq!(find_curves(&square(2.5, (1.5, 0.0), 1.0), &camera()), []);
}

#[test]
fn built_in_bodies_are_found() {
    for name in ["squares", "blocks"] {
        let sequence = scene::render(name, W, H).unwrap();
        let curves = found(&sequence);
        assert_eq!(curves.len(), sequence.truth.regions() - 1, "{name}");
        for body in 1..sequence.truth.regions() {
            let on = |x, y| usize::from(sequence.truth.labels[(x, y)]) == body;
            let best = curves.iter().map(|c| overlap(c, on)).fold(0.0, f64::max);
            assert!(best > 0.6, "{name}: body {body} is covered by {best}");
        }
    }
}

#[test]
fn scenery_at_all_depths_is_one_body() {
    for name in ["flight", "columns"] {
        assert_eq!(found(&scene::render(name, 240, 180).unwrap()), [], "{name}");
    }
}

#[test]
fn frames_of_different_things_give_nothing() {
    let [one, other] = ["blocks", "head"].map(|name| scene::render(name, W, H).unwrap());
    let [[first, _], [second, _]] = [one.frames, other.frames];
    let pair = pair([first, second]);
    assert_eq!(find_curves(&pair, &camera()), []);
    assert_eq!(focal_length(&pair, &camera()), None);
}

#[test]
fn polygons_lie_in_the_frame_to_a_tenth_of_a_pixel() {
    for curve in found(&scene::render("figure", W, H).unwrap()) {
        let Shape::Polygon { points } = curve else {
            panic!("found curves are polygons");
        };
        for [x, y] in points {
            assert!((0.0..=159.0).contains(&x) && (0.0..=119.0).contains(&y));
            assert!((10.0 * x - (10.0 * x).round()).abs() < 1e-6);
        }
    }
}

#[test]
fn frames_of_any_size_and_odd_cameras_are_taken() {
    for (width, height) in [(16, 16), (16, 600), (600, 17), (28, 28)] {
        let frames = [0.0, 0.8].map(|shift| {
            let value = |x: usize, y: usize| texture(x as f64 - shift, y as f64) as f32;
            Frame::from_grey(Grid::from_fn(width, height, value)).unwrap()
        });
        let camera = Camera::centred(100.0, width, height).unwrap();
        assert_eq!(find_curves(&pair(frames), &camera), [], "{width}×{height}");
    }
    let frames = square(22.0, (1.5, 0.0), 1.0);
    let by_hand = Camera {
        focal: f64::NAN,
        cx: 1e300,
        cy: 0.0,
    };
    let odd = [(1.0, 80.0, 60.0), (1e6, 80.0, 60.0), (64.0, 1e6, -1e6)];
    let odd = odd.map(|(f, x, y)| Camera::new(f, x, y).unwrap());
    for camera in odd.into_iter().chain([by_hand]) {
        assert!(find_curves(&frames, &camera).len() <= 7);
        focal_length(&frames, &camera);
    }
}

#[test]
fn displacement_is_that_of_the_faster_things() {
    for name in ["blocks", "columns"] {
        let Sequence { frames, truth, .. } = scene::render(name, W, H).unwrap();
        let flow = truth.flow.u.data().iter().zip(truth.flow.v.data());
        let mut speeds: Vec<f32> = flow.map(|(u, v)| u.hypot(*v)).collect();
        speeds.retain(|speed| speed.is_finite());
        speeds.sort_by(f32::total_cmp);
        let expected = f64::from(speeds[speeds.len() * 99 / 100]) / W as f64;
        let found = displacement(&frames[0].grey, &frames[1].grey);
        assert!(
            (found.share - expected).abs() < 0.15 * expected,
            "{name}: {found:?}, {expected}"
        );
        assert!(found.followed > 0.9, "{name}: {found:?}");
    }
}

#[test]
fn displacement_tells_too_little_from_too_much() {
    let moved = |u: f64| {
        let frame = |t: f64| {
            Grid::from_fn(W, H, |x, y| {
                texture(x as f64 - t * u, y as f64 + t * 0.3 * u) as f32
            })
        };
        displacement(&frame(0.0), &frame(1.0)).verdict
    };
    assert_eq!(moved(0.2), Verdict::Small);
    // A small body before scenery at rest is motion, too.
    let body = square(11.0, (4.0, 0.0), 1.0);
    let found = displacement(&body.first().grey, &body.second().grey);
    assert_eq!(found.verdict, Verdict::Fit, "{found:?}");
    assert_eq!(moved(4.0), Verdict::Fit);
    assert_eq!(moved(24.0), Verdict::Large);
    let other = scene::render("blocks", W, H).unwrap().frames[0]
        .grey
        .clone();
    let cut = displacement(
        &Grid::from_fn(W, H, |x, y| texture(x as f64, y as f64) as f32),
        &other,
    );
    assert_eq!(cut.verdict, Verdict::Large, "{cut:?}");
    let black = Grid::new(W, H, 0.0);
    assert_eq!(displacement(&black, &black).verdict, Verdict::Small);
}
