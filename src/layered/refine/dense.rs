//! Dense inverse depth under one rigid motion, with its discontinuities, and the motion with it.
//!
//! x is ρ in pixels of image motion (ρ times the median of f |m|, see [`View`]). After each warp
//!
//! ```text
//! minimise  Σ ψ(e + e_x (x − x₀))/σ²  +  Σ λ_I [ φ(∂xx x) + φ(∂yy x) ],      φ(d) = δ² log(1 + d²/δ²)
//! λ_I = λ/(1 + |∇I|/20)
//! ```
//!
//! e is the difference of the frames in grey levels, σ its robust spread, ψ Geman and McClure's at 5σ. ψ and φ are
//! taken as squares with the weights of the present x, which makes the linear system of [`Lines`]. λ rises and δ falls
//! from warp to warp: first what the start has wrong is smoothed away, then what is smooth is made smooth, while
//! creases and steps are kept. From the third warp on, pixels near steps may change sides, see [`settle`].
//!
//! The first half of the warps change T (|T| held) and ω too, by one Gauss–Newton step with a change of ρ eliminated in each
//! 4×4 pixels. Pixels that are covered or leave the frame say nothing; those that leave continue what is seen.

use super::boundaries::settle;
use super::hidden::{continue_outside, hidden};
use super::linearisation::Linearisation;
use super::lines::{Bending, Lines};
use super::motion_step::motion_step;
use crate::camera::RigidMotion;
use crate::grid::Grid;
use crate::layered::scale::Scale;
use crate::layered::view::View;

/// Warps.
const WARPS: usize = 6;
/// λ at the first and the last warp, 1/px².
const SMOOTHNESS: [f32; 2] = [20.0, 5e4];
/// δ at the first and the last warp, px.
const CREASE: [f32; 2] = [0.4, 0.007];
/// Gradient at which λ has halved, grey levels a pixel.
const EDGE: f32 = 20.0;
/// Least weight of bending: nothing else holds pixels without data.
const LEAST_BENDING: f32 = 1e-4;
/// Shifts of the alternating directions, as shares of λ.
const SHIFTS: [f32; 3] = [1.0, 0.1, 1e-2];
/// A pixel is covered by what is nearer by more than this many pixels of image motion.
const COVERED: f32 = 0.7;
/// Where ψ turns, in σ.
const CLIP: f32 = 5.0;

/// Depth and motion of one region.
#[derive(Clone, Debug)]
pub struct Refined {
    /// ρ; its mean over the support is 1.
    pub rho: Grid<f32>,
    /// The motion; |T| is that which belongs to ρ.
    pub motion: RigidMotion,
}

/// Refines ρ from `start` for the pixels of `support`, and the motion. All grids are of the scale's size. `start` should be
/// right to a pixel or two of image motion; |T| must not be 0.
pub fn refine(
    scale: &Scale,
    motion: &RigidMotion,
    support: &Grid<bool>,
    start: Grid<f32>,
) -> Refined {
    let mut dense = Dense::new(scale, start);
    let mut motion = *motion;
    for warp in 0..WARPS {
        let share = warp as f32 / (WARPS - 1) as f32;
        let between = |[first, last]: [f32; 2]| first * (last / first).powf(share);
        let mut view = View::of(&scale.camera, &motion);
        let pixels = view.pixels_a_rho(support);
        if warp > 1 {
            settle(scale, &view, support, &mut dense.rho, pixels, dense.sigma);
        }
        dense.look(&view, support, pixels);
        if 2 * warp < WARPS {
            let compared = &mut dense.compared;
            motion_step(compared, &view, &dense.rho, dense.sigma, &mut motion);
            view = View::of(&scale.camera, &motion);
        }
        dense.smooth(&view, pixels, between(SMOOTHNESS), between(CREASE));
    }
    let mut rho = dense.rho;
    // A mean of 1 over the support, and T with it, which changes no image motion.
    let owned = rho.data().iter().zip(support.data()).filter(|(_, s)| **s);
    let (sum, count) = owned.fold((0.0, 0usize), |(sum, n), (&r, _)| {
        (sum + f64::from(r), n + 1)
    });
    let mean = sum / count.max(1) as f64;
    if mean > 1e-6 {
        rho.data_mut().iter_mut().for_each(|r| *r /= mean as f32);
        motion.translation *= mean;
    }
    Refined { rho, motion }
}

