//! Curves without islands: what a curve bounds is one thing, or a few pieces of like size.
//!
//! A pixel here and there is explained better by chance, by a shadow or by a highlight, wherever regions
//! leave room for it; one that is not connected with its region's main part is no evidence of it.
//! Pieces (four-connected, φ > 0) smaller than [`PIECE`] of the largest go, and so do holes smaller than
//! [`HOLE`] of it that do not reach the frame's border and belong to no other curve.

use super::redistance::redistance;
use crate::grid::Grid;

/// Least size of a piece, as a share of the largest.
const PIECE: f64 = 0.3;
/// Least size of a hole, as a share of the largest piece.
const HOLE: f64 = 0.05;

/// Removes islands and holes from every level set; those that change become signed distances.
pub fn without_islands(phi: &mut [Grid<f32>]) {
    for k in 0..phi.len() {
        let inside = phi[k].map(|p| p > 0.0);
        let pieces = Pieces::of(&inside, true);
        let Some(largest) = pieces.sizes.iter().max().map(|&n| n as f64) else {
            continue;
        };
        let holes = Pieces::of(&inside, false);
        let mut changed = false;
        for i in 0..inside.len() {
            let flips = match (pieces.number[i], holes.number[i]) {
                (Some(piece), _) => (pieces.sizes[piece] as f64) < PIECE * largest,
                (_, Some(hole)) => {
                    (holes.sizes[hole] as f64) < HOLE * largest
                        && !holes.at_border[hole]
                        && phi
                            .iter()
                            .enumerate()
                            .all(|(j, p)| j == k || p.data()[i] <= 0.0)
                }
                _ => false,
            };
            if flips {
                let p = &mut phi[k].data_mut()[i];
                *p = if *p > 0.0 { -1e-3 } else { 1e-3 };
                changed = true;
            }
        }
        if changed {
            redistance(&mut phi[k]);
        }
    }
}

/// The connected pieces of a mask.
struct Pieces {
    /// The piece that each pixel belongs to.
    number: Vec<Option<usize>>,
    sizes: Vec<usize>,
    at_border: Vec<bool>,
}

impl Pieces {
    /// The pieces of the pixels that are `value`.
    fn of(mask: &Grid<bool>, value: bool) -> Self {
        let (width, height) = (mask.width(), mask.height());
        let mut pieces = Self {
            number: vec![None; mask.len()],
            sizes: Vec::new(),
            at_border: Vec::new(),
        };
        let mut open = Vec::new();
        for start in 0..mask.len() {
            if mask.data()[start] != value || pieces.number[start].is_some() {
                continue;
            }
            let piece = pieces.sizes.len();
            let (mut size, mut border) = (0, false);
            pieces.number[start] = Some(piece);
            open.push(start);
            while let Some(i) = open.pop() {
                let (x, y) = (i % width, i / width);
                size += 1;
                border |= x == 0 || y == 0 || x + 1 == width || y + 1 == height;
                let mut visit = |j: usize| {
                    if mask.data()[j] == value && pieces.number[j].is_none() {
                        pieces.number[j] = Some(piece);
                        open.push(j);
                    }
                };
                if x > 0 {
                    visit(i - 1);
                }
                if x + 1 < width {
                    visit(i + 1);
                }
                if y > 0 {
                    visit(i - width);
                }
                if y + 1 < height {
                    visit(i + width);
                }
            }
            pieces.sizes.push(size);
            pieces.at_border.push(border);
        }
        pieces
    }
}
