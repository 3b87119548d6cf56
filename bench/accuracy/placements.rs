//! Circles put elsewhere than a sequence has them: in a few ways by plan, and in many by lot.

use relievo::{Grid, Shape};

use crate::dice::Dice;

/// Number of sets of circles by plan.
pub const PLANNED: usize = 5;
/// What a circle's centre moves by, in radii, and what its radius is multiplied by. Every second circle
/// moves the other way.
const PLACEMENTS: [[f64; 3]; PLANNED] = [
    [0.0, 0.0, 1.0],
    [0.33, 0.0, 1.0],
    [0.0, -0.33, 1.0],
    [-0.25, 0.25, 0.8],
    [-0.2, -0.2, 1.25],
];

/// What a drawn circle's radius is multiplied by, at least and at most.
pub const GROWTH: [f64; 2] = [0.5, 1.5];
/// Share of its object that a drawn circle covers at least.
pub const LEAST_COVERED: f64 = 0.15;
/// Share of the smaller of two drawn circles that the other may cover.
pub const MOST_SHARED: f64 = 0.1;
/// Draws after which a circle, or a set of them, is given up.
const DRAWS: usize = 10_000;

/// The circles by plan, the sequence's own first.
pub fn planned(curves: &[Shape]) -> Vec<Vec<Shape>> {
    let placed = |[right, down, grow]: [f64; 3]| {
        let each = circles(curves).into_iter().enumerate();
        each.map(|(k, Circle { x, y, r })| {
            let way = if k % 2 == 0 { 1.0 } else { -1.0 };
            let (x, y) = (x + way * right * r, y + way * down * r);
            Shape::Circle { x, y, r: grow * r }
        })
        .collect()
    };
    PLACEMENTS.into_iter().map(placed).collect()
}

/// `count` sets of circles by lot, the same for the same `seed`: as large as [`GROWTH`] allows, each on its
/// object by [`LEAST_COVERED`], none on another by more than [`MOST_SHARED`]. Fewer where such circles
/// cannot be had.
pub fn drawn(curves: &[Shape], labels: &Grid<u8>, count: usize, seed: u64) -> Vec<Vec<Shape>> {
    let mut dice = Dice::new(seed);
    let own = circles(curves);
    let draw = |_| set(&own, labels, &mut dice);
    (0..count).filter_map(draw).collect()
}

/// A circle in pixels.
#[derive(Clone, Copy)]
pub struct Circle {
    /// Column of its centre.
    pub x: f64,
    /// Row of its centre.
    pub y: f64,
    /// Its radius.
    pub r: f64,
}

/// Those of `curves` that are circles.
pub fn circles(curves: &[Shape]) -> Vec<Circle> {
    let circle = |curve: &Shape| match *curve {
        Shape::Circle { x, y, r } => Some(Circle { x, y, r }),
        Shape::Polygon { .. } => None,
    };
    curves.iter().filter_map(circle).collect()
}

fn set(own: &[Circle], labels: &Grid<u8>, dice: &mut Dice) -> Option<Vec<Shape>> {
    for _ in 0..DRAWS {
        let each = own.iter().enumerate();
        let set: Vec<Circle> = each
            .map(|(k, circle)| one(circle, labels, k + 1, dice))
            .collect::<Option<_>>()?;
        let apart = |i: usize| {
            set[..i]
                .iter()
                .all(|other| shared(&set[i], other) <= MOST_SHARED)
        };
        if (0..set.len()).all(apart) {
            return Some(set.iter().map(Circle::shape).collect());
        }
    }
    None
}

/// A circle on object `k`, whose own one is given.
fn one(own: &Circle, labels: &Grid<u8>, k: usize, dice: &mut Dice) -> Option<Circle> {
    let draw = || {
        let r = own.r * dice.between(GROWTH[0], GROWTH[1]);
        // The own circle has a third of the object's area: in an object twice as long as wide the
        // farthest pixel is some 2.5 of its radii away.
        let reach = 2.5 * own.r + r;
        let mut shift = || dice.between(-reach, reach);
        let (x, y) = (own.x + shift(), own.y + shift());
        Circle { x, y, r }
    };
    let mut draws = std::iter::repeat_with(draw).take(DRAWS);
    draws.find(|circle| covered(circle, labels, k) >= LEAST_COVERED)
}

/// Share of object `k` that lies in the circle.
pub fn covered(circle: &Circle, labels: &Grid<u8>, k: usize) -> f64 {
    let (mut inside, mut all) = (0.0, 0.0);
    for (i, _) in (labels.data().iter().enumerate()).filter(|(_, label)| usize::from(**label) == k)
    {
        let (x, y) = ((i % labels.width()) as f64, (i / labels.width()) as f64);
        all += 1.0;
        inside += f64::from(u8::from((x - circle.x).hypot(y - circle.y) < circle.r));
    }
    inside / f64::max(all, 1.0)
}

/// The area common to two circles over the smaller one's.
pub fn shared(a: &Circle, b: &Circle) -> f64 {
    let apart = (a.x - b.x).hypot(a.y - b.y);
    let (small, large) = (a.r.min(b.r), a.r.max(b.r));
    if apart >= small + large {
        return 0.0;
    }
    if apart <= large - small {
        return 1.0;
    }
    // Each circle's sector less its triangle, along the common chord.
    let part = |r: f64, other: f64| {
        let to_chord = (apart * apart + r * r - other * other) / (2.0 * apart);
        let chord = (r * r - to_chord * to_chord).max(0.0).sqrt();
        r * r * (to_chord / r).clamp(-1.0, 1.0).acos() - to_chord * chord
    };
    (part(small, large) + part(large, small)) / (std::f64::consts::PI * small * small)
}

impl Circle {
    fn shape(&self) -> Shape {
        Shape::Circle {
            x: self.x,
            y: self.y,
            r: self.r,
        }
    }
}
