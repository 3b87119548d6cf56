//! The stereo pair: the frame for the left eye, and what a second camera at distance d to the right
//! of the first would see for the right eye.
//!
//! ```text
//! (22)  x' = x − f d/Z        (23)  y' = y        (24)  I'(x, y) = I(x̃, y)
//! ```
//!
//! x̃ is the place of the row whose x' is x; where surfaces compete for it, the nearer is seen. Both
//! pictures are shifted against each other so that depth Z₀ has no parallax: x − x' = f d (1/Z − 1/Z₀),
//! positive before the screen. What the second camera sees and the first did not is filled with the
//! farther of the two sides, mirrored, since it is the farther surface that was hidden.

use super::span::Span;
use super::{Picture, ViewParams};
use crate::frames::Frame;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// Neighbours whose places in the second picture are no further apart than this (px) are one surface.
const JOINED: f32 = 2.0;

/// Where the second camera stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// d, in units of depth.
    pub baseline: f64,
    /// 1/Z₀, the inverse of the depth without parallax.
    pub convergence: f64,
}

impl Rig {
    /// The rig in which no observable depth has more parallax than the share
    /// [`ViewParams::baseline`] of the width, and [`ViewParams::convergence`] says what lies on the
    /// screen.
    pub fn fitted(found: &Interpretation, params: &ViewParams) -> Self {
        let Some(span) = Span::of(found, true, |_| true) else {
            return Self {
                baseline: 0.0,
                convergence: 0.0,
            };
        };
        let (far, near) = (f64::from(span.far), f64::from(span.near));
        let convergence = far + params.convergence * (near - far);
        let widest = (near - convergence).max(convergence - far);
        let pixels = params.baseline * found.depth.width() as f64;
        Self {
            baseline: pixels / (found.camera.focal * widest),
            convergence,
        }
    }
}

/// Parallax x − x' in pixels of each pixel of the frame.
pub fn parallax(depth: &Grid<f32>, focal: f64, rig: &Rig) -> Grid<f32> {
    depth.map(|z| {
        let rho = 1.0 / f64::from(z);
        let rho = if rho.is_finite() && rho > 0.0 {
            rho
        } else {
            rig.convergence
        };
        (focal * rig.baseline * (rho - rig.convergence)) as f32
    })
}

/// The picture that the second camera sees. `interpolate` mixes the two pixels between which a place
/// falls; without it the one nearest to it is taken, as the paper does.
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
        let (colours, shifts, kinds) = (picture.row(y), parallax.row(y), labels.row(y));
        for x in 0..width {
            let place = x as f32 - shifts[x];
            // The pixel for itself, half a pixel to either side…
            let nearest = place.round();
            row.offer(nearest, shifts[x], (place - nearest).abs(), colours[x]);
            // … and the surface from it to its right neighbour.
            if x + 1 == width || kinds[x] != kinds[x + 1] {
                continue;
            }
            let next = (x + 1) as f32 - shifts[x + 1];
            if next <= place || next - place > JOINED {
                continue;
            }
            let mut target = place.ceil();
            while target <= next {
                let t = (target - place) / (next - place);
                let colour = if interpolate {
                    super::mix(colours[x], colours[x + 1], t)
                } else {
                    colours[if t < 0.5 { x } else { x + 1 }]
                };
                let shift = shifts[x] * (1.0 - t) + shifts[x + 1] * t;
                row.offer(target, shift, -1.0, colour);
                target += 1.0;
            }
        }
        row.fill();
        out.row_mut(y).copy_from_slice(&row.colours);
    }
    out
}

/// Both eyes' pictures, left first.
pub(super) fn pair(
    frame: &Frame,
    found: &Interpretation,
    params: &ViewParams,
) -> [Grid<[u8; 3]>; 2] {
    let rig = Rig::fitted(found, params);
    // A few wild depths must not fly off: nothing goes beyond the span by more than a half.
    let limit = (1.5 * params.baseline * frame.width() as f64) as f32;
    let shifts = parallax(&found.depth, found.camera.focal, &rig).map(|s| s.clamp(-limit, limit));
    let right = second_eye(&frame.rgb, &shifts, &found.labels, params.interpolate);
    [(*frame.rgb).clone(), right]
}

/// The pair side by side, twice as wide as the frame: left eye's picture on the left.
pub fn stereo(frame: &Frame, found: &Interpretation, params: &ViewParams) -> Picture {
    let [left, right] = pair(frame, found, params);
    let width = frame.width();
    Grid::from_fn(2 * width, frame.height(), |x, y| {
        let [r, g, b] = if x < width {
            left[(x, y)]
        } else {
            right[(x - width, y)]
        };
        [r, g, b, 255]
    })
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
