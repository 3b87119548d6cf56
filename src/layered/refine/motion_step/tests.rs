use super::*;
use crate::camera::Camera;
use crate::layered::scale::Scale;

#[test]
fn finds_back_to_the_motion() {
    let (width, height) = (96, 72);
    let camera = Camera::centred(100.0, width, height).unwrap();
    let truth = RigidMotion {
        translation: DVec3::new(0.02, -0.005, 0.02),
        rotation: DVec3::new(0.002, -0.003, 0.004),
    };
    let texture = |[x, y]: [f32; 2]| {
        let waves = [(0.5, 0.2), (-0.3, 0.6), (0.2, -0.7), (0.9, 0.4)];
        let sum: f32 = waves.iter().map(|(a, b)| (a * x + b * y).sin()).sum();
        128.0 + 25.0 * sum
    };
    let rho = Grid::from_fn(width, height, |x, y| {
        1.0 + 0.4 * (0.1 * x as f32).sin() + 0.4 * (0.13 * y as f32).cos()
    });
    let view = View::of(&camera, &truth);
    let first = Grid::from_fn(width, height, |x, y| {
        texture(view.target(x, y, rho[(x, y)]))
    });
    let second = Grid::from_fn(width, height, |x, y| texture([x as f32, y as f32]));
    let frames = [first, second];
    let scale = Scale::new(frames.clone(), frames, camera);
    let (support, hidden) = (
        Grid::new(width, height, true),
        Grid::new(width, height, false),
    );
    let away = |m: &RigidMotion| {
        let angle = m.translation.angle_between(truth.translation);
        (angle.to_degrees(), (m.rotation - truth.rotation).length())
    };
    let mut motion = truth;
    motion.translation = glam::DQuat::from_rotation_y(0.06) * motion.translation;
    motion.rotation += DVec3::new(0.0, 0.001, 0.001);
    let length = motion.translation.length();
    let mut compared = Linearisation::new(width * height);
    for _ in 0..8 {
        let view = View::of(&camera, &motion);
        compared.compare(&scale, &view, &rho, &support, &hidden);
        motion_step(&mut compared, &view, &rho, 1.0, &mut motion);
    }
    let (degrees, turn) = away(&motion);
    assert!(degrees < 0.3 && turn < 3e-4, "{degrees} {turn}");
    assert!((motion.translation.length() - length).abs() < 1e-9);
}
