//! Curves that are found rather than drawn.

use super::background::{CARRIED, UNEXPLAINED, background};
use super::epipolar::median;
use super::lattice::Lattice;
use super::segments::segments;
use super::matches::matches;
use super::outline::{Outline, outlines};
use super::pieces::{field, joined};
use super::sample::{Carrier, Sample};
use crate::camera::Camera;
use crate::curves::Shape;
use crate::frames::{FramePair, halved, halved_camera};
use crate::grid::Grid;
use crate::options::MAX_CURVES;

/// Frames of more pixels are halved.
const PIXELS: usize = 352 * 288;
/// A body covers at least this share of the lattice.
const SMALLEST: f64 = 0.008;

/// Fewest matches of a piece of one.
const FEW: usize = 12;
/// Median χ² of what does not follow the background though its flow continues it.
const STRONG: f64 = 25.0;

/// Curves.
pub fn find_curves(pair: &FramePair, camera: &Camera) -> Vec<Shape> {
    let mut camera = *camera;
    let mut frames = [pair.first(), pair.second()].map(|f| f.grey.clone());
    while frames[0].len() > PIXELS {
        frames = frames.map(|f| halved(&f));
        camera = halved_camera(&camera);
    }
    let size = [frames[0].width(), frames[0].height()];
    let frame = [pair.width(), pair.height()];
    let t0 = std::time::Instant::now();
    let samples: Vec<Sample> = matches(&frames[0], &frames[1])
        .into_iter()
        .map(|m| Sample::new(m, &camera))
        .collect();
    let t1 = t0.elapsed();
    let lattice = Lattice::new(&samples, size);
    let everything = vec![true; samples.len()];
    let whole = || segments(&samples, &lattice, &everything);
    let t2 = t0.elapsed();
    let Some((motion, full)) = background(&samples, whole, &camera, size) else {
        return Vec::new();
    };
    let carrier = Carrier::new(&motion, &camera);
    let misfit: Vec<f64> = samples.iter().map(|s| carrier.misfit(s)).collect();
    let wanted: Vec<bool> = misfit.iter().map(|&m| m > UNEXPLAINED).collect();
    let fewest = (SMALLEST * lattice.places() as f64) as usize;
    let mut left = wanted.clone();
    let mut pieces = Vec::new();
    if full {
        let segments = whole();
        let shares = segments.shares(|k| !wanted[k]);
        pieces = segments.members(|s| shares[s] <= CARRIED);
        pieces.retain(|piece| piece.len() >= fewest);
        pieces.iter().flatten().for_each(|&k| left[k] = false);
    }
    let mut others = segments(&samples, &lattice, &left).members(|_| true);
    if full {
        others.retain(|piece| {
            median(piece.iter().map(|&k| misfit[k]).collect()) > STRONG
        });
    }
    pieces.extend(others);
    pieces.retain(|piece| piece.len() >= FEW);
    let mut found = joined(pieces, &samples, &lattice, &camera);
    found.retain(|piece| piece.len() >= fewest);
    let mut curves: Vec<Outline> = found
        .iter()
        .filter_map(|body| {
            let field = field(body, &samples, &lattice);
            let each = outlines(&field, size, frame).into_iter();
            each.max_by(|a, b| a.share.total_cmp(&b.share))
        })
        .collect();
    let t3 = t0.elapsed();
    if std::env::var("DUMP").is_ok() {
        eprintln!("times {t1:?} {t2:?} {t3:?} matches {} unexplained {} groups {:?}", samples.len(), wanted.iter().filter(|w| **w).count(), found.iter().map(Vec::len).collect::<Vec<_>>());
        dump(&frames[0], &samples, &misfit, &found, &curves, frame);
    }
    curves.sort_by(|a, b| b.share.total_cmp(&a.share));
    curves.truncate(MAX_CURVES);
    let polygon = |outline: Outline| Shape::Polygon {
        points: outline.corners,
    };
    curves.into_iter().map(polygon).collect()
}

fn dump(frame: &Grid<f32>, samples: &[Sample], misfit: &[f64], found: &[Vec<usize>], curves: &[Outline], full: [usize; 2]) {
    const S: usize = 3;
    let (w, h) = (frame.width(), frame.height());
    let mut out = Grid::from_fn(w * S, h * S, |x, y| {
        let g = (frame[(x / S, y / S)] * 0.6) as u8;
        [g, g, g]
    });
    let mut dot = |x: f32, y: f32, r: i32, c: [u8; 3]| {
        let (x, y) = ((x * S as f32) as i32 + 1, (y * S as f32) as i32 + 1);
        for b in -r..=r {
            for a in -r..=r {
                let (x, y) = (x + a, y + b);
                if x >= 0 && y >= 0 && x < (w * S) as i32 && y < (h * S) as i32 {
                    out[(x as usize, y as usize)] = c;
                }
            }
        }
    };
    let mut which = vec![usize::MAX; samples.len()];
    for (g, group) in found.iter().enumerate() {
        for &k in group {
            which[k] = g;
        }
    }
    let palette = [[255, 60, 60], [60, 255, 60], [80, 120, 255], [255, 255, 0], [255, 0, 255], [0, 255, 255], [255, 160, 0]];
    for (k, s) in samples.iter().enumerate() {
        let c = if which[k] != usize::MAX { palette[which[k] % 7] } else if misfit[k] > UNEXPLAINED { [255, 255, 255] } else { [0, 90, 0] };
        let [x, y] = s.matched.at;
        dot(x, y, 1, c);
        let d = s.displacement();
        for t in 1..12 {
            let t = t as f32 / 12.0;
            dot(x + d.x as f32 * t, y + d.y as f32 * t, 0, c);
        }
    }
    for o in curves {
        let n = o.corners.len();
        for k in 0..n {
            let (a, b) = (o.corners[k], o.corners[(k + 1) % n]);
            for t in 0..200 {
                let t = t as f64 / 200.0;
                let f = w as f64 / full[0] as f64;
                dot(((a[0] + t * (b[0] - a[0])) * f) as f32, ((a[1] + t * (b[1] - a[1])) * f) as f32, 0, [255, 255, 255]);
            }
        }
    }
    let mut bytes = format!("P6 {} {} 255\n", w * S, h * S).into_bytes();
    out.data().iter().for_each(|c| bytes.extend(c));
    std::fs::write(std::env::var("DUMP").unwrap(), bytes).unwrap();
}
