//! How brightness changes between two frames as a whole: I2 ≈ gain · I1 + offset.
//!
//! Exposure and light change from frame to frame, while the share of pixels that are darker than any given
//! one hardly does. The line through the quantiles of both frames (5 % to 95 %, least squares) is
//! therefore known before anything is known of motion. Grey levels.

use crate::grid::Grid;

/// Quantiles compared.
const QUANTILES: usize = 19;
/// A gain nearer to 1 and an offset nearer to 0, in grey levels, than these may come from what moved.
const PLAIN: (f64, f64) = (0.04, 4.0);

/// A change of brightness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// What the first frame's brightness is multiplied with.
    pub gain: f64,
    /// What is added to it then, grey levels.
    pub offset: f64,
}

impl Default for Lighting {
    fn default() -> Self {
        Self {
            gain: 1.0,
            offset: 0.0,
        }
    }
}

impl Lighting {
    /// The change between two frames, none when it is too small to be told from what moves.
    pub fn between(first: &Grid<f32>, second: &Grid<f32>) -> Self {
        let (a, b) = (quantiles(first), quantiles(second));
        let n = QUANTILES as f64;
        let (ma, mb) = (a.iter().sum::<f64>() / n, b.iter().sum::<f64>() / n);
        let pairs = || a.iter().zip(&b).map(|(a, b)| (a - ma, b - mb));
        let spread: f64 = pairs().map(|(a, _)| a * a).sum();
        if spread <= 0.0 {
            return Self::default();
        }
        let gain = pairs().map(|(a, b)| a * b).sum::<f64>() / spread;
        let found = Self {
            gain,
            offset: mb - gain * ma,
        };
        let shift = found.gain * ma + found.offset - ma;
        if gain > 0.0 && ((gain - 1.0).abs() > PLAIN.0 || shift.abs() > PLAIN.1) {
            found
        } else {
            Self::default()
        }
    }

    /// This change and then `next`.
    pub fn then(self, next: Self) -> Self {
        Self {
            gain: self.gain * next.gain,
            offset: next.gain * self.offset + next.offset,
        }
    }
}

fn quantiles(picture: &Grid<f32>) -> [f64; QUANTILES] {
    let mut values = picture.data().to_vec();
    values.sort_unstable_by(f32::total_cmp);
    std::array::from_fn(|i| {
        let rank = (i + 1) * (values.len() - 1) / (QUANTILES + 1);
        f64::from(values[rank])
    })
}
