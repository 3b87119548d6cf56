//! From a level set to the curve itself: marching squares at φ = 0, φ > 0 inside.
//!
//! Points lie between pixels, where φ interpolated along the line between two neighbours crosses
//! zero; coordinates are pixels, (0, 0) the centre of the top-left pixel. A region that reaches the
//! frame's border is closed along it, half a pixel outside the outermost centres. On screen, with y
//! downwards, outer curves run clockwise and holes counter-clockwise, the inside on the right.

use serde::Serialize;

use crate::grid::Grid;
use crate::ordered::ordered;

/// From an edge's number to that of the edge below it; more than twice the longest side of a frame.
const ROW: f64 = 65_536.0;

/// A sub-pixel polyline around (a part of) a region.
///
/// ```
/// use relievo::Shape;
/// use relievo::curves::contours;
///
/// let circle = Shape::Circle { x: 20.0, y: 15.0, r: 5.0 };
/// let outline = &contours(&circle.level_set(40, 30, 0)?, 1)[0];
/// assert!(outline.closed);
/// for [x, y] in &outline.points {
///     assert!(((x - 20.0).hypot(y - 15.0) - 5.0).abs() < 0.1);
/// }
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Contour {
    /// The region it bounds: k for the k-th curve.
    pub label: u8,
    /// Its points `[x, y]` in order; the last is joined to the first when `closed`.
    pub points: Vec<[f32; 2]>,
    /// Whether it returns to its start, which those of level sets always do.
    pub closed: bool,
}

impl Contour {
    /// The same curve on the frame enlarged `n` times.
    pub(crate) fn enlarged(self, n: usize) -> Self {
        self.scaled(n as f32)
    }

    /// The same curve on the frame shrunk `n` times.
    pub fn shrunk(self, n: usize) -> Self {
        self.scaled((n as f32).recip())
    }

    fn scaled(mut self, n: f32) -> Self {
        for c in self.points.as_flattened_mut() {
            *c = n * (*c + 0.5) - 0.5;
        }
        self
    }
}

/// All curves of a level set, largest first; none when it has only one sign. What is not a number
/// counts as outside.
pub fn contours(level_set: &Grid<f32>, label: u8) -> Vec<Contour> {
    let (width, height) = (level_set.width(), level_set.height());
    if level_set.is_empty() {
        return Vec::new();
    }
    // One ring of pixels around the frame with the sign turned: the zero then lies half-way to it.
    let phi = |x: usize, y: usize| -> f32 {
        let (x, y) = (x as isize - 1, y as isize - 1);
        let value = level_set.clamped(x, y);
        let inside = x >= 0 && y >= 0 && x < width as isize && y < height as isize;
        if inside { value } else { -value.abs() }
    };
    let mut steps = Vec::new();
    for y in 0..=height {
        for x in 0..=width {
            let corners = [phi(x, y), phi(x + 1, y), phi(x + 1, y + 1), phi(x, y + 1)];
            for (from, to) in links(corners) {
                let edge = |side: usize| match side {
                    0 => Edge::across(x, y),
                    1 => Edge::down(x + 1, y),
                    2 => Edge::across(x, y + 1),
                    _ => Edge::down(x, y),
                };
                steps.push((edge(from), edge(to)));
            }
        }
    }
    // To be found by the edge that a step comes from.
    let sorted = ordered(steps.clone(), |(from, _)| from.number());
    let place = |edge: Edge| {
        let by_number = |(from, _): &(Edge, Edge)| from.number().total_cmp(&edge.number());
        sorted.binary_search_by(by_number).ok()
    };
    let mut taken = vec![false; sorted.len()];
    let mut found = Vec::new();
    for (start, _) in steps {
        let mut points = Vec::new();
        let mut edge = start;
        while let Some(at) = place(edge).filter(|&at| !taken[at]) {
            taken[at] = true;
            points.push(edge.crossing(&phi));
            edge = sorted[at].1;
        }
        if points.len() > 2 {
            found.push(Contour {
                label,
                points,
                closed: true,
            });
        }
    }
    ordered(found, |contour| -(contour.points.len() as f64))
}

/// The line between two neighbouring pixels of the padded level set.
#[derive(Clone, Copy)]
struct Edge {
    x: u32,
    y: u32,
    down: bool,
}

impl Edge {
    fn across(x: usize, y: usize) -> Self {
        Self {
            x: x as u32,
            y: y as u32,
            down: false,
        }
    }

    fn down(x: usize, y: usize) -> Self {
        Self {
            down: true,
            ..Self::across(x, y)
        }
    }

    /// Its own, in the order of rows.
    fn number(self) -> f64 {
        let [x, y] = [self.x, self.y].map(f64::from);
        y * ROW + 2.0 * x + f64::from(u8::from(self.down))
    }

    fn crossing(self, phi: &impl Fn(usize, usize) -> f32) -> [f32; 2] {
        let (x, y) = (self.x as usize, self.y as usize);
        let a = phi(x, y);
        let b = if self.down {
            phi(x, y + 1)
        } else {
            phi(x + 1, y)
        };
        let t = a / (a - b);
        let t = if t.is_finite() {
            t.clamp(0.0, 1.0)
        } else {
            0.5
        };
        // Less the ring of padding.
        let (x, y) = (x as f32 - 1.0, y as f32 - 1.0);
        if self.down { [x, y + t] } else { [x + t, y] }
    }
}

/// Which side of a cell leads to which, the inside on the right. Corners clockwise from the top
/// left, side i between corners i and i + 1. A saddle is joined when its mean is inside.
fn links(corners: [f32; 4]) -> impl Iterator<Item = (usize, usize)> {
    let inside = corners.map(|c| c > 0.0);
    // Walking clockwise round the cell, the curve enters it where the walk leaves the inside
    // and leaves it where the walk comes in again.
    let entries: Vec<usize> = (0..4)
        .filter(|&i| inside[i] && !inside[(i + 1) % 4])
        .collect();
    let joined = entries.len() == 2 && corners.iter().sum::<f32>() > 0.0;
    entries.into_iter().map(move |entry| {
        // Side at which the stretch of inside corners that ends at `entry` began, or, joined, the
        // side at which the stretch after it begins.
        let exit = if joined {
            (1..4)
                .map(|step| (entry + step) % 4)
                .find(|&i| !inside[i] && inside[(i + 1) % 4])
        } else {
            (1..4)
                .map(|step| (entry + 4 - step) % 4)
                .find(|&i| !inside[i] && inside[(i + 1) % 4])
        };
        (entry, exit.unwrap_or(entry))
    })
}
