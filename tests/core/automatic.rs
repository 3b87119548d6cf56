//! Curves that are found rather than drawn: as many as things move by themselves, and on them.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::support::{grey_pair, noise, pair, texture};
use glam::DVec3;
use relievo::scene::{self, Sequence};
use relievo::start::{automatic, focal_length};
use relievo::{Camera, FramePair, Grid, Options, RigidMotion, Shape, Solver};

/// What is found in a sequence.
fn found(sequence: &Sequence) -> Vec<Shape> {
    automatic(&pair(sequence), &sequence.truth.camera)
}

fn corners(shape: &Shape) -> &[[f64; 2]] {
    match shape {
        Shape::Polygon { points } => points,
        Shape::Circle { .. } => panic!("found curves are polygons"),
    }
}

fn mask(shape: &Shape, width: usize, height: usize) -> Grid<bool> {
    Grid::from_fn(width, height, |x, y| {
        shape.signed_distance(x as f64, y as f64) > 0.0
    })
}

/// Intersection over union.
fn overlap(a: &Grid<bool>, b: &Grid<bool>) -> f64 {
    let both = |f: fn(bool, bool) -> bool| {
        let pairs = a.data().iter().zip(b.data());
        pairs.filter(|(a, b)| f(**a, **b)).count() as f64
    };
    both(|a, b| a && b) / both(|a, b| a || b)
}

fn area(mask: &Grid<bool>) -> usize {
    mask.data().iter().filter(|inside| **inside).count()
}

/// That there is one curve for each body that moves by itself, and that each covers its body.
fn one_for_each(sequence: &Sequence, least: f64) {
    let labels = &sequence.truth.labels;
    let (width, height) = (labels.width(), labels.height());
    let curves: Vec<_> = found(sequence)
        .iter()
        .map(|shape| mask(shape, width, height))
        .collect();
    let bodies = sequence.truth.regions() - 1;
    let name = &sequence.name;
    assert_eq!(curves.len(), bodies, "{name}");
    for body in 1..=bodies {
        let seen = labels.map(|l| usize::from(l) == body);
        let best = curves.iter().map(|curve| overlap(curve, &seen));
        let best = best.fold(0.0, f64::max);
        assert!(best > least, "{name}: body {body} is covered by {best}");
    }
    // The largest comes first.
    assert!(curves.windows(2).all(|two| area(&two[0]) >= area(&two[1])));
}

#[test]
fn what_moves_by_itself_is_found() {
    for name in ["squares", "blocks", "figure", "head", "carousel"] {
        one_for_each(&scene::render(name, 160, 120).unwrap(), 0.7);
    }
}

/// A turning drum between two other bodies shows two sides, and either would suit its neighbour's motion.
#[test]
fn sides_belong_to_the_body_whose_motion_they_share_at_the_seam() {
    one_for_each(&scene::render("carousel", 320, 240).unwrap(), 0.7);
}

#[test]
fn noise_large_motion_and_a_moving_camera_are_withstood() {
    one_for_each(
        &scene::variant("blocks", 2004, 3.0, 4.0, 320, 240).unwrap(),
        0.6,
    );
    one_for_each(
        &scene::variant("carousel", 2007, 4.0, 12.0, 320, 240).unwrap(),
        0.6,
    );
}

#[test]
fn scenery_at_all_depths_is_one_body() {
    let flight = scene::render("flight", 240, 180).unwrap();
    let depth = flight.truth.depth.data();
    let near = depth.iter().copied().fold(f32::INFINITY, f32::min);
    let far = depth.iter().copied().fold(0.0, f32::max);
    assert!(far > 3.0 * near, "the hills are deep");
    assert_eq!(found(&flight), []);
}

const W: usize = 160;
const H: usize = 120;

/// A still texture on which a square of `half` a side around (x, y) moves by (u, v).
fn square(x: f64, y: f64, half: f64, (u, v): (f64, f64)) -> FramePair {
    let frame = |t: f64| {
        Grid::from_fn(W, H, |px, py| {
            let (px, py) = (px as f64, py as f64);
            let (dx, dy) = (px - x - t * u, py - y - t * v);
            let value = if dx.abs() < half && dy.abs() < half {
                texture(dx + 400.0, dy + 300.0)
            } else {
                texture(px, py)
            };
            value as f32
        })
    };
    grey_pair(frame(0.0), frame(1.0))
}

