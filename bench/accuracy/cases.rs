//! What is measured: the built-in sequences, and variants that nobody tuned for.
//!
//! A case is a recipe. It is rendered only where it is worked on, so that a run holds few pictures
//! at a time.

use relievo::scene::{self, Draw, Sequence};

use crate::Failure;

/// Columns and rows at which everything is measured.
const SIZE: [usize; 2] = [320, 240];
/// The first variant's seed unless another is asked for.
pub const SEED: u64 = 1000;
/// Number of variants.
const VARIANTS: u64 = 20;
/// Their noise in grey levels.
const NOISES: [f32; 5] = [1.0, 2.0, 3.0, 4.0, 6.0];
/// Their largest image motion in pixels.
const DISPLACEMENTS: [f64; 5] = [2.0, 4.0, 6.0, 9.0, 12.0];

/// How a random scene is filmed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filming {
    /// Bodies move.
    Moving,
    /// All stands still and is filmed in passing.
    Passing,
    /// Bodies move before a background of little relief.
    Mild,
}

/// A recipe for a sequence.
#[derive(Clone, Debug)]
pub enum Case {
    /// One of [`scene::names`].
    BuiltIn(&'static str),
    /// What [`scene::variant`], [`scene::passing`] and [`scene::mild`] take.
    Variant {
        /// How it is filmed.
        filming: Filming,
        /// What decides it.
        draw: Draw<'static>,
    },
}

impl Case {
    /// Every built-in sequence.
    pub fn built_in() -> Vec<Self> {
        scene::names().map(Self::BuiltIn).collect()
    }

    /// The variants whose seeds begin at `seed`. The two bases take turns; noise and displacement
    /// pass through their values at paces of their own, so that strong noise meets small motion too.
    pub fn variants(seed: u64, filming: Filming) -> Vec<Self> {
        let variant = |k: u64| Self::Variant {
            filming,
            draw: Draw {
                base: ["blocks", "carousel"][(k % 2) as usize],
                seed: seed.wrapping_add(k),
                noise_sigma: NOISES[(k / 2 % 5) as usize],
                displacement: DISPLACEMENTS[((k / 2 * 3 + k / 10) % 5) as usize],
                size: SIZE,
            },
        };
        (0..VARIANTS).map(variant).collect()
    }

    /// The sequence's name, as [`Sequence::name`] will have it.
    pub fn name(&self) -> String {
        match self {
            Self::BuiltIn(name) => (*name).to_owned(),
            Self::Variant { filming, draw } => {
                let name = format!("{}-{}", draw.base, draw.seed);
                match filming {
                    Filming::Moving => name,
                    Filming::Passing => format!("passing-{name}"),
                    Filming::Mild => format!("mild-{name}"),
                }
            }
        }
    }

    /// Whether it was drawn at random.
    pub fn drawn(&self) -> bool {
        matches!(self, Self::Variant { .. })
    }

    /// The sequence itself.
    pub fn render(&self) -> Result<Sequence, Failure> {
        let [width, height] = SIZE;
        let sequence = match *self {
            Self::BuiltIn(name) => scene::render(name, width, height),
            Self::Variant { filming, ref draw } => match filming {
                Filming::Moving => scene::variant(draw),
                Filming::Passing => scene::passing(draw),
                Filming::Mild => scene::mild(draw),
            },
        };
        Ok(sequence?)
    }
}
