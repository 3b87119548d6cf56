//! Threshold dynamics: every pixel goes to the region whose smoothed residual is least, argmin_k Gσ * ξk.
//!
//! Where (17) moves a curve by a pixel, this moves it to wherever the data are better (Merriman, Bence and
//! Osher 1994; Esedoḡlu and Otto 2015), so that a start which misses its object still finds it. σ in
//! pixels plays the part of λ. One step; it leaves signed distances, φ > 0 inside, zero between pixels.

use super::redistance::redistance;
use crate::frames::blur;
use crate::grid::Grid;

/// The level sets of labels 1… after one step; `xi[0]` is the background's residual.
pub fn threshold(xi: &[Grid<f32>], sigma: f64) -> Vec<Grid<f32>> {
    let smooth: Vec<Grid<f32>> = xi.iter().map(|xi| blur(xi, sigma)).collect();
    (1..xi.len())
        .map(|k| {
            let mut phi = Grid::new(xi[k].width(), xi[k].height(), f32::INFINITY);
            for (j, rival) in smooth.iter().enumerate() {
                if j != k {
                    let own = smooth[k].data();
                    for ((p, &r), &o) in phi.data_mut().iter_mut().zip(rival.data()).zip(own) {
                        *p = p.min(r - o);
                    }
                }
            }
            redistance(&mut phi);
            phi
        })
        .collect()
}
