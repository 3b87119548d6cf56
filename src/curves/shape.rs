//! The curves that a person draws: circles and polygons, before they become level sets.
//!
//! Coordinates are pixels, (0, 0) the centre of the top-left pixel.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use super::polygon;
use crate::error::Error;
use crate::grid::Grid;

/// A closed curve as drawn.
///
/// ```
/// use relievo::Shape;
///
/// let circle = Shape::Circle { x: 20.0, y: 15.0, r: 5.0 };
/// assert_eq!(circle.signed_distance(20.0, 12.0), 2.0); // inside
/// assert_eq!(circle.signed_distance(30.0, 15.0), -5.0); // outside
///
/// let triangle: Shape = serde_json::from_str(
///     r#"{"kind": "polygon", "points": [[1, 1], [9, 1], [5, 8]]}"#,
/// ).unwrap();
/// assert!(triangle.signed_distance(5.0, 3.0) > 0.0);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Shape {
    /// A circle.
    Circle {
        /// Column of the centre.
        x: f64,
        /// Row of the centre.
        y: f64,
        /// Radius, above 0.
        r: f64,
    },
    /// A polygon, closed from its last corner to its first; also a freehand line.
    Polygon {
        /// The corners, at least three.
        points: Vec<[f64; 2]>,
    },
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Circle,
    Polygon,
}

/// Whatever a curve may have.
#[derive(Deserialize)]
#[serde(rename = "curve", deny_unknown_fields)]
struct Drawn {
    kind: Kind,
    x: Option<f64>,
    y: Option<f64>,
    r: Option<f64>,
    points: Option<Vec<[f64; 2]>>,
}

// What is derived keeps a value of any type until it knows the kind, and takes 8 kB more.
impl<'de> Deserialize<'de> for Shape {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let it = Drawn::deserialize(from)?;
        let needed = |value: Option<f64>, name| value.ok_or_else(|| D::Error::missing_field(name));
        match it.kind {
            Kind::Circle if it.points.is_some() => {
                Err(D::Error::unknown_field("points", &["kind", "x", "y", "r"]))
            }
            Kind::Circle => Ok(Self::Circle {
                x: needed(it.x, "x")?,
                y: needed(it.y, "y")?,
                r: needed(it.r, "r")?,
            }),
            Kind::Polygon if it.x.or(it.y).or(it.r).is_some() => Err(D::Error::custom(
                "a polygon has `points`, and neither `x` nor `y` nor `r`",
            )),
            Kind::Polygon => (it.points)
                .map(|points| Self::Polygon { points })
                .ok_or_else(|| D::Error::missing_field("points")),
        }
    }
}

impl Shape {
    /// Signed distance in pixels from `(x, y)` to the curve: above 0 inside, below 0 outside.
    pub fn signed_distance(&self, x: f64, y: f64) -> f64 {
        match self {
            Shape::Circle { x: cx, y: cy, r } => r - (x - cx).hypot(y - cy),
            Shape::Polygon { points } => polygon::signed_distance(points, x, y),
        }
    }

    /// Whether the curve can lie on a `width × height` frame; `index` (from 0) only names it in errors.
    ///
    /// # Errors
    /// [`Error::CurveNotFinite`], [`Error::CurveOutside`] when it meets no pixel of the frame, [`Error::CurveEmpty`] when
    /// it has no corner.
    pub fn check(&self, width: usize, height: usize, index: usize) -> Result<(), Error> {
        let curve = index + 1;
        let (min, max, finite) = self.bounds();
        if !finite {
            return Err(Error::CurveNotFinite { curve });
        }
        if min[0] > max[0] {
            return Err(Error::CurveEmpty { curve });
        }
        let (w, h) = (width as f64, height as f64);
        if max[0] < -0.5 || max[1] < -0.5 || min[0] > w - 0.5 || min[1] > h - 0.5 {
            return Err(Error::CurveOutside {
                curve,
                width,
                height,
            });
        }
        Ok(())
    }

    /// The level set of the curve over a `width × height` frame; `index` (from 0) only names it in errors.
    ///
    /// # Errors
    /// What [`Shape::check`] finds, and [`Error::CurveEmpty`] when it encloses no pixel.
    pub fn level_set(&self, width: usize, height: usize, index: usize) -> Result<Grid<f32>, Error> {
        let curve = index + 1;
        self.check(width, height, index)?;
        let phi = match self {
            Shape::Circle { .. } => Grid::from_fn(width, height, |x, y| {
                self.signed_distance(x as f64, y as f64) as f32
            }),
            Shape::Polygon { points } => polygon::level_set(points, width, height),
        };
        if phi.data().iter().all(|&p| p <= 0.0) {
            return Err(Error::CurveEmpty { curve });
        }
        Ok(phi)
    }

    /// The same curve on the frame shrunk `n` times.
    pub(crate) fn shrunk(&self, n: usize) -> Self {
        let n = n as f64;
        let place = |c: f64| (c + 0.5) / n - 0.5;
        match self {
            Self::Circle { x, y, r } => Self::Circle {
                x: place(*x),
                y: place(*y),
                r: r / n,
            },
            Self::Polygon { points } => Self::Polygon {
                points: points.iter().map(|p| p.map(place)).collect(),
            },
        }
    }

    /// Least and greatest corner, and whether every number is finite; least exceeds greatest when
    /// there is nothing to bound.
    fn bounds(&self) -> ([f64; 2], [f64; 2], bool) {
        match self {
            Shape::Circle { x, y, r } => (
                [x - r, y - r],
                [x + r, y + r],
                x.is_finite() && y.is_finite() && r.is_finite(),
            ),
            Shape::Polygon { points } => {
                let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
                let mut finite = true;
                for p in points {
                    for i in 0..2 {
                        finite &= p[i].is_finite();
                        min[i] = min[i].min(p[i]);
                        max[i] = max[i].max(p[i]);
                    }
                }
                (min, max, finite)
            }
        }
    }
}
