//! What residuals say: how noisy the frames are, how well each region fits, how the light has changed.

use super::evidence::Evidence;
use super::region::Region;
use crate::frames::Lighting;
use crate::grid::Grid;
use crate::motion::solve_positive;
use crate::paper::spread;
use crate::warp::{Linearisation, RESIDUAL, Scale};

/// Least σ of the gradient's change: frames of 8 bits are not known better.
const LEAST_GRADIENT_SIGMA: f64 = 0.2;

/// Standard deviations of residuals.
#[derive(Clone, Debug)]
pub(super) struct Noise {
    /// Of the whole frame's, grey levels.
    pub sigma: f64,
    /// Of the gradient's change, grey levels per pixel.
    pub gradient: f64,
    /// Of each region's own, grey levels.
    pub regions: Vec<f64>,
}

impl Noise {
    /// Not measured yet.
    pub fn unknown(regions: usize) -> Self {
        Self {
            sigma: f64::INFINITY,
            gradient: LEAST_GRADIENT_SIGMA,
            regions: vec![0.0; regions],
        }
    }

    /// As the owners of pixels see it; while curves mean little, as the best `of_all` regions does.
    pub fn measure(
        lines: &[Linearisation],
        labels: &Grid<u8>,
        scale: &Scale,
        of_all: bool,
    ) -> Self {
        let mut least = Grid::new(labels.width(), labels.height(), f32::INFINITY);
        let mut changes = Vec::new();
        let mut regions = Vec::new();
        for (k, line) in lines.iter().enumerate() {
            let mut own = Vec::new();
            for i in (0..line.rows.len()).filter(|&i| line.inside.data()[i]) {
                let at = line.window.place(i);
                let r = line.rows.data()[i][RESIDUAL].abs();
                let owns = usize::from(labels[at]) == k;
                if owns {
                    own.push(r);
                    changes.extend(line.gradient_change(scale, i));
                }
                if owns || of_all {
                    least[at] = least[at].min(r);
                }
            }
            regions.push(spread(own));
        }
        let seen = least.data().iter().filter(|r| r.is_finite());
        Self {
            sigma: spread(seen.copied().collect()),
            gradient: spread(changes).max(LEAST_GRADIENT_SIGMA),
            regions,
        }
    }
}

/// Gain and offset that are left over, from where the first frame's pixels are found in the second: least
/// squares of the residual on brightness, over what fits.
pub(super) fn change_of_light<'a>(
    regions: impl Iterator<Item = (Region, Evidence<'a>)>,
) -> Option<Lighting> {
    let mut normal = [[0.0f64; 2]; 2];
    let mut right = [0.0f64; 2];
    for (region, evidence) in regions {
        let line = evidence.linearise(&region);
        let weight = evidence.weights(&line);
        for (i, &w) in weight.data().iter().enumerate() {
            let w = f64::from(w);
            let brightness = evidence.scale.first[line.window.place(i)];
            let basis = [f64::from(brightness), 1.0];
            let change = f64::from(line.rows.data()[i][RESIDUAL] + region.shade.data()[i]);
            for a in 0..2 {
                right[a] += w * basis[a] * change;
                for b in 0..2 {
                    normal[a][b] += w * basis[a] * basis[b];
                }
            }
        }
    }
    let [gain, offset] = solve_positive(&normal, &right)?;
    Some(Lighting {
        gain: 1.0 + gain,
        offset,
    })
}
