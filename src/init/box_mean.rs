//! The mean over a square around each pixel, and a picture less it: what is left does not depend on how bright
//! the surroundings are.

use crate::grid::Grid;

/// The mean over the (2 `radius` + 1)² pixels around each, of those that lie on the picture.
fn box_mean(picture: &Grid<f32>, radius: usize) -> Grid<f32> {
    let (width, height) = (picture.width(), picture.height());
    let mut across = Grid::new(width, height, 0.0f32);
    for y in 0..height {
        let row = picture.row(y);
        // A sum that slides must not collect rounding: f64.
        let mut sum: f64 = row.iter().take(radius).map(|&v| f64::from(v)).sum();
        for (x, out) in across.row_mut(y).iter_mut().enumerate() {
            if x + radius < width {
                sum += f64::from(row[x + radius]);
            }
            if x > radius {
                sum -= f64::from(row[x - radius - 1]);
            }
            let count = (x + radius + 1).min(width) - x.saturating_sub(radius);
            *out = (sum / count as f64) as f32;
        }
    }
    let mut mean = Grid::new(width, height, 0.0f32);
    let mut sums = vec![0.0f64; width];
    let add = |sums: &mut [f64], row: &[f32], sign: f64| {
        for (s, &v) in sums.iter_mut().zip(row) {
            *s += sign * f64::from(v);
        }
    };
    for y in 0..radius.min(height) {
        add(&mut sums, across.row(y), 1.0);
    }
    for y in 0..height {
        if y + radius < height {
            add(&mut sums, across.row(y + radius), 1.0);
        }
        if y > radius {
            add(&mut sums, across.row(y - radius - 1), -1.0);
        }
        let count = (y + radius + 1).min(height) - y.saturating_sub(radius);
        let scale = 1.0 / count as f64;
        for (out, s) in mean.row_mut(y).iter_mut().zip(&sums) {
            *out = (s * scale) as f32;
        }
    }
    mean
}

/// The picture less its [`box_mean`].
pub fn less_box_mean(picture: &Grid<f32>, radius: usize) -> Grid<f32> {
    let mut rest = box_mean(picture, radius);
    for (out, &v) in rest.data_mut().iter_mut().zip(picture.data()) {
        *out = v - *out;
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_the_mean_of_what_lies_on_the_picture() {
        let picture = Grid::from_fn(9, 7, |x, y| (x * x + 3 * y) as f32);
        let mean = box_mean(&picture, 2);
        for y in 0..7usize {
            for x in 0..9usize {
                let (mut sum, mut count) = (0.0, 0.0);
                for v in y.saturating_sub(2)..(y + 3).min(7) {
                    for u in x.saturating_sub(2)..(x + 3).min(9) {
                        sum += picture[(u, v)];
                        count += 1.0;
                    }
                }
                assert!((mean[(x, y)] - sum / count).abs() < 1e-4);
            }
        }
    }

    #[test]
    fn takes_a_radius_larger_than_the_picture() {
        let picture = Grid::from_fn(5, 4, |x, _| x as f32);
        assert!(box_mean(&picture, 30).data().iter().all(|&v| v == 2.0));
    }
}
