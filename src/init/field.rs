//! The matches of a body as a number for each place of the lattice.
//!
//! A place without a match sees, along its row and its column, the nearest matches to the left, to the right, above and
//! below. Where it sees the body on three sides, it is part of it.

use super::lattice::{Lattice, place};
use super::sample::Sample;
use crate::grid::Grid;

/// 1 where a body is, on the lattice and in its gaps, −1 where something else is, between them where neither is known.
pub fn field(body: &[usize], samples: &[Sample], lattice: &Lattice) -> Grid<f32> {
    let [across, down] = lattice.size();
    let mut known = Grid::from_fn(across, down, |x, y| lattice.at((x, y)).map(|_| -1.0f32));
    for &k in body {
        known[place(&samples[k].matched)] = Some(1.0);
    }
    let sign = Grid::from_fn(across, down, |x, y| {
        known[(x, y)].unwrap_or_else(|| {
            let sides = [
                (0..x).rev().find_map(|i| known[(i, y)]),
                (x + 1..across).find_map(|i| known[(i, y)]),
                (0..y).rev().find_map(|j| known[(x, j)]),
                (y + 1..down).find_map(|j| known[(x, j)]),
            ];
            let own = sides.iter().filter(|side| **side == Some(1.0)).count();
            if own >= 3 { 1.0 } else { 0.0 }
        })
    });
    Grid::from_fn(across, down, |x, y| {
        let (mut sum, mut weight) = (sign[(x, y)], sign[(x, y)].abs());
        for (other, apart) in lattice.within((x, y), 2) {
            let w = (-0.7 * apart as f32).exp();
            sum += w * sign[other];
            weight += w * sign[other].abs();
        }
        if weight > 0.0 { sum / weight } else { -1.0 }
    })
}
