use std::rc::Rc;

use super::*;
use crate::camera::Camera;
use crate::frames::{Frame, FramePair};
use crate::solver::{Approach, Next};

const W: usize = 160;
const H: usize = 120;

fn texture(x: f64, y: f64) -> f64 {
    120.0
        + 25.0 * (0.21 * x + 0.07 * y + 2.0 * (0.043 * y).sin()).sin()
        + 25.0 * (0.23 * y - 0.06 * x + 2.0 * (0.037 * x).cos()).cos()
        + 18.0 * (0.6 * x - 0.41 * y + 3.0 * (0.05 * x).sin()).sin()
}

/// Columns and rows of two boxes side by side.
const BOXES: [[f64; 4]; 2] = [[40.0, 80.0, 30.0, 90.0], [80.0, 120.0, 30.0, 90.0]];

/// A texture at rest, and two boxes on it that move by so many pixels each.
fn pair(motions: [[f64; 2]; 2]) -> Rc<FramePair> {
    let frame = |t: f64| {
        let picture = Grid::from_fn(W, H, |px, py| {
            let (px, py) = (px as f64, py as f64);
            let on = BOXES.iter().zip(motions).find_map(|(b, [u, v])| {
                let (x, y) = (px - t * u, py - t * v);
                let inside = x >= b[0] && x < b[1] && y >= b[2] && y < b[3];
                inside.then(|| texture(x + 300.0, y + 500.0))
            });
            on.unwrap_or_else(|| texture(px, py)) as f32
        });
        Frame::from_grey(picture).unwrap()
    };
    Rc::new(FramePair::new(frame(0.0), frame(1.0)).unwrap())
}

/// A level set in the middle of each box.
fn drawn() -> Vec<Grid<f32>> {
    let of = |b: &[f64; 4]| {
        let (cx, cy) = (0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3]));
        Grid::from_fn(W, H, |x, y| {
            (16.0 - (x as f64 - cx).hypot(y as f64 - cy)) as f32
        })
    };
    BOXES.iter().map(of).collect()
}

fn camera() -> Camera {
    Camera::centred(160.0, W, H).unwrap()
}

/// Curves that enclose something after the first scale.
fn left(pair: Rc<FramePair>) -> usize {
    let found = Layered::first_scale(pair, camera(), drawn(), &Options::default());
    let encloses = |set: &&Grid<f32>| set.data().iter().any(|v| *v > 0.0);
    found.iter().filter(encloses).count()
}

#[test]
fn one_motion_in_two_pieces_becomes_one() {
    assert_eq!(left(pair([[1.5, 0.5]; 2])), 1);
}

#[test]
fn two_motions_stay_two() {
    assert_eq!(left(pair([[1.5, 0.5], [-1.0, 1.5]])), 2);
    assert_eq!(left(pair([[1.5, 0.5], [1.5, -0.5]])), 2);
}

#[test]
fn what_does_not_move_by_itself_becomes_background() {
    assert_eq!(left(pair([[0.0; 2], [1.5, 0.5]])), 1);
}

#[test]
fn drawn_pieces_of_one_motion_are_noted() {
    let options = Options::default();
    let noted = |motions| {
        let mut solver = Layered::new(pair(motions), camera(), drawn(), &options);
        loop {
            solver.find_motions(&options);
            solver.find_depth(&options);
            solver.move_curves(&options);
            if solver.end_pass(0.0, false, &options) == Next::Done {
                break;
            }
        }
        // Where both explain as well, one may take all from the other.
        solver.regions[2].window.map(|_| solver.regions[2].part_of)
    };
    assert!(matches!(noted([[1.5, 0.5]; 2]), None | Some(Some(1))));
    assert_eq!(noted([[1.5, 0.5], [-1.0, 1.5]]), Some(None));
}
