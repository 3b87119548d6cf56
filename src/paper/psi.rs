//! ψ = s·T/Z + (It + q·ω) of every region, row by row (`constraint.rs` has the equation).

use std::ops::Range;

use super::rows::runs;
use crate::camera::{Camera, RigidMotion};
use crate::constraint::RowMotion;
use crate::frames::Derivatives;
use crate::grid::Grid;

/// What ψ of every region depends on, but for depth.
pub struct Psi<'a> {
    derivatives: &'a Derivatives,
    /// The motion of every region along every row, region by region.
    motions: Vec<RowMotion>,
}

impl<'a> Psi<'a> {
    /// ψ of regions with these `motions`, the background's first.
    pub fn new(camera: &Camera, derivatives: &'a Derivatives, motions: &[RigidMotion]) -> Self {
        let rows = 0..derivatives.it.height();
        let along = |m| rows.clone().map(move |y| RowMotion::new(camera, m, y));
        Self {
            derivatives,
            motions: motions.iter().flat_map(along).collect(),
        }
    }

    fn along(&self, k: usize, y: usize) -> &RowMotion {
        &self.motions[k * self.derivatives.it.height() + y]
    }

    /// Writes ψ of region `k`, grey levels, at `pixels` of row `y`, where `z` is the whole row's depth.
    pub(super) fn of_region(
        &self,
        k: usize,
        y: usize,
        pixels: Range<usize>,
        z: &[f32],
        psi: &mut [f32],
    ) {
        let z = &z[pixels.clone()];
        self.along(k, y)
            .residual(self.derivatives, y, pixels, z, psi);
    }

    /// Calls `visit` with every row of ψ, grey levels, each pixel under the motion of its own region.
    pub(super) fn rows(&self, labels: &Grid<u8>, z: &Grid<f32>, mut visit: impl FnMut(&[f32])) {
        let mut psi = vec![0.0; z.width()];
        for y in 0..z.height() {
            for (k, run) in runs(labels.row(y)) {
                self.of_region(k, y, run.clone(), z.row(y), &mut psi[run]);
            }
            visit(&psi);
        }
    }

    /// Writes s·T and It + q·ω of the region that owns each pixel.
    pub(super) fn along_depth(
        &self,
        labels: &Grid<u8>,
        slope: &mut Grid<f32>,
        offset: &mut Grid<f32>,
    ) {
        for y in 0..labels.height() {
            for (k, run) in runs(labels.row(y)) {
                let slope = &mut slope.row_mut(y)[run.clone()];
                let offset = &mut offset.row_mut(y)[run.clone()];
                self.along(k, y)
                    .along_depth(self.derivatives, y, run, slope, offset);
            }
        }
    }
}