fn camera() -> Camera {
    Camera::centred(160.0, W, H).unwrap()
}

#[test]
fn a_lone_square_is_found_wherever_it_goes() {
    for motion in [(1.5, 0.0), (-0.7, 1.1), (0.0, -4.0)] {
        let curves = automatic(&square(70.0, 60.0, 20.0, motion), &camera());
        assert_eq!(curves.len(), 1, "{motion:?}");
        let true_square = Grid::from_fn(W, H, |x, y| {
            (x as f64 - 70.0).abs() < 20.0 && (y as f64 - 60.0).abs() < 20.0
        });
        let overlap = overlap(&mask(&curves[0], W, H), &true_square);
        assert!(overlap > 0.7, "{motion:?}: overlap {overlap}");
    }
}

#[test]
fn where_nothing_moves_no_curve_is_found() {
    // Frames without contrast, and equal ones, are no pair: here one pixel differs.
    let still = |mut grey: Grid<f32>| {
        let first = grey.clone();
        grey[(20, 30)] += 1.0;
        automatic(&grey_pair(first, grey), &camera())
    };
    let picture =
        |f: &dyn Fn(f64, f64) -> f64| Grid::from_fn(W, H, |x, y| f(x as f64, y as f64) as f32);
    let nearly_flat = |x: f64, _| if x < 1.0 { 91.0 } else { 90.0 };
    assert_eq!(still(picture(&nearly_flat)), []);
    assert_eq!(still(picture(&texture)), []);
    assert_eq!(
        still(
            scene::render("blocks", W, H).unwrap().frames[0]
                .grey
                .clone()
        ),
        []
    );
    // Frames of two scenes.
    let [one, other] = ["blocks", "head"].map(|name| scene::render(name, W, H).unwrap());
    let [[first, _], [second, _]] = [one.frames, other.frames];
    let pair = FramePair::new(first, second).unwrap();
    assert_eq!(automatic(&pair, &camera()), []);
    // Two frames of nothing but noise, and a texture under noise of its own in each frame.
    for (share, seed) in [(0.0, 1), (0.0, 5), (1.0, 3)] {
        let [first, second] = [seed, seed + 1].map(|seed| {
            let noise = noise(W, H, seed);
            let value = |x: f64, y: f64| {
                120.0 + share * (texture(x, y) - 120.0) + 5.0 * noise[(x as usize, y as usize)]
            };
            picture(&value)
        });
        let found = automatic(&grey_pair(first, second), &camera());
        assert_eq!(found, [], "share {share}");
    }
}

#[test]
fn what_is_too_small_to_be_told_is_not_found() {
    assert_eq!(
        automatic(&square(70.0, 60.0, 5.0, (1.5, 0.0)), &camera()),
        []
    );
}

#[test]
fn a_turn_of_the_camera_moves_nothing_by_itself() {
    let still = |x: f64, y: f64| texture(x, y) as f32;
    let first = Grid::from_fn(W, H, |x, y| still(x as f64, y as f64));
    let back = RigidMotion {
        translation: DVec3::ZERO,
        rotation: -DVec3::new(0.01, 0.02, 0.03),
    };
    let second = Grid::from_fn(W, H, |x, y| {
        let (x, y) = (x as f64, y as f64);
        let (u, v) = camera().displacement(&back, x, y, 0.0).unwrap();
        still(x + u, y + v)
    });
    assert_eq!(automatic(&grey_pair(first, second), &camera()), []);
}

