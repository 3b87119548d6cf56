//! From level sets to labels, and back.

use crate::frames::blur;
use crate::grid::Grid;

/// Standard deviation of the Gaussian that turns labels into level sets of their outlines, in pixels of the labels.
const BLUR: f32 = 0.7;

/// Who is where: k where φk is the largest above 0, 0 outside all curves.
pub fn labels(phi: &[Grid<f32>], width: usize, height: usize) -> Grid<u8> {
    let mut labels = Grid::new(width, height, 0u8);
    let mut highest = vec![0.0f32; width];
    for y in 0..height {
        highest.fill(0.0);
        for (k, phi) in (1..).zip(phi) {
            let row = labels.row_mut(y).iter_mut().zip(&mut highest);
            for ((label, highest), &phi) in row.zip(phi.row(y)) {
                *label = if phi > *highest { k } else { *label };
                *highest = if phi > *highest { phi } else { *highest };
            }
        }
    }
    labels
}

/// The level set of what is `inside`: how much more of the surroundings are than are not, in pixels. Labels were found in
/// pixels `side` times as large.
pub(crate) fn smoothed(inside: &Grid<bool>, side: f32) -> Grid<f32> {
    let signs = inside.map(|inside| if inside { 1.0 } else { -1.0 });
    blur(&signs, f64::from(BLUR * side)).map(|share| side * share)
}

/// Pixels of which one labelling says something else than another of the same size.
pub(crate) fn differing(one: &[u8], other: &[u8]) -> usize {
    one.iter().zip(other).filter(|(a, b)| a != b).count()
}
