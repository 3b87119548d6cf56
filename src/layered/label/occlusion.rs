//! What the second frame hides.
//!
//! A pixel of the background that goes where a region in front goes too cannot be seen there: its residual says nothing.
//! It is charged a constant instead, unless it fits better. Without this the strip that a thing covers as it moves
//! fits nobody, and falls to whoever fits by chance. Curves are in front of the background.

use crate::grid::Grid;

use super::super::estimate::State;
use super::super::scale::Scale;
use super::data_cost::inside;

/// Which regions are seen at each place of the second frame, a bit for each.
pub(crate) struct Cover {
    seen: Grid<u8>,
}

impl Cover {
    /// Where the pixels of all regions but the background go, as far as they look there as they should: at less
    /// than `confirmed`.
    pub fn of(
        scale: &Scale,
        level: usize,
        states: &[&State],
        labels: &Grid<u8>,
        costs: &[Grid<f32>],
        confirmed: f32,
    ) -> Self {
        let mut seen = Grid::new(scale.width, scale.height, 0u8);
        for (k, state) in states.iter().enumerate().skip(1) {
            for_each_target(scale, level, state, |x, y, to_x, to_y| {
                if usize::from(labels[(x, y)]) != k || costs[k][(x, y)] > confirmed {
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
                    if px >= 0.0 && py >= 0.0 && px < scale.width as f32 && py < scale.height as f32
                    {
                        seen[(px as usize, py as usize)] |= 1 << k;
                    }
                }
            });
        }
        Self { seen }
    }

    /// Whether another region than `k` is seen where one of its pixels goes.
    pub fn hides(&self, k: usize, x: f32, y: f32) -> bool {
        let (x, y) = (x.round(), y.round());
        x >= 0.0
            && y >= 0.0
            && x < self.seen.width() as f32
            && y < self.seen.height() as f32
            && self.seen[(x as usize, y as usize)] & !(1 << k) != 0
    }

    /// Charges hidden pixels of region `k` at most what chance would.
    pub fn excuse(
        &self,
        k: usize,
        scale: &Scale,
        level: usize,
        state: &State,
        chance: &Grid<f32>,
        costs: &mut Grid<f32>,
    ) {
        for_each_target(scale, level, state, |x, y, to_x, to_y| {
            let (cost, chance) = (&mut costs[(x, y)], chance[(x, y)]);
            if *cost > chance && self.hides(k, to_x, to_y) {
                *cost = chance;
            }
        });
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
    let (f, cx, cy) = (
        scale.camera.focal as f32,
        scale.camera.cx as f32,
        scale.camera.cy as f32,
    );
    let pose = state.pose();
    let (r, t) = (pose.rotation, pose.translation);
    let mut rho = vec![1.0; window.width];
    for y in window.top..window.top + window.height {
        state.surface.row(level, y, window.left, &mut rho);
        let down = (y as f32 - cy) / f;
        for (n, rho) in rho.iter().enumerate() {
            let x = window.left + n;
            let across = (x as f32 - cx) / f;
            let q: [f32; 3] =
                std::array::from_fn(|c| r[c][0] * across + r[c][1] * down + r[c][2] + rho * t[c]);
            let near = f / q[2].max(1e-3);
            each(x, y, q[0] * near + cx, q[1] * near + cy);
        }
    }
}