/// What a warp works on.
struct Dense<'a> {
    scale: &'a Scale,
    contrast: Grid<f32>,
    rho: Grid<f32>,
    hidden: Grid<bool>,
    compared: Linearisation,
    sigma: f32,
    bending: Bending,
    lines: Lines,
    x: Vec<f32>,
    pull: Vec<f32>,
}

impl<'a> Dense<'a> {
    fn new(scale: &'a Scale, start: Grid<f32>) -> Self {
        let (width, height) = (start.width(), start.height());
        let plane = || Grid::new(width, height, 0.0f32);
        let [gx, gy] = &scale.gradient;
        let mut contrast = gx.clone();
        for (c, gy) in contrast.data_mut().iter_mut().zip(gy.data()) {
            *c = c.hypot(*gy);
        }
        Self {
            scale,
            contrast,
            hidden: Grid::new(width, height, false),
            compared: Linearisation::new(width * height),
            sigma: 1.0,
            bending: Bending {
                data: plane(),
                across: plane(),
                down: plane(),
            },
            lines: Lines::new(width, height),
            x: vec![0.0; width * height],
            pull: vec![0.0; width * height],
            rho: start,
        }
    }

    /// Warps by the present ρ. `pixels` of image motion are a unit of ρ.
    fn look(&mut self, view: &View, support: &Grid<bool>, pixels: f32) {
        self.hidden = hidden(&self.rho, view, support, COVERED / pixels);
        continue_outside(&mut self.rho, view, &self.hidden, 1.0 / pixels);
        self.compared
            .compare(self.scale, view, &self.rho, support, &self.hidden);
        self.sigma = self.compared.spread();
    }

    /// One solve for ρ.
    fn smooth(&mut self, view: &View, pixels: f32, lambda: f32, delta: f32) {
        for (x, &r) in self.x.iter_mut().zip(self.rho.data()) {
            *x = r * pixels;
        }
        self.weigh_data(view, pixels);
        self.weigh_bending(lambda, delta);
        let shifts = SHIFTS.map(|s| s * lambda);
        self.lines
            .solve(&self.bending, &mut self.x, &self.pull, &shifts);
        for (r, &x) in self.rho.data_mut().iter_mut().zip(&self.x) {
            // Beyond a pixel the linearisation says nothing.
            let step = (x - *r * pixels).clamp(-1.0, 1.0);
            *r += step / pixels;
        }
    }

    fn weigh_data(&mut self, view: &View, pixels: f32) {
        let t = view.translation;
        let cut = 1.0 / (CLIP * self.sigma).powi(2);
        let precision = 1.0 / self.sigma.powi(2);
        let data = self.bending.data.data_mut();
        for (i, (a, pull)) in data.iter_mut().zip(&mut self.pull).enumerate() {
            let g = self.compared.gradient[i];
            let slope = (g[0] * t[0] + g[1] * t[1] + g[2] * t[2]) / pixels;
            let e = self.compared.residual[i];
            let weight = 1.0 / (1.0 + e * e * cut);
            // Where nothing is compared the slope is 0.
            let weight = weight * weight * precision;
            *a = weight * slope * slope;
            *pull = -weight * slope * e;
        }
    }

    fn weigh_bending(&mut self, lambda: f32, delta: f32) {
        let (width, height) = (self.rho.width(), self.rho.height());
        let inverse = 1.0 / (delta * delta);
        let weight = |d: f32, contrast: f32| {
            lambda / ((1.0 + contrast / EDGE) * (1.0 + d * d * inverse)) + LEAST_BENDING
        };
        let row = |y: usize| y * width..(y + 1) * width;
        for y in 0..height {
            let (x, contrast) = (&self.x[row(y)], self.contrast.row(y));
            let out = &mut self.bending.across.row_mut(y)[1..width - 1];
            for ((w, three), &c) in out.iter_mut().zip(x.windows(3)).zip(&contrast[1..]) {
                *w = weight(three[0] - 2.0 * three[1] + three[2], c);
            }
        }
        for y in 1..height - 1 {
            let [a, b, c] = [y - 1, y, y + 1].map(|y| &self.x[row(y)]);
            let contrast = self.contrast.row(y);
            let out = self.bending.down.row_mut(y);
            for i in 0..width {
                out[i] = weight(a[i] - 2.0 * b[i] + c[i], contrast[i]);
            }
        }
    }
}

#[cfg(test)]
mod tests;
