//! Hollow or bulging: which way a surface bends as a whole.
//!
//! ```text
//! hollow  ⇔  Σ w (ρ − plane) (x² + y²)  >  0        the plane fitted to ρ with the weights w
//! ```
//!
//! What the plane leaves is at right angles to 1, x and y, so that the sign is that of x² + y² in the regression of ρ
//! on (1, x, y, x² + y²), wherever the origin is: nearer at the rim than in the middle.

use super::Plane;
use crate::grid::Grid;

/// Whether the surface of inverse depth `rho` is nearer towards the rim of the region whose pixels have a `weight` over 0
/// than in its middle, a slope aside.
pub fn hollow(rho: &Grid<f32>, weight: &Grid<f32>) -> bool {
    let plane = Plane::fit(rho, weight);
    let mut sum = 0.0;
    for y in 0..rho.height() {
        for x in 0..rho.width() {
            let w = f64::from(weight[(x, y)]);
            let left = f64::from(rho[(x, y)]) - plane.at(x as f64, y as f64);
            sum += w * left * (x * x + y * y) as f64;
        }
    }
    sum > 0.0
}
