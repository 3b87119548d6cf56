//! Curves to start from, without anyone drawing: a polygon roughly on each thing that moves by itself.
//!
//! Small patches are matched all over the frame. Their displacements are explained by planes in motion,
//! as many as pay for their description; planes that one motion carries, whatever their depth, are
//! one body; the body that holds most of the frame's border is the background, and each place where
//! another explains the patches better gets an outline. Everything is decided by one criterion, the
//! description length of the patches, so there is nothing to set. The same frames give the same curves;
//! frames that do not show the same things give none.
//!
//! What moves as the background would at another depth cannot be told from scenery, and what covers less
//! than a hundredth of the frame cannot be told from the seam between two motions.

use super::bodies::Bodies;
use super::look::Look;
use super::outline::{Outline, outlines};
use super::rigid::Search;
use super::surfaces::least_costs;
use crate::camera::Camera;
use crate::curves::Shape;
use crate::frames::FramePair;

/// Curves at most.
const MOST: usize = 4;

/// The largest four of [`Look::bodies`]; none when one rigid motion explains both frames. `camera` is the frames' own.
pub fn automatic(pair: &FramePair, camera: &Camera) -> Vec<Shape> {
    let look = Look::at(pair, camera);
    let mut curves = look.map_or_else(Vec::new, |look| look.bodies());
    curves.truncate(MOST);
    curves
}

impl Look {
    /// Polygons roughly on the things that move by themselves, the largest first; none when one rigid motion explains
    /// both frames. Corners are in pixels of the frame, inside it, to a tenth of a pixel.
    pub fn bodies(&self) -> Vec<Shape> {
        let (sights, lattice) = (&self.sights, &self.lattice);
        let costs: Vec<Vec<f64>> = Bodies::find(self, Search::QUICK)
            .members
            .iter()
            .map(|body| body.iter().map(|&k| &self.surfaces.all[k]))
            .map(|surfaces| least_costs(sights, lattice, surfaces))
            .collect();
        let mut curves: Vec<Outline> = (1..costs.len())
            .flat_map(|k| {
                let rivals = || costs.iter().enumerate().filter(move |(j, _)| *j != k);
                let margin: Vec<f64> = (0..sights.all.len())
                    .map(|i| {
                        let least = rivals().map(|(_, c)| c[i]).fold(f64::INFINITY, f64::min);
                        least - costs[k][i]
                    })
                    .collect();
                outlines(lattice, &margin, self.size, self.frame)
            })
            .collect();
        curves.sort_by(|a, b| b.share.total_cmp(&a.share));
        let polygon = |outline: Outline| Shape::Polygon {
            points: outline.corners,
        };
        curves.into_iter().map(polygon).collect()
    }
}
