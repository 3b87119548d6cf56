//! The one visible loop: for each scale estimate, label, refine.

use std::rc::Rc;

use crate::camera::{Camera, RigidMotion};
use crate::curves;
use crate::depth;
use crate::energy::Energy;
use crate::frames::{FramePair, Lighting};
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::motion::Kind;
use crate::options::{Diffusion, Options};
use crate::solver::{Approach, Weights};
use crate::window::Window;

use super::estimate::{self, Estimator, Free, Outcome, PlanarFlow, Prior, State, Support, Surface};
use super::label;
use super::region::Region;
use super::scale::{Scale, pyramid};

/// Rounds of planar fits and labels before depth is looked for.
thread_local! { pub static ORACLE: std::cell::RefCell<Option<Grid<u8>>> = const { std::cell::RefCell::new(None) }; }

fn oracle(level: usize, w: usize, h: usize) -> Option<Grid<u8>> {
    if par("ORACLE", 0.0) == 0.0 {
        return None;
    }
    let full = ORACLE.with(|o| o.borrow().clone())?;
    let half = (1 << level) / 2;
    Some(Grid::from_fn(w, h, |x, y| {
        full[((x << level) + half, (y << level) + half)]
    }))
}

/// R
const PLANAR_ROUNDS: usize = 6;
const LEAST_SIGMA: f32 = 0.4;
const MU_MOTION: f64 = 1e5;
const MU_DEPTH: f64 = 3e6;
const EPSILON: f64 = 1e-3;
const BETA: f32 = 1.0;
const RELIEF: f64 = 100.0;
const MARGIN: usize = 16;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Planar(usize),
    Search,
    Rigid(usize),
    Done,
}

pub(crate) struct Layered {
    pair: Rc<FramePair>,
    scales: Vec<Scale>,
    level: usize,
    base: usize,
    phase: Phase,
    labels: Grid<u8>,
    regions: Vec<Region>,
    sigma: f32,
    estimator: Estimator,
    costs: Vec<Grid<f32>>,
    pulls: Vec<Grid<f32>>,
    spare: Grid<f32>,
    offered: Grid<u8>,
    energy: Energy,
    changed: f64,
}

fn par(name: &str, default: f64) -> f64 {
    std::env::var(name)
        .ok()
        .and_then(|v| v.parse().ok())
        .unwrap_or(default)
}

impl Layered {
    pub fn new(
        pair: Rc<FramePair>,
        camera: Camera,
        level_sets: Vec<Grid<f32>>,
        options: &Options,
    ) -> Self {
        let lighting = if options.lighting {
            Lighting::between(&pair.first().grey, &pair.second().grey)
        } else {
            Lighting::default()
        };
        let scales = pyramid(&pair, camera, 0.7, lighting);
        let base = scales
            .iter()
            .position(|s| s.width.min(s.height) <= 150)
            .unwrap_or(scales.len() - 1);
        let mut layered = Self {
            pair,
            level: base,
            base,
            phase: Phase::Planar(0),
            labels: Grid::new(1, 1, 0),
            regions: Vec::new(),
            sigma: 10.0,
            estimator: Estimator::default(),
            costs: Vec::new(),
            pulls: Vec::new(),
            spare: Grid::new(1, 1, 0.0),
            offered: Grid::new(1, 1, 255),
            energy: Energy::default(),
            changed: 1.0,
            scales,
        };
        layered.place(level_sets);
        layered
    }

    fn place(&mut self, level_sets: Vec<Grid<f32>>) {
        self.level = self.base;
        let count = level_sets.len() + 1;
        self.phase = if count > 1 {
            Phase::Planar(0)
        } else {
            Phase::Planar(PLANAR_ROUNDS - 1)
        };
        let (fw, fh) = (self.pair.width(), self.pair.height());
        let full = curves::labels(&level_sets, fw, fh);
        let (w, h) = (self.scales[self.base].width, self.scales[self.base].height);
        let half = (1 << self.base) / 2;
        self.labels = Grid::from_fn(w, h, |x, y| {
            full[((x << self.base) + half, (y << self.base) + half)]
        });
        let spacing = self.spacing();
        let whole = Window::whole(fw, fh);
        self.regions = (0..count)
            .map(|_| Region::new(Surface::flat(spacing, &whole)))
            .collect();
        if let Some(l) = oracle(self.level, self.labels.width(), self.labels.height()) {
            self.labels = l;
        }
        self.fit_memory();
        self.find_windows();
    }

