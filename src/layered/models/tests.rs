use super::*;
use crate::camera::Camera;
use crate::window::Window;

fn state() -> State {
    let mut surface = Surface::flat(8, &Window::whole(64, 48));
    for (n, rho) in surface.rho.iter_mut().enumerate() {
        *rho = 1.0 + 0.3 * (0.9 * n as f32).sin();
    }
    State {
        model: MotionModel::Full,
        translation: DVec3::new(0.02, -0.01, 0.015),
        rotation: turn(DVec3::new(0.01, 0.02, -0.005)),
        surface,
    }
}

#[test]
fn the_mirror_image_of_the_mirror_image_is_the_thing_itself() {
    let (own, twice) = (state(), mirrored(&mirrored(&state())));
    assert!((own.translation - twice.translation).length() < 1e-12);
    assert!((own.omega() - twice.omega()).length() < 1e-9);
    for (a, b) in own.surface.rho.iter().zip(&twice.surface.rho) {
        assert!((a - b).abs() < 1e-6);
    }
}

#[test]
fn through_a_long_lens_the_mirror_image_moves_alike() {
    // Without T_z, whose flow the mirror keeps only for ρ = 1.
    let mut own = state();
    own.translation.z = 0.0;
    let other = mirrored(&own);
    let camera = Camera::centred(1000.0, 64, 48).unwrap();
    for (x, y) in [(3.0, 4.0), (40.0, 20.0), (60.0, 44.0)] {
        let go = |s: &State| {
            let rho = f64::from(s.surface.at(x as f32, y as f32));
            camera.displacement(&s.motion(), x, y, rho).unwrap()
        };
        let ((u, v), (p, q)) = (go(&own), go(&other));
        let apart = (u - p).hypot(v - q);
        assert!(apart < 0.05 * u.hypot(v), "{apart} of ({u}, {v})");
        assert!(
            (own.surface.at(x as f32, y as f32) - other.surface.at(x as f32, y as f32)).abs()
                > 0.01
        );
    }
}

fn candidate(model: MotionModel, translation: DVec3, score: f64) -> Candidate {
    Candidate {
        state: State {
            model,
            translation,
            ..state()
        },
        energy: 0.0,
        score,
    }
}

#[test]
fn only_another_direction_that_fits_as_well_makes_it_ambiguous() {
    use MotionModel::{Full, Still};
    let (x, y) = (DVec3::X, DVec3::Y);
    let of = |other: Candidate| {
        ambiguous(
            &distinct(vec![other, candidate(Full, x, 100.0)], FINE * EQUAL),
            EQUAL,
        )
    };
    assert!(of(candidate(Full, y, 105.0)));
    assert!(of(candidate(Full, -x, 105.0)));
    assert!(!of(candidate(Full, y, 100.0 + 2.0 * EQUAL)));
    assert!(!of(candidate(Full, x + 0.1 * y, 105.0)));
    assert!(!of(candidate(Still, DVec3::ZERO, 105.0)));
    let kept = distinct(
        vec![
            candidate(Full, y, 100.0 + 2.0 * FINE * EQUAL),
            candidate(Full, x, 100.0),
            candidate(Still, DVec3::ZERO, 110.0),
            candidate(Still, DVec3::ZERO, 120.0),
        ],
        FINE * EQUAL,
    );
    let scores: Vec<f64> = kept.iter().map(|c| c.score).collect();
    assert_eq!(scores, [100.0, 110.0]);
}