#[test]
fn polygons_lie_in_the_frame_and_are_fit_to_start_from() {
    // The bear stands on the frame's lower border.
    let figure = scene::render("figure", 160, 120).unwrap();
    let labels = &figure.truth.labels;
    assert!(labels.row(119).contains(&1));
    let curves = found(&figure);
    for corners in curves.iter().map(corners) {
        assert!((4..=60).contains(&corners.len()), "{}", corners.len());
        for [x, y] in corners {
            assert!((0.0..=159.0).contains(x) && (0.0..=119.0).contains(y));
            let tenths = |value: f64| (10.0 * value - (10.0 * value).round()).abs() < 1e-6;
            assert!(tenths(*x) && tenths(*y));
        }
        assert!(corners.iter().any(|[_, y]| *y == 119.0));
    }
    let solver = Solver::new(
        pair(&figure),
        figure.truth.camera,
        &curves,
        Options::default(),
    );
    assert_eq!(solver.unwrap().interpretation().regions(), 2);
}

#[test]
fn larger_frames_give_the_same_curves_larger() {
    let [small, large] = [(160, 120), (480, 360)].map(|(width, height)| {
        let sequence = scene::render("squares", width, height).unwrap();
        let curves = found(&sequence);
        assert_eq!(curves.len(), 2);
        // Seen at the smaller size.
        let shrink = width as f64 / 160.0;
        curves
            .iter()
            .map(|shape| {
                Grid::from_fn(160, 120, |x, y| {
                    let grow = |at: usize| (at as f64 + 0.5) * shrink - 0.5;
                    shape.signed_distance(grow(x), grow(y)) > 0.0
                })
            })
            .collect::<Vec<_>>()
    });
    for curve in &small {
        let best = large.iter().map(|other| overlap(curve, other));
        assert!(best.fold(0.0, f64::max) > 0.75);
    }
}

#[test]
fn a_mirrored_pair_gives_mirrored_curves() {
    let sequence = scene::render("carousel", 160, 120).unwrap();
    let [first, second] =
        [0, 1].map(|i| Grid::from_fn(160, 120, |x, y| sequence.frames[i].grey[(159 - x, y)]));
    let curves = found(&sequence);
    let others = automatic(&grey_pair(first, second), &sequence.truth.camera);
    assert_eq!(others.len(), curves.len());
    for curve in &curves {
        let flipped = Grid::from_fn(160, 120, |x, y| {
            curve.signed_distance((159 - x) as f64, y as f64) > 0.0
        });
        let best = others.iter().map(|o| overlap(&mask(o, 160, 120), &flipped));
        assert!(best.fold(0.0, f64::max) > 0.8);
    }
}

#[test]
fn the_same_frames_give_the_same_curves() {
    let sequence = scene::render("blocks", 160, 120).unwrap();
    assert_eq!(found(&sequence), found(&sequence));
}

#[test]
fn frames_of_any_size_are_taken() {
    let stripes = |width: usize, height: usize, shift: f64| {
        Grid::from_fn(width, height, |x, y| {
            texture(x as f64 - shift, y as f64) as f32
        })
    };
    for (width, height) in [(16, 16), (16, 600), (600, 17), (28, 28)] {
        let [first, second] = [0.0, 0.8].map(|shift| stripes(width, height, shift));
        let camera = Camera::centred(100.0, width, height).unwrap();
        let found = automatic(&grey_pair(first, second), &camera);
        assert_eq!(found, [], "{width}×{height}");
    }
}

#[test]
fn no_camera_is_too_odd_to_look_through() {
    let sequence = scene::render("squares", 96, 72).unwrap();
    let pair = pair(&sequence);
    let odd = [
        Camera::new(1.0, 47.5, 35.5),
        Camera::new(1e6, 47.5, 35.5),
        Camera::new(64.0, 1e6, -1e6),
        Camera::new(1.0, 1e6, 1e6),
    ];
    let by_hand = Camera {
        focal: f64::NAN,
        cx: 1e300,
        cy: 0.0,
    };
    for camera in odd.map(Result::unwrap).into_iter().chain([by_hand]) {
        let curves = automatic(&pair, &camera);
        assert!(curves.len() <= 4, "{camera:?}");
        if let Some(found) = focal_length(&pair, &camera) {
            assert!(found.focal.is_finite() && found.focal > 0.0, "{camera:?}");
        }
    }
}
