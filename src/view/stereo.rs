//! The stereo pair: the frame for the left eye, and what a second camera at distance d to the right
//! of the first would see for the right eye.
//!
//! ```text
//! (22)  x' = x − f d/Z        (23)  y' = y        (24)  I'(x, y) = I(x̃, y)
//! ```
//!
//! x̃ is the place of the row whose x' is x; where surfaces compete for it, the nearer is seen. Both
//! pictures are shifted against each other so that depth Z₀ has no parallax: x − x' = f d (1/Z − 1/Z₀),
//! positive before the screen. What the second camera sees and the first did not is the surface that goes on behind
//! (`behind.rs`); at the frame's border, where none is known, the row is mirrored.

use super::arrangement::arranged;
use super::layers::{Layer, Layers, NOTHING};
use super::params::{Choice, choose};
use super::span::percentile;
use super::{Picture, ViewParams};
use crate::error::Error;
use crate::frames::Frame;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// Neighbours whose places in the second picture are no further apart than this (px) are one surface.
const JOINED: f32 = 2.0;
/// What a convergence that is not given leaves of the parallax behind the screen, at least.
const LEAST_BEHIND: f32 = 0.5;
/// The columns at each side, as a share of the width, that a convergence that is not given looks at.
const BORDER: f32 = 0.03;

/// How a pair can be laid out: for eyes that look ahead, the left one's picture left; for crossed eyes, right; and for 3-D
/// screens, which take both at half their width.
pub const LAYOUTS: [Choice; 3] = [
    Choice {
        value: "parallel",
        label: "Parallel",
    },
    Choice {
        value: "crossed",
        label: "Cross-eyed",
    },
    Choice {
        value: "half",
        label: "Side by side, half width",
    },
];

/// Where the second camera stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// d, in units of depth.
    pub baseline: f64,
    /// 1/Z₀, the inverse of the depth without parallax.
    pub convergence: f64,
}

impl Rig {
    /// The rig in which no known depth has more parallax than the share
    /// [`ViewParams::baseline`] of the width, and [`ViewParams::convergence`] says what lies on the
    /// screen. If that does not, it is the nearest at the left and right border, which would else be cut off before the
    /// screen; half of the parallax at least lies behind it.
    pub fn fitted(found: &Interpretation, params: &ViewParams) -> Self {
        let (rho, known) = arranged(found, params);
        Self::over(&rho, &known, found.camera.focal, params)
    }

    fn over(rho: &Grid<f32>, known: &Grid<bool>, focal: f64, params: &ViewParams) -> Self {
        let width = rho.width();
        let edge = (BORDER * width as f32).ceil() as usize;
        let (mut all, mut border) = (Vec::new(), Vec::new());
        for (i, (&rho, &known)) in rho.data().iter().zip(known.data()).enumerate() {
            if known {
                all.push(rho);
                if i % width < edge || i % width >= width - edge {
                    border.push(rho);
                }
            }
        }
        let Some((far, near)) = percentile(&mut all, 0.02).zip(percentile(&mut all, 0.98)) else {
            return Self {
                baseline: 0.0,
                convergence: 0.0,
            };
        };
        // A plane that faces the camera has no parallax to stretch.
        let range = (near - far).max(0.02 * near);
        let share = params.convergence.unwrap_or_else(|| {
            let nearest = percentile(&mut border, 0.95).unwrap_or(far);
            f64::from(((nearest - far) / range).clamp(LEAST_BEHIND, 1.0))
        });
        let convergence = f64::from(far) + share * f64::from(range);
        let widest = f64::from(range) * share.max(1.0 - share);
        let pixels = params.baseline * width as f64;
        Self {
            baseline: pixels / (focal * widest),
            convergence,
        }
    }
}

/// Parallax x − x' in pixels of each pixel of the frame.
pub fn parallax(depth: &Grid<f32>, focal: f64, rig: &Rig) -> Grid<f32> {
    depth.map(|z| {
        let rho = 1.0 / z;
        if rho.is_finite() && rho > 0.0 {
            shift(rho, focal, rig)
        } else {
            0.0
        }
    })
}

