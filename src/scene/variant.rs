//! Random variants of `blocks` and `carousel`, for measuring accuracy on scenes that nobody tuned for.
//!
//! A seed decides shapes, places, textures, lamp and motions. A draw is kept when every object shows
//! between [`LEAST_SHOWN`] and [`MOST_SHOWN`] of the frame, covers its own middle, and moves
//! otherwise than the background would in its place; else the next one is drawn. Each body's motion
//! is scaled so that its fastest pixel covers a drawn share of the displacement asked for, and the
//! fastest body all of it.

use glam::{DMat3, DVec3};

use super::cast::{Caster, Moment};
use super::dice::Dice;
use super::solid::Solid;
use super::stage::{Light, Material, Part, Pose, Shadows, Stage, turn};
use super::texture::{Pattern, Texture};
use super::{Sequence, blocks, camera, carousel, sequence, truth};
use crate::camera::{Camera, RigidMotion};
use crate::error::Error;
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

/// A motion whose size is still open: a turn about `centre` with a shift.
#[derive(Clone, Copy, Default)]
struct Course {
    centre: DVec3,
    rotation: DVec3,
    shift: DVec3,
    /// Share of the largest displacement that its fastest pixel covers.
    pace: f64,
}

impl Course {
    fn motion(&self, size: f64) -> RigidMotion {
        turn(self.centre, self.rotation * size, self.shift * size)
    }
}

/// Draws a variant of `base` ("blocks" or "carousel") from `seed` and renders it at
/// `width × height`. Both frames get Gaussian noise of `noise_sigma` grey levels (0–50), the same in all
/// channels, before they are rounded; `displacement` (0.1–16) is the largest image motion in pixels
/// at a width of 320, larger in proportion in larger frames.
///
/// # Errors
/// [`Error::Choice`] for another base, [`Error::Option`] for a noise or displacement out of range,
/// [`Error::Size`] outside the limits of a frame.
pub fn variant(
    base: &str,
    seed: u64,
    noise_sigma: f32,
    displacement: f64,
    width: usize,
    height: usize,
) -> Result<Sequence, Error> {
    let (entry, many) = match base {
        "blocks" => (blocks::ENTRY, false),
        "carousel" => (carousel::ENTRY, true),
        _ => {
            return Err(Error::Choice {
                what: "sequence with variants".to_owned(),
                value: base.to_owned(),
                choices: "blocks, carousel".to_owned(),
            });
        }
    };
    check("noise", f64::from(noise_sigma), 0.0, MOST_NOISE)?;
    check("displacement", displacement, 0.1, MOST_DISPLACEMENT)?;
    let camera = camera(base, width, height)?;
    // Another stream for each base, and another for the noise.
    let mut dice = Dice::new(seed ^ if many { 0x6361_726f } else { 0x626c_6f63 });
    let mut noise = Dice::new(dice.bits());
    let mut stage = draw(&mut dice, many, displacement).0;
    for _ in 1..DRAWS {
        let (drawn, good) = draw(&mut dice, many, displacement);
        stage = drawn;
        if good {
            break;
        }
    }
    let pictures = [Moment::First, Moment::Second].map(|moment| {
        let mut picture = Caster::new(&stage, camera, moment).picture(width, height);
        for colour in &mut picture {
            let error = noise_sigma * noise.normal() as f32;
            *colour = colour.map(|c| (c + error).round().clamp(0.0, 255.0));
        }
        picture
    });
    let made = sequence(&entry, &stage, camera, width, height, &pictures);
    Ok(Sequence {
        name: format!("{base}-{seed}"),
        title: format!("{}, variant {seed}", entry.title),
        lesson: format!(
            "Drawn at random: {displacement} pixels of motion at most, noise of {noise_sigma} grey levels."
        ),
        ..made
    })
}

/// One draw, and whether it is fit to be used.
fn draw(dice: &mut Dice, many: bool, displacement: f64) -> (Stage, bool) {
    let ground = Pose::ground(
        dice.between(0.5, 0.85) - if many { 0.1 } else { 0.0 },
        dice.between(6.2, 7.2),
    );
    let floor = texture(dice);
    let mut parts = vec![Part {
        solid: Solid::Floor,
        pose: ground,
        material: Material::matt(floor),
        body: 0,
    }];
    // Beyond the floor a wall, so that no horizon shows.
    parts.push(Part {
        pose: Pose::at(0.0, 0.0, dice.between(3.6, 5.0))
            .turned(DMat3::from_rotation_x(std::f64::consts::FRAC_PI_2))
            .within(ground),
        material: Material::matt(texture(dice)),
        ..parts[0].clone()
    });
    let bodies = if many { 3 } else { 2 };
    let alike = !many && dice.chance(0.6);
    for body in 1..=bodies {
        let own = texture(dice);
        let texture = if alike {
            Texture {
                seed: own.seed,
                ..floor
            }
        } else {
            own
        };
        let slot = body as f64 - 0.5 * (bodies + 1) as f64;
        let x = slot * if many { 1.75 } else { 2.3 } + dice.between(-0.3, 0.3);
        let z = dice.between(-1.0, 0.9);
        let part = object(dice, body, many, x, z, texture);
        parts.push(Part {
            pose: part.pose.within(ground),
            ..part
        });
    }
    let courses = courses(dice, ground, &parts, bodies, many);
    let lamp = DVec3::new(
        dice.between(-1.0, 1.0),
        dice.between(-1.5, -0.8),
        dice.between(-0.8, 0.4),
    );
    let mut stage = Stage {
        parts,
        motions: vec![RigidMotion::default(); bodies + 1],
        light: Light::daylight(
            ground.direction(lamp),
            ground.direction(DVec3::NEG_Y),
            dice.between(0.12, 0.25),
        ),
        shadows: if many {
            Shadows::Painted
        } else {
            Shadows::Cast
        },
        haze: (0.0, DVec3::ZERO),
    };
    let good = set_motion(&mut stage, &courses, displacement);
    (stage, good)
}