    fn spacing(&self) -> usize {
        8 << self.base.saturating_sub(1)
    }

    fn fit_memory(&mut self) {
        let (w, h) = (self.here().width, self.here().height);
        let count = self.regions.len();
        self.costs = vec![Grid::new(w, h, 0.0); count];
        self.pulls = vec![Grid::new(w, h, 0.0); count];
        self.spare = Grid::new(w, h, 0.0);
        self.offered = Grid::new(w, h, 255);
    }

    fn here(&self) -> &Scale {
        &self.scales[self.level]
    }

    fn find_windows(&mut self) {
        let (w, h) = (self.labels.width(), self.labels.height());
        for (k, region) in self.regions.iter_mut().enumerate() {
            let data = self.labels.data();
            region.window = Window::around(w, h, 0, |i| usize::from(data[i]) == k);
            let offered = self.offered.data();
            region.reach = Window::around(w, h, 0, |i| {
                usize::from(data[i]) == k || usize::from(offered[i]) == k
            });
            region.fresh = false;
        }
    }

    /// The pixels of region k without a rim.
    fn support_labels(&self) -> Grid<u8> {
        let rim = par("RIM", 1.0) as usize;
        let mut out = self.labels.clone();
        if self.level > 0 && par("RIMALL", 0.0) == 0.0 {
            return out;
        }
        let (w, h) = (out.width(), out.height());
        for _ in 0..rim {
            let old = out.clone();
            for y in 0..h {
                for x in 0..w {
                    let c = old[(x, y)];
                    if (x > 0 && old[(x - 1, y)] != c)
                        || (x + 1 < w && old[(x + 1, y)] != c)
                        || (y > 0 && old[(x, y - 1)] != c)
                        || (y + 1 < h && old[(x, y + 1)] != c)
                    {
                        out[(x, y)] = 255;
                    }
                }
            }
        }
        out
    }

    fn prior(&self, weight: f64, options: &Options) -> Prior {
        let size = (self.pair.width() * self.pair.height()) as f64 / (320.0 * 240.0);
        let sigma = f64::from(self.sigma);
        Prior {
            mu: weight * size * sigma * sigma,
            diffusion: options.diffusion,
            epsilon: par("EPS", EPSILON),
        }
    }

    fn planar_motions(&mut self, round: usize) {
        let labels = self.labels.clone();
        let coarse = (self.level + 1).min(self.scales.len() - 1);
        let coarser = coarsened(&labels, coarse - self.level);
        let coarsest = (self.level + 1).min(self.scales.len() - 1);
        let coarse_labels = coarsened(&labels, coarsest - self.level);
        for (k, region) in self.regions.iter_mut().enumerate() {
            let Some(window) = region.window else {
                continue;
            };
            let whole = |labels: &Grid<u8>| {
                Window::around(labels.width(), labels.height(), 0, |i| {
                    usize::from(labels.data()[i]) == k
                })
            };
            if round == 0
                || self.phase == Phase::Planar(PLANAR_ROUNDS - 1) && region.flow.sigma == 0.0
            {
                if let Some(window) = whole(&coarse_labels) {
                    let support = Support {
                        labels: &coarse_labels,
                        offered: None,
                        label: k as u8,
                        window,
                    };
                    region.flow = PlanarFlow::search(&self.scales[coarsest], &support);
                }
                if let Some(window) = whole(&coarser) {
                    let support = Support {
                        labels: &coarser,
                        offered: None,
                        label: k as u8,
                        window,
                    };
                    region
                        .flow
                        .fit(&self.scales[coarse], &support, estimate::Degree::Shift, 3);
                    region
                        .flow
                        .fit(&self.scales[coarse], &support, estimate::Degree::Affine, 4);
                }
            }
            let support = Support {
                labels: &labels,
                offered: None,
                label: k as u8,
                window,
            };
            let degree = if round < 3 && k > 0 {
                estimate::Degree::Affine
            } else {
                estimate::Degree::Plane
            };
            region
                .flow
                .fit(&self.scales[self.level], &support, degree, 3);
        }
    }

