//! What a user should know of frames that are taken all the same.

use serde::Serialize;

/// A remark on two frames.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Note {
    /// Part of the frames shows nothing of the scene.
    Absent {
        /// Share of the frame, 0–1.
        share: f64,
    },
    /// All that is seen lies within so few steps of brightness that detail is lost.
    Faint {
        /// Steps between the darkest and the brightest.
        levels: usize,
    },
    /// Even and odd rows show different moments.
    Interlaced,
    /// The files' numbers have room for much brighter light.
    Stretched {
        /// Share of the files' range that is used, 0–1.
        share: f64,
    },
}

impl std::fmt::Display for Note {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Absent { share } => write!(
                f,
                "{:.1} % of the frames do not show the scene: they are transparent, black bars, or a logo or text over the picture. No depth is found there.",
                100.0 * share
            ),
            Self::Faint { levels } => write!(
                f,
                "The frames have little contrast: only {levels} levels of brightness. The contrast of both is stretched equally. Fine relief and small motions may be lost."
            ),
            Self::Interlaced => write!(
                f,
                "The first frame seems to be interlaced: even and odd rows show different moments. Take its two fields instead."
            ),
            Self::Stretched { share } => write!(
                f,
                "The frames use only {:.1} % of the brightness range of their files. The contrast of both is stretched equally.",
                100.0 * share
            ),
        }
    }
}