/// A solid standing on the ground at (x, z).
fn object(dice: &mut Dice, body: usize, many: bool, x: f64, z: f64, texture: Texture) -> Part {
    let yaw = DMat3::from_rotation_y(dice.between(0.0, std::f64::consts::PI));
    let kind = if many { dice.bits() % 3 } else { 0 };
    let (solid, height) = match kind {
        0 => {
            let half = DVec3::new(
                dice.between(0.55, 0.9),
                dice.between(0.4, 0.8),
                dice.between(0.55, 0.9),
            );
            (Solid::Cuboid(half), half.y)
        }
        1 => {
            let radii = DVec3::new(
                dice.between(0.65, 0.95),
                dice.between(0.65, 0.95),
                dice.between(0.65, 0.95),
            );
            (Solid::Ellipsoid(radii), radii.y)
        }
        _ => {
            let half = dice.between(0.55, 0.85);
            let radius = dice.between(0.6, 0.85);
            (Solid::Cylinder { radius, half }, half)
        }
    };
    let shine = if many { dice.between(0.0, 0.25) } else { 0.0 };
    Part {
        solid,
        pose: Pose::at(x, -height, z).turned(yaw),
        material: Material::shiny(texture, shine, 30.0),
        body,
    }
}

/// How the background and each body shall move.
fn courses(
    dice: &mut Dice,
    ground: Pose,
    parts: &[Part],
    bodies: usize,
    many: bool,
) -> Vec<Course> {
    let direction = |dice: &mut Dice, lift: f64| {
        let angle = dice.between(0.0, std::f64::consts::TAU);
        let rise = dice.between(-lift, lift);
        ground.direction(DVec3::new(angle.cos(), rise, angle.sin()))
    };
    let mut courses = vec![match dice.pick(&[0, 0, 0, 1, 1, 2]) {
        0 => Course::default(),
        // The camera moves, or turns: a turn about the camera tells nothing of depth.
        1 => Course {
            shift: direction(dice, 0.4),
            pace: dice.between(0.2, 0.5),
            ..Course::default()
        },
        _ => Course {
            rotation: direction(dice, 0.4),
            pace: dice.between(0.2, 0.5),
            ..Course::default()
        },
    }];
    let background_moves = courses[0].pace > 0.0;
    let fastest = dice.bits() as usize % bodies;
    for body in 0..bodies {
        let pace = if body == fastest {
            1.0
        } else {
            dice.between(0.6, 1.0)
        };
        let still = background_moves && body != fastest && dice.chance(0.25);
        let turns = dice.chance(if many { 0.75 } else { 0.35 });
        // About an axis near the upright one; an angle of 1 moves a surface about as far as a shift.
        let axis = ground
            .direction(DVec3::new(
                dice.between(-0.4, 0.4),
                1.0,
                dice.between(-0.4, 0.4),
            ))
            .normalize();
        let turn = dice.pick(&[-1.0, 1.0]) * dice.between(0.6, 1.2);
        courses.push(Course {
            centre: parts[parts.len() - bodies + body].pose.centre,
            rotation: if turns { axis * turn } else { DVec3::ZERO },
            shift: direction(dice, 0.1),
            pace: if still { 0.0 } else { pace },
        });
    }
    courses
}

/// Gives every body its motion, and says whether the draw is fit to be used.
fn set_motion(stage: &mut Stage, courses: &[Course], displacement: f64) -> bool {
    let (w, h) = SKETCH;
    let per = w as f64 / STATED_WIDTH;
    let Ok(camera) = Camera::centred(w as f64, w, h) else {
        return false;
    };
    let caster = Caster::new(stage, camera, Moment::First);
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

/// A texture of any kind and colour, with grain.
fn texture(dice: &mut Dice) -> Texture {
    let pattern = dice.pick(&[
        Pattern::Mottle,
        Pattern::Marble,
        Pattern::Marble,
        Pattern::Speckle,
        Pattern::Strata,
    ]);
    let hue = DVec3::new(
        dice.between(0.45, 1.0),
        dice.between(0.45, 1.0),
        dice.between(0.45, 1.0),
    );
    let hue = hue / hue.max_element();
    let light = dice.between(0.5, 0.85);
    let contrast = dice.between(0.45, 0.85);
    let dark = light * (1.0 - contrast);
    let mut colours = [
        hue * dark,
        hue * 0.5 * (dark + light),
        DVec3::splat(0.3).lerp(hue, 0.7) * light,
    ];
    if dice.chance(0.4) {
        colours.reverse();
    }
    Texture {
        pattern,
        colours,
        scale: dice.between(0.6, 1.3) * if pattern == Pattern::Strata { 0.4 } else { 1.0 },
        grain: dice.between(0.2, 0.5),
        seed: dice.bits() as u32 % 100_000,
    }
}

fn check(key: &str, value: f64, min: f64, max: f64) -> Result<(), Error> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(Error::Option {
        key: key.to_owned(),
        value: value.to_string(),
        min,
        max,
    })
}
