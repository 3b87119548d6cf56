//! One region of the coarse-to-fine solver: its motion and its own inverse depth. `fit.rs` improves them.

use super::evidence::Evidence;
use crate::camera::RigidMotion;
use crate::depth::{Bends, FieldPrior, Plane};
use crate::grid::Grid;
use crate::motion::Kind;
use crate::warp::{Linearisation, Scale};
use crate::window::Window;

/// Inverse depth is kept between these; the region's mean is 1.
pub(super) const RHO_RANGE: [f32; 2] = [0.02, 20.0];
/// Pixels over which a surface's slope is taken for the same.
const SLOPE: f64 = 8.0;

/// A region.
#[derive(Clone, Debug)]
pub(super) struct Region {
    pub motion: RigidMotion,
    pub kind: Kind,
    pub rho: Grid<f32>,
    /// What the smoothness of its depth counts, as a share of μ.
    pub stiffness: f64,
    /// How much brighter its pixels become: bodies turn under their lamps. Grey levels.
    pub shade: Grid<f32>,
}

impl Region {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            motion: RigidMotion::default(),
            kind: Kind::Full,
            stiffness: 1.0,
            rho: Grid::new(width, height, 1.0),
            shade: Grid::new(width, height, 0.0),
        }
    }

    /// The same with depth in `window` alone.
    pub fn cropped(&self, window: &Window) -> Self {
        Self {
            rho: window.crop(&self.rho),
            shade: window.crop(&self.shade),
            ..*self
        }
    }

    /// The constraint around what it is at present, for depth in `window` alone.
    pub fn linearise(&self, scale: &Scale, window: Window) -> Linearisation {
        let mut line = scale.linearise(&self.motion, &self.rho, window);
        line.allow_for(&self.shade);
        line
    }

    /// Takes over what has been found in `window`; beyond it depth goes on as the plane does that fits it
    /// best where it is `certain`.
    pub fn take(&mut self, part: &Self, window: &Window, certain: &Grid<f32>) {
        let plane = Plane::fit(&part.rho, certain);
        let (left, top) = (window.left as f64, window.top as f64);
        self.rho = Grid::from_fn(self.rho.width(), self.rho.height(), |x, y| {
            let rho = plane.at(x as f64 - left, y as f64 - top) as f32;
            rho.clamp(RHO_RANGE[0], RHO_RANGE[1])
        });
        window.paste(&part.rho, &mut self.rho);
        self.shade.data_mut().fill(0.0);
        window.paste(&part.shade, &mut self.shade);
        self.motion = part.motion;
        self.kind = part.kind;
        self.stiffness = part.stiffness;
    }

    /// What the relief of the owned pixels costs.
    pub fn relief_energy(&self, prior: &FieldPrior, evidence: &Evidence) -> f64 {
        let owned = evidence.owned.data().iter().zip(self.rho.data());
        prior.relief
            * owned
                .map(|(&w, &rho)| f64::from(w * (rho - 1.0).powi(2)))
                .sum::<f64>()
    }

    /// Mean ρ over the owned pixels back to 1, T with it.
    pub fn normalise(&mut self, owned: &Grid<f32>) {
        let (mut sum, mut count) = (0.0f64, 0.0f64);
        for (&rho, &w) in self.rho.data().iter().zip(owned.data()) {
            sum += f64::from(rho * w);
            count += f64::from(w);
        }
        if count < 1.0 {
            return;
        }
        let mean = sum / count;
        self.motion.translation *= mean;
        for rho in self.rho.data_mut() {
            *rho = (*rho / mean as f32).clamp(RHO_RANGE[0], RHO_RANGE[1]);
        }
    }

    /// How ρ departs from the surfaces that are free, or from its own slope: what is smoothed.
    pub fn bends(
        &self,
        linearisation: &Linearisation,
        evidence: &Evidence,
        weight: &Grid<f32>,
    ) -> Bends {
        let owned = &evidence.owned;
        match evidence.uncharged() {
            Some(surface) => {
                Bends::about_slope(&surface.departure(&self.rho), owned, [0.0; 2], SLOPE)
            }
            None => {
                let plane = Plane::fit(&self.rho, &certainty(linearisation, weight));
                Bends::about_slope(&self.rho, owned, plane.slope(), SLOPE)
            }
        }
    }
}

/// ω a²: how far the pixels tell depth.
pub(super) fn certainty(linearisation: &Linearisation, weight: &Grid<f32>) -> Grid<f32> {
    let mut certain = weight.clone();
    for (c, row) in certain.data_mut().iter_mut().zip(linearisation.rows.data()) {
        *c *= row[0] * row[0];
    }
    certain
}
