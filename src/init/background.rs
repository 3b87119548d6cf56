//! The motion of the background.
//!
//! Most of the matches along the frame's border decide whether the camera stands still or turns: they have to be
//! explained to within their uncertainty then. Otherwise the full motion is sought from all matches, each time anew from
//! the segments that it explains; the motion that explains most of the frame stays.

use glam::DVec3;

use super::epipolar::{Pair, epipolar_motion, median};
use super::lattice::Lattice;
use super::matches::Match;
use super::rotation::rotation_alone;
use super::sample::{Carrier, EXPLAINED, Sample};
use super::segments::{Segments, segments};
use crate::camera::{Camera, RigidMotion};
use crate::motion_model::MotionModel;

/// Width of the border in shares of the frame's sides.
const BORDER: f32 = 0.1;
/// Share of the border's matches that rest or a rotation has to explain.
const MOST: f64 = 0.65;
/// Greatest median χ² of the border's matches under rest; 1.39 is expected.
const STILL: f64 = 3.0;
/// The same under a rotation, which far scenery in translation resembles.
const TURNED: f64 = 1.8;
/// Share of a segment's matches that the motion that carries it explains.
pub const CARRIED: f64 = 0.8;
/// Times that the motion is found anew from what it explains.
const ROUNDS: usize = 2;
/// Share of a segment's matches that the motion has to explain to be found anew from it.
const MAINLY: f64 = 0.5;
/// Share of matches above which a motion is good enough.
const PLENTY: f64 = 0.95;
/// Shifts tried, in pixels.
const SHIFTS: [f64; 8] = [-6.0, -4.0, -2.0, -1.0, 1.0, 2.0, 4.0, 6.0];
/// Matches used for the full motion, about.
const SAMPLE: usize = 1500;

/// The background's motion, and whether it has a translation; `None` where too little is matched.
pub fn background(
    samples: &[Sample],
    segments: &Segments,
    camera: &Camera,
    size: [usize; 2],
) -> Option<(RigidMotion, bool)> {
    let border: Vec<&Sample> = samples.iter().filter(|s| on_border(s, size)).collect();
    let fits = |motion: &RigidMotion, middle: f64| {
        let carrier = Carrier::new(motion, camera);
        let misfit: Vec<f64> = border.iter().map(|s| carrier.misfit(s)).collect();
        let explained = misfit.iter().filter(|&&m| m < EXPLAINED).count();
        explained as f64 > MOST * misfit.len() as f64 && median(misfit) < middle
    };
    let still = RigidMotion::default();
    if fits(&still, STILL) {
        return Some((still, false));
    }
    let mut pairs: Vec<Pair> = border.iter().map(|s| s.pair()).collect();
    let mut turned = still;
    for _ in 0..ROUNDS {
        (turned.rotation, _) = rotation_alone(&pairs, camera.focal);
        let carrier = Carrier::new(&turned, camera);
        let explained = samples.iter().filter(|s| carrier.explains(s));
        pairs = explained.map(Sample::pair).collect();
    }
    if fits(&turned, TURNED) {
        return Some((turned, false));
    }
    let mut chosen: Vec<usize> = (0..samples.len()).collect();
    let mut best: Option<(usize, RigidMotion)> = None;
    for _ in 0..=ROUNDS {
        let Some(motion) = full(samples, &chosen, camera) else {
            break;
        };
        let motion = ahead(samples, motion, camera);
        chosen = carried(samples, segments, &motion, camera);
        if best.is_none_or(|(count, _)| chosen.len() > count) {
            best = Some((chosen.len(), motion));
        }
        if chosen.len() as f64 > PLENTY * samples.len() as f64 {
            break;
        }
    }
    best.map(|(_, motion)| (motion, true))
}

/// The matches of the segments that the background's motion explains mainly; `None` when it has no translation.
pub fn scenery(samples: &[Sample], camera: &Camera, size: [usize; 2]) -> Option<Vec<Match>> {
    let lattice = Lattice::new(samples.iter().map(|s| &s.matched), size);
    let segments = segments(samples, &lattice);
    let (motion, translates) = background(samples, &segments, camera, size)?;
    let carrier = Carrier::new(&motion, camera);
    let shares = segments.shares(|k| carrier.explains(&samples[k]));
    let members = segments.members(|s| shares[s] > MAINLY).concat();
    translates.then(|| members.iter().map(|&k| samples[k].matched).collect())
}

/// The full motion that explains most of all matches.
pub fn whole_motion(samples: &[Sample], camera: &Camera) -> Option<RigidMotion> {
    let everything: Vec<usize> = (0..samples.len()).collect();
    full(samples, &everything, camera)
}

fn full(samples: &[Sample], chosen: &[usize], camera: &Camera) -> Option<RigidMotion> {
    let stride = (chosen.len() / SAMPLE).max(1);
    let each = chosen.iter().step_by(stride);
    let matches: Vec<Match> = each.map(|&k| samples[k].matched).collect();
    let found = epipolar_motion(&matches, camera)?;
    (found.model == MotionModel::Full).then_some(found.motion)
}

/// `motion`, with the turn that brings most matches before the camera. A turn about an axis across T and the optical
/// axis shifts the picture along epipolar lines that are nearly parallel: what it does is then not seen in e, but in
/// points that would lie beyond infinity.
fn ahead(samples: &[Sample], motion: RigidMotion, camera: &Camera) -> RigidMotion {
    let across = DVec3::Z.cross(motion.translation);
    let turned = |pixels: f64| RigidMotion {
        rotation: motion.rotation + across * (pixels / camera.focal),
        ..motion
    };
    let explained = |motion: &RigidMotion| {
        let carrier = Carrier::new(motion, camera);
        samples.iter().filter(|s| carrier.explains(s)).count()
    };
    let here = explained(&motion);
    if here as f64 > PLENTY * samples.len() as f64 {
        return motion;
    }
    let tried = SHIFTS.map(turned);
    let best = tried
        .into_iter()
        .map(|m| (explained(&m), m))
        .max_by_key(|(count, _)| *count);
    match best {
        Some((count, better)) if count > here => better,
        _ => motion,
    }
}

/// The explained matches of those segments that `motion` carries.
fn carried(
    samples: &[Sample],
    segments: &Segments,
    motion: &RigidMotion,
    camera: &Camera,
) -> Vec<usize> {
    let carrier = Carrier::new(motion, camera);
    let explained: Vec<bool> = samples.iter().map(|s| carrier.explains(s)).collect();
    let shares = segments.shares(|k| explained[k]);
    let carried = |k: &usize| explained[*k] && segments.of[*k].is_some_and(|s| shares[s] > MAINLY);
    (0..samples.len()).filter(carried).collect()
}

fn on_border(sample: &Sample, [width, height]: [usize; 2]) -> bool {
    let near = |at: f32, side: usize| {
        let side = side as f32;
        at < BORDER * side || at > (1.0 - BORDER) * side
    };
    let [x, y] = sample.matched.at;
    near(x, width) || near(y, height)
}
