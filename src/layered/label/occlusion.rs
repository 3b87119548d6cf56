//! What the second frame hides.
//!
//! A pixel of the background that goes where a region in front goes too cannot be seen there: its residual says nothing.
//! It is charged what it costs to match by chance, unless it fits better. Without this the strip that a thing covers as it
//! moves fits nobody, and falls to whoever fits by chance. Curves are in front of the background.

use super::super::estimate::State;
use super::super::scale::Scale;
use super::data_cost::inside;
use crate::grid::Grid;

/// Places of the second frame that regions share before one is said to hide the other.
const MEETING: usize = 10;

/// Which regions are seen at each place of the second frame, a bit for each.
pub(in crate::layered) struct Occlusion {
    seen: Grid<u8>,
    regions: usize,
}

impl Occlusion {
    /// Where the pixels of all regions but the background go.
    pub fn of(scale: &Scale, level: usize, states: &[&State], labels: &Grid<u8>) -> Self {
        let mut seen = Grid::new(scale.width, scale.height, 0u8);
        let (width, height) = (scale.width as f32, scale.height as f32);
        for (k, state) in states.iter().enumerate().skip(1) {
            for_each_target(scale, level, state, |x, y, to_x, to_y| {
                if usize::from(labels[(x, y)]) != k {
                    return;
                }
                // All four pixels around: what spreads leaves no gaps.
                let (left, top) = (to_x.floor(), to_y.floor());
                for (px, py) in [
                    (left, top),
                    (left + 1.0, top),
                    (left, top + 1.0),
                    (left + 1.0, top + 1.0),
                ] {
                    if px >= 0.0 && py >= 0.0 && px < width && py < height {
                        seen[(px as usize, py as usize)] |= 1 << k;
                    }
                }
            });
        }
        Self {
            seen,
            regions: states.len(),
        }
    }

    /// The regions in front that are seen at a place of the second frame.
    pub fn at(&self, x: f32, y: f32) -> u8 {
        let (x, y) = (x.round(), y.round());
        let inside =
            x >= 0.0 && y >= 0.0 && x < self.seen.width() as f32 && y < self.seen.height() as f32;
        if inside {
            self.seen[(x as usize, y as usize)]
        } else {
            0
        }
    }

    /// Charges hidden pixels of the background at most what chance would; which regions hide some of it.
    pub fn excuse(
        &self,
        scale: &Scale,
        level: usize,
        background: &State,
        chance: &Grid<f32>,
        costs: &mut Grid<f32>,
    ) -> Vec<bool> {
        let mut hidden = vec![0; self.regions];
        for_each_target(scale, level, background, |x, y, to_x, to_y| {
            let seen = self.at(to_x, to_y);
            if seen == 0 {
                return;
            }
            let (cost, chance) = (&mut costs[(x, y)], chance[(x, y)]);
            if *cost > chance {
                *cost = chance;
                for (k, hidden) in hidden.iter_mut().enumerate() {
                    *hidden += usize::from(seen >> k & 1);
                }
            }
        });
        hidden.iter().map(|&count| count >= MEETING).collect()
    }
}

/// Calls with every pixel that a surface reaches and the place that it goes to.
fn for_each_target(
    scale: &Scale,
    level: usize,
    state: &State,
    mut each: impl FnMut(usize, usize, f32, f32),
) {
    let window = inside(&state.surface.window(), level, scale);
    let target = state.pose().target(scale);
    let mut rho = vec![1.0; window.width];
    for y in window.top..window.top + window.height {
        state.surface.row(level, y, window.left, &mut rho);
        for (n, rho) in rho.iter().enumerate() {
            let x = window.left + n;
            let (to_x, to_y) = target.of(x, y, *rho);
            each(x, y, to_x, to_y);
        }
    }
}
