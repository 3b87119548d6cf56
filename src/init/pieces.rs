//! Pieces of bodies: which of them one rigid motion carries, and what lies between them.
//!
//! A place without a match sees, along its row and its column, the nearest matches to the left, to the right, above and
//! below. Where it sees two pieces, they may be one body behind a gap in the texture; they are when one rigid motion
//! explains both. Where it sees one body on three sides, it is part of it.

use super::epipolar::epipolar_motion;
use super::lattice::{Lattice, place};
use super::matches::Match;
use super::sample::{Carrier, Sample};
use crate::camera::Camera;
use crate::grid::Grid;

/// Places that have to see two pieces.
const SEEN: usize = 4;
/// Share of the matches of both that one motion has to explain.
const RIGID: f64 = 0.85;

/// The pieces, those that are one body joined.
pub fn joined(
    mut pieces: Vec<Vec<usize>>,
    samples: &[Sample],
    lattice: &Lattice,
    camera: &Camera,
) -> Vec<Vec<usize>> {
    'again: loop {
        let labels = labels(&pieces, samples, lattice);
        let count = pieces.len();
        let mut seen = vec![0usize; count * count];
        for_gaps(&labels, |_, sides| {
            let pieces = sides.map(|side| side.and_then(|label| label.checked_sub(1)));
            for a in pieces.iter().flatten() {
                for b in pieces.iter().flatten().filter(|b| *b > a) {
                    seen[a * count + b] += 1;
                }
            }
        });
        for a in 0..count {
            for b in a + 1..count {
                if seen[a * count + b] >= SEEN && rigid(&pieces[a], &pieces[b], samples, camera) {
                    let other = pieces.remove(b);
                    pieces[a].extend(other);
                    continue 'again;
                }
            }
        }
        return pieces;
    }
}

/// 1 where a body is, on the lattice and in its gaps, −1 where something else is, between them where neither is known.
pub fn field(body: &[usize], samples: &[Sample], lattice: &Lattice) -> Grid<f32> {
    let labels = labels(&[body.to_vec()], samples, lattice);
    let mut sign = labels.map(|label| match label {
        Some(1) => 1.0f32,
        Some(_) => -1.0,
        None => 0.0,
    });
    for_gaps(&labels, |at, sides| {
        if sides.iter().filter(|side| **side == Some(1)).count() >= 3 {
            sign[at] = 1.0;
        }
    });
    Grid::from_fn(sign.width(), sign.height(), |x, y| {
        let (mut sum, mut weight) = (sign[(x, y)], sign[(x, y)].abs());
        for (other, apart) in lattice.within((x, y), 2) {
            let w = (-0.7 * apart as f32).exp();
            sum += w * sign[other];
            weight += w * sign[other].abs();
        }
        if weight > 0.0 { sum / weight } else { -1.0 }
    })
}

/// 0 at matches that are of no piece, k + 1 at those of piece k.
fn labels(pieces: &[Vec<usize>], samples: &[Sample], lattice: &Lattice) -> Grid<Option<usize>> {
    let [across, down] = lattice.size();
    let mut labels = Grid::from_fn(across, down, |x, y| lattice.at((x, y)).map(|_| 0));
    for (k, piece) in pieces.iter().enumerate() {
        for &sample in piece {
            labels[place(&samples[sample].matched)] = Some(k + 1);
        }
    }
    labels
}

/// Calls `visit` with each place that has no label and the nearest labels on its four sides.
fn for_gaps(
    labels: &Grid<Option<usize>>,
    mut visit: impl FnMut((usize, usize), [Option<usize>; 4]),
) {
    let (across, down) = (labels.width(), labels.height());
    for y in 0..down {
        for x in 0..across {
            if labels[(x, y)].is_none() {
                let sides = [
                    (0..x).rev().find_map(|i| labels[(i, y)]),
                    (x + 1..across).find_map(|i| labels[(i, y)]),
                    (0..y).rev().find_map(|j| labels[(x, j)]),
                    (y + 1..down).find_map(|j| labels[(x, j)]),
                ];
                visit((x, y), sides);
            }
        }
    }
}

fn rigid(a: &[usize], b: &[usize], samples: &[Sample], camera: &Camera) -> bool {
    let [a, b] = [a, b].map(|piece| piece.iter().map(|&k| samples[k]).collect::<Vec<_>>());
    let matches: Vec<Match> = a.iter().chain(&b).map(|s| s.matched).collect();
    epipolar_motion(&matches, camera).is_some_and(|found| {
        let carrier = Carrier::new(&found.motion, camera);
        [a, b]
            .iter()
            .all(|piece| carrier.share_explained(piece) >= RIGID)
    })
}
