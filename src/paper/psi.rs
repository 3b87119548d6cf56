//! ψ = s·T/Z + (It + q·ω) of every region, row by row (`constraint.rs` has the equation).

use std::ops::Range;

use super::rows::runs;
use crate::camera::{Camera, RigidMotion};
use crate::constraint::RowMotion;
use crate::frames::Derivatives;
use crate::grid::Grid;

/// What ψ of every region depends on, but for depth.
#[derive(Clone, Copy)]
pub struct Psi<'a> {
    /// The camera.
    pub camera: &'a Camera,
    /// Ix, Iy and It.
    pub derivatives: &'a Derivatives,
    /// The motion of each region, the background's first.
    pub motions: &'a [RigidMotion],
}

impl Psi<'_> {
    /// Writes ψ of region `k`, grey levels, at `pixels` of row `y`, where `z` is the whole row's depth.
    pub(super) fn of_region(
        &self,
        k: usize,
        y: usize,
        pixels: Range<usize>,
        z: &[f32],
        psi: &mut [f32],
    ) {
        let row = RowMotion::new(self.camera, &self.motions[k], y);
        let z = &z[pixels.clone()];
        row.residual(self.derivatives, y, pixels, z, psi);
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
                let row = RowMotion::new(self.camera, &self.motions[k], y);
                let slope = &mut slope.row_mut(y)[run.clone()];
                let offset = &mut offset.row_mut(y)[run.clone()];
                row.along_depth(self.derivatives, y, run, slope, offset);
            }
        }
    }
}
