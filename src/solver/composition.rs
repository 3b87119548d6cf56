//! One picture out of layers: at each pixel the depth, motion and confidence of the region that owns it,
//! and what the second frame hides.

use crate::camera::RigidMotion;
use crate::curves::{self, Measure};
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::motion::Kind;
use crate::paper;
use crate::warp::{Linearisation, Scale};

use super::rivalry;

/// One region at the frame's size.
pub(super) struct Layer {
    pub motion: RigidMotion,
    pub kind: Kind,
    /// Inverse depth over the whole frame.
    pub rho: Grid<f32>,
    /// How much brighter its pixels become, grey levels.
    pub shade: Grid<f32>,
}

/// What `layers` and the curves `level_sets` between them say of the frames at `scale`. What is out of sight in the second
/// frame has left it, or, if `covers`, is behind what another layer shows there.
pub(super) fn composed(
    scale: &Scale,
    level_sets: &[Grid<f32>],
    layers: &[Layer],
    measure: &Measure,
    covers: bool,
) -> Interpretation {
    let (width, height) = (scale.width(), scale.height());
    let labels = curves::labels(level_sets, width, height);
    let mut flow = Flow {
        u: Grid::new(width, height, 0.0),
        v: Grid::new(width, height, 0.0),
    };
    let mut depth = Grid::new(width, height, 1.0f32);
    let mut confidence = Grid::new(width, height, 0.0f32);
    let lines: Vec<Linearisation> = layers
        .iter()
        .map(|layer| {
            let mut line = scale.linearise(&layer.motion, &layer.rho, scale.whole());
            line.allow_for(&layer.shade);
            line
        })
        .collect();
    let cover = covers.then(|| {
        let xi = rivalry::residuals(&lines, scale, measure);
        rivalry::cover(&lines, &xi, &labels, measure)
    });
    let mut occluded = Grid::new(width, height, 0u8);
    for (k, (layer, line)) in layers.iter().zip(&lines).enumerate() {
        let shows = layer.kind.translates();
        let slope = line.rows.map(|row| if shows { row[0] } else { 0.0 });
        let certain = paper::confidence(&slope, measure.sigma);
        for i in 0..labels.len() {
            if usize::from(labels.data()[i]) != k {
                continue;
            }
            let (x, y) = ((i % width) as f64, (i / width) as f64);
            let rho = layer.rho.data()[i];
            let moved = scale
                .camera
                .displacement(&layer.motion, x, y, f64::from(rho));
            let (u, v) = moved.unwrap_or((0.0, 0.0));
            flow.u.data_mut()[i] = u as f32;
            flow.v.data_mut()[i] = v as f32;
            depth.data_mut()[i] = rho.recip();
            let (qx, qy) = (x + u, y + v);
            // A pixel reaches half of one beyond its centre, where there is nothing to compare with any more.
            let stays = (-0.5..width as f64 - 0.5).contains(&qx)
                && (-0.5..height as f64 - 0.5).contains(&qy);
            let covered = cover
                .as_ref()
                .is_some_and(|cover| cover.hides(k, [qx as f32, qy as f32]));
            occluded.data_mut()[i] = u8::from(moved.is_none() || !stays || covered);
            if shows && line.inside.data()[i] && !covered {
                confidence.data_mut()[i] = certain.data()[i];
            }
        }
    }
    Interpretation {
        camera: scale.camera,
        labels,
        depth,
        flow,
        confidence,
        occluded,
        motions: layers.iter().map(|layer| layer.motion).collect(),
    }
}
