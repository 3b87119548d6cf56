//! The functional (7), term by term, for curves and depth that may have moved since:
//!
//! ```text
//! (7)  E = Σk ∫_Rk [ ψk² + μ g(‖∇Z‖) ] dx + λ Σ_{k≥1} ∮_γk ds
//! ```
//!
//! in grey levels², a pixel being the unit of area. The length of a curve is that of
//! [`curves::length`](crate::curves::length).

use super::psi::Psi;
use crate::curves;
use crate::energy::Energy;
use crate::grid::Grid;
use crate::linalg::{dot, sum};
use crate::smoothness::Smoothness;

/// The terms of (7) for level sets `phi` and depth `z`; `labels` are those of `phi`.
pub fn energy(
    psi: &Psi,
    labels: &Grid<u8>,
    z: &Grid<f32>,
    smoothness: &Smoothness,
    phi: &[Grid<f32>],
    lambda: f64,
) -> Energy {
    let mut data = 0.0;
    psi.rows(labels, z, |psi| data += dot(psi, psi));
    Energy {
        data,
        smoothness: relief(smoothness, z),
        length: lambda * phi.iter().map(curves::length).sum::<f64>(),
    }
}

/// μ ∫ g(‖∇Z‖), with forward differences; those across the frame's border are 0.
fn relief(smoothness: &Smoothness, z: &Grid<f32>) -> f64 {
    let (width, height) = (z.width(), z.height());
    let mut row = vec![0.0f32; width];
    let mut energy = 0.0;
    for y in 0..height {
        let (here, below) = (z.row(y), z.row((y + 1).min(height - 1)));
        for x in 0..width - 1 {
            let (dx, dy) = (here[x + 1] - here[x], below[x] - here[x]);
            row[x] = smoothness.at(dx * dx + dy * dy).0;
        }
        row[width - 1] = smoothness
            .at((below[width - 1] - here[width - 1]).powi(2))
            .0;
        energy += sum(&row);
    }
    energy
}
