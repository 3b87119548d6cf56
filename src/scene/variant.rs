//! Random variants of `blocks` and `carousel`, and of `carousel` with a fourth body, for measuring on scenes that nobody
//! tuned for.
//!
//! A seed decides shapes, places, textures, lamp and motions. A draw is kept when every object shows
//! between [`LEAST_SHOWN`] and [`MOST_SHOWN`] of the frame, covers its own middle, and moves
//! otherwise than the background would in its place; else the next one is drawn. Each body's motion
//! is scaled so that its fastest pixel covers a drawn share of the displacement asked for, and the
//! fastest body all of it.

use glam::DVec3;

use super::cast::{Caster, Moment};
use super::dice::Dice;
use super::film::Film;
use super::lottery::{self, Course};
use super::stage::Stage;
use super::{Draw, Entry, Sequence, blocks, camera, carousel, truth};
use crate::camera::{Camera, RigidMotion};
use crate::error::{Error, within};
use crate::grid::Grid;

/// Share of the frame that every object shows at least.
const LEAST_SHOWN: f64 = 0.035;
/// Share of the frame that no object exceeds.
const MOST_SHOWN: f64 = 0.2;
/// Mean difference in image motion between an object and the background in its place, as a share of
/// the largest displacement.
const LEAST_DIFFERENCE: f64 = 0.3;
/// Draws after which the last one is taken as it is.
const DRAWS: usize = 400;
/// The grid on which a draw is judged.
const SKETCH: (usize, usize) = (80, 60);
/// Width at which displacements are stated.
const STATED_WIDTH: f64 = 320.0;
/// Largest displacement that can be asked for.
const MOST_DISPLACEMENT: f64 = 16.0;
/// Largest noise that can be asked for.
const MOST_NOISE: f64 = 50.0;

/// Renders the variant that `draw` decides. Frames are rounded again after noise.
///
/// # Errors
/// [`Error::Choice`] for another base, [`Error::Option`] for a noise or displacement out of range,
/// [`Error::Size`] outside the limits of a frame.
pub fn variant(draw: &Draw<'_>) -> Result<Sequence, Error> {
    Drawn::new(draw)?.filmed(draw, "", "", "")
}

/// A stage drawn from a seed, with all that filming it takes.
pub(super) struct Drawn {
    pub entry: Entry,
    pub stage: Stage,
    /// What else is drawn for it.
    pub dice: Dice,
    noise: Dice,
    noise_sigma: f32,
    camera: Camera,
    size: [usize; 2],
}

impl Drawn {
    /// The stage of the variant.
    pub fn new(draw: &Draw<'_>) -> Result<Self, Error> {
        let Draw {
            base,
            seed,
            noise_sigma,
            displacement,
            size,
        } = *draw;
        let (entry, bodies) = match base {
            "blocks" => (blocks::ENTRY, 2),
            "carousel" => (carousel::ENTRY, 3),
            "crowd" => (carousel::ENTRY, 4),
            _ => {
                return Err(Error::Choice {
                    what: "sequence with variants".to_owned(),
                    value: base.to_owned(),
                    choices: "blocks, carousel, crowd".to_owned(),
                });
            }
        };
        within("noise", f64::from(noise_sigma), 0.0, MOST_NOISE)?;
        within("displacement", displacement, 0.1, MOST_DISPLACEMENT)?;
        let camera = camera(base, size[0], size[1])?;
        // Another stream for each base, and another for the noise.
        let stream = match bodies {
            2 => 0x626c_6f63,
            3 => 0x6361_726f,
            _ => 0x6372_6f77,
        };
        let mut dice = Dice::new(seed ^ stream);
        let noise = Dice::new(dice.bits());
        let (mut stage, mut courses) = lottery::draw(&mut dice, bodies);
        let mut draws = 1;
        while !set_motion(&mut stage, &courses, displacement) && draws < DRAWS {
            (stage, courses) = lottery::draw(&mut dice, bodies);
            draws += 1;
        }
        Ok(Self {
            entry,
            stage,
            dice,
            noise,
            noise_sigma,
            camera,
            size,
        })
    }

    /// Two frames of the stage: what its name begins with, how it was filmed, and what that is an example of.
    ///
    /// # Errors
    /// Those of [`Film`].
    pub fn filmed(
        self,
        draw: &Draw<'_>,
        prefix: &str,
        how: &str,
        example: &str,
    ) -> Result<Sequence, Error> {
        let entry = self.entry;
        let Draw {
            base,
            seed,
            noise_sigma,
            displacement,
            ..
        } = draw;
        Ok(Sequence {
            name: format!("{prefix}{base}-{seed}"),
            title: format!("{}, variant {seed}{how}", entry.title),
            lesson: format!(
                "Drawn at random{example}: {displacement} pixels of motion at most, noise of {noise_sigma} grey levels."
            ),
            ..self.film(2)?.sequence(&entry)
        })
    }

    /// `frames` frames of the stage, each with noise of its own.
    pub fn film(mut self, frames: usize) -> Result<Film, Error> {
        let noisy = |picture: &mut Vec<[f32; 3]>| {
            for colour in picture {
                let error = self.noise_sigma * self.noise.normal() as f32;
                *colour = colour.map(|c| (c + error).round().clamp(0.0, 255.0));
            }
        };
        Film::of(&self.stage, self.camera, self.size, frames, noisy)
    }
}

/// Gives every body its motion, and says whether the draw is fit to be used.
pub(super) fn set_motion(stage: &mut Stage, courses: &[Course], displacement: f64) -> bool {
    let (w, h) = SKETCH;
    let per = w as f64 / STATED_WIDTH;
    let Ok(camera) = Camera::centred(w as f64, w, h) else {
        return false;
    };
    let caster = Caster::new(stage, camera, Moment::FIRST);
    let seen = Grid::from_fn(w, h, |x, y| caster.look(x as f64, y as f64));
    let move_at = |motion: &RigidMotion, x: usize, y: usize| {
        camera
            .displacement(motion, x as f64, y as f64, 1.0 / seen[(x, y)].depth)
            .map_or(DVec3::ZERO, |(u, v)| DVec3::new(u, v, 0.0) / per)
    };
    let pixels = |body: usize| {
        let seen = &seen;
        (0..w * h)
            .map(move |i| (i % w, i / w))
            .filter(move |&at| seen[at].body == body)
    };
    let mut motions = Vec::new();
    for (body, course) in courses.iter().enumerate() {
        let mut size = 0.01;
        // Displacement is nearly proportional to size: a few corrections settle it.
        for _ in 0..4 {
            let motion = course.motion(size);
            let fastest = pixels(body)
                .map(|(x, y)| move_at(&motion, x, y).length())
                .fold(1e-9, f64::max);
            size *= course.pace * displacement / fastest;
            if course.pace == 0.0 {
                break;
            }
        }
        motions.push(course.motion(size));
    }
    let labels = seen.map(|s| s.body as u8);
    let good = truth::middles(&labels, courses.len())
        .iter()
        .enumerate()
        .all(|(k, middle)| {
            let body = k + 1;
            let shown = middle.pixels / (w * h) as f64;
            let differs = pixels(body)
                .map(|(x, y)| (move_at(&motions[body], x, y) - move_at(&motions[0], x, y)).length())
                .sum::<f64>()
                / middle.pixels.max(1.0);
            (LEAST_SHOWN..=MOST_SHOWN).contains(&shown)
                && usize::from(labels[(middle.x as usize, middle.y as usize)]) == body
                && differs > LEAST_DIFFERENCE * displacement
        });
    stage.motions = motions;
    good
}
