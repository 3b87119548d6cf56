//! One row of a region's pixels: where they go, what is left, and what that says of depth and motion.
//!
//! Symbols are those of `normal_equations.rs`. Quantity by quantity, so that loops run over slices of one length.

use super::super::scale::Scale;
use super::normal_equations::{BINS_PER_LEVEL, Support};
use crate::frames::LANES;
use crate::layered::view::View;

/// One row of pixels.
#[derive(Default)]
pub(super) struct Rows {
    pub rho: Vec<f32>,
    /// R r.
    pub ray: [Vec<f32>; 3],
    /// q_x/q_z, q_y/q_z and 1/q_z.
    pub place: [Vec<f32>; 3],
    pub residual: Vec<f32>,
    pub weight: Vec<f32>,
    /// h.
    pub lever: [Vec<f32>; 3],
    /// h·T.
    pub slope: Vec<f32>,
    /// The five derivatives by motion.
    pub by_motion: [Vec<f32>; 5],
    /// Sums down the rows of a cell, for each column of pixels.
    pub square: [Vec<f32>; 3],
    pub cross: [[Vec<f32>; 2]; 6],
}

impl Rows {
    /// Makes room for so many pixels.
    pub fn fit(&mut self, count: usize) {
        let singles = [
            &mut self.rho,
            &mut self.residual,
            &mut self.weight,
            &mut self.slope,
        ];
        let groups = (self.ray.iter_mut())
            .chain(&mut self.place)
            .chain(&mut self.lever)
            .chain(&mut self.by_motion)
            .chain(&mut self.square)
            .chain(self.cross.as_flattened_mut());
        for row in groups.chain(singles) {
            row.resize(count, 0.0);
        }
    }

    pub fn clear_sums(&mut self) {
        let sums = (self.square.iter_mut()).chain(self.cross.as_flattened_mut());
        for row in sums {
            row.fill(0.0);
        }
    }

    /// Where the row's pixels go.
    pub fn project(&mut self, scale: &Scale, view: &View, left: usize, y: usize) {
        let n = self.rho.len();
        let share = 1.0 / scale.camera.focal as f32;
        let down = (y as f32 - scale.camera.cy as f32) * share;
        let first = (left as f32 - scale.camera.cx as f32) * share;
        let (r, t) = (&view.rotation, view.translation);
        let start: [f32; 3] = std::array::from_fn(|c| r[c][0] * first + r[c][1] * down + r[c][2]);
        let step: [f32; 3] = std::array::from_fn(|c| r[c][0] * share);
        let [ax, ay, az] = &mut self.ray;
        let [px, py, pz] = &mut self.place;
        let (ax, ay, az) = (&mut ax[..n], &mut ay[..n], &mut az[..n]);
        let (px, py, pz) = (&mut px[..n], &mut py[..n], &mut pz[..n]);
        for i in 0..n {
            let (rho, at) = (self.rho[i], i as f32);
            let ray = [
                start[0] + step[0] * at,
                start[1] + step[1] * at,
                start[2] + step[2] * at,
            ];
            let near = 1.0 / (ray[2] + rho * t[2]).max(1e-3);
            ax[i] = ray[0];
            ay[i] = ray[1];
            az[i] = ray[2];
            px[i] = (ray[0] + rho * t[0]) * near;
            py[i] = (ray[1] + rho * t[1]) * near;
            pz[i] = near;
        }
    }

    /// Residuals and the second frame's gradient; weight 1 where there is something to compare.
    pub fn compare(&mut self, scale: &Scale, support: &Support, y: usize, histogram: &mut [u32]) {
        let (n, last) = (self.rho.len(), histogram.len() - 1);
        let left = support.window.left;
        let (f, cx, cy) = (
            scale.camera.focal as f32,
            scale.camera.cx as f32,
            scale.camera.cy as f32,
        );
        let labels = &support.labels.row(y)[left..left + n];
        let offered = support
            .offered
            .map_or(labels, |o| &o.row(y)[left..left + n]);
        let first = &scale.first.row(y)[left..left + n];
        let [px, py, _] = &self.place;
        let [gx, gy, _] = &mut self.lever;
        for start in (0..n).step_by(LANES) {
            let count = (n - start).min(LANES);
            // Beyond the row's end the last pixel stands again.
            let lanes = std::array::from_fn(|i| start + i.min(count - 1));
            let to_x = lanes.map(|i| px[i] * f + cx);
            let to_y = lanes.map(|i| py[i] * f + cy);
            let belongs: [bool; LANES] = std::array::from_fn(|n| {
                let i = lanes[n];
                (labels[i] == support.label || offered[i] == support.label)
                    && scale.contains(to_x[n], to_y[n])
            });
            let [value, across, down] = if belongs.contains(&true) {
                scale.second.four_with_gradient(to_x, to_y)
            } else {
                [[0.0; LANES]; 3]
            };
            for (n, i) in (start..start + count).enumerate() {
                (self.residual[i], gx[i], gy[i], self.weight[i]) = if belongs[n] {
                    let residual = value[n] - first[i];
                    let bin = (residual.abs() * BINS_PER_LEVEL) as usize;
                    histogram[bin.min(last)] += 1;
                    (residual, across[n], down[n], 1.0)
                } else {
                    Default::default()
                };
            }
        }
    }

