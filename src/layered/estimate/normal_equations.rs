//! One pass over a region's pixels: what they say of its motion and of its surface, as normal equations.
//!
//! A pixel with ray r = ((x − cx)/f, (y − cy)/f, 1) and inverse depth ρ goes to the image of q = R r + ρ T. With
//! h = (f/q_z)(g_x, g_y, −(g_x q_x + g_y q_y)/q_z), g the mean of both frames' gradients, its residual
//! e = I2(π(q)) − I1 changes to first order by
//!
//! ```text
//! δe = h·T δρ + ρ h·δT + (R r × h)·δω
//! ```
//!
//! and counts with the weight of the Geman–McClure cost c(e) = e²/(1 + e²/(κσ)²), grey levels²:
//! w = (1 + e²/(κσ)²)⁻². Sums are kept by cell of the control grid for ρ, and over the region for the rest.

use crate::grid::Grid;
use crate::window::Window;

use super::super::models::Problem;
use super::super::scale::Scale;
use super::step::State;
use super::surface::Surface;

/// κ: a residual of so many σ counts half its square.
pub(crate) const CUT: f32 = 3.0;
/// Bins of the histogram from which σ comes, and bins a grey level.
const BINS: usize = 512;
const BINS_PER_LEVEL: f32 = 8.0;

/// A rigid motion as the pixel loops want it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub rotation: [[f32; 3]; 3],
    pub translation: [f32; 3],
    /// Two directions perpendicular to T and as long.
    pub tangent: [[f32; 3]; 2],
}

/// Where pixels go.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    pose: Pose,
    focal: f32,
    centre: [f32; 2],
}

impl Pose {
    /// Where pixels of `scale` go.
    pub fn target(self, scale: &Scale) -> Target {
        Target {
            pose: self,
            focal: scale.camera.focal as f32,
            centre: [scale.camera.cx as f32, scale.camera.cy as f32],
        }
    }
}

impl Target {
    /// The place in the second frame of pixel (x, y) at inverse depth ρ.
    #[inline(always)]
    pub fn of(&self, x: usize, y: usize, rho: f32) -> (f32, f32) {
        let share = 1.0 / self.focal;
        let [cx, cy] = self.centre;
        let (x, y) = ((x as f32 - cx) * share, (y as f32 - cy) * share);
        let (r, t) = (&self.pose.rotation, self.pose.translation);
        let q: [f32; 3] = std::array::from_fn(|c| r[c][0] * x + r[c][1] * y + r[c][2] + rho * t[c]);
        let near = self.focal / q[2].max(1e-3);
        (q[0] * near + cx, q[1] * near + cy)
    }
}

/// Which pixels belong: those of `labels` that are `label`, inside `window`.
#[derive(Clone, Copy)]
pub(crate) struct Support<'a> {
    pub labels: &'a Grid<u8>,
    /// Pixels that another region owns but does not explain.
    pub offered: Option<&'a Grid<u8>>,
    pub label: u8,
    pub window: Window,
}

impl<'a> Support<'a> {
    /// The pixels that region `k` owns.
    pub fn of(labels: &'a Grid<u8>, k: usize, window: Window) -> Self {
        Self {
            labels,
            offered: None,
            label: k as u8,
            window,
        }
    }
}

/// Sums of products with the derivative a = h·T by ρ, in one cell: of a² with the products of two pairs of linear
/// weights, of a with each of the six others with one pair.
#[derive(Clone, Copy, Default)]
pub(crate) struct Cell {
    pub square: [f32; 9],
    pub cross: [[f32; 6]; 4],
}

/// What one pass finds.
#[derive(Default)]
pub(crate) struct NormalEquations {
    /// By column and row of cells.
    pub cells: Vec<Cell>,
    /// Over (δT along both tangents, δω, e): upper triangle.
    pub motion: [[f64; 6]; 6],
    /// Σ c(e), grey levels².
    pub cost: f64,
    /// Pixels that could be compared.
    #[cfg(test)]
    pub pixels: usize,
    /// 1.4826 times the median |e|, grey levels.
    pub spread: f32,
    rows: Rows,
}

/// One row of pixels, quantity by quantity, so that loops run over equal slices.
#[derive(Default)]
struct Rows {
    rho: Vec<f32>,
    /// R r.
    ray: [Vec<f32>; 3],
    /// q_x/q_z, q_y/q_z and 1/q_z.
    place: [Vec<f32>; 3],
    residual: Vec<f32>,
    weight: Vec<f32>,
    /// h.
    lever: [Vec<f32>; 3],
    /// h·T.
    slope: Vec<f32>,
    /// The five derivatives by motion.
    by_motion: [Vec<f32>; 5],
    /// Sums down the rows of a cell, for each column of pixels.
    square: [Vec<f32>; 3],
    cross: [[Vec<f32>; 2]; 6],
}

