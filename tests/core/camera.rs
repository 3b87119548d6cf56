//! Equation (1) and the exact displacement against points that move.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::DVec3;
use relievo::{Camera, Error, RigidMotion};

fn motion(t: [f64; 3], w: [f64; 3]) -> RigidMotion {
    RigidMotion {
        translation: DVec3::from_array(t),
        rotation: DVec3::from_array(w),
    }
}

/// A camera off the frame's centre, pixels all over the frame at several depths, and motions that have
/// each component alone and all at once.
fn cases() -> Vec<(Camera, RigidMotion, [f64; 2], f64)> {
    let camera = Camera::new(310.0, 150.3, 122.7).unwrap();
    let mut motions = vec![motion([0.02, -0.03, 0.05], [0.004, -0.007, 0.011])];
    for i in 0..3 {
        let mut unit = [0.0; 3];
        unit[i] = 0.02;
        motions.push(motion(unit, [0.0; 3]));
        motions.push(motion([0.0; 3], unit));
    }
    let mut cases = Vec::new();
    for m in motions {
        for pixel in [[0.0, 0.0], [319.0, 239.0], [150.3, 122.7], [40.5, 201.25]] {
            for z in [0.4, 1.0, 7.5] {
                cases.push((camera, m, pixel, z));
            }
        }
    }
    cases
}

#[test]
fn image_motion_is_the_velocity_of_a_projected_moving_point() {
    for (camera, motion, [px, py], z) in cases() {
        let point = z * camera.ray(px, py);
        let velocity = motion.translation + motion.rotation.cross(point);
        let seen = |t: f64| camera.project(point + t * velocity);
        // Five points: exact up to h⁴, so that a step large enough to be free of rounding will do.
        let h = 0.01;
        let slope = |of: fn((f64, f64)) -> f64| {
            (of(seen(-2.0 * h)) - of(seen(2.0 * h)) + 8.0 * (of(seen(h)) - of(seen(-h))))
                / (12.0 * h)
        };
        let (u, v) = camera.image_motion(&motion, px, py, 1.0 / z);
        let (du, dv) = (u - slope(|p| p.0), v - slope(|p| p.1));
        assert!(
            du.abs() < 1e-9 && dv.abs() < 1e-9,
            "off by ({du:e}, {dv:e}) at ({px}, {py}), Z = {z}, for {motion:?}"
        );
    }
}

