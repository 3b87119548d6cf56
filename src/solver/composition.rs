//! One picture out of layers: at each pixel the depth, motion and confidence of the region that owns it,
//! and what the second frame hides.

use crate::camera::RigidMotion;
use crate::curves;
use crate::depth;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::motion::Kind;
use crate::occlusion::occluded;
use crate::warp::Scale;

/// One region at the frame's size.
pub(super) struct Layer {
    pub motion: RigidMotion,
    pub kind: Kind,
    /// Inverse depth over the whole frame.
    pub rho: Grid<f32>,
}

/// What `layers` and the curves `level_sets` between them say of the frames at `scale`, whose residual
/// has standard deviation `sigma`.
pub(super) fn composed(
    scale: &Scale,
    level_sets: &[Grid<f32>],
    layers: &[Layer],
    sigma: f64,
) -> Interpretation {
    let (width, height) = (scale.width(), scale.height());
    let labels = curves::labels(level_sets, width, height);
    let mut flow = Flow {
        u: Grid::new(width, height, 0.0),
        v: Grid::new(width, height, 0.0),
    };
    let mut depth = Grid::new(width, height, 1.0f32);
    let mut confidence = Grid::new(width, height, 0.0f32);
    let mut target = vec![[0.0f32; 2]; width * height];
    let mut chi2 = vec![0.0f32; width * height];
    for (k, layer) in layers.iter().enumerate() {
        let line = scale.linearise(&layer.motion, &layer.rho, scale.whole());
        let shows = layer.kind.translates();
        let slope = line.rows.map(|row| if shows { row[0] } else { 0.0 });
        let certain = depth::confidence(&slope, sigma);
        for i in 0..labels.len() {
            if usize::from(labels.data()[i]) != k {
                continue;
            }
            let (x, y) = ((i % width) as f64, (i / width) as f64);
            let rho = layer.rho.data()[i];
            let (u, v) = scale
                .camera
                .displacement(&layer.motion, x, y, f64::from(rho))
                .unwrap_or((0.0, 0.0));
            flow.u.data_mut()[i] = u as f32;
            flow.v.data_mut()[i] = v as f32;
            depth.data_mut()[i] = rho.recip();
            confidence.data_mut()[i] = if shows { certain.data()[i] } else { 0.0 };
            target[i] = [(x + u) as f32, (y + v) as f32];
            chi2[i] = curves::misfit(&line, i, sigma, true);
        }
    }
    let occluded = occluded(&labels, &target, &chi2);
    for (c, &hidden) in confidence.data_mut().iter_mut().zip(occluded.data()) {
        if hidden != 0 {
            *c = 0.0;
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
