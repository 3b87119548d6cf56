//! A region as one plane: image motion of eight numbers, before depth is looked for.
//!
//! ```text
//! u = p0 + p1 x + p2 y + p6 x² + p7 xy        v = p3 + p4 x + p5 y + p6 xy + p7 y²
//! ```
//!
//! in units of f, x and y from the principal point in units of f: what (1) gives for a plane. Fitted by Gauss–Newton on
//! residuals with Geman–McClure weights; first a shift is searched for among whole pixels of a coarse scale.

use super::super::scale::Scale;
use super::normal_equations::Support;
use crate::linalg::solve;
use crate::spread::spread;

/// Largest shift that is tried, as a share of the frame's sides.
const REACH: f32 = 0.15;
/// What a pixel of shift costs, grey levels: of equal shifts the smallest.
const SHIFT_COST: f32 = 0.1;
/// Where a residual of the search stops counting, grey levels.
const SATURATION: f32 = 60.0;

/// Image motion of a plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PlanarFlow {
    pub p: [f32; 8],
    /// σ of what it leaves, grey levels; 0 before a fit.
    pub sigma: f32,
}

/// How many of the numbers are fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Degree {
    Shift,
    Affine,
    Plane,
}

impl Degree {
    fn free(self) -> &'static [usize] {
        match self {
            Self::Shift => &[0, 3],
            Self::Affine => &[0, 1, 2, 3, 4, 5],
            Self::Plane => &[0, 1, 2, 3, 4, 5, 6, 7],
        }
    }
}

impl PlanarFlow {
    /// Image motion at (x, y), all in units of f.
    #[inline(always)]
    pub fn at(&self, x: f32, y: f32) -> (f32, f32) {
        let p = &self.p;
        let bend = p[6] * x + p[7] * y;
        (
            p[0] + p[1] * x + p[2] * y + bend * x,
            p[3] + p[4] * x + p[5] * y + bend * y,
        )
    }

    /// The shift by whole pixels of `scale` under which the region's pixels look most alike.
    pub fn search(scale: &Scale, support: &Support) -> Self {
        let focal = scale.camera.focal as f32;
        let reach = |side: usize| (side as f32 * REACH) as isize;
        let (rx, ry) = (reach(scale.width), reach(scale.height));
        let window = support.window;
        // Every second pixel of a large region tells enough.
        let stride = if window.width * window.height > 1500 {
            2
        } else {
            1
        };
        let mut best = (f32::INFINITY, 0, 0);
        for dy in -ry..=ry {
            for dx in -rx..=rx {
                let (mut sum, mut count) = (0.0f32, 0u32);
                for y in (window.top..window.top + window.height).step_by(stride) {
                    let to_y = y as isize + dy;
                    if to_y < 0 || to_y >= scale.height as isize {
                        continue;
                    }
                    let first = scale.first.row(y);
                    let labels = support.labels.row(y);
                    for x in (window.left..window.left + window.width).step_by(stride) {
                        let to_x = x as isize + dx;
                        if labels[x] == support.label && to_x >= 0 && to_x < scale.width as isize {
                            let value = scale.second.pixel(to_x as usize, to_y as usize);
                            sum += (value - first[x]).abs().min(SATURATION);
                            count += 1;
                        }
                    }
                }
                let cost = sum / count as f32 + SHIFT_COST * (dx as f32).hypot(dy as f32);
                if count > 10 && cost < best.0 {
                    best = (cost, dx, dy);
                }
            }
        }
        let mut flow = Self::default();
        flow.p[0] = best.1 as f32 / focal;
        flow.p[3] = best.2 as f32 / focal;
        flow
    }

    /// Fits it to the region's pixels at `scale`, in `steps` steps.
    pub fn fit(&mut self, scale: &Scale, support: &Support, degree: Degree, steps: usize) {
        let mut sigma = 20.0;
        let mut residuals: Vec<f32> = Vec::new();
        for _ in 0..steps {
            let mut sums = [[0.0f32; 9]; 9];
            residuals.clear();
            let cut = 1.0 / (2.5f32 * sigma).powi(2);
            self.for_each(scale, support, |x, y, [e, gx, gy]| {
                residuals.push(e);
                let weight = 1.0 / (1.0 + e * e * cut);
                let along = gx * x + gy * y;
                let row = [
                    gx,
                    gx * x,
                    gx * y,
                    gy,
                    gy * x,
                    gy * y,
                    along * x,
                    along * y,
                    e,
                ];
                for a in 0..9 {
                    let weighted = weight * row[a];
                    for b in a..9 {
                        sums[a][b] += weighted * row[b];
                    }
                }
            });
            if residuals.len() < 20 {
                return;
            }
            sigma = (spread(&mut residuals) as f32).max(1.0);
            self.sigma = sigma;
            let free = degree.free();
            let mut a = [[0.0; 8]; 8];
            let mut b = [0.0; 8];
            for i in 0..8 {
                if !free.contains(&i) {
                    a[i][i] = 1.0;
                    continue;
                }
                for &j in free {
                    a[i][j] = f64::from(sums[i.min(j)][i.max(j)]);
                }
                a[i][i] = a[i][i] * 1.0001 + 1.0;
                b[i] = f64::from(-sums[i][8]);
            }
            let Some(step) = solve(&a, &b) else {
                return;
            };
            for (p, d) in self.p.iter_mut().zip(step) {
                *p += d as f32;
            }
        }
    }

    /// Calls with each pixel of the region that can be compared: its place, its residual, and the mean gradient of
    /// both frames times f.
    pub fn for_each(
        &self,
        scale: &Scale,
        support: &Support,
        mut each: impl FnMut(f32, f32, [f32; 3]),
    ) {
        let focal = scale.camera.focal as f32;
        let share = 1.0 / focal;
        let window = support.window;
        for py in window.top..window.top + window.height {
            let y = (py as f32 - scale.camera.cy as f32) * share;
            let labels = support.labels.row(py);
            let first = scale.first.row(py);
            let [across, down] = [&scale.gradient[0], &scale.gradient[1]].map(|g| g.row(py));
            for px in window.left..window.left + window.width {
                if labels[px] != support.label {
                    continue;
                }
                let x = (px as f32 - scale.camera.cx as f32) * share;
                let (u, v) = self.at(x, y);
                let (to_x, to_y) = (px as f32 + u * focal, py as f32 + v * focal);
                if scale.contains(to_x, to_y) {
                    let [value, gx, gy] = scale.second.with_gradient(to_x, to_y);
                    let half = 0.5 * focal;
                    let e = value - first[px];
                    each(x, y, [e, half * (gx + across[px]), half * (gy + down[px])]);
                }
            }
        }
    }
}
