//! The focal length, found where scenery and a turning camera tell it, and kept where nothing does.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::support::{grey_pair, pair, texture};
use glam::DVec3;
use relievo::scene;
use relievo::start::{FocalLength, focal_length};
use relievo::{Camera, FramePair, Grid, RigidMotion};

/// Three walls one behind the other, seen by a camera before and after `motion`. Lengths are in widths of
/// the frame, of `width` × ¾ `width` pixels.
fn walls(width: usize, focal: f64, motion: RigidMotion) -> FramePair {
    let (w, height) = (width as f64, width * 3 / 4);
    let camera = Camera::centred(focal * w, width, height).unwrap();
    let back = motion.matrix().transpose();
    // 1/Z, and the part of the first frame that a wall fills.
    let walls: [(f64, [f64; 4]); 3] = [
        (1.0, [0.35, 0.2, 0.7, 0.6]),
        (0.6, [-1.0, -1.0, 0.3, 2.0]),
        (0.3, [-9.0, -9.0, 9.0, 9.0]),
    ];
    let brightness = |px: f64, py: f64, t: f64| {
        let ray = camera.ray(px, py);
        walls
            .iter()
            .enumerate()
            .find_map(|(k, (rho, [left, top, right, bottom]))| {
                let point = if t == 0.0 {
                    ray / *rho
                } else {
                    let (ray, shift) = (back * ray, back * motion.translation);
                    ray * ((1.0 / rho + shift.z) / ray.z) - shift
                };
                let (x, y) = camera.project(point);
                let within =
                    (*left..*right).contains(&(x / w)) && (*top..*bottom).contains(&(y / w));
                let (x, y) = (320.0 * x / w, 320.0 * y / w);
                within.then(|| texture(x + 500.0 * k as f64, y) as f32)
            })
    };
    let frame = |t: f64| {
        let seen = |x, y| brightness(x as f64, y as f64, t).unwrap();
        Grid::from_fn(width, height, seen)
    };
    grey_pair(frame(0.0), frame(1.0))
}

/// Shifts the picture by so many widths of the frame where a wall is at 1, and turns it by as many more.
fn motion(focal: f64, shift: [f64; 2], turn: [f64; 2]) -> RigidMotion {
    RigidMotion {
        translation: DVec3::new(shift[0], shift[1], 0.0) / focal,
        rotation: DVec3::new(-turn[1], turn[0], 0.0) / focal,
    }
}

/// What is found when the frame's width is taken for f; in widths.
fn found(pair: &FramePair) -> Option<FocalLength> {
    let width = pair.width() as f64;
    let guess = Camera::centred(width, pair.width(), pair.height()).unwrap();
    focal_length(pair, &guess).map(|f| FocalLength {
        focal: f.focal / width,
        least: f.least / width,
        greatest: f.greatest / width,
    })
}

#[test]
fn scenery_before_a_turning_camera_tells_it() {
    for (truth, turn) in [(0.5, -0.02), (0.4, -0.02), (3.0, 0.035)] {
        let pair = walls(240, truth, motion(truth, [0.03, 0.0], [turn, 0.01]));
        let f = found(&pair).expect("the width is not the focal length");
        assert!((f.focal / truth).ln().abs() < 0.25, "{truth}: {f:?}");
        assert!(f.least <= truth && truth <= f.greatest, "{truth}: {f:?}");
        assert!(f.least <= f.focal && f.focal <= f.greatest, "{f:?}");
    }
}

#[test]
fn it_is_found_in_noise_and_beside_things_that_move_by_themselves() {
    let scene = scene::variant("blocks", 1014, 4.0, 6.0, 320, 240).unwrap();
    let pair = pair(&scene);
    let mut guess = scene.truth.camera;
    let truth = guess.focal;
    assert_eq!(
        focal_length(&pair, &guess),
        None,
        "the truth needs no other"
    );
    guess.focal = 4.0 * truth;
    let f = focal_length(&pair, &guess).expect("a field of view of 14° is far off");
    assert!(f.least < truth && truth < f.greatest, "{f:?}");
    assert!(f.greatest < guess.focal, "{f:?}");
}

#[test]
fn it_grows_with_the_frames() {
    let of = |width| {
        let pair = walls(width, 3.0, motion(3.0, [0.03, 0.0], [0.035, 0.01]));
        found(&pair).unwrap().focal
    };
    assert!((of(480) / of(240)).ln().abs() < 0.2);
}

#[test]
fn it_is_kept_where_nothing_turns() {
    let pair = walls(240, 3.0, motion(3.0, [0.03, 0.01], [0.0, 0.0]));
    assert_eq!(found(&pair), None);
}

#[test]
fn it_is_kept_where_frames_show_different_things() {
    let [one, other] =
        ["flight", "carousel"].map(|name| scene::render(name, 160, 120).unwrap().frames[0].clone());
    let pair = FramePair::new(one, other).unwrap();
    assert_eq!(found(&pair), None);
}
