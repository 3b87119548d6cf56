//! The following pair of a film: what is known is carried to where the second frame has it.

use std::rc::Rc;

use super::label::NOBODY;
use super::scale::pyramid;
use super::solver::{Layered, Phase};
use crate::frames::FramePair;
use crate::grid::Grid;
use crate::options::Options;

impl Layered {
    /// Labels go where their pixels go, curves before the background; surfaces go along. Motions are those of the
    /// last pair. No search is due, only passes of each scale.
    pub(super) fn follow(&mut self, pair: Rc<FramePair>, options: &Options) {
        let (width, height) = (pair.width(), pair.height());
        let before = self.compose(options);
        let mut labels = Grid::new(width, height, NOBODY);
        let mut rho = Grid::new(width, height, 0.0f32);
        for y in 0..height {
            for x in 0..width {
                let at = (x, y);
                let to_x = (x as f32 + before.flow.u[at]).round();
                let to_y = (y as f32 + before.flow.v[at]).round();
                if to_x >= 0.0 && to_y >= 0.0 && to_x < width as f32 && to_y < height as f32 {
                    let to = (to_x as usize, to_y as usize);
                    let label = before.labels[at];
                    // Anything is before the background, and what is nearer before what is farther.
                    let nearer = before.depth[at].recip() > rho[to];
                    let free = labels[to] == NOBODY || labels[to] == 0 && label > 0;
                    if free || labels[to] == label && nearer {
                        labels[to] = label;
                        rho[to] = before.depth[at].recip();
                    }
                }
            }
        }
        for label in labels.data_mut() {
            if *label == NOBODY {
                *label = 0;
            }
        }
        self.carry_surfaces(&before.flow.u, &before.flow.v);
        self.scales = pyramid(&pair, self.scales[0].camera, options);
        self.pair = pair;
        self.small = None;
        self.far = 0.0;
        let known = !matches!(self.phase, Phase::Planar(_) | Phase::Search);
        self.level = self.first;
        self.put_labels(&labels);
        self.warm = known;
        self.phase = if known {
            Phase::Rigid(0)
        } else {
            Phase::Planar(0)
        };
        for region in &mut self.regions {
            region.dense = None;
            // Who comes to a halt and goes back moves against what was found.
            let mut back = region.state.clone();
            (back.translation, back.rotation) = (-back.translation, back.rotation.transpose());
            region.alternatives = vec![back];
        }
        self.fit_memory();
        self.fit_surfaces();
    }

    /// Each surface has at a place what it had where that came from, to first order.
    fn carry_surfaces(&mut self, u: &Grid<f32>, v: &Grid<f32>) {
        for k in 0..self.regions.len() {
            let (mut sum, mut count) = ([0.0f64; 2], 0.0f64);
            for (x, y) in self.owned(k) {
                let place = |at: usize, side: usize| (at << self.level).min(side - 1);
                let at = (place(x, u.width()), place(y, u.height()));
                sum[0] += f64::from(u[at]);
                sum[1] += f64::from(v[at]);
                count += 1.0;
            }
            if count > 0.0 {
                let shift = sum.map(|s| (s / count) as f32);
                let surface = &mut self.regions[k].state.surface;
                *surface = surface.shifted(shift);
            }
        }
    }
}
