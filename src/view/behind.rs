//! The surface that goes on behind a silhouette.
//!
//! Across a cut, a border of regions or a leap of depth, the farther side is hidden by the nearer. It is continued under
//! it, ring by ring, as far as [`Cut::furthest`]; there its 1/Z is what solves
//!
//! ```text
//! Δ(1/Z) = 0
//! ```
//!
//! with the 1/Z that is seen along the cut: a plane so goes on as the plane that it is. It is solved on every second pixel
//! first, and so on down to [`SMALL`]. Its colours are mirrored at the cut and then smoothed. It stops where it would come
//! before what is seen.

use std::collections::VecDeque;

use super::layers::{Layer, NOTHING};
use super::leaps::Leap;
use crate::grid::Grid;

/// How far behind what hides it a surface lies at least, as a share of 1/Z.
const APART: f32 = 0.02;
/// Sweeps of successive over-relaxation, and its factor. They end when the eye sees no difference, which is long before
/// the last digit.
const SWEEPS: usize = 40;
const OVER: f32 = 1.85;
/// Sweeps from what every second pixel gave, of plain relaxation, and pixels from which on there are such.
const FINE_SWEEPS: usize = 4;
const SMALL: usize = 400_000;
/// Sweeps that smooth the mirrored colours.
const SMOOTHED: usize = 6;

/// What parts the nearer from the farther.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Cut {
    /// A border between regions.
    Border,
    /// A leap within one.
    Leap,
}

impl Cut {
    /// How far a surface is continued at most, as a share of the longer side. A body may be seen past altogether; a leap is
    /// often no more than an edge.
    fn furthest(self) -> f32 {
        match self {
            Self::Border => 0.5,
            Self::Leap => 0.2,
        }
    }
}

/// What is hidden behind `seen` across one kind of cut, up to `reach` of the longer side from it; nothing where nothing is
/// known to be.
pub(super) fn behind(seen: &Layer, leap: Leap, cut: Cut, reach: f32) -> Layer {
    let (width, height) = (seen.rho.width(), seen.rho.height());
    let mut hidden = Layer {
        labels: Grid::new(width, height, NOTHING),
        rho: Grid::new(width, height, 0.0),
        colours: Grid::new(width, height, [0; 3]),
        known: Grid::new(width, height, false),
    };
    flood(seen, &mut hidden, leap, cut, reach);
    let reached = reached(&hidden);
    if reached.is_empty() {
        return hidden;
    }
    if width * height > SMALL {
        start_from(&mut hidden, &behind(&halved(seen), leap, cut, reach));
        relax(seen, &mut hidden, &reached, leap, FINE_SWEEPS, 1.0);
    } else {
        relax(seen, &mut hidden, &reached, leap, SWEEPS, OVER);
    }
    smooth(&mut hidden, &reached);
    hidden
}

/// Every second pixel.
fn halved(layer: &Layer) -> Layer {
    Layer {
        labels: every_second(&layer.labels),
        rho: every_second(&layer.rho),
        colours: every_second(&layer.colours),
        known: every_second(&layer.known),
    }
}

fn every_second<T: Copy>(grid: &Grid<T>) -> Grid<T> {
    let (width, height) = (grid.width().div_ceil(2), grid.height().div_ceil(2));
    Grid::from_fn(width, height, |x, y| grid[(2 * x, 2 * y)])
}

/// Takes 1/Z from every second pixel, where that is of the same surface.
fn start_from(hidden: &mut Layer, coarse: &Layer) {
    for y in 0..hidden.rho.height() {
        for x in 0..hidden.rho.width() {
            let (at, there) = ((x, y), (x / 2, y / 2));
            if hidden.labels[at] != NOTHING && coarse.labels[there] == hidden.labels[at] {
                hidden.rho[at] = coarse.rho[there];
            }
        }
    }
}

/// The nearer and the farther of two neighbours that a cut parts; `None` where there is none.
fn farther(seen: &Layer, leap: Leap, cut: Cut, p: usize, q: usize) -> Option<(usize, usize)> {
    let (a, b) = (seen.labels.data()[p], seen.labels.data()[q]);
    let (near, far) = (seen.rho.data()[p], seen.rho.data()[q]);
    let first = match cut {
        Cut::Leap if a == b && leap.between(near, far) => near > far,
        Cut::Border if a != b => b == 0 || (a != 0 && near > far),
        _ => return None,
    };
    Some(if first { (p, q) } else { (q, p) })
}

/// Places left, right, above and below of pixel `at`; `None` where the picture ends.
fn beside(at: usize, width: usize, height: usize) -> [Option<usize>; 4] {
    let (x, y) = (at % width, at / width);
    [
        (x > 0).then(|| at - 1),
        (x + 1 < width).then(|| at + 1),
        (y > 0).then(|| at - width),
        (y + 1 < height).then(|| at + width),
    ]
}

