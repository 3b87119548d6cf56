//! Surfaces that several curves hold, tried in parts.
//!
//! Where two things touch and move nearly alike, one surface may explain the patches of both, and what lies on each
//! side of it joins them to one body. Curves that somebody drew say better where to look: a surface of which several
//! curves hold a share of [`HOLDS`] or more is tried in as many parts, each patch in that of the curve it is deepest
//! inside or nearest to. Parts are fitted, and all patches shared out anew; that is kept if it is a shorter description
//! (E of `surfaces.rs`, in which a further surface has its price).

use super::lattice::Lattice;
use super::look::Look;
use super::surface::Surface;
use super::surfaces::FEWEST;
use crate::grid::Grid;

/// Share of a surface's patches that a curve has to hold.
const HOLDS: f64 = 0.1;

impl Look {
    /// The same with parts for surfaces that several of `curves` hold, level sets that cover the frame; `None` where
    /// that is no shorter a description.
    pub fn parted(self, curves: &[Grid<f32>]) -> Option<Self> {
        let depths: Vec<Vec<f32>> = curves
            .iter()
            .map(|curve| depths(curve, &self.lattice, self.size))
            .collect();
        let mut all = Vec::new();
        for (k, &surface) in self.surfaces.all.iter().enumerate() {
            let parts = parts(&self.surfaces.patches(k), &depths);
            if parts.len() < 2 || parts.iter().any(|part| part.len() < FEWEST) {
                all.push(surface);
            } else {
                let fitted = |part: &Vec<usize>| Surface::best(&self.sights, part, Some(surface));
                all.extend(parts.iter().map(fitted));
            }
        }
        if all.len() == self.surfaces.all.len() {
            return None;
        }
        let surfaces = self.surfaces.instead(&self.sights, &self.lattice, all)?;
        Some(Self { surfaces, ..self })
    }
}

/// How deep inside a curve each patch is, below 0 outside, for patches matched on a picture of `size` columns and rows.
fn depths(curve: &Grid<f32>, lattice: &Lattice, size: (usize, usize)) -> Vec<f32> {
    let [columns, rows] = &lattice.pixels;
    let along =
        |pixel: f32, size: usize, whole: usize| (pixel + 0.5) * size as f32 / whole as f32 - 0.5;
    let depth = |&(column, row): &(usize, usize)| {
        curve.bilinear(
            along(columns[column], curve.width(), size.0),
            along(rows[row], curve.height(), size.1),
        )
    };
    lattice.places.iter().map(depth).collect()
}

/// `patches` by the curve that each is deepest inside or nearest to, of those that hold enough of them.
fn parts(patches: &[usize], depths: &[Vec<f32>]) -> Vec<Vec<usize>> {
    let least = HOLDS * patches.len() as f64;
    let holds = |depth: &&Vec<f32>| {
        let held = patches.iter().filter(|&&i| depth[i] > 0.0).count();
        held as f64 >= least
    };
    let holding: Vec<&Vec<f32>> = depths.iter().filter(holds).collect();
    let mut parts = vec![Vec::new(); holding.len()];
    for &i in patches {
        let deepest = (0..holding.len()).max_by(|&a, &b| holding[a][i].total_cmp(&holding[b][i]));
        if let Some(part) = deepest {
            parts[part].push(i);
        }
    }
    parts
}