fn shift(rho: f32, focal: f64, rig: &Rig) -> f32 {
    (focal * rig.baseline * (f64::from(rho) - rig.convergence)) as f32
}

/// The picture that the second camera sees of one surface. `interpolate` mixes the two pixels between which a place
/// falls; without it the one nearest to it is taken, as the paper does. What no pixel covers is filled with the farther
/// of the two sides, mirrored.
pub fn second_eye(
    picture: &Grid<[u8; 3]>,
    parallax: &Grid<f32>,
    labels: &Grid<u8>,
    interpolate: bool,
) -> Grid<[u8; 3]> {
    let (width, height) = (picture.width(), picture.height());
    let mut out = Grid::new(width, height, [0_u8; 3]);
    for y in 0..height {
        let mut row = Row::new(width);
        let shifts = parallax.row(y);
        let joined = |x: usize| {
            labels[(x, y)] == labels[(x + 1, y)] && shifts[x] - shifts[x + 1] <= JOINED - 1.0
        };
        row.offer_all(picture.row(y), shifts, joined, interpolate);
        row.fill();
        out.row_mut(y).copy_from_slice(&row.colours);
    }
    out
}

/// The same of both surfaces: what is seen, and what goes on behind.
fn second_eye_of(layers: &Layers, focal: f64, rig: &Rig, interpolate: bool) -> Grid<[u8; 3]> {
    let (width, height) = (layers.seen.rho.width(), layers.seen.rho.height());
    let mut out = Grid::new(width, height, [0_u8; 3]);
    for y in 0..height {
        let mut row = Row::new(width);
        for layer in [&layers.seen].into_iter().chain(&layers.hidden) {
            let Layer { labels, rho, .. } = layer;
            let shifts: Vec<f32> = (0..width)
                .map(|x| match labels[(x, y)] {
                    NOTHING => f32::NAN,
                    _ => shift(rho[(x, y)], focal, rig),
                })
                .collect();
            let joined = |x: usize| {
                labels[(x, y)] == labels[(x + 1, y)]
                    && !layers.leap.between(rho[(x, y)], rho[(x + 1, y)])
            };
            row.offer_all(layer.colours.row(y), &shifts, joined, interpolate);
        }
        row.fill();
        out.row_mut(y).copy_from_slice(&row.colours);
    }
    out
}

/// Both eyes' pictures, left first; exchanged if [`ViewParams::swap`] says so.
pub(super) fn pair(
    frame: &Frame,
    found: &Interpretation,
    params: &ViewParams,
) -> [Grid<[u8; 3]>; 2] {
    // The nearest and the farthest part by twice the parallax.
    let layers = Layers::of(frame, found, params, 3.0 * params.baseline as f32);
    let focal = found.camera.focal;
    let rig = Rig::over(&layers.seen.rho, &layers.seen.known, focal, params);
    let right = second_eye_of(&layers, focal, &rig, params.interpolate);
    let left = (*frame.rgb).clone();
    if params.swap {
        [right, left]
    } else {
        [left, right]
    }
}

/// The pair as [`ViewParams::layout`] says: twice as wide as the frame, or as wide, with each picture at half its width.
///
/// # Errors
/// [`Error::Choice`] for an unknown layout.
pub fn stereo(
    frame: &Frame,
    found: &Interpretation,
    params: &ViewParams,
) -> Result<Picture, Error> {
    let layout = choose("layout", &params.layout, &LAYOUTS)?;
    let [left, right] = pair(frame, found, params);
    let [first, second] = if layout == 1 {
        [right, left]
    } else {
        [left, right]
    };
    // Columns of a picture that one column of the pair is the mean of.
    let narrow = if layout == 2 { 2 } else { 1 };
    let width = frame.width().div_ceil(narrow);
    Ok(Grid::from_fn(2 * width, frame.height(), |x, y| {
        let (picture, x) = if x < width {
            (&first, x)
        } else {
            (&second, x - width)
        };
        let at = |x: usize| picture[(x.min(frame.width() - 1), y)];
        let [r, g, b] = super::mix(at(narrow * x), at(narrow * x + narrow - 1), 0.5);
        [r, g, b, 255]
    }))
}