/// Continues every surface, with the values of the nearest pixel that is seen of it.
fn flood(seen: &Layer, hidden: &mut Layer, leap: Leap, cut: Cut, reach: f32) {
    let (width, height) = (seen.rho.width(), seen.rho.height());
    let furthest = (cut.furthest().min(reach) * width.max(height) as f32).ceil() as u32;
    let (labels, rho) = (seen.labels.data(), seen.rho.data());
    let taken = hidden.labels.data_mut();
    let mut queue = VecDeque::new();
    // Whoever comes first to a pixel has it.
    let mut take = |queue: &mut VecDeque<_>, at: usize, source: usize, far: u32| {
        let label = labels[source];
        // Regions lie before the background, whatever their depth.
        let in_front = match (labels[at], label) {
            (1.., 0) => true,
            (0, 1..) => false,
            _ => rho[at] > (1.0 + APART) * rho[source],
        };
        if taken[at] == NOTHING && in_front {
            taken[at] = label;
            queue.push_back((at, source, far));
        }
    };
    for y in 0..height {
        for p in y * width..(y + 1) * width {
            if p + 1 < (y + 1) * width
                && let Some((near, far)) = farther(seen, leap, cut, p, p + 1)
            {
                take(&mut queue, near, far, 1);
            }
            if y + 1 < height
                && let Some((near, far)) = farther(seen, leap, cut, p, p + width)
            {
                take(&mut queue, near, far, 1);
            }
        }
    }
    while let Some((at, source, far)) = queue.pop_front() {
        hidden.rho.data_mut()[at] = rho[source];
        hidden.colours.data_mut()[at] = mirrored(seen, at, source);
        hidden.known.data_mut()[at] = seen.known.data()[source];
        if far < furthest {
            for next in beside(at, width, height).into_iter().flatten() {
                take(&mut queue, next, source, far + 1);
            }
        }
    }
}

/// The colour as far on the seen side of `source` as `at` lies on the hidden one.
fn mirrored(seen: &Layer, at: usize, source: usize) -> [u8; 3] {
    let (width, height) = (seen.rho.width(), seen.rho.height());
    let image = |a: usize, s: usize, side: usize| {
        let there = (2 * s + usize::from(s < a)).checked_sub(a + usize::from(s > a));
        there.filter(|&c| c < side)
    };
    let there = image(at % width, source % width, width)
        .zip(image(at / width, source / width, height))
        .filter(|&place| {
            let i = place.1 * width + place.0;
            seen.labels.data()[i] == seen.labels.data()[source]
                && seen.rho.data()[i] < (1.0 + 2.0 * APART) * seen.rho.data()[source]
        });
    there.map_or(seen.colours.data()[source], |place| seen.colours[place])
}

/// What a neighbour of a pixel that is reached has for it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Beside {
    Nothing,
    /// The hidden surface.
    Hidden,
    /// The same where it is seen.
    Seen,
}

/// A pixel behind which something goes on, and what its neighbours have for it, in the order of [`beside`].
struct Reached {
    at: usize,
    around: [Beside; 4],
}

impl Reached {
    fn of(at: usize, width: usize, height: usize, what: impl Fn(usize) -> Beside) -> Self {
        let mut around = [Beside::Nothing; 4];
        for (around, next) in around.iter_mut().zip(beside(at, width, height)) {
            if let Some(next) = next {
                *around = what(next);
            }
        }
        Self { at, around }
    }

    /// Places of its neighbours; meant for those that there are.
    fn places(&self, width: usize) -> [usize; 4] {
        let at = self.at;
        [
            at.wrapping_sub(1),
            at + 1,
            at.wrapping_sub(width),
            at + width,
        ]
    }
}

fn relax(
    seen: &Layer,
    hidden: &mut Layer,
    reached: &[usize],
    leap: Leap,
    sweeps: usize,
    over: f32,
) {
    let (width, height) = (seen.rho.width(), seen.rho.height());
    let shown = seen.rho.data();
    let labels = hidden.labels.data();
    // A ghost is flat.
    let known = reached.iter().filter(|&&at| hidden.known.data()[at]);
    let around: Vec<Reached> = known
        .map(|&at| {
            Reached::of(at, width, height, |next| {
                let there = seen.labels.data()[next];
                // What is seen of the surface lies across the cut.
                let parted = there != seen.labels.data()[at]
                    || (shown[at] > shown[next] && leap.between(shown[at], shown[next]));
                if labels[next] == labels[at] {
                    Beside::Hidden
                } else if there == labels[at] && parted {
                    Beside::Seen
                } else {
                    Beside::Nothing
                }
            })
        })
        .collect();
    let rho = hidden.rho.data_mut();
    for _ in 0..sweeps {
        for reached in &around {
            let (mut sum, mut count) = (0.0, 0.0);
            for (next, what) in reached.places(width).into_iter().zip(reached.around) {
                sum += match what {
                    Beside::Hidden => rho[next],
                    Beside::Seen => shown[next],
                    Beside::Nothing => continue,
                };
                count += 1.0;
            }
            if count > 0.0 {
                let here = rho[reached.at];
                let value = (here + over * (sum / count - here)).max(0.5 * here);
                rho[reached.at] = value.min(shown[reached.at] / (1.0 + APART));
            }
        }
    }
}

/// The pixels behind which something goes on, row by row.
fn reached(hidden: &Layer) -> Vec<usize> {
    let labels = hidden.labels.data();
    (0..labels.len())
        .filter(|&i| labels[i] != NOTHING)
        .collect()
}

fn smooth(hidden: &mut Layer, reached: &[usize]) {
    let (width, height) = (hidden.rho.width(), hidden.rho.height());
    let labels = hidden.labels.data();
    let one = |at: usize| {
        Reached::of(at, width, height, |next| match labels[next] == labels[at] {
            true => Beside::Hidden,
            false => Beside::Nothing,
        })
    };
    let around: Vec<Reached> = reached.iter().map(|&at| one(at)).collect();
    let colours = hidden.colours.data_mut();
    for _ in 0..SMOOTHED {
        for reached in &around {
            let [mut r, mut g, mut b] = colours[reached.at].map(|c| 2 * u32::from(c));
            let mut count = 2;
            for (next, what) in reached.places(width).into_iter().zip(reached.around) {
                if what == Beside::Hidden {
                    let [red, green, blue] = colours[next].map(u32::from);
                    (r, g, b) = (r + red, g + green, b + blue);
                    count += 1;
                }
            }
            colours[reached.at] = [r, g, b].map(|c| ((c + count / 2) / count) as u8);
        }
    }
}
