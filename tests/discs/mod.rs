//! Discs that regions explain: what curves are set to find.

use relievo::curves::labels;
use relievo::{Grid, Shape};

/// The frame's width and height.
pub const W: usize = 64;
pub const H: usize = 56;

/// The level set of a circle.
pub fn circle(x: f64, y: f64, r: f64) -> Grid<f32> {
    let shape = Shape::Circle { x, y, r };
    Grid::from_fn(W, H, |px, py| {
        shape.signed_distance(px as f64, py as f64) as f32
    })
}

/// Residuals of `contrast` that drop to 0 inside `shapes[k − 1]` for region k, and outside all for region 0.
pub fn residuals(shapes: &[Grid<f32>], contrast: f32) -> Vec<Grid<f32>> {
    let truth = labels(shapes, W, H);
    let own = |k: usize| truth.map(|l| if usize::from(l) == k { 0.0 } else { contrast });
    (0..=shapes.len()).map(own).collect()
}

/// The share of the frame that is labelled otherwise than in truth.
pub fn wrong(found: &[Grid<f32>], truth: &[Grid<f32>]) -> f64 {
    let (found, truth) = (labels(found, W, H), labels(truth, W, H));
    let pairs = found.data().iter().zip(truth.data());
    pairs.filter(|(a, b)| a != b).count() as f64 / (W * H) as f64
}

/// The same value at every pixel.
pub fn everywhere(value: f32) -> Grid<f32> {
    Grid::new(W, H, value)
}