    fn search_motions(&mut self, options: &Options) {
        let labels = self.support_labels();
        let verbose = par("V", 0.0) > 0.0;
        for k in 0..self.regions.len() {
            let Some(window) = self.regions[k].window else {
                continue;
            };
            let scale = &self.scales[self.level];
            let support = Support {
                labels: &labels,
                offered: None,
                label: k as u8,
                window,
            };
            let flow = self.regions[k].flow;
            let sigma = flow.sigma.max(0.7);
            let blocks = estimate::Blocks::gather(scale, &support, &flow);
            let pixels = labels
                .data()
                .iter()
                .filter(|&&l| usize::from(l) == k)
                .count();
            // A large region shows enough at the next coarser scale.
            let up = usize::from(pixels > 8000 && self.level + 1 < self.scales.len());
            let level = self.level + up;
            let coarse = coarsened(&labels, up);
            let Some(cw) = Window::around(coarse.width(), coarse.height(), 0, |i| {
                usize::from(coarse.data()[i]) == k
            }) else {
                continue;
            };
            let csup = Support {
                labels: &coarse,
                offered: None,
                label: k as u8,
                window: cw,
            };
            let full = self.full_window(window);
            let size = (self.pair.width() * self.pair.height()) as f64 / (320.0 * 240.0);
            let prior = Prior {
                mu: par("CMU", 1e5) * size * f64::from(sigma * sigma),
                diffusion: options.diffusion,
                epsilon: par("EPS", EPSILON),
            };
            let mut pool: Vec<(f64, Kind, State)> = Vec::new();
            let scale = &self.scales[level];
            let steps = par("I0", 5.0) as usize;
            let spacing = self.regions[k].state.surface.spacing;
            let equations = &mut self.regions[k].equations;
            let estimator = &mut self.estimator;
            let mut run = |model: Kind,
                           mut state: State,
                           fresh_depth: bool,
                           pool: &mut Vec<(f64, Kind, State)>| {
                if fresh_depth && model.translates() {
                    estimator.improve(
                        scale,
                        level,
                        csup,
                        &mut state,
                        Free::Depth,
                        &prior,
                        sigma,
                        1,
                        equations,
                        false,
                    );
                }
                let outcome = estimator.improve(
                    scale,
                    level,
                    csup,
                    &mut state,
                    free(model),
                    &prior,
                    sigma,
                    if model == Kind::Still { 0 } else { steps },
                    equations,
                    false,
                );
                let relief = if model.translates() {
                    equations.relief(&state.surface)
                } else {
                    0.0
                };
                let score =
                    outcome.energy / f64::from(sigma * sigma) + RELIEF * relief + penalty(model);
                if verbose {
                    eprintln!(
                        "  cand k{k} {model:?} E {:.1} relief {:.4} score {:.1} T {:.3?} w {:.5?}",
                        outcome.energy / f64::from(sigma * sigma),
                        relief,
                        score,
                        state.translation.normalize_or_zero(),
                        state.omega()
                    );
                }
                pool.push((score, model, state));
            };
            let flat = State::still(Surface::flat(2 * spacing, &full));
            run(Kind::Still, flat.clone(), false, &mut pool);
            run(
                Kind::Rotation,
                State {
                    rotation: blocks.rotation(),
                    ..flat.clone()
                },
                false,
                &mut pool,
            );
            for (model, most) in [
                (Kind::Translation, 3),
                (Kind::Full, par("NC", 5.0) as usize),
            ] {
                let first = pool.len();
                for candidate in blocks.directions(most, model == Kind::Full) {
                    let state = State {
                        translation: candidate.translation,
                        rotation: candidate.rotation,
                        ..flat.clone()
                    };
                    run(model, state, true, &mut pool);
                }
                pool[first..].sort_by(|a, b| a.0.total_cmp(&b.0));
                if model == Kind::Full && pool.len() > first {
                    let best = &pool[first].2;
                    let mut mirror = best.clone();
                    let t = best.translation;
                    let w = best.omega();
                    mirror.translation = glam::DVec3::new(-t.x, -t.y, t.z);
                    mirror.rotation =
                        estimate::turn(glam::DVec3::new(w.x - 2.0 * t.y, w.y + 2.0 * t.x, w.z));
                    mirror
                        .surface
                        .rho
                        .iter_mut()
                        .for_each(|r| *r = (2.0 - *r).max(0.2));
                    run(model, mirror, false, &mut pool);
                    pool[first..].sort_by(|a, b| a.0.total_cmp(&b.0));
                }
            }
            pool.sort_by(|a, b| a.0.total_cmp(&b.0));
            let best = pool[0].0;
            let mut kept: Vec<(Kind, State)> = Vec::new();
            for (score, model, state) in pool {
                if score < best + par("KEEP", 60.0) && kept.iter().all(|(m, _)| *m != model) {
                    kept.push((model, state));
                }
            }
            let region = &mut self.regions[k];
            region.model = kept[0].0;
            region.state = kept[0].1.clone();
            region.alternatives = kept.split_off(1);
            region.fresh = false;
        }
    }

