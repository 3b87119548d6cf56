//! Between which inverse depths a picture shows depth.
//!
//! From the 2nd to the 98th percentile of 1/Z over pixels whose depth is observable, so that a few
//! wild ones do not set the range.

use crate::interpretation::Interpretation;

/// Confidence from which a depth counts.
pub(super) const OBSERVABLE: f32 = 0.1;
/// A span is at least this share of its middle: a plane facing the camera is not stretched into noise.
const LEAST_SHARE: f32 = 0.02;

/// A range of inverse depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    /// Least 1/Z.
    pub far: f32,
    /// Greatest 1/Z.
    pub near: f32,
}

impl Span {
    /// The span of the pixels in `keep` with observable depth; of all in `keep` if `any` and none is
    /// observable.
    pub fn of(found: &Interpretation, any: bool, keep: impl Fn(usize) -> bool) -> Option<Self> {
        let collect = |least: f32| -> Vec<f32> {
            (0..found.depth.len())
                .filter(|&i| keep(i) && found.confidence.data()[i] >= least)
                .map(|i| 1.0 / found.depth.data()[i])
                .filter(|rho| rho.is_finite() && *rho > 0.0)
                .collect()
        };
        let mut rho = collect(OBSERVABLE);
        if rho.is_empty() && any {
            rho = collect(f32::NEG_INFINITY);
        }
        let (far, near) = (percentile(&mut rho, 0.02)?, percentile(&mut rho, 0.98)?);
        let middle = (far + near) / 2.0;
        let half = ((near - far) / 2.0).max(LEAST_SHARE * middle / 2.0);
        Some(Self {
            far: middle - half,
            near: middle + half,
        })
    }

    /// 0 at the far end to 1 at the near end, clamped; 0 for a depth that is no number.
    pub fn nearness(&self, depth: f32) -> f32 {
        let t = (1.0 / depth - self.far) / (self.near - self.far);
        if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) }
    }
}

/// The value below which a share `q` of the values lies; they are reordered.
pub(super) fn percentile(values: &mut [f32], q: f32) -> Option<f32> {
    if values.is_empty() {
        return None;
    }
    let rank = (q * (values.len() - 1) as f32).round() as usize;
    let (_, value, _) = values.select_nth_unstable_by(rank, f32::total_cmp);
    Some(*value)
}
