//! Means over a square window.

use crate::grid::Grid;

/// The mean over (2r+1)² pixels, the border repeated outwards.
pub(super) fn box_blur(plane: &mut Grid<f32>, radius: usize, spare: &mut Grid<f32>) {
    let (width, height) = (plane.width(), plane.height());
    let share = 1.0 / (2 * radius + 1) as f32;
    for y in 0..height {
        let row = plane.row(y);
        let out = spare.row_mut(y);
        let at = |x: isize| row[x.clamp(0, width as isize - 1) as usize];
        let edge = radius.min(width);
        for x in (0..edge).chain(width.saturating_sub(radius).max(edge)..width) {
            let sum: f32 = (0..=2 * radius)
                .map(|d| at((x + d) as isize - radius as isize))
                .sum();
            out[x] = sum * share;
        }
        if width > 2 * radius {
            let inner = &mut out[radius..width - radius];
            let n = inner.len();
            inner.copy_from_slice(&row[..n]);
            for d in 1..=2 * radius {
                for (o, v) in inner.iter_mut().zip(&row[d..d + n]) {
                    *o += v;
                }
            }
            inner.iter_mut().for_each(|o| *o *= share);
        }
    }
    for y in 0..height {
        let at = |d: usize| (y + d).saturating_sub(radius).min(height - 1);
        let out = plane.row_mut(y);
        out.copy_from_slice(spare.row(at(0)));
        for d in 1..=2 * radius {
            for (o, v) in out.iter_mut().zip(spare.row(at(d))) {
                *o += v;
            }
        }
        out.iter_mut().for_each(|o| *o *= share);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_a_mean() {
        let mut plane = Grid::from_fn(17, 13, |x, y| (x * x + 3 * y) as f32);
        let old = plane.clone();
        box_blur(&mut plane, 2, &mut Grid::new(17, 13, 0.0));
        for (x, y) in [(0, 0), (8, 6), (16, 12), (1, 11)] {
            let mut sum = 0.0;
            for dy in -2isize..=2 {
                for dx in -2isize..=2 {
                    sum += old.clamped(x as isize + dx, y as isize + dy);
                }
            }
            assert!((plane[(x, y)] - sum / 25.0).abs() < 1e-3);
        }
    }
}
