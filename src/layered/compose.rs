//! One picture out of layers: at each pixel of the frame the depth, motion and confidence of the region that owns it,
//! and what the second frame hides; at any scale.

use super::label::Occlusion;
use super::solver::{Layered, Phase};
use crate::camera::RigidMotion;
use crate::confidence::confidence;
use crate::curves::smoothed;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation, NEAREST_FARTHEST};
use crate::options::Options;
use crate::solver::Expected;

/// What flow is off by on the mean where surfaces fit, in pixels of the scale at work.
const FLOW_ERROR: f64 = 0.05;
/// Squared slope that noise alone has, in σ² of the residual: a third on smoothed frames, half as much again by chance.
const NOISE: f32 = 0.5;
/// Confidence of a region that two motions explain equally well, at most.
const AMBIGUOUS: f32 = 0.5;

impl Layered {
    /// What the frames are taken for.
    pub(super) fn compose(&self, options: &Options) -> Interpretation {
        let (width, height) = (self.pair.width(), self.pair.height());
        let camera = self.scales[0].camera;
        let labels = self.frame_labels();
        let motions: Vec<RigidMotion> = self.regions.iter().map(|r| r.state.motion()).collect();
        let planar = matches!(self.phase, Phase::Planar(_));
        let finest = &self.scales[0];
        let occlusion = (options.occlusion && !planar && self.regions.len() > 1).then(|| {
            let states = self.regions.iter().map(|r| &r.state);
            Occlusion::of(finest, 0, states, &labels)
        });
        let mut flow = Flow {
            u: Grid::new(width, height, 0.0),
            v: Grid::new(width, height, 0.0),
        };
        let mut depth = Grid::new(width, height, 1.0f32);
        let mut squares = Grid::new(width, height, 0.0f32);
        let mut occluded = Grid::new(width, height, 0u8);
        let [nearest, farthest] = NEAREST_FARTHEST;
        let f = camera.focal as f32;
        let views: Vec<_> = (self.regions.iter())
            .map(|r| r.state.view(&camera))
            .collect();
        for y in 0..height {
            for x in 0..width {
                let at = (x, y);
                let k = usize::from(labels[at]);
                let region = &self.regions[k];
                if planar {
                    let ray = camera.ray(x as f64, y as f64);
                    let (u, v) = region.flow.at(ray.x as f32, ray.y as f32);
                    (flow.u[at], flow.v[at]) = (u * f, v * f);
                    continue;
                }
                let rho = region.rho(x, y);
                let [to_x, to_y] = views[k].target(x, y, rho);
                (flow.u[at], flow.v[at]) = (to_x - x as f32, to_y - y as f32);
                depth[at] = rho.max(farthest.recip()).recip().max(nearest);
                let hidden = k == 0 && occlusion.as_ref().is_some_and(|o| o.at(to_x, to_y) != 0);
                let seen = finest.contains(to_x, to_y) && !hidden;
                occluded[at] = u8::from(!seen);
                if seen && region.state.model.translates() {
                    let t = region.state.translation.as_vec3().to_array();
                    let (px, py) = ((to_x - camera.cx as f32) / f, (to_y - camera.cy as f32) / f);
                    let [gx, gy] = [&finest.gradient[0], &finest.gradient[1]].map(|g| g[at]);
                    let (mx, my) = (f * (t[0] - px * t[2]), f * (t[1] - py * t[2]));
                    let steep = NOISE * self.sigma * self.sigma * (mx * mx + my * my);
                    squares[at] = (gx * mx + gy * my).powi(2) - steep;
                }
            }
        }
        let mut confidence = confidence(&squares, f64::from(self.sigma));
        for (i, c) in confidence.data_mut().iter_mut().enumerate() {
            let region = &self.regions[usize::from(labels.data()[i])];
            if occluded.data()[i] != 0
                || !region.state.model.translates()
                || !region.rigid
                || planar
            {
                *c = 0.0;
            } else if region.ambiguous {
                *c = c.min(AMBIGUOUS);
            }
        }
        Interpretation {
            camera,
            labels,
            depth,
            flow,
            confidence,
            occluded,
            motions,
        }
    }

    /// Labels at the frame's size; outlines between pixels of a coarse scale come from what surrounds them.
    pub(super) fn frame_labels(&self) -> Grid<u8> {
        let (width, height) = (self.pair.width(), self.pair.height());
        if self.level == 0 {
            return self.labels.clone();
        }
        let (level, labels) = (self.level, &self.labels);
        Grid::from_fn(width, height, |x, y| {
            labels[(
                (x >> level).min(labels.width() - 1),
                (y >> level).min(labels.height() - 1),
            )]
        })
    }

    /// φk at the frame's size: how much more of its surroundings belong to k than to any other region, in pixels.
    pub(super) fn smooth_level_sets(&self) -> Vec<Grid<f32>> {
        let labels = self.frame_labels();
        let side = (1 << self.level) as f32;
        let level_set = |k| smoothed(&labels.map(|l| usize::from(l) == k), side);
        (1..self.regions.len()).map(level_set).collect()
    }

    /// How good labels and flow are, judged by the scale at work and, in the end, by matches.
    pub(super) fn expected_now(&self) -> Option<Expected> {
        if matches!(self.phase, Phase::Planar(_) | Phase::Search) {
            return None;
        }
        let labels = &self.labels;
        let beside = (0..labels.height())
            .flat_map(|y| labels.row(y).windows(2))
            .filter(|pair| pair[0] != pair[1])
            .count();
        Some(Expected {
            flow: FLOW_ERROR * f64::from(1u32 << self.level) + self.far,
            // Of the two pixels beside an outline one has the wrong label.
            labels: beside as f64 / labels.len() as f64,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn confidence_grows_with_what_shows() {
        let of =
            |slope: f32, sigma: f64| confidence(&Grid::new(31, 31, slope * slope), sigma)[(15, 15)];
        assert_eq!(of(0.0, 1.0), 0.0);
        let mut before = 0.0;
        for slope in [0.1, 0.3, 1.0, 3.0, 10.0] {
            let c = of(slope, 1.0);
            assert!(c > before && c < 1.0);
            assert_eq!(of(-slope, 1.0), c);
            assert!(of(slope, 2.0) < c);
            before = c;
        }
        assert!(before > 0.99);
        // ½ where ρ is known to 0.15: 4π 2.5² pixels of slope a know it to σ / (a √(4π 2.5²)).
        let pixels = 4.0 * std::f64::consts::PI * 2.5 * 2.5;
        for sigma in [0.5, 2.0] {
            let half = (sigma / (0.15 * pixels.sqrt())) as f32;
            assert!((of(half, sigma) - 0.5).abs() < 1e-3);
        }
    }

    #[test]
    fn confidence_reaches_as_far_as_smoothing_does() {
        let squares = Grid::from_fn(60, 20, |x, _| if x < 30 { 16.0 } else { 0.0 });
        let c = confidence(&squares, 1.0);
        assert!(c[(10, 10)] > 0.9 && c[(29, 10)] > 0.5);
        assert_eq!(c[(50, 10)], 0.0);
        for x in 0..59 {
            assert!(c[(x + 1, 10)] <= c[(x, 10)] + 1e-6);
        }
    }
}
