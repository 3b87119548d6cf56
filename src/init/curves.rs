//! Curves that are found rather than drawn.

use super::background::{CARRIED, UNEXPLAINED, background};
use super::lattice::{Lattice, place};
use super::segments::segments;
use super::matches::matches;
use super::outline::{Outline, outlines};
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
    let segments = if full {
        whole()
    } else {
        segments(&samples, &lattice, &wanted)
    };
    let fewest = SMALLEST * lattice.places() as f64;
    let shares = segments.shares(|k| !wanted[k]);
    let found: Vec<Vec<usize>> = (0..segments.count)
        .filter(|&s| shares[s] <= CARRIED)
        .map(|s| (0..samples.len()).filter(|&k| segments.of[k] == Some(s)).collect::<Vec<_>>())
        .filter(|g| g.len() as f64 >= fewest)
        .collect();
    if std::env::var("DUMP").is_ok() {
        for s in 0..segments.count.min(12) {
            let n = segments.of.iter().filter(|o| **o == Some(s)).count();
            eprintln!("segment {s}: {n} share {:.2}", shares[s]);
        }
    }
    let mut curves: Vec<Outline> = found
        .iter()
        .flat_map(|group| {
            let field = field(&samples, &lattice, group);
            outlines(&field, size, frame)
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

/// Above 0 where most matches around are of the group.
fn field(samples: &[Sample], lattice: &Lattice, group: &[usize]) -> Grid<f32> {
    let (across, down) = (lattice.size()[0], lattice.size()[1]);
    let mut sums = Grid::new(across, down, [0.0f32; 2]);
    let mut member = vec![false; samples.len()];
    group.iter().for_each(|&k| member[k] = true);
    for (k, sample) in samples.iter().enumerate() {
        let (i, j) = place(sample);
        let sign = if member[k] { 1.0 } else { -1.0 };
        for b in -2isize..=2 {
            for a in -2isize..=2 {
                let (x, y) = (i as isize + a, j as isize + b);
                if x >= 0 && y >= 0 && x < across as isize && y < down as isize {
                    let w = (-0.7 * (a * a + b * b) as f32).exp();
                    let cell = &mut sums[(x as usize, y as usize)];
                    cell[0] += w * sign;
                    cell[1] += w;
                }
            }
        }
    }
    sums.map(|[sum, weight]| if weight > 0.0 { sum / weight } else { -1.0 })
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