#[test]
fn displacement_is_exact_for_large_motions() {
    // A quarter turn about the optical axis takes (x, y) to (−y, x).
    let camera = Camera::new(100.0, 50.0, 40.0).unwrap();
    let quarter = motion([0.0; 3], [0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    let (du, dv) = camera.displacement(&quarter, 80.0, 45.0, 1.0).unwrap();
    assert!((du - (-5.0 - 30.0)).abs() < 1e-9 && (dv - (30.0 - 5.0)).abs() < 1e-9);
    // Any other, by Rodrigues' formula.
    let large = motion([0.3, -0.2, 0.4], [0.2, -0.3, 0.4]);
    for (px, py, z) in [(0.0, 0.0, 1.0), (90.0, 70.0, 3.0), (50.0, 10.0, 0.9)] {
        let p = z * camera.ray(px, py);
        let angle = large.rotation.length();
        let axis = large.rotation / angle;
        let turned = p * angle.cos()
            + axis.cross(p) * angle.sin()
            + axis * axis.dot(p) * (1.0 - angle.cos());
        let (qx, qy) = camera.project(turned + large.translation);
        let (du, dv) = camera.displacement(&large, px, py, 1.0 / z).unwrap();
        assert!((px + du - qx).abs() < 1e-9 && (py + dv - qy).abs() < 1e-9);
    }
}

#[test]
fn displacement_tends_to_image_motion_as_motion_gets_smaller() {
    for (camera, full, [px, py], z) in cases() {
        let error = |scale: f64| {
            let part = motion(
                (scale * full.translation).to_array(),
                (scale * full.rotation).to_array(),
            );
            let (u, v) = camera.image_motion(&part, px, py, 1.0 / z);
            let (du, dv) = camera.displacement(&part, px, py, 1.0 / z).unwrap();
            (du - u).hypot(dv - v)
        };
        let (whole, tenth) = (error(1.0), error(0.1));
        // (1) is the first order, so that the rest falls with the square.
        assert!(tenth <= whole / 80.0 + 1e-9, "{whole} and {tenth} px");
    }
}

#[test]
fn points_at_infinity_only_turn() {
    let camera = Camera::centred(200.0, 160, 120).unwrap();
    let turn = motion([0.0; 3], [0.01, 0.02, -0.03]);
    let both = motion([5.0, -4.0, 3.0], [0.01, 0.02, -0.03]);
    for (px, py) in [(0.0, 0.0), (79.5, 59.5), (159.0, 30.0)] {
        let far = camera.image_motion(&both, px, py, 0.0);
        assert_eq!(far, camera.image_motion(&turn, px, py, 1.0));
        assert_eq!(
            camera.displacement(&both, px, py, 0.0),
            camera.displacement(&turn, px, py, 1.0)
        );
        assert!(far.0.is_finite() && far.1.is_finite());
    }
}

#[test]
fn points_that_pass_behind_the_camera_are_not_seen() {
    let camera = Camera::centred(200.0, 160, 120).unwrap();
    for away in [
        motion([0.0, 0.0, -1.5], [0.0; 3]),
        motion([0.0, 0.0, -1.0], [0.0; 3]),
        motion([0.0; 3], [0.0, 2.5, 0.0]),
    ] {
        assert_eq!(camera.displacement(&away, 79.5, 59.5, 1.0), None);
    }
    let nearer = motion([0.0, 0.0, -0.9], [0.0; 3]);
    assert!(camera.displacement(&nearer, 79.5, 59.5, 1.0).is_some());
}

#[test]
fn rays_and_projection_undo_each_other() {
    let camera = Camera::new(310.0, 150.3, 122.7).unwrap();
    for (px, py) in [(0.0, 0.0), (319.0, 239.0), (150.3, 122.7)] {
        let (qx, qy) = camera.project(3.5 * camera.ray(px, py));
        assert!((qx - px).abs() < 1e-9 && (qy - py).abs() < 1e-9);
    }
}

#[test]
fn a_motion_keeps_lengths_and_moves_the_origin_by_its_translation() {
    let m = motion([0.3, -0.2, 0.4], [0.2, -0.3, 0.4]);
    assert!((m.apply(DVec3::ZERO) - m.translation).length() < 1e-15);
    let (a, b) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 0.5, 4.0));
    let after = (m.apply(a) - m.apply(b)).length();
    assert!((after - (a - b).length()).abs() < 1e-12);
}

#[test]
fn the_centre_of_a_frame_lies_between_its_outermost_pixels() {
    let camera = Camera::centred(100.0, 5, 4).unwrap();
    assert_eq!((camera.cx, camera.cy), (2.0, 1.5));
}

#[test]
fn impossible_cameras_are_refused_with_the_number() {
    for focal in [0.0, -50.0, 0.9, 1.1e6, 1e300, f64::INFINITY] {
        assert_eq!(Camera::new(focal, 0.0, 0.0), Err(Error::Focal(focal)));
        let Err(error) = Camera::centred(focal, 64, 48) else {
            panic!("{focal} was accepted");
        };
        let sentence = error.to_string();
        for number in [focal.to_string(), "from 1 to 1000000".to_owned()] {
            assert!(sentence.contains(&number), "{sentence}");
        }
    }
    assert!(matches!(
        Camera::new(f64::NAN, 0.0, 0.0),
        Err(Error::Focal(f)) if f.is_nan()
    ));
    for (cx, cy) in [(f64::INFINITY, 0.0), (3.0, -1e300), (2e6, 0.0)] {
        let error = Error::Centre(cx, cy);
        assert!(error.to_string().contains("from -1000000 to 1000000"));
        assert_eq!(Camera::new(1.0, cx, cy), Err(error));
    }
    assert!(matches!(
        Camera::new(1.0, f64::NAN, 0.0),
        Err(Error::Centre(..))
    ));
}