impl Rows {
    fn fit(&mut self, count: usize) {
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

    fn clear_sums(&mut self) {
        let sums = (self.square.iter_mut()).chain(self.cross.as_flattened_mut());
        for row in sums {
            row.fill(0.0);
        }
    }
}

impl NormalEquations {
    /// Goes over the region's pixels; residuals of the problem's σ are usual.
    pub fn gather(&mut self, problem: &Problem, state: &State) {
        let (scale, level, support) = (problem.scale, problem.level, problem.support);
        let (pose, surface) = (&state.pose(), &state.surface);
        let Window {
            left,
            top,
            width,
            height,
        } = support.window;
        self.rows.fit(width);
        self.rows.clear_sums();
        self.cells.clear();
        self.cells
            .resize((surface.columns - 1) * (surface.rows - 1), Cell::default());
        self.motion = Default::default();
        self.cost = 0.0;
        let mut histogram = [0u32; BINS];
        let inverse = 1.0 / (CUT * problem.sigma).powi(2);
        let mut lanes = [[[0.0f32; 8]; 6]; 6];
        for y in top..top + height {
            surface.row(level, y, left, &mut self.rows.rho);
            self.rows.project(scale, pose, left, y);
            self.rows.compare(scale, &support, y, &mut histogram);
            self.cost += self.rows.weigh(scale, pose, left, y, inverse);
            let (row, below) = surface.row_cell(level, y);
            self.rows.sum_down(pose, below);
            self.rows.sum_motion(&mut lanes);
            let last = surface.row_cell(level, y + 1).0 != row || y + 1 == top + height;
            if last {
                self.collect(surface, level, left, width, row);
                self.rows.clear_sums();
            }
        }
        for a in 0..6 {
            for b in a..6 {
                self.motion[a][b] = lanes[a][b].iter().map(|&v| f64::from(v)).sum();
            }
        }
        #[cfg(test)]
        {
            self.pixels = histogram.iter().sum::<u32>() as usize;
        }
        self.spread = spread(&histogram);
    }