    fn full_window(&self, window: Window) -> Window {
        let (w, h) = (self.pair.width(), self.pair.height());
        let l = self.level;
        let left = (window.left << l).saturating_sub(MARGIN);
        let top = (window.top << l).saturating_sub(MARGIN);
        let right = (((window.left + window.width) << l) + MARGIN).min(w);
        let bottom = (((window.top + window.height) << l) + MARGIN).min(h);
        Window {
            left,
            top,
            width: right - left,
            height: bottom - top,
        }
    }

    fn rigid_motions(&mut self, options: &Options, steps: usize) {
        let labels = self.support_labels();
        let offered = self.offered.clone();
        let prior = self.prior(par("MMU", MU_MOTION), options);
        for k in 0..self.regions.len() {
            let Some(window) = self.regions[k].reach else {
                continue;
            };
            let region = &mut self.regions[k];
            let free = match region.model {
                Kind::Still => continue,
                Kind::Rotation => Free::Rotation,
                Kind::Translation => Free::Translation,
                Kind::Full => Free::Full,
            };
            let support = Support {
                labels: &labels,
                offered: Some(&offered),
                label: k as u8,
                window,
            };
            region.outcome = self.estimator.improve(
                &self.scales[self.level],
                self.level,
                support,
                &mut region.state,
                free,
                &prior,
                self.sigma,
                steps,
                &mut region.equations,
                region.fresh,
            );
            region.fresh = true;
        }
    }

    fn rigid_depth(&mut self, options: &Options, steps: usize) {
        let labels = self.support_labels();
        let offered = self.offered.clone();
        let prior = self.prior(par("DMU", MU_DEPTH), options);
        for k in 0..self.regions.len() {
            let Some(window) = self.regions[k].reach else {
                continue;
            };
            let region = &mut self.regions[k];
            if !region.model.translates() {
                let support = Support {
                    labels: &labels,
                    offered: Some(&offered),
                    label: k as u8,
                    window,
                };
                region.outcome = self.estimator.improve(
                    &self.scales[self.level],
                    self.level,
                    support,
                    &mut region.state,
                    Free::Depth,
                    &prior,
                    self.sigma,
                    0,
                    &mut region.equations,
                    region.fresh,
                );
                region.fresh = true;
                continue;
            }
            let support = Support {
                labels: &labels,
                offered: Some(&offered),
                label: k as u8,
                window,
            };
            let wald = region.outcome.wald;
            region.outcome = self.estimator.improve(
                &self.scales[self.level],
                self.level,
                support,
                &mut region.state,
                Free::Depth,
                &prior,
                self.sigma,
                steps,
                &mut region.equations,
                region.fresh,
            );
            region.outcome.wald = wald;
            region.fresh = true;
        }
    }

    fn measure_sigma(&mut self) {
        let spreads = self
            .regions
            .iter()
            .filter(|r| r.window.is_some())
            .map(|r| r.outcome.spread);
        self.sigma = spreads.fold(LEAST_SIGMA, f32::max);
    }