/// A row of the second picture while it is put together.
struct Row {
    colours: Vec<[u8; 3]>,
    /// Parallax of what is seen, negative infinite in holes.
    shifts: Vec<f32>,
    /// How far it was off its place; less wins among the equally near.
    misses: Vec<f32>,
}

impl Row {
    fn new(width: usize) -> Self {
        Self {
            colours: vec![[0; 3]; width],
            shifts: vec![f32::NEG_INFINITY; width],
            misses: vec![f32::INFINITY; width],
        }
    }

    /// Every pixel of a row, and the surface between those that are `joined` to the next. A shift that is not a number is
    /// no pixel.
    fn offer_all(
        &mut self,
        colours: &[[u8; 3]],
        shifts: &[f32],
        joined: impl Fn(usize) -> bool,
        interpolate: bool,
    ) {
        let width = colours.len();
        for x in 0..width {
            let place = x as f32 - shifts[x];
            if place.is_nan() {
                continue;
            }
            // The pixel for itself, half a pixel to either side…
            let nearest = (place + 0.5).floor();
            self.offer(nearest, shifts[x], (place - nearest).abs(), colours[x]);
            // … and the surface from it to its right neighbour.
            if x + 1 == width || !joined(x) {
                continue;
            }
            let next = (x + 1) as f32 - shifts[x + 1];
            let mut target = place.ceil();
            while target <= next {
                let t = (target - place) / (next - place).max(1e-6);
                let colour = if interpolate {
                    super::mix(colours[x], colours[x + 1], t)
                } else {
                    colours[if t < 0.5 { x } else { x + 1 }]
                };
                let shift = shifts[x] * (1.0 - t) + shifts[x + 1] * t;
                self.offer(target, shift, -1.0, colour);
                target += 1.0;
            }
        }
    }

    /// Seen if it is nearer than what was there, or as near (to half a pixel of parallax) and closer
    /// to its place.
    fn offer(&mut self, target: f32, shift: f32, miss: f32, colour: [u8; 3]) {
        if !(target >= 0.0 && target < self.colours.len() as f32) {
            return;
        }
        let x = target as usize;
        let nearer = shift - self.shifts[x];
        if nearer > 0.5 || (nearer >= -0.5 && miss < self.misses[x]) {
            self.colours[x] = colour;
            self.shifts[x] = shift;
            self.misses[x] = miss;
        }
    }

    fn fill(&mut self) {
        let width = self.colours.len();
        let mut x = 0;
        while x < width {
            if self.shifts[x] > f32::NEG_INFINITY {
                x += 1;
                continue;
            }
            let mut end = x;
            while end < width && self.shifts[end] == f32::NEG_INFINITY {
                end += 1;
            }
            self.fill_hole(x, end);
            x = end;
        }
    }

    /// Mirrors the farther side into the hole `from..to`, as far as it is one surface.
    fn fill_hole(&mut self, from: usize, to: usize) {
        let left = from.checked_sub(1);
        let right = (to < self.colours.len()).then_some(to);
        let (edge, step) = match (left, right) {
            (Some(l), Some(r)) if self.shifts[l] <= self.shifts[r] => (l, -1_isize),
            (Some(l), None) => (l, -1),
            (_, Some(r)) => (r, 1),
            (None, None) => return,
        };
        let surface = self.shifts[edge];
        let mut source = edge;
        for i in 0..to - from {
            let target = if step < 0 { from + i } else { to - 1 - i };
            self.colours[target] = self.colours[source];
            if let Some(next) = source.checked_add_signed(step)
                && self
                    .shifts
                    .get(next)
                    .is_some_and(|s| (s - surface).abs() < JOINED)
                && !(from..to).contains(&next)
            {
                source = next;
            }
        }
    }
}