    /// Adds the sums down a row of cells to the cells.
    fn collect(&mut self, surface: &Surface, level: usize, left: usize, width: usize, row: usize) {
        let share = 1.0 / (surface.spacing >> level) as f32;
        let (rows, cells) = (&self.rows, &mut self.cells);
        surface.runs(level, left, width, |run| {
            let cell = &mut cells[run.column * (surface.rows - 1) + row];
            for n in 0..run.length {
                let i = run.start + n;
                let right = ((run.offset + n) as f32 + 0.5) * share;
                let weights = [1.0 - right, right];
                let pairs = [
                    weights[0] * weights[0],
                    weights[0] * weights[1],
                    weights[1] * weights[1],
                ];
                for (down, sums) in rows.square.iter().enumerate() {
                    for (across, pair) in pairs.iter().enumerate() {
                        cell.square[3 * across + down] += sums[i] * pair;
                    }
                }
                for (m, sums) in rows.cross.iter().enumerate() {
                    for (across, weight) in weights.iter().enumerate() {
                        for (down, sums) in sums.iter().enumerate() {
                            cell.cross[2 * across + down][m] += sums[i] * weight;
                        }
                    }
                }
            }
        });
    }
}

impl Rows {
    /// Where the row's pixels go.
    fn project(&mut self, scale: &Scale, pose: &Pose, left: usize, y: usize) {
        let n = self.rho.len();
        let share = 1.0 / scale.camera.focal as f32;
        let down = (y as f32 - scale.camera.cy as f32) * share;
        let first = (left as f32 - scale.camera.cx as f32) * share;
        let (r, t) = (&pose.rotation, pose.translation);
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
    fn compare(&mut self, scale: &Scale, support: &Support, y: usize, histogram: &mut [u32]) {
        let n = self.rho.len();
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
        for i in 0..n {
            let (x, y) = (px[i] * f + cx, py[i] * f + cy);
            if (labels[i] == support.label || offered[i] == support.label) && scale.contains(x, y) {
                let [value, across, down] = scale.read(x, y);
                let residual = value - first[i];
                let bin = (residual.abs() * BINS_PER_LEVEL) as usize;
                histogram[bin.min(BINS - 1)] += 1;
                self.residual[i] = residual;
                gx[i] = across;
                gy[i] = down;
                self.weight[i] = 1.0;
            } else {
                self.residual[i] = 0.0;
                gx[i] = 0.0;
                gy[i] = 0.0;
                self.weight[i] = 0.0;
            }
        }
    }

    /// h, h·T and the robust weights; the row's cost.
    fn weigh(&mut self, scale: &Scale, pose: &Pose, left: usize, y: usize, inverse: f32) -> f64 {
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
        let t = pose.translation;
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
    fn sum_down(&mut self, pose: &Pose, below: f32) {
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
            let [b, c] = pose.tangent;
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
    fn sum_motion(&self, lanes: &mut [[[f32; 8]; 6]; 6]) {
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

/// 1.4826 times the median of a histogram of |e|.
fn spread(histogram: &[u32]) -> f32 {
    let count: usize = histogram.iter().map(|&n| n as usize).sum();
    let mut below = 0;
    let median = histogram.iter().position(|&n| {
        below += n as usize;
        2 * below >= count
    });
    1.4826 * (median.unwrap_or(0) as f32 + 0.5) / BINS_PER_LEVEL
}

#[cfg(test)]
pub(super) mod tests {
    use glam::DVec3;

    use super::super::step::{Prior, turn};
    use super::*;
    use crate::camera::Camera;
    use crate::frames::{Frame, FramePair, Lighting};
    use crate::layered::scale::pyramid;
    use crate::options::Diffusion;

    /// Frames of one surface before and after a motion, and what is true of them.
    pub struct Made {
        pub scale: Scale,
        pub labels: Grid<u8>,
        pub truth: State,
    }

    /// Inverse depth of hills, around 1.
    fn hills(x: f64, y: f64) -> f64 {
        1.0 + 0.3 * (0.11 * x + 0.4).sin() * (0.13 * y).cos()
    }

    fn texture(x: f64, y: f64) -> f64 {
        120.0
            + 40.0 * (0.31 * x + 0.12 * y + (0.07 * y).sin()).sin()
            + 35.0 * (0.29 * y - 0.14 * x + (0.05 * x).cos()).cos()
    }

    impl Made {
        pub fn new(width: usize, height: usize, translation: DVec3, omega: DVec3) -> Self {
            let camera = Camera::centred(1.1 * width as f64, width, height).unwrap();
            let rotation = turn(omega);
            let go = |x: f64, y: f64| {
                let q = rotation * camera.ray(x, y) + hills(x, y) * translation;
                camera.project(q)
            };
            let first = Grid::from_fn(width, height, |x, y| texture(x as f64, y as f64) as f32);
            let second = Grid::from_fn(width, height, |x, y| {
                let (to_x, to_y) = (x as f64, y as f64);
                let (mut px, mut py) = (to_x, to_y);
                for _ in 0..30 {
                    let (qx, qy) = go(px, py);
                    (px, py) = (px + to_x - qx, py + to_y - qy);
                }
                texture(px, py) as f32
            });
            let [first, second] = [first, second].map(|grey| Frame::from_grey(grey).unwrap());
            let pair = FramePair::new(first, second).unwrap();
            let scale = pyramid(&pair, camera, 0.0, Lighting::default()).swap_remove(0);
            let mut surface = Surface::flat(8, &Window::whole(width, height));
            for i in 0..surface.columns {
                for j in 0..surface.rows {
                    let node = surface.node(i, j);
                    let at = |n: usize| 8.0 * n as f64 - 0.5;
                    surface.rho[node] = hills(at(i), at(j)) as f32;
                }
            }
            Self {
                scale,
                labels: Grid::new(width, height, 0),
                truth: State {
                    translation,
                    rotation,
                    surface,
                },
            }
        }

        /// A shift of some pixels with a turn.
        pub fn usual() -> Self {
            let (t, w) = (
                DVec3::new(0.03, -0.02, 0.02),
                DVec3::new(0.004, 0.006, -0.01),
            );
            Self::new(48, 40, t, w)
        }

        /// All pixels at least `margin` from the border.
        pub fn problem(&self, margin: usize) -> Problem<'_> {
            let window = Window {
                left: margin,
                top: margin,
                width: self.labels.width() - 2 * margin,
                height: self.labels.height() - 2 * margin,
            };
            Problem {
                scale: &self.scale,
                level: 0,
                support: Support::of(&self.labels, 0, window),
                prior: Prior {
                    mu: 100.0,
                    diffusion: Diffusion::Isotropic,
                    epsilon: 1e-3,
                },
                sigma: 2.0,
            }
        }

        /// The truth, somewhat off in everything.
        pub fn off(&self) -> State {
            let mut state = self.truth.clone();
            state.translation += DVec3::new(-0.004, 0.004, 0.002);
            state.rotation = turn(DVec3::new(0.002, -0.001, 0.003)) * state.rotation;
            for (n, rho) in state.surface.rho.iter_mut().enumerate() {
                *rho += 0.05 * (1.7 * n as f32).sin();
            }
            state
        }
    }

    /// Makes the gradient of the first frame that of the second where `state` leads, so that their mean is the residual's
    /// exact derivative.
    fn align(made: &mut Made, state: &State) {
        let target = state.pose().target(&made.scale);
        for y in 0..made.scale.height {
            for x in 0..made.scale.width {
                let (to_x, to_y) = target.of(x, y, state.surface.at(x as f32, y as f32));
                if made.scale.contains(to_x, to_y) {
                    let [_, gx, gy] = made.scale.read(to_x, to_y);
                    made.scale.gradient[0][(x, y)] = gx;
                    made.scale.gradient[1][(x, y)] = gy;
                }
            }
        }
    }

    fn cost(made: &Made, state: &State) -> f64 {
        let mut equations = NormalEquations::default();
        equations.gather(&made.problem(6), state);
        equations.cost
    }

    /// Half the derivative of the cost where `change` moves the state by so much.
    fn half_slope(made: &Made, state: &State, by: f64, change: impl Fn(&mut State, f64)) -> f64 {
        let at = |by: f64| {
            let mut moved = state.clone();
            change(&mut moved, by);
            cost(made, &moved)
        };
        (at(by) - at(-by)) / (4.0 * by)
    }

    #[test]
    fn right_hand_sides_are_slopes_of_the_cost() {
        let mut made = Made::usual();
        let state = made.off();
        align(&mut made, &state);
        let mut equations = NormalEquations::default();
        equations.gather(&made.problem(6), &state);
        assert!(equations.cost > 100.0, "there is something to explain");
        let near = |own: f64, slope: f64, size: f64, what: &str| {
            assert!((own - slope).abs() < 0.01 * size, "{what}: {own}, {slope}");
        };
        let tangent = state
            .pose()
            .tangent
            .map(|b| DVec3::from_array(b.map(f64::from)));
        let right: [f64; 5] = std::array::from_fn(|i| equations.motion[i][5]);
        for i in 0..2 {
            let slope = half_slope(&made, &state, 3e-3, |s, by| {
                s.translation += tangent[i] * by
            });
            near(right[i], slope, right[0].hypot(right[1]), "T");
        }
        for i in 0..3 {
            let slope = half_slope(&made, &state, 1e-4, |s, by| {
                let mut omega = DVec3::ZERO;
                omega[i] = by;
                s.rotation = turn(omega) * s.rotation;
            });
            let size = DVec3::new(right[2], right[3], right[4]).length();
            near(right[2 + i], slope, size, "ω");
        }
        // By ρ of a control point: what its four cells say.
        let surface = &state.surface;
        let size = 0.1 * equations.cost;
        for (i, j) in [(2, 2), (3, 1), (1, 3), (4, 3)] {
            let cell = |i: usize, j: usize| equations.cells[i * (surface.rows - 1) + j].cross;
            let own = cell(i, j)[0][5]
                + cell(i, j - 1)[1][5]
                + cell(i - 1, j)[2][5]
                + cell(i - 1, j - 1)[3][5];
            let node = surface.node(i, j);
            let slope = half_slope(&made, &state, 4e-3, |s, by| {
                s.surface.rho[node] += by as f32
            });
            near(f64::from(own), slope, size, "ρ");
        }
    }

    #[test]
    fn sums_are_those_of_a_loop_over_pixels() {
        let made = Made::usual();
        let state = made.off();
        let problem = made.problem(3);
        let mut equations = NormalEquations::default();
        equations.gather(&problem, &state);
        let (scale, surface, window) = (&made.scale, &state.surface, problem.support.window);
        let Camera { focal, cx, cy } = scale.camera;
        let (t, r) = (state.translation, state.rotation);
        let (b, c) = (t / t.length()).any_orthonormal_pair();
        let mut motion = [[0.0f64; 6]; 6];
        let mut cells = vec![([0.0f64; 9], [[0.0f64; 6]; 4]); equations.cells.len()];
        let (mut cost, mut pixels) = (0.0, 0);
        for y in window.top..window.top + window.height {
            for x in window.left..window.left + window.width {
                let (fx, fy) = ((x as f64 + 0.5) / 8.0, (y as f64 + 0.5) / 8.0);
                let (i, j) = (fx as usize, fy as usize);
                let (tx, ty) = (fx - i as f64, fy - j as f64);
                let share = [
                    (1.0 - tx) * (1.0 - ty),
                    (1.0 - tx) * ty,
                    tx * (1.0 - ty),
                    tx * ty,
                ];
                let rho: f64 = (0..4)
                    .map(|p| share[p] * f64::from(surface.rho[surface.node(i + p / 2, j + p % 2)]))
                    .sum();
                let turned = r * DVec3::new((x as f64 - cx) / focal, (y as f64 - cy) / focal, 1.0);
                let q = turned + rho * t;
                let (to_x, to_y) = (focal * q.x / q.z + cx, focal * q.y / q.z + cy);
                if !scale.contains(to_x as f32, to_y as f32) {
                    continue;
                }
                let [value, gx, gy] = scale.read(to_x as f32, to_y as f32).map(f64::from);
                let e = value - f64::from(scale.first[(x, y)]);
                let gx = 0.5 * (gx + f64::from(scale.gradient[0][(x, y)]));
                let gy = 0.5 * (gy + f64::from(scale.gradient[1][(x, y)]));
                let h = focal / q.z * DVec3::new(gx, gy, -(gx * q.x + gy * q.y) / q.z);
                let square = (e / f64::from(CUT * problem.sigma)).powi(2);
                cost += e * e / (1.0 + square);
                let weight = (1.0 + square).powi(-2);
                let by_omega = turned.cross(h);
                let length = t.length();
                let row = [
                    rho * length * h.dot(b),
                    rho * length * h.dot(c),
                    by_omega.x,
                    by_omega.y,
                    by_omega.z,
                    e,
                ];
                for m in 0..6 {
                    for n in m..6 {
                        motion[m][n] += weight * row[m] * row[n];
                    }
                }
                let slope = h.dot(t);
                let (square, cross) = &mut cells[i * (surface.rows - 1) + j];
                let pairs = |t: f64| [(1.0 - t) * (1.0 - t), (1.0 - t) * t, t * t];
                for (across, a) in pairs(tx).into_iter().enumerate() {
                    for (down, b) in pairs(ty).into_iter().enumerate() {
                        square[3 * across + down] += weight * slope * slope * a * b;
                    }
                }
                for p in 0..4 {
                    for m in 0..6 {
                        cross[p][m] += weight * slope * row[m] * share[p];
                    }
                }
                pixels += 1;
            }
        }
        assert_eq!(equations.pixels, pixels);
        assert!((equations.cost / cost - 1.0).abs() < 1e-3);
        let near = |own: f64, sum: f64, size: f64| {
            assert!((own - sum).abs() < 2e-3 * size, "{own} and {sum}");
        };
        for m in 0..6 {
            for n in m..6 {
                near(
                    equations.motion[m][n],
                    motion[m][n],
                    (motion[m][m] * motion[n][n]).sqrt(),
                );
            }
        }
        for (own, (square, cross)) in equations.cells.iter().zip(&cells) {
            let whole: f64 = square.iter().sum();
            for n in 0..9 {
                near(own.square[n].into(), square[n], whole.max(1e-9));
            }
            for p in 0..4 {
                for m in 0..6 {
                    // Cells share the region's size of a derivative.
                    let size = (whole * motion[m][m]).sqrt();
                    near(own.cross[p][m].into(), cross[p][m], size.max(1e-9));
                }
            }
        }
    }

    #[test]
    fn only_pixels_that_belong_count() {
        let mut made = Made::usual();
        for y in 0..40 {
            for x in 0..24 {
                made.labels[(x, y)] = 1;
            }
        }
        let state = made.off();
        let mut equations = NormalEquations::default();
        equations.gather(&made.problem(4), &state);
        assert_eq!(equations.pixels, 20 * 32);
        let offered = Grid::from_fn(48, 40, |x, _| if x < 10 { 0 } else { 255 });
        let mut problem = made.problem(4);
        problem.support.offered = Some(&offered);
        equations.gather(&problem, &state);
        assert_eq!(equations.pixels, (20 + 6) * 32);
    }

    #[test]
    fn nothing_is_left_of_the_truth() {
        let made = Made::usual();
        let mut equations = NormalEquations::default();
        equations.gather(&made.problem(6), &made.truth);
        let exact = equations.cost / equations.pixels as f64;
        equations.gather(&made.problem(6), &State::still(made.truth.surface.clone()));
        let still = equations.cost / equations.pixels as f64;
        assert!(exact < 0.5 && still > 5.0, "{exact}, {still} at rest");
    }
}