    fn select_models(&mut self, options: &Options) {
        let labels = self.support_labels();
        let prior = self.prior(par("MMU", MU_MOTION), options);
        let sigma = self.sigma;
        for k in 0..self.regions.len() {
            let Some(window) = self.regions[k].window else {
                continue;
            };
            let support = Support {
                labels: &labels,
                offered: None,
                label: k as u8,
                window,
            };
            let level = self.level;
            let region = &mut self.regions[k];
            let surface = region.state.surface.clone();
            let mut best = (
                f64::INFINITY,
                region.model,
                region.state.clone(),
                Outcome::default(),
            );
            let alternatives = std::mem::take(&mut region.alternatives);
            let own = (region.model, region.state.clone());
            for (n, (model, state)) in std::iter::once(own).chain(alternatives).enumerate() {
                let mut state = state;
                if n > 0 {
                    state.surface = state.surface.over(surface.spacing, &surface.window());
                }
                let steps = if model == Kind::Still {
                    0
                } else if n == 0 {
                    0
                } else {
                    3
                };
                let outcome = self.estimator.improve(
                    &self.scales[level],
                    level,
                    support,
                    &mut state,
                    free(model),
                    &prior,
                    sigma,
                    steps,
                    &mut region.equations,
                    false,
                );
                let relief = if model.translates() {
                    region.equations.relief(&state.surface)
                } else {
                    0.0
                };
                let mut score = outcome.energy / f64::from(sigma * sigma)
                    + RELIEF * relief
                    + par("PS", 6.0) * penalty(model);
                if model == Kind::Still {
                    score -= par("STILLB", 0.0);
                }
                if par("V", 0.0) > 0.0 {
                    eprintln!(
                        "  select k{k} {model:?} E {:.1} relief {relief:.4} score {score:.1} T {:.3?} w {:.5?}",
                        outcome.energy / f64::from(sigma * sigma),
                        state.translation.normalize_or_zero(),
                        state.omega()
                    );
                }
                if score < best.0 {
                    best = (score, model, state, outcome);
                }
            }
            region.model = best.1;
            region.state = best.2;
            region.outcome = best.3;
            region.fresh = false;
        }
    }

    fn mean_flow(&self, k: usize, window: Window) -> f64 {
        let scale = self.here();
        let region = &self.regions[k];
        let motion = self.motion(k);
        let (mut sum, mut n) = (0.0, 0.0);
        let side = (1 << self.level) as f32;
        for y in (window.top..window.top + window.height).step_by(4) {
            for x in (window.left..window.left + window.width).step_by(4) {
                if usize::from(self.labels[(x, y)]) == k {
                    let at = |p: usize| (p as f32 + 0.5) * side - 0.5;
                    let rho = region.state.surface.at(at(x), at(y));
                    if let Some((u, v)) =
                        scale
                            .camera
                            .displacement(&motion, x as f64, y as f64, f64::from(rho))
                    {
                        sum += u.hypot(v);
                        n += 1.0;
                    }
                }
            }
        }
        sum / f64::max(n, 1.0)
    }

    fn motion(&self, k: usize) -> RigidMotion {
        let state = &self.regions[k].state;
        RigidMotion {
            translation: state.translation,
            rotation: state.omega(),
        }
    }

