use super::*;
use glam::DVec3;

/// A texture without repetition, by an integer hash smoothed between its points 3 px apart.
fn texture(x: f32, y: f32) -> f32 {
    let at = |i: i32, j: i32| {
        let h = (i.wrapping_mul(374_761_393) ^ j.wrapping_mul(668_265_263)) as u32;
        let h = (h ^ (h >> 13)).wrapping_mul(1_274_126_177);
        ((h >> 16) & 255) as f32
    };
    let (x, y) = (x / 3.0, y / 3.0);
    let (i, j) = (x.floor(), y.floor());
    let (s, t) = (x - i, y - j);
    let (i, j) = (i as i32, j as i32);
    let top = at(i, j) * (1.0 - s) + at(i + 1, j) * s;
    let bottom = at(i, j + 1) * (1.0 - s) + at(i + 1, j + 1) * s;
    top * (1.0 - t) + bottom * t
}

/// Share of the pixels, away from the step and the border, that the sweep has within half a pixel; |T| f is 4 px.
fn share_right(width: usize, height: usize, support: &Grid<bool>) -> f64 {
    let focal = width as f64;
    let camera = Camera::centred(focal, width, height).unwrap();
    let motion = RigidMotion {
        translation: DVec3::new(4.0 / focal, 0.0, 0.0),
        rotation: DVec3::ZERO,
    };
    let rho = |x: usize| if x > width / 2 { 2.0f32 } else { 0.5 };
    let second = Grid::from_fn(width, height, |x, y| texture(x as f32, y as f32));
    let first = Grid::from_fn(width, height, |x, y| {
        texture(x as f32 + 4.0 * rho(x), y as f32)
    });
    let found = sweep([&first, &second], &camera, &motion, support, [0.0, 3.0]);
    let (mut right, mut count) = (0.0, 0.0);
    for y in 4..height - 4 {
        for x in (4..width - 14).filter(|x| x.abs_diff(width / 2) > 10) {
            if support[(x, y)] {
                let moved = 4.0 * found[(x, y)];
                right += f64::from(u8::from((moved - 4.0 * rho(x)).abs() < 0.5));
                count += 1.0;
            }
        }
    }
    right / count
}

#[test]
fn finds_two_depths() {
    assert!(share_right(96, 72, &Grid::new(96, 72, true)) > 0.97);
}

#[test]
fn needs_no_more_than_its_support() {
    let support = Grid::from_fn(96, 72, |x, y| (x / 20 + y / 20) % 2 == 0);
    assert!(share_right(96, 72, &support) > 0.95);
}

#[test]
fn halves_large_frames() {
    let (width, height) = (1000, 312);
    assert!(width * height > MOST_PIXELS);
    assert!(share_right(width, height, &Grid::new(width, height, true)) > 0.95);
}

#[test]
fn a_median_is_the_fifth_of_nine() {
    let field = Grid::from_fn(12, 9, |x, y| ((x * 37 + y * 101 + x * x * y) % 71) as f32);
    let found = median3(&field);
    for y in 1..8 {
        for x in 1..11 {
            let mut nine: Vec<f32> = (0..9)
                .map(|i| field[(x + i % 3 - 1, y + i / 3 - 1)])
                .collect();
            nine.sort_by(f32::total_cmp);
            assert_eq!(found[(x, y)], nine[4]);
        }
    }
    assert_eq!(found[(0, 4)], field[(0, 4)]);
}
