use glam::DVec3;

use super::super::curvature::Prior;
use super::*;
use crate::camera::{Camera, turn};
use crate::frames::{Frame, FramePair};
use crate::layered::scale::{Scale, pyramid};
use crate::motion_model::MotionModel;
use crate::options::{Diffusion, Options};

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
        let plain = Options {
            smoothing: 0.0,
            lighting: false,
            ..Options::default()
        };
        let scale = pyramid(&pair, camera, &plain).swap_remove(0);
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
                model: MotionModel::Full,
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
                sigma: 2.0,
            },
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
    let view = state.view(&made.scale.camera);
    for y in 0..made.scale.height {
        for x in 0..made.scale.width {
            let [to_x, to_y] = view.target(x, y, state.surface.at(x as f32, y as f32));
            if made.scale.contains(to_x, to_y) {
                let [_, gx, gy] = made.scale.second.with_gradient(to_x, to_y);
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
    let tangent = state.tangent();
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
    let [b, c] = state.tangent().map(|b| b / t.length());
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
            let [value, gx, gy] = scale
                .second
                .with_gradient(to_x as f32, to_y as f32)
                .map(f64::from);
            let e = value - f64::from(scale.first[(x, y)]);
            let gx = 0.5 * (gx + f64::from(scale.gradient[0][(x, y)]));
            let gy = 0.5 * (gy + f64::from(scale.gradient[1][(x, y)]));
            let h = focal / q.z * DVec3::new(gx, gy, -(gx * q.x + gy * q.y) / q.z);
            let square = e * e / f64::from(most_cost(problem.prior.sigma));
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