    fn relabel(&mut self, planar: bool, options: &Options) {
        if let Some(l) = oracle(self.level, self.labels.width(), self.labels.height()) {
            if par("ORACLE", 0.0) == 1.0 || planar {
                self.labels = l;
                self.find_windows();
                return;
            }
        }
        if self.regions.len() == 1 {
            self.changed = 0.0;
            return;
        }
        let level = self.level;
        let sigma = if planar {
            self.planar_sigma()
        } else {
            self.sigma
        };
        let scale = &self.scales[level];
        for (region, costs) in self.regions.iter().zip(&mut self.costs) {
            if region.window.is_none() {
                costs.data_mut().fill(f32::MAX / 4.0);
            } else if planar {
                label::planar_cost(scale, &region.flow, sigma, costs);
            } else {
                label::rigid_cost(scale, level, &region.state, sigma, costs);
            }
            if region.window.is_some() {
                label::finish(
                    costs,
                    sigma,
                    &mut self.spare,
                    par("HR", 4.0) as usize,
                    par("HD", 9.0) as f32,
                    par("HM", 0.0) as f32,
                    scale,
                    if planar {
                        par("SLP", 0.0)
                    } else if self.level > 0 {
                        par("SL1", 0.0)
                    } else {
                        par("SL0", 0.0)
                    } as f32,
                );
            }
        }
        if options.occlusion && !planar {
            let states: Vec<&State> = self.regions.iter().map(|r| &r.state).collect();
            let first = &scale.first;
            let most = label::saturation(sigma);
            let oc = par("OC", 0.7) as f32;
            let shift = par("SH", 7.0) as isize;
            let mut chance = if par("CH", 1.0) > 0.0 {
                Grid::from_fn(first.width(), first.height(), |x, y| {
                    let (x, y) = (x as isize, y as isize);
                    let here = first.clamped(x, y);
                    [(shift, 0), (-shift, 0), (0, shift), (0, -shift)]
                        .iter()
                        .map(|(dx, dy)| {
                            let e = first.clamped(x + dx, y + dy) - here;
                            let q = e * e;
                            0.25 * oc * q * most / (q + most)
                        })
                        .sum::<f32>()
                })
            } else {
                Grid::new(first.width(), first.height(), oc * most)
            };
            label::box_blur(&mut chance, 3, &mut self.spare);
            label::box_blur(&mut chance, 3, &mut self.spare);
            let cover = label::Cover::of(
                scale,
                level,
                &states,
                &self.labels,
                &self.costs,
                par("CONF", 9.0) as f32 * most,
            );
            for (k, state) in states.iter().enumerate() {
                if k == 0 || par("MUT", 1.0) > 0.0 {
                    cover.excuse(k, scale, level, state, &chance, &mut self.costs[k]);
                }
            }
        }
        let radius = if planar { 3 } else { par("BR", 1.0) as usize };
        for costs in &mut self.costs {
            label::box_blur(costs, radius, &mut self.spare);
        }
        let beta = if planar {
            par("PBETA", 0.5)
        } else {
            if self.level > 0 || self.phase == Phase::Search {
                par("BETA1", 1.0)
            } else if self.phase == Phase::Rigid(0) {
                par("BETA0", 2.0)
            } else {
                par("BETA", 4.0)
            }
        } as f32
            * label::saturation(sigma);
        let arg = if self.level > 0 {
            par("ARG", 2.0)
        } else {
            par("ARG0", 0.0)
        } as usize;
        if arg > 0 && !planar {
            let mut smooth = self.costs.clone();
            for c in &mut smooth {
                label::box_blur(c, arg, &mut self.spare);
                label::box_blur(c, arg, &mut self.spare);
            }
            for i in 0..self.labels.len() {
                let mut best = (0, f32::INFINITY);
                for (k, c) in smooth.iter().enumerate() {
                    if c.data()[i] < best.1 {
                        best = (k, c.data()[i]);
                    }
                }
                self.labels.data_mut()[i] = best.0 as u8;
            }
        }
        let (ea, es) = (par("EA", 0.0) as f32, par("ES", 1.0) as f32);
        let [gx, gy] = &self.scales[level].gradient;
        let mag = Grid::from_fn(gx.width(), gx.height(), |x, y| gx[(x, y)].hypot(gy[(x, y)]));
        let mean = mag.data().iter().sum::<f32>() / mag.len() as f32;
        let s2 = (es * mean).powi(2);
        let beta = mag.map(|m| beta * (1.0 - ea * m * m / (m * m + s2)));
        self.changed = label::partition(
            &self.costs,
            &beta,
            &mut self.labels,
            &mut self.pulls,
            &mut self.spare,
        );
        self.offered.data_mut().fill(255);
        if !planar && par("OFF", 1.0) > 0.0 {
            let most = label::saturation(sigma) * par("OFFC", 0.4) as f32;
            for i in 0..self.labels.len() {
                let owner = usize::from(self.labels.data()[i]);
                if self.costs[owner].data()[i] > most {
                    let mut best = (255u8, par("OFFP", 0.01) as f32);
                    for (j, pull) in self.pulls.iter().enumerate() {
                        if j != owner
                            && (j > 0 || par("OFFB", 1.0) > 0.0)
                            && pull.data()[i] > best.1
                        {
                            best = (j as u8, pull.data()[i]);
                        }
                    }
                    self.offered.data_mut()[i] = best.0;
                }
            }
        }
        self.find_windows();
        if !planar {
            for k in 0..self.regions.len() {
                if let Some(window) = self.regions[k].reach {
                    let full = if k == 0 {
                        Window::whole(self.pair.width(), self.pair.height())
                    } else {
                        self.full_window(window)
                    };
                    let surface = &self.regions[k].state.surface;
                    self.regions[k].state.surface = surface.over(surface.spacing, &full);
                }
            }
        }
    }

