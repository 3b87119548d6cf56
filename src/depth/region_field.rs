//! The inverse depth of one region: the system that both depth and the joint motion step solve.
//!
//! ```text
//! E(ρ) = Σ ω_i (r + a δρ)² + Σ_edges c_ij ( ρ_j − ρ_i − s_ij )² + κ Σ (ρ − 1)²
//! ```
//!
//! ρ = 1/Z makes the data term linear. s is the step that is expected (`bends.rs`), lagged: what is smoothed is how
//! ρ bends, or how what departs from a cubic surface does (`polynomials.rs`). c is (11) or (12) of the bend over ε, lagged;
//! ε is a change of ρ per pixel of the frame, in units of mean ρ, and less on creases (`crease.rs`). The bend that c sees is averaged over a pixel or two: a fold is a line and stays, a pixel
//! that sticks out by itself, which is noise, is pulled back (Catté, Lions, Morel & Coll 1992). Edges that leave the
//! region count [`BEYOND`]: there smoothness only carries depth on, and what is carried on would else hold the surface
//! along its curve, as a frame does a cloth. Weights are in units of the noise's variance. κ keeps relief that nothing
//! shows from growing.

use super::bends::Bends;
use super::elliptic::Elliptic;
use crate::frames::blur;
use crate::grid::Grid;
use crate::options::Diffusion;

/// Standard deviation of the window over which bends are averaged before c sees them, in pixels.
const FOLD: f64 = 1.5;

/// What smoothness counts where an edge has an end outside of the region.
const BEYOND: f32 = 0.1;

/// Smoothness of a region's ρ.
#[derive(Clone, Debug)]
pub struct FieldPrior {
    /// (11) or (12).
    pub diffusion: Diffusion,
    /// Noise variance times the weight of smoothness, grey levels².
    pub strength: f64,
    /// ε, per pixel.
    pub epsilon: f64,
    /// The share of ε that holds for the step to the right, and for the one down, of every pixel; none for all of it.
    pub creases: Option<[Grid<f32>; 2]>,
    /// The region (> 0); none while everything counts as such.
    pub within: Option<Grid<f32>>,
    /// Weight of (ρ − 1)² at each pixel of the region, grey levels².
    pub relief: f64,
}

/// Weights of the edges to the right and below.
pub struct Edges {
    right: Vec<f32>,
    below: Vec<f32>,
}

impl FieldPrior {
    /// The same with `share` of its strength.
    pub fn softened(&self, share: f64) -> Self {
        Self {
            strength: share * self.strength,
            ..self.clone()
        }
    }

    /// c for every edge.
    pub fn edges(&self, bends: &Bends) -> Edges {
        let (width, height) = (bends.right.width(), bends.right.height());
        let e2 = (self.epsilon * self.epsilon) as f32;
        let flat = (self.strength as f32) / e2;
        let counts = |axis: usize, at: (usize, usize)| {
            let next = (at.0 + 1 - axis, at.1 + axis);
            match &self.within {
                Some(region) if region[at].min(region[next]) <= 0.0 => BEYOND,
                _ => 1.0,
            }
        };
        if self.diffusion == Diffusion::Isotropic {
            return Edges::new(width, height, |axis, at| flat * counts(axis, at));
        }
        let [right, down] = [&bends.right, &bends.down].map(|bend| blur(bend, FOLD));
        let fold2 = Grid::from_fn(width, height, |x, y| {
            right[(x, y)].powi(2) + down[(x, y)].powi(2)
        });
        Edges::new(width, height, |axis, at| {
            let share = self.creases.as_ref().map_or(1.0, |s| s[axis][at]);
            flat * counts(axis, at) / (1.0 + fold2[at] / (e2 * share * share)).sqrt()
        })
    }
}

impl Edges {
    /// `weight` of the edges to the right (axis 0) and below (1) of each pixel; none leads out of the grid.
    fn new(width: usize, height: usize, weight: impl Fn(usize, (usize, usize)) -> f32) -> Self {
        let right = |x, y| {
            if x + 1 < width {
                weight(0, (x, y))
            } else {
                0.0
            }
        };
        let below = |x, y| {
            if y + 1 < height {
                weight(1, (x, y))
            } else {
                0.0
            }
        };
        Self {
            right: Grid::from_fn(width, height, right).into_vec(),
            below: Grid::from_fn(width, height, below).into_vec(),
        }
    }

    /// The operator with data weights `data` on the diagonal.
    pub fn system(&self, width: usize, height: usize, data: Vec<f32>) -> Elliptic {
        Elliptic::new(width, height, data, self.right.clone(), self.below.clone())
    }

    /// How smoothing pulls on the field as it is: minus half the energy's gradient.
    pub fn pull(&self, bends: &Bends) -> Grid<f32> {
        let (width, height) = (bends.right.width(), bends.right.height());
        let mut pull = Grid::new(width, height, 0.0f32);
        let out = pull.data_mut();
        for y in 0..height {
            for x in 0..width {
                let i = y * width + x;
                if x + 1 < width {
                    let flux = self.right[i] * bends.right.data()[i];
                    out[i] += flux;
                    out[i + 1] -= flux;
                }
                if y + 1 < height {
                    let flux = self.below[i] * bends.down.data()[i];
                    out[i] += flux;
                    out[i + width] -= flux;
                }
            }
        }
        pull
    }

    /// γ = Σ h/(h + Σc): how many of the field's values the data weights h determine, the rest being
    /// smoothed over. Pixel by pixel, which counts each neighbour as known.
    pub fn determined(&self, data: &Grid<f32>) -> f64 {
        let around = |i: usize| {
            let mut sum = self.right[i] + self.below[i];
            if i > 0 {
                sum += self.right[i - 1];
            }
            if i >= data.width() {
                sum += self.below[i - data.width()];
            }
            f64::from(sum)
        };
        let each = data.data().iter().enumerate();
        each.filter(|(_, h)| **h > 0.0)
            .map(|(i, &h)| f64::from(h) / (f64::from(h) + around(i)))
            .sum()
    }

    /// Σ c (bend)² over the pixels that are `owned`: how the field goes on elsewhere is no part of (7).
    pub fn energy(&self, bends: &Bends, owned: &Grid<f32>) -> f64 {
        let (right, down) = (bends.right.data(), bends.down.data());
        let each = owned.data().iter().enumerate().map(|(i, &own)| {
            let bent = self.right[i] * right[i] * right[i] + self.below[i] * down[i] * down[i];
            f64::from(own * bent)
        });
        each.sum()
    }
}
