use super::*;

fn weights(width: usize, height: usize) -> Bending {
    let noise = |x: usize, y: usize| ((x * 7 + y * 13 + x * y) % 11) as f32 / 11.0;
    Bending {
        data: Grid::from_fn(width, height, |x, y| {
            if (x + y) % 3 == 0 { 0.0 } else { noise(x, y) }
        }),
        across: Grid::from_fn(width, height, |x, y| {
            if x == 0 || x + 1 == width {
                0.0
            } else {
                30.0 * (0.1 + noise(y, x))
            }
        }),
        down: Grid::from_fn(width, height, |x, y| {
            if y == 0 || y + 1 == height {
                0.0
            } else {
                30.0 * (0.1 + noise(x, y))
            }
        }),
    }
}

#[test]
fn reaches_the_known_solution() {
    let (width, height) = (37, 29);
    let bending = weights(width, height);
    let known = Grid::from_fn(width, height, |x, y| {
        (0.2 * x as f32).sin() + (0.13 * y as f32).cos() + if x > 20 { 1.0 } else { 0.0 }
    });
    let mut lines = Lines::new(width, height);
    // A·known, to be found again from 0.
    lines.apply(&bending, known.data(), true);
    let right = lines.applied.clone();
    let mut x = vec![0.0; width * height];
    let shifts: Vec<f32> = (0..40).map(|k| 30.0 * 0.1f32.powi(k % 5)).collect();
    lines.solve(&bending, &mut x, &right, &shifts);
    let worst = x
        .iter()
        .zip(known.data())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f32::max);
    assert!(worst < 0.02, "{worst}");
}

#[test]
fn leaves_planes_alone() {
    let (width, height) = (21, 33);
    let bending = weights(width, height);
    let plane = Grid::from_fn(width, height, |x, y| 0.3 * x as f32 - 0.2 * y as f32 + 4.0);
    let mut x = plane.data().to_vec();
    let pull = vec![0.0; width * height];
    Lines::new(width, height).solve(&bending, &mut x, &pull, &[10.0, 1.0, 0.1]);
    assert!(
        x.iter()
            .zip(plane.data())
            .all(|(a, b)| (a - b).abs() < 1e-3)
    );
}
