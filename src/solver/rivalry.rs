//! What layers have to say against each other at every pixel: ξ, who would be hidden, who is farther away.

use crate::curves::Measure;
use crate::frames::blur;
use crate::grid::Grid;
use crate::occlusion::{Cover, Landing};
use crate::warp::{Linearisation, Scale};

/// A curve pays this, in variances, for pixels that are nearer to another by this share of the frame's
/// width: of two that move alike, the nearer takes them.
const FAR: (f32, f32) = (2.0, 0.05);
/// Mean ξ, in variances, from which a pixel is not explained, and the mean's standard deviation in pixels.
const UNEXPLAINED: (f32, f64) = (3.5, 1.5);
/// Standard deviation of the window over which a landing is confirmed, in pixels.
const CONFIRMING: f64 = 1.0;

/// ξ of every region over the frame; outside its window a region has nothing to say for itself.
pub(super) fn residuals(
    lines: &[Linearisation],
    scale: &Scale,
    measure: &Measure,
) -> Vec<Grid<f32>> {
    let whole = |line: &Linearisation| {
        let mut all = Grid::new(scale.width(), scale.height(), measure.refuted());
        let own = measure.residual_in_units(line, scale);
        line.window.paste(&own, &mut all);
        all
    };
    lines.iter().map(whole).collect()
}

/// Pixels that their owner does not explain.
pub(super) fn unexplained(xi: &[Grid<f32>], labels: &Grid<u8>, sigma: f64) -> Grid<bool> {
    let mut own = xi[0].clone();
    for (i, o) in own.data_mut().iter_mut().enumerate() {
        *o = xi[usize::from(labels.data()[i])].data()[i];
    }
    let most = UNEXPLAINED.0 * (sigma * sigma) as f32;
    blur(&own, UNEXPLAINED.1).map(|o| o > most)
}

/// What the regions cover in the second frame, from their ξ.
pub(super) fn cover(
    lines: &[Linearisation],
    xi: &[Grid<f32>],
    labels: &Grid<u8>,
    measure: &Measure,
) -> Cover {
    let variance = (measure.sigma * measure.sigma) as f32;
    let landings: Vec<Landing> = lines
        .iter()
        .zip(xi)
        .map(|(line, xi)| Landing {
            target: targets(line, labels.width(), labels.height()),
            chi2: blur(xi, CONFIRMING).map(|x| x / variance),
        })
        .collect();
    Cover::of(labels, &landings)
}

/// Where the pixels of the frame go; not a number outside the window and where they leave the frame.
fn targets(line: &Linearisation, width: usize, height: usize) -> Grid<[f32; 2]> {
    let mut all = Grid::new(width, height, [f32::NAN; 2]);
    for i in 0..line.rows.len() {
        if line.inside.data()[i] {
            let at = line.window.place(i);
            let [u, v] = line.flow.data()[i];
            all[at] = [at.0 as f32 + u, at.1 as f32 + v];
        }
    }
    all
}

/// Hidden pixels cannot speak against their region.
pub(super) fn excuse_hidden(
    xi: &mut [Grid<f32>],
    lines: &[Linearisation],
    cover: &Cover,
    measure: &Measure,
) {
    for (k, (xi, line)) in xi.iter_mut().zip(lines).enumerate() {
        let target = targets(line, xi.width(), xi.height());
        for (xi, &to) in xi.data_mut().iter_mut().zip(target.data()) {
            if cover.hides(k, to) {
                *xi = xi.min(measure.hidden());
            }
        }
    }
}

/// Pixels that are hidden, or out of sight, where their owner says that they go.
pub(super) fn hidden(lines: &[Linearisation], labels: &Grid<u8>, cover: &Cover) -> Grid<bool> {
    let mut hidden = labels.map(|_| false);
    for (k, line) in lines.iter().enumerate() {
        let target = targets(line, labels.width(), labels.height());
        for (i, &to) in target.data().iter().enumerate() {
            if usize::from(labels.data()[i]) == k {
                hidden.data_mut()[i] = to[0].is_nan() || cover.hides(k, to);
            }
        }
    }
    hidden
}

/// Of two curves that move alike, the nearer takes a pixel.
pub(super) fn charge_distance(xi: &mut [Grid<f32>], phi: &[Grid<f32>], measure: &Measure) {
    let Some(first) = phi.first() else {
        return;
    };
    let reach = FAR.1 * first.width() as f32;
    let price = FAR.0 * (measure.sigma * measure.sigma) as f32;
    for i in 0..first.len() {
        let inside = phi.iter().map(|phi| phi.data()[i]);
        let nearest = inside.fold(f32::NEG_INFINITY, f32::max);
        for (xi, phi) in xi[1..].iter_mut().zip(phi) {
            let farther = nearest - phi.data()[i];
            xi.data_mut()[i] += price * (farther / reach).min(1.0);
        }
    }
}
