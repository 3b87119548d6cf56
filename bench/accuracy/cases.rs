//! What is measured: the built-in sequences, and variants that nobody tuned for.
//!
//! A case is a recipe. It is rendered only where it is worked on, so that a run holds few pictures
//! at a time.

use relievo::scene::{self, Sequence};

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

/// A recipe for a sequence.
#[derive(Clone, Debug)]
pub enum Case {
    /// One of [`scene::names`].
    BuiltIn(&'static str),
    /// What [`scene::variant`] takes, or [`scene::passing`].
    Variant {
        /// Whether all of it stands still and is filmed in passing.
        passing: bool,
        /// "blocks" or "carousel".
        base: &'static str,
        /// Decides shapes, textures, lamp and motions.
        seed: u64,
        /// Grey levels.
        noise: f32,
        /// Pixels.
        displacement: f64,
    },
}

impl Case {
    /// Every built-in sequence.
    pub fn built_in() -> Vec<Self> {
        scene::names().map(Self::BuiltIn).collect()
    }

    /// The variants whose seeds begin at `seed`. The two bases take turns; noise and displacement
    /// pass through their values at paces of their own, so that strong noise meets small motion too.
    pub fn variants(seed: u64, passing: bool) -> Vec<Self> {
        let variant = |k: u64| Self::Variant {
            passing,
            base: ["blocks", "carousel"][(k % 2) as usize],
            seed: seed.wrapping_add(k),
            noise: NOISES[(k / 2 % 5) as usize],
            displacement: DISPLACEMENTS[((k / 2 * 3 + k / 10) % 5) as usize],
        };
        (0..VARIANTS).map(variant).collect()
    }

    /// The sequence's name, as [`Sequence::name`] will have it.
    pub fn name(&self) -> String {
        match self {
            Self::BuiltIn(name) => (*name).to_owned(),
            Self::Variant {
                passing: true,
                base,
                seed,
                ..
            } => format!("passing-{base}-{seed}"),
            Self::Variant { base, seed, .. } => format!("{base}-{seed}"),
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
            Self::Variant {
                passing,
                base,
                seed,
                noise,
                displacement,
            } => {
                let draw = if passing {
                    scene::passing
                } else {
                    scene::variant
                };
                draw(base, seed, noise, displacement, width, height)
            }
        };
        Ok(sequence?)
    }
}
