//! The steps of a pass of the coarse-to-fine solver: motion, depth, curves, and the way to the next scale.

use super::Layers;
use crate::camera::RigidMotion;
use crate::curves;
use crate::energy::Energy;
use crate::grid::Grid;
use crate::interpretation::Interpretation;
use crate::motion::Kind;
use crate::occlusion::Cover;
use crate::options::{MotionMethod, Options};
use crate::solver::approach::Approach;
use crate::solver::composition::{Layer, composed};
use crate::solver::evidence::Role;
use crate::solver::region::Region;
use crate::solver::sweep::swept;
use crate::solver::weights::Weights;
use crate::solver::{choice, rivalry, stiffness};
use crate::warp::pyramid;

/// Steps of motion and depth in a pass, and for a body whose depth is free to depart from its surface as many as this while
/// motion does not stand still. Not for the background: its depth may leap where no curve is, and T, followed to the end,
/// goes after what no depth explains.
const JOINT_STEPS: [usize; 2] = [2, 8];
/// Steps of depth alone where motions are held, as many as depth has in a pass in which they are not, and where depth has
/// been swept, which leaves it rough.
const DEPTH_STEPS: usize = JOINT_STEPS[0] + 1;
/// Pixels by which a region grows when all curves move to the least partition.
const REACH: f32 = 1.0;

impl Approach for Layers {
    fn find_motions(&mut self, options: &Options) {
        self.look_for_bodies(options);
        if self.weights.sigma.is_infinite() {
            let lines = self.linearisations();
            self.measure_noise(&lines, options);
        }
        let schedule = self.schedule;
        if schedule.rests() {
            return;
        }
        if schedule.deep().is_none() {
            if !schedule.begins() {
                self.each_region(options, |region, evidence, _| {
                    for _ in 0..JOINT_STEPS[0] {
                        region.fit_flat(evidence);
                    }
                });
            }
            return;
        }
        self.each_region(options, |region, evidence, prior| {
            if options.motion == MotionMethod::LeastSquares {
                region.fit_flat(evidence);
                region.normalise(&evidence.owned);
                return;
            }
            if options.search && schedule.searches() {
                region.search(evidence, prior);
            }
            let free = evidence.role == Role::Body && evidence.departing;
            let most = JOINT_STEPS[usize::from(free)];
            region.fit(evidence, prior, [JOINT_STEPS[0], most]);
            if options.search && schedule.chooses_relief() && region.kind == Kind::Full {
                *region = choice::in_relief(region, evidence, prior, schedule.reliefs());
            }
            if options.choose_kind && schedule.chooses() {
                *region = choice::chosen(region, evidence, prior, schedule.reliefs());
            }
        });
    }

    fn find_depth(&mut self, options: &Options) {
        if self.schedule.deep().is_some() {
            let learns = options.mu.is_none() && self.schedule.learns();
            let sweeps = options.sweep && self.schedule.sweeps();
            let rests = self.schedule.rests();
            // On the first scale depth that follows anything would take what curves are still to take.
            let refined = self.schedule.level < self.schedule.start;
            self.each_region(options, |region, evidence, prior| {
                let sweeps = sweeps && region.kind.translates() && evidence.role != Role::Body;
                if sweeps {
                    region.rho = swept(region, evidence);
                    region.normalise(&evidence.owned);
                }
                if learns {
                    region.stiffness = stiffness::foretelling(region, evidence, prior);
                }
                let steps = if rests || sweeps && refined {
                    DEPTH_STEPS
                } else {
                    1
                };
                for _ in 0..steps {
                    region.fit_depth(evidence, prior);
                    region.normalise(&evidence.owned);
                }
                if options.lighting {
                    region.shade = evidence.shade(region);
                }
            });
            if learns {
                self.schedule.has_learnt();
            }
        }
    }

