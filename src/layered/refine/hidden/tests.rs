use super::*;
use crate::camera::{Camera, RigidMotion};
use glam::DVec3;

const SIZE: (usize, usize) = (60, 40);

/// A shift to the right by 2 px at ρ = 1.
fn view() -> View {
    let camera = Camera::centred(100.0, SIZE.0, SIZE.1).unwrap();
    let motion = RigidMotion {
        translation: DVec3::new(0.02, 0.0, 0.0),
        rotation: DVec3::ZERO,
    };
    View::of(&camera, &motion)
}

#[test]
fn what_is_covered_and_what_leaves_is_hidden() {
    // Columns 20 to 29 move by 8 px, all else by 2: they come to lie on 28 to 37.
    let near = |x: usize| (20..30).contains(&x);
    let mut rho = Grid::from_fn(SIZE.0, SIZE.1, |x, _| if near(x) { 4.0 } else { 1.0 });
    let support = Grid::new(SIZE.0, SIZE.1, true);
    let mask = hidden(&rho, &view(), &support, 0.5);
    let row: Vec<usize> = (0..SIZE.0).filter(|&x| mask[(x, 20)]).collect();
    let expected: Vec<usize> = (30..36).chain(58..60).collect();
    assert_eq!(row, expected);
    for x in 30..36 {
        rho[(x, 20)] = 9.0;
    }
    fill(&mut rho, &mask);
    assert!((30..36).all(|x| rho[(x, 20)] == 1.0));
    let nothing = Grid::new(SIZE.0, SIZE.1, false);
    let mask = hidden(&rho, &view(), &nothing, 0.5);
    assert!(mask.data().iter().all(|&m| !m));
}

#[test]
fn what_leaves_continues_the_slope() {
    let slope = |x: usize| 3.0 + 0.02 * x as f32;
    let truth = Grid::from_fn(SIZE.0, SIZE.1, |x, _| slope(x));
    let support = Grid::new(SIZE.0, SIZE.1, true);
    let mask = hidden(&truth, &view(), &support, 0.5);
    let mut rho = Grid::from_fn(
        SIZE.0,
        SIZE.1,
        |x, y| {
            if mask[(x, y)] { 5.0 } else { slope(x) }
        },
    );
    continue_outside(&mut rho, &view(), &mask, 1.0);
    for (a, b) in rho.data().iter().zip(truth.data()) {
        assert!((a - b).abs() < 1e-3);
    }
}