    fn dump(&self) {
        thread_local! { static N: std::cell::Cell<usize> = const { std::cell::Cell::new(0) }; }
        let n = N.with(|n| {
            n.set(n.get() + 1);
            n.get()
        });
        let (w, h) = (self.labels.width(), self.labels.height());
        let truth = ORACLE.with(|o| o.borrow().clone()).unwrap();
        let half = (1 << self.level) / 2;
        let mut out = format!("P5 {w} {h} 255\n").into_bytes();
        for y in 0..h {
            for x in 0..w {
                let t = truth[((x << self.level) + half, (y << self.level) + half)];
                let l = self.labels[(x, y)];
                out.push(if l == t { 40 * t } else { 255 - 20 * t });
            }
        }
        std::fs::write(format!("/tmp/dump/{n:02}.pgm"), out).unwrap();
    }

    fn planar_sigma(&self) -> f32 {
        self.regions
            .iter()
            .filter(|r| r.window.is_some())
            .map(|r| r.flow.sigma)
            .fold(0.0, f32::max)
            .max(1.0)
    }

    fn finer(&mut self) {
        self.level -= 1;
        let (w, h) = (self.here().width, self.here().height);
        let old = std::mem::replace(&mut self.labels, Grid::new(1, 1, 0));
        self.labels = Grid::from_fn(w, h, |x, y| {
            old[((x / 2).min(old.width() - 1), (y / 2).min(old.height() - 1))]
        });
        if let Some(l) = oracle(self.level, w, h) {
            if par("ORACLE", 0.0) == 1.0 {
                self.labels = l;
            }
        }
        self.fit_memory();
        self.find_windows();
    }
}

fn free(model: Kind) -> Free {
    match model {
        Kind::Still => Free::Depth,
        Kind::Rotation => Free::Rotation,
        Kind::Translation => Free::Translation,
        Kind::Full => Free::Full,
    }
}

fn penalty(model: Kind) -> f64 {
    match model {
        Kind::Still => 0.0,
        Kind::Rotation => par("PR", 20.0),
        Kind::Translation => par("PT", 30.0),
        Kind::Full => par("PF", 50.0),
    }
}

/// Labels of a coarser scale: what most... a pixel of four alike, else 255.
fn coarsened(labels: &Grid<u8>, times: usize) -> Grid<u8> {
    let mut out = labels.clone();
    for _ in 0..times {
        out = Grid::from_fn(out.width() / 2, out.height() / 2, |x, y| {
            let q = [
                out[(2 * x, 2 * y)],
                out[(2 * x + 1, 2 * y)],
                out[(2 * x, 2 * y + 1)],
                out[(2 * x + 1, 2 * y + 1)],
            ];
            if q[0] == q[1] || q[0] == q[2] || q[0] == q[3] {
                q[0]
            } else {
                q[1]
            }
        });
    }
    out
}

impl Approach for Layered {
    fn find_motions(&mut self, options: &Options) {
        match self.phase {
            Phase::Planar(round) => self.planar_motions(round),
            Phase::Search => {
                self.search_motions(options);
                self.sigma = self
                    .regions
                    .iter()
                    .filter(|r| r.window.is_some())
                    .map(|r| r.flow.sigma)
                    .fold(LEAST_SIGMA, f32::max);
                self.rigid_motions(options, 1);
                self.measure_sigma();
                self.regions.iter_mut().for_each(|r| r.fresh = false);
                self.rigid_motions(options, par("I1", 3.0) as usize);
                self.measure_sigma();
                self.regions.iter_mut().for_each(|r| r.fresh = false);
            }
            Phase::Rigid(n) => {
                if n == 0 && self.level < self.base {
                    for k in 0..self.regions.len() {
                        if let Some(window) = self.regions[k].window {
                            let full = if k == 0 {
                                Window::whole(self.pair.width(), self.pair.height())
                            } else {
                                self.full_window(window)
                            };
                            self.regions[k].state.surface =
                                self.regions[k].state.surface.over(self.spacing(), &full);
                        }
                    }
                    self.rigid_motions(options, 1);
                    self.measure_sigma();
                    self.regions.iter_mut().for_each(|r| r.fresh = false);
                }
                self.rigid_motions(options, par("I2", 2.0) as usize);
                self.measure_sigma();
                self.regions.iter_mut().for_each(|r| r.fresh = false);
                if self.level == 0 && n == 0 && options.choose_kind {
                    self.select_models(options);
                }
            }
            Phase::Done => {}
        }
    }