    fn move_curves(&mut self, options: &Options) {
        self.look_for_bodies(options);
        self.go_to_bodies();
        let mut lines = self.linearisations();
        self.measure_noise(&lines, options);
        if self.phi.is_empty() || self.schedule.holds_curves() {
            return;
        }
        if options.growth && self.schedule.grows() {
            self.grow(options);
            lines = self.linearisations();
        }
        let xi = self.residuals(&lines, options);
        if !(options.occlusion && self.schedule.excuses()) {
            self.cover = None;
        } else if self.cover.is_none() || !self.schedule.holds_cover() {
            let measure = self.measure(options);
            self.cover = Some(rivalry::cover(&lines, &xi, &self.labels, &measure));
        }
        let xi = self.competition(xi, &lines, options);
        if options.partition && self.schedule.repartitions() {
            self.phi = curves::least_partition(&self.phi, &xi, &self.outline(options), REACH);
        } else if self.schedule.settled() {
            let outline = self.outline(options);
            curves::evolve(&mut self.phi, &xi, &outline, options.curve_steps);
        } else {
            self.phi = curves::threshold(&xi, self.schedule.window());
        }
        if options.islands && self.schedule.deep().is_some() {
            curves::without_islands(&mut self.phi);
        }
        self.relabel();
        self.unclaimed = rivalry::unexplained(&xi, &self.labels, self.weights.sigma);
    }

    fn end_pass(&mut self, still: bool, options: &Options) -> bool {
        if options.lighting && self.schedule.relights() {
            self.measure_lighting(options);
        }
        if self.schedule.advance() {
            self.refine();
        }
        self.schedule.unfinished() || options.cross_validation && self.schedule.comes_to_rest(still)
    }

    fn reconsider(&mut self, options: &Options) {
        if options.smoothing != self.smoothing {
            self.smoothing = options.smoothing;
            self.scales = pyramid(&self.pair, self.scales[0].camera, options.smoothing);
            for scale in &mut self.scales {
                scale.relight(self.lighting);
            }
        }
        self.weights = Weights::of_layers(self.noise.sigma, self.schedule.settled(), options);
        self.schedule.stir();
        self.forget_stiffness();
    }

    fn replace_curves(&mut self, level_sets: Vec<Grid<f32>>, options: &Options) {
        if !self.schedule.begun() {
            // Nothing has been found yet, and with which scale to begin depends on how many curves there are.
            let camera = self.scales[0].camera;
            *self = Self::new(self.pair.clone(), camera, level_sets, options);
            return;
        }
        let (width, height) = (self.labels.width(), self.labels.height());
        let known = self.regions.len();
        // The search for motions and threshold dynamics, which end with a scale's first passes, are
        // needed again.
        self.schedule.restart();
        self.regions
            .resize(level_sets.len() + 1, Region::new(width, height));
        self.forget_stiffness();
        self.noise.regions.resize(level_sets.len() + 1, 0.0);
        self.cover = None;
        self.unclaimed.data_mut().fill(false);
        self.place_curves(level_sets);
        self.propose_motions(known);
    }

    fn energy(&self, options: &Options) -> Energy {
        self.energy_in_pixels(options)
    }

    fn labels(&self) -> &Grid<u8> {
        &self.labels
    }

    fn level_sets(&self) -> Vec<Grid<f32>> {
        let side = (1u32 << self.schedule.level) as f32;
        let each = self.phi.iter();
        each.map(|phi| self.at_full_size(phi).map(|p| side * p))
            .collect()
    }

    fn motions(&self) -> Vec<(RigidMotion, Kind)> {
        let camera = self.scales[0].camera;
        let each = self.regions.iter();
        each.map(|r| (r.motion, r.kind.min(Kind::seen(&camera, &r.motion))))
            .collect()
    }

    fn behind(&self) -> Vec<Vec<usize>> {
        self.cover.as_ref().map_or_else(Vec::new, Cover::behind)
    }

    fn weights(&self) -> Weights {
        self.weights
    }

    fn scale(&self) -> (usize, usize) {
        (self.schedule.level, self.schedule.start + 1)
    }

    fn settled(&self) -> bool {
        self.schedule.settled()
    }

    fn rests(&self) -> bool {
        self.schedule.rests()
    }

    fn flat(&self) -> bool {
        self.schedule.deep().is_none()
    }

    fn interpretation(&self, options: &Options) -> Interpretation {
        let read: Vec<Layer> = self
            .regions
            .iter()
            .zip(self.motions())
            .map(|(region, (motion, kind))| Layer {
                motion,
                kind,
                rho: self.at_full_size(&region.rho),
                shade: self.at_full_size(&region.shade),
            })
            .collect();
        let measure = self.measure(options);
        composed(
            &self.scales[0],
            &self.level_sets(),
            &read,
            &measure,
            options.occlusion,
        )
    }
}
