//! What the layers weigh against each other: residuals, noise, and the functional (7) as it stands.

use super::Layers;
use crate::curves::{self, Measure};
use crate::energy::Energy;
use crate::grid::Grid;
use crate::options::Options;
use crate::solver::noise::Noise;
use crate::solver::region::Region;
use crate::solver::rivalry;
use crate::solver::weights::Weights;
use crate::warp::Linearisation;

impl Layers {
    pub(super) fn linearisations(&self) -> Vec<Linearisation> {
        let each = self.regions.iter().enumerate();
        each.map(|(k, region)| {
            let window = self.window(k);
            region.cropped(&window).linearise(self.here(), window)
        })
        .collect()
    }

    pub(super) fn measure_noise(&mut self, lines: &[Linearisation], options: &Options) {
        let flat = self.schedule.deep().is_none();
        self.noise = Noise::measure(lines, &self.labels, self.here(), flat);
        self.weights = Weights::of_layers(self.noise.sigma, self.schedule.settled(), options);
    }

    /// What hypotheses are measured by. Gradients, which help to tell regions apart, see an edge of the
    /// nearer region from outside it: settled curves would stand a pixel off.
    pub(super) fn measure(&self, options: &Options) -> Measure {
        Measure {
            sigma: self.weights.sigma,
            gradient_sigma: (options.gradients && !self.schedule.settled())
                .then_some(self.noise.gradient),
            normalised: options.normalised,
        }
    }

    /// ξ of every region, nobody being excused.
    pub(super) fn residuals(&self, lines: &[Linearisation], options: &Options) -> Vec<Grid<f32>> {
        rivalry::residuals(lines, self.here(), &self.measure(options))
    }

    /// What regions compete with, from their ξ.
    pub(super) fn competition(
        &self,
        mut xi: Vec<Grid<f32>>,
        lines: &[Linearisation],
        options: &Options,
    ) -> Vec<Grid<f32>> {
        let measure = self.measure(options);
        if let Some(cover) = &self.cover {
            rivalry::excuse_hidden(&mut xi, lines, cover, &measure);
        }
        rivalry::charge_distance(&mut xi, &self.phi, &measure);
        xi
    }

    /// What a pixel of curve costs at every place: λ, less on edges.
    pub(super) fn outline(&self, options: &Options) -> Grid<f32> {
        let Weights { lambda, sigma, .. } = self.weights;
        if options.edges {
            curves::outline_cost(&self.here().first, sigma, lambda)
        } else {
            Grid::new(self.labels.width(), self.labels.height(), lambda as f32)
        }
    }

    /// The functional (7) as it stands, in pixels of the frame.
    pub(super) fn energy_in_pixels(&self, options: &Options) -> Energy {
        if self.weights.sigma.is_infinite() {
            return Energy::default();
        }
        let lines = self.linearisations();
        let xi = self.competition(self.residuals(&lines, options), &lines, options);
        let owners = self.labels.data().iter().enumerate();
        let data = owners
            .map(|(i, &k)| f64::from(xi[usize::from(k)].data()[i]))
            .sum::<f64>();
        let deep = self.schedule.deep().is_some();
        let smoothness = |(k, region): (usize, &Region)| {
            if !(deep && region.kind.translates()) {
                return 0.0;
            }
            let window = lines[k].window;
            let evidence = self.evidence(k, window, options);
            let weight = evidence.weights(&lines[k]);
            if weight.data().iter().all(|w| *w <= 0.0) {
                return 0.0;
            }
            let prior = self.prior(k, &evidence, options);
            let bends = region.cropped(&window).bends(&lines[k], &evidence, &weight);
            prior.edges(&bends).energy(&bends, &evidence.owned)
        };
        let outline = self.outline(options);
        let length: f64 = self.phi.iter().map(|phi| curves::cost(phi, &outline)).sum();
        // In pixels of the frame: areas grow fourfold from scale to scale, lengths twofold.
        let side = f64::from(1u32 << self.schedule.level);
        Energy {
            data: data * side * side,
            smoothness: self.regions.iter().enumerate().map(smoothness).sum::<f64>() * side * side,
            length: length * side,
        }
    }
}
