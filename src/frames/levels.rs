//! The grey levels that two frames use, and both stretched alike where these are few.
//!
//! ```text
//! v ↦ 16 + (v − low) · 219 / (high − low)         when high − low < 64
//! ```
//!
//! low and high are quantiles of the brightness of both frames, in grey levels: a camera's 12 bits in a file of 16 fill a
//! sixteenth of it, and are shown black and judged by noise that is not theirs. Stretched, they are what they
//! would be had the file been filled. The ends leave room for what is brighter or darker than the quantiles.

use std::sync::Arc;

use super::frame::Frame;
use super::note::Note;

/// Share of pixels that may be darker than `low`, and brighter than `high`.
const BEYOND: f64 = 1e-3;
/// Levels that are stretched when all pixels lie within fewer.
const NARROW: f32 = 64.0;
/// What `low` and `high` become.
const ENDS: [f32; 2] = [16.0, 235.0];
/// Fewer steps of the file's numbers than this between `low` and `high` are worth a word.
const FEW_STEPS: f32 = 64.0;
/// Classes of the histogram in a grey level: those of 16-bit files.
const CLASSES: f32 = 257.0;

/// The grey levels between which frames lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Levels {
    low: f32,
    high: f32,
}

impl Levels {
    /// The levels of all frames together.
    pub fn of(frames: &[&Frame]) -> Self {
        let mut counts = vec![0u64; 65_536];
        for v in frames.iter().flat_map(|frame| frame.grey.data()) {
            counts[((v * CLASSES + 0.5) as usize).min(65_535)] += 1;
        }
        let beyond = (BEYOND * counts.iter().sum::<u64>() as f64) as u64;
        let quantile = |mut classes: Box<dyn Iterator<Item = usize>>| {
            let mut sum = 0;
            classes.find(|&i| {
                sum += counts[i];
                sum > beyond
            })
        };
        let low = quantile(Box::new(0..65_536)).unwrap_or(0);
        let high = quantile(Box::new((0..65_536).rev())).unwrap_or(0);
        Self {
            low: low as f32 / CLASSES,
            high: high as f32 / CLASSES,
        }
    }

    /// Whether frames that lie between them are stretched.
    pub fn narrow(&self) -> bool {
        self.high > self.low && self.high - self.low < NARROW
    }

    /// What to say of frames that are stretched, whose files count in steps of `step` grey levels.
    pub fn note(&self, step: f32) -> Note {
        let [low, high] = [self.low, self.high];
        let steps = (high - low) / step;
        // Brightness that was computed has no steps.
        if steps < FEW_STEPS {
            Note::Faint {
                levels: steps as usize + 1,
            }
        } else {
            Note::Stretched {
                share: f64::from(high / 255.0),
            }
        }
    }

    /// The frame with these levels stretched.
    pub fn stretch(&self, frame: &Frame) -> Frame {
        let gain = (ENDS[1] - ENDS[0]) / (self.high - self.low);
        let stretched = |v: f32| ENDS[0] + gain * (v - self.low);
        let shown = |v: f32| stretched(v).round().clamp(0.0, 255.0) as u8;
        let rgb = match &frame.deep {
            Some(deep) => deep.map(|c| c.map(|c| shown(f32::from(c) / CLASSES))),
            None => frame.rgb.map(|c| c.map(|c| shown(f32::from(c)))),
        };
        Frame {
            grey: Arc::new(frame.grey.map(stretched)),
            rgb: Arc::new(rgb),
            deep: None,
            ..frame.clone()
        }
    }
}