    fn find_depth(&mut self, options: &Options) {
        if matches!(self.phase, Phase::Search | Phase::Rigid(_)) {
            self.rigid_depth(options, par("I4", 2.0) as usize);
        }
    }

    fn move_curves(&mut self, options: &Options) {
        if par("DUMP", 0.0) > 0.0 {
            self.dump();
        }
        if self.phase == Phase::Done {
            return;
        }
        self.relabel(matches!(self.phase, Phase::Planar(_)), options);
    }

    fn end_pass(&mut self, _still: bool, _options: &Options) -> bool {
        self.phase = match self.phase {
            Phase::Planar(n) if n + 1 < PLANAR_ROUNDS => Phase::Planar(n + 1),
            Phase::Planar(_) => Phase::Search,
            Phase::Search => Phase::Rigid(0),
            Phase::Rigid(n)
                if n + 1
                    < if self.level > 0 {
                        par("NR1", 2.0)
                    } else {
                        par("NR", 2.0)
                    } as usize =>
            {
                Phase::Rigid(n + 1)
            }
            Phase::Rigid(_) if self.level > 0 => {
                self.finer();
                Phase::Rigid(0)
            }
            _ => Phase::Done,
        };
        self.phase != Phase::Done
    }

    fn reconsider(&mut self, _: &Options) {}

    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>, _: &Options) {
        self.place(level_sets);
    }

    fn energy(&self, _: &Options) -> Energy {
        self.energy
    }

    fn labels(&self) -> &Grid<u8> {
        &self.labels
    }

    fn level_sets(&self) -> Vec<Grid<f32>> {
        Vec::new()
    }

    fn motions(&self) -> Vec<(RigidMotion, Kind)> {
        (0..self.regions.len())
            .map(|k| (self.motion(k), self.regions[k].model))
            .collect()
    }

    fn behind(&self) -> Vec<Vec<usize>> {
        Vec::new()
    }

    fn weights(&self) -> Weights {
        Weights::default()
    }

    fn scale(&self) -> (usize, usize) {
        (self.level, self.base + 1)
    }

    fn flat(&self) -> bool {
        false
    }

    fn interpretation(&self, _options: &Options) -> Interpretation {
        let (width, height) = (self.pair.width(), self.pair.height());
        let side = 1 << self.level;
        let labels = Grid::from_fn(width, height, |x, y| {
            self.labels[(
                (x / side).min(self.labels.width() - 1),
                (y / side).min(self.labels.height() - 1),
            )]
        });
        let camera = self.scales[0].camera;
        let mut flow = Flow {
            u: Grid::new(width, height, 0.0),
            v: Grid::new(width, height, 0.0),
        };
        let mut z = Grid::new(width, height, 1.0f32);
        let motions: Vec<RigidMotion> = (0..self.regions.len()).map(|k| self.motion(k)).collect();
        for y in 0..height {
            for x in 0..width {
                let k = usize::from(labels[(x, y)]);
                let rho = self.regions[k].state.surface.at(x as f32, y as f32);
                if let Some((u, v)) =
                    camera.displacement(&motions[k], x as f64, y as f64, f64::from(rho))
                {
                    flow.u[(x, y)] = u as f32;
                    flow.v[(x, y)] = v as f32;
                }
                z[(x, y)] = 1.0 / rho.max(1e-3);
            }
        }
        Interpretation {
            camera,
            labels,
            depth: z,
            flow,
            confidence: Grid::new(width, height, 1.0),
            occluded: Grid::new(width, height, 0),
            motions,
        }
    }
}