    /// h, h·T and the robust weights; the row's cost.
    pub fn weigh(
        &mut self,
        scale: &Scale,
        view: &View,
        left: usize,
        y: usize,
        inverse: f32,
    ) -> f64 {
        let n = self.rho.len();
        let f = scale.camera.focal as f32;
        let [gx, gy] = &scale.gradient;
        let (gx, gy) = (&gx.row(y)[left..left + n], &gy.row(y)[left..left + n]);
        let [px, py, pz] = &self.place;
        let (px, py, pz) = (&px[..n], &py[..n], &pz[..n]);
        let [hx, hy, hz] = &mut self.lever;
        let (hx, hy, hz) = (&mut hx[..n], &mut hy[..n], &mut hz[..n]);
        let (residual, weight) = (&self.residual[..n], &mut self.weight[..n]);
        let slope = &mut self.slope[..n];
        let t = view.translation;
        let mut cost = [0.0f32; 8];
        for i in 0..n {
            let square = residual[i] * residual[i];
            let root = 1.0 / (1.0 + square * inverse);
            cost[i % 8] += square * root * weight[i];
            weight[i] *= root * root;
            let near = f * pz[i];
            hx[i] = 0.5 * (hx[i] + gx[i]) * near;
            hy[i] = 0.5 * (hy[i] + gy[i]) * near;
            hz[i] = -(hx[i] * px[i] + hy[i] * py[i]);
            slope[i] = hx[i] * t[0] + hy[i] * t[1] + hz[i] * t[2];
        }
        f64::from(cost.iter().sum::<f32>())
    }

    /// Adds the row to the sums down its cells, `below` being how far down it lies in them.
    pub fn sum_down(&mut self, [b, c]: [[f32; 3]; 2], below: f32) {
        let n = self.rho.len();
        let weights = [1.0 - below, below];
        let pairs = [
            weights[0] * weights[0],
            weights[0] * weights[1],
            weights[1] * weights[1],
        ];
        let (weight, slope, rho) = (&self.weight[..n], &self.slope[..n], &self.rho[..n]);
        let [s0, s1, s2] = &mut self.square;
        let (s0, s1, s2) = (&mut s0[..n], &mut s1[..n], &mut s2[..n]);
        for i in 0..n {
            let square = weight[i] * slope[i] * slope[i];
            s0[i] += pairs[0] * square;
            s1[i] += pairs[1] * square;
            s2[i] += pairs[2] * square;
        }
        {
            let [ax, ay, az] = &self.ray;
            let (ax, ay, az) = (&ax[..n], &ay[..n], &az[..n]);
            let [hx, hy, hz] = &self.lever;
            let (hx, hy, hz) = (&hx[..n], &hy[..n], &hz[..n]);
            let [m0, m1, m2, m3, m4] = &mut self.by_motion;
            let (m0, m1, m2) = (&mut m0[..n], &mut m1[..n], &mut m2[..n]);
            let (m3, m4) = (&mut m3[..n], &mut m4[..n]);
            for i in 0..n {
                let (x, y, z) = (hx[i], hy[i], hz[i]);
                m0[i] = rho[i] * (x * b[0] + y * b[1] + z * b[2]);
                m1[i] = rho[i] * (x * c[0] + y * c[1] + z * c[2]);
                m2[i] = ay[i] * z - az[i] * y;
                m3[i] = az[i] * x - ax[i] * z;
                m4[i] = ax[i] * y - ay[i] * x;
            }
        }
        let derivatives = self.by_motion.iter().chain([&self.residual]);
        for (sums, derivative) in self.cross.iter_mut().zip(derivatives) {
            let derivative = &derivative[..n];
            let [above, under] = sums;
            let (above, under) = (&mut above[..n], &mut under[..n]);
            for i in 0..n {
                let product = weight[i] * slope[i] * derivative[i];
                above[i] += weights[0] * product;
                under[i] += weights[1] * product;
            }
        }
    }

    /// Adds the row's products of derivatives by motion, eight lanes at a time.
    pub fn sum_motion(&self, lanes: &mut [[[f32; 8]; 6]; 6]) {
        let [m0, m1, m2, m3, m4] = &self.by_motion;
        let all = [m0, m1, m2, m3, m4, &self.residual];
        let n = self.rho.len();
        for start in (0..n).step_by(8) {
            let count = (n - start).min(8);
            let eight = |row: &[f32]| -> [f32; 8] {
                if count == 8 {
                    row[start..start + 8].try_into().unwrap_or_default()
                } else {
                    std::array::from_fn(|i| if i < count { row[start + i] } else { 0.0 })
                }
            };
            let weight = eight(&self.weight);
            let values = all.map(|row| eight(row));
            for a in 0..6 {
                let weighted: [f32; 8] = std::array::from_fn(|i| weight[i] * values[a][i]);
                for b in a..6 {
                    for i in 0..8 {
                        lanes[a][b][i] += weighted[i] * values[b][i];
                    }
                }
            }
        }
    }
}
