//! Frames and cameras that tell little or nothing: no panic, no endless loop, no number that is none.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::scene::{self, Sequence};
use relievo::{Camera, FramePair, Grid, Shape, Solver, Status};

use crate::support::{best, changed, circle, grey_pair, noise, pair, run, texture, whole};

/// Solves it from a curve in the middle and from none.
fn survives(pair: &FramePair, focal: f64) {
    let (width, height) = (pair.width(), pair.height());
    let camera = Camera::centred(focal, width, height).unwrap();
    let middle = circle(width as f64 / 2.0, height as f64 / 2.0, 5.0);
    for curves in [vec![], vec![middle]] {
        ends(pair, camera, &curves);
    }
}

fn ends(pair: &FramePair, camera: Camera, curves: &[Shape]) {
    let mut solver = Solver::new(pair.clone(), camera, curves, best()).unwrap();
    let found = run(&mut solver);
    assert_ne!(solver.status(), Status::Diverged);
    assert!(solver.iterations() < 40, "{} passes", solver.iterations());
    assert!(solver.history().iter().all(|e| e.is_finite()));
    whole(&found, curves.len() + 1);
    let weights = solver.report().weights;
    assert!(weights.mu.is_finite() && weights.sigma.is_finite() && weights.lambda.is_finite());
    let finite = |p: &[f32; 2]| p[0].is_finite() && p[1].is_finite();
    assert!(
        solver
            .contours()
            .iter()
            .all(|c| c.points.iter().all(finite))
    );
}

fn shifted([width, height]: [usize; 2], by: f64) -> FramePair {
    let frame = |by: f64| {
        Grid::from_fn(width, height, |x, y| {
            texture(x as f64 - by, y as f64) as f32
        })
    };
    grey_pair(frame(0.0), frame(by))
}

#[test]
fn frames_of_any_shape_are_taken() {
    for size in [
        [16, 16],
        [16, 400],
        [400, 16],
        [17, 31],
        [47, 49],
        [301, 18],
    ] {
        survives(&shifted(size, 0.7), size[0] as f64);
    }
}

#[test]
fn one_pixel_that_differs_is_nothing_that_moves() {
    let frame = Grid::from_fn(64, 48, |x, y| texture(x as f64, y as f64) as f32);
    let mut second = frame.clone();
    second[(20, 30)] += 1.0;
    let pair = grey_pair(frame, second);
    survives(&pair, 64.0);
    let camera = Camera::centred(64.0, 64, 48).unwrap();
    let found = run(&mut Solver::new(pair, camera, &[], best()).unwrap());
    let flow = found.flow.u.data().iter().chain(found.flow.v.data());
    assert!(flow.map(|w| w.abs()).fold(0.0, f32::max) < 0.02);
    // On a blank wall.
    let blank = Grid::new(64, 48, 90.0f32);
    let mut spot = blank.clone();
    spot[(20, 30)] = 91.0;
    let mut moved = blank;
    moved[(22, 30)] = 91.0;
    survives(&grey_pair(spot, moved), 64.0);
}

#[test]
fn stripes_and_rows_that_are_all_alike_leave_numbers_whole() {
    let stripes = |along: f64, across: f64, by: f64| {
        Grid::from_fn(96, 72, |x, y| {
            (120.0 + 60.0 * (along * (x as f64 - by) + across * (y as f64 - by)).sin()) as f32
        })
    };
    for (along, across) in [(0.4, 0.0), (0.0, 0.4), (0.3, 0.3), (3.1, 0.0)] {
        survives(
            &grey_pair(stripes(along, across, 0.0), stripes(along, across, 0.8)),
            96.0,
        );
    }
    // A step, and rows of one brightness each.
    let step = |at: usize| Grid::from_fn(96, 72, |x, _| if x < at { 20.0 } else { 200.0 });
    survives(&grey_pair(step(40), step(42)), 96.0);
    let rows = |by: usize| Grid::from_fn(96, 72, |_, y| ((y + by) * 37 % 256) as f32);
    survives(&grey_pair(rows(0), rows(1)), 96.0);
}

#[test]
fn frames_that_have_nothing_to_do_with_each_other_come_to_an_end() {
    let random = |seed| noise(96, 72, seed).map(|v| (120.0 + 60.0 * v) as f32);
    survives(&grey_pair(random(1), random(2)), 96.0);
    let [one, other] = ["blocks", "head"].map(|name| scene::render(name, 96, 72).unwrap());
    let [[first, _], [second, _]] = [one.frames, other.frames];
    survives(&FramePair::new(first, second).unwrap(), 96.0);
    // Black and white change places.
    let negative = changed(scene::render("blocks", 96, 72).unwrap(), |i, _, v| {
        if i == 1 { 255.0 - v } else { v }
    });
    survives(&pair(&negative), 96.0);
}

#[test]
fn the_longest_and_the_shortest_focal_length_are_taken() {
    let frames = shifted([96, 72], 1.3);
    for focal in [1.0, 3.0, 1e4, 1e6] {
        survives(&frames, focal);
    }
    let blocks = scene::render("blocks", 96, 72).unwrap();
    for focal in [1.0, 1e6] {
        let camera = Camera::centred(focal, 96, 72).unwrap();
        ends(&pair(&blocks), camera, &blocks.curves);
    }
    let far = Camera::new(96.0, 1e5, -1e5).unwrap();
    ends(&pair(&blocks), far, &blocks.curves);
}

#[test]
fn curves_may_lie_badly() {
    let Sequence {
        truth,
        curves,
        frames,
        ..
    } = scene::render("blocks", 96, 72).unwrap();
    let [first, second] = frames;
    let pair = FramePair::new(first, second).unwrap();
    let tiny = circle(48.0, 36.0, 0.8);
    let all = circle(48.0, 36.0, 200.0);
    let twice = vec![curves[0].clone(), curves[0].clone()];
    let seven: Vec<Shape> = (0..7)
        .map(|i| circle(8.0 + 13.0 * f64::from(i), 36.0, 6.0))
        .collect();
    for curves in [vec![tiny], vec![all], twice, seven] {
        ends(&pair, truth.camera, &curves);
    }
}
