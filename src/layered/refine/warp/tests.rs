use super::*;
use crate::camera::{Camera, RigidMotion};
use glam::{DQuat, DVec3};

fn wave(x: f32, y: f32) -> f32 {
    100.0 + 30.0 * (0.35 * x + 0.2 * y).sin() + 20.0 * (0.15 * x - 0.3 * y).cos()
}

#[test]
fn the_spline_passes_through_the_pixels_with_its_slope() {
    let picture = Grid::from_fn(40, 30, |x, y| wave(x as f32, y as f32));
    let pair = Pair::new(&picture, &picture);
    let smooth = smoothed(&picture);
    for (x, y) in [(0, 0), (39, 29), (17, 9), (1, 28)] {
        let [v, ..] = pair.sample(x as f32, y as f32);
        assert!((v - smooth[(x, y)]).abs() < 1e-2, "{x} {y}");
    }
    let [a, gx, gy] = pair.sample(20.3, 11.6);
    let d = 0.01;
    assert!(((pair.sample(20.3 + d, 11.6)[0] - a) / d - gx).abs() < 0.1);
    assert!(((pair.sample(20.3, 11.6 + d)[0] - a) / d - gy).abs() < 0.1);
}

#[test]
fn derivatives_are_those_of_the_residual() {
    let camera = Camera::centred(60.0, 40, 30).unwrap();
    let motion = RigidMotion {
        translation: DVec3::new(0.02, -0.01, 0.03),
        rotation: DVec3::new(0.004, -0.006, 0.01),
    };
    let second = Grid::from_fn(40, 30, |x, y| wave(x as f32, y as f32));
    // A flat first frame has no derivative, so that the mean of both is half of the second's.
    let pair = Pair::new(&Grid::new(40, 30, 0.0), &second);
    let (support, hidden) = (Grid::new(40, 30, true), Grid::new(40, 30, false));
    let residual = |motion: &RigidMotion, rho: f32| {
        let mut out = Linearisation::new(1200);
        let rho = Grid::new(40, 30, rho);
        pair.linearise(
            &View::new(&camera, motion),
            &rho,
            &support,
            &hidden,
            &mut out,
        );
        out
    };
    let (i, rho) = (14 * 40 + 19, 1.3);
    let here = residual(&motion, rho);
    let view = View::new(&camera, &motion);
    let g = DVec3::from_array([0, 1, 2].map(|k| 2.0 * f64::from(here.gradient[k][i])));
    let p = DVec3::from_array(view.turned(19, 14).map(f64::from));
    let check = |changed: f32, by: f64, expected: f64| {
        let slope = f64::from(changed - here.residual[i]) / by;
        assert!(
            (slope - expected).abs() < 0.03 * expected.abs() + 0.5,
            "{slope} {expected}"
        );
    };
    let d = 1e-3;
    check(
        residual(&motion, rho + 0.01).residual[i],
        0.01,
        g.dot(motion.translation),
    );
    let mut moved = motion;
    moved.translation.x += d;
    check(residual(&moved, rho).residual[i], d, f64::from(rho) * g.x);
    let mut turned = motion;
    let turn = DQuat::from_rotation_z(d) * DQuat::from_scaled_axis(motion.rotation);
    turned.rotation = turn.to_scaled_axis();
    check(residual(&turned, rho).residual[i], d, p.cross(g).z);
}
