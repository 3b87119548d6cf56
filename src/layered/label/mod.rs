//! Stage 2 of a scale: which region each pixel belongs to.

mod components;
mod data_cost;
mod memory;
mod occlusion;
mod partition;

pub(super) use components::drop_small_components;
pub(super) use data_cost::{planar_cost, rigid_residual};
pub(super) use memory::Memory;
pub(super) use occlusion::Occlusion;
pub(super) use partition::LENGTH_OF_PULL;

use crate::grid::Grid;

/// The label of no region.
pub(super) const NOBODY: u8 = 255;

/// Labels of a scale so many times coarser: that of most of four pixels, else of one of them.
pub(super) fn coarsened(labels: &Grid<u8>, times: usize) -> Grid<u8> {
    let mut coarse = labels.clone();
    for _ in 0..times {
        let fine = coarse;
        coarse = Grid::from_fn(fine.width() / 2, fine.height() / 2, |x, y| {
            let (x, y) = (2 * x, 2 * y);
            let [a, b, c, d] = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|at| fine[at]);
            if a == b || a == c || a == d { a } else { b }
        });
    }
    coarse
}
