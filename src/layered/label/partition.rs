//! Labels by threshold dynamics (Merriman, Bence and Osher 1994; Esedoglu and Otto 2015).
//!
//! ```text
//! E = Σk Σ_{x∈Rk} Ck(x)  +  (β/2) Σk Σx 1k (1 − K ∗ 1k)
//! ```
//!
//! Ck is a region's cost, averaged over 5×5 pixels, K a 9×9 kernel whose Fourier transform is nowhere negative (a
//! box twice). The second sum is the length of all outlines times λ = β · `LENGTH_OF_PULL`, up to the kernel's
//! width. Each sweep gives a pixel to the region with the least Ck − β K ∗ 1k; with such a K no sweep raises E. It stops
//! when no pixel changes, or after [`SWEEPS`].

use crate::grid::Grid;

/// Sweeps at most.
const SWEEPS: usize = 6;
/// Half the side of one of K's two boxes, pixels.
const RADIUS: usize = 2;
/// λ/β, half the mean distance under K: for boxes of 5 pixels, twice.
pub(crate) const LENGTH_OF_PULL: f64 = 0.8;

/// Relabels from costs that are averaged already; which share of pixels changed. `pulls` is memory for one plane a region.
pub(crate) fn partition(
    costs: &[Grid<f32>],
    beta: &Grid<f32>,
    labels: &mut Grid<u8>,
    pulls: &mut [Grid<f32>],
    spare: &mut Grid<f32>,
) -> f64 {
    let before = labels.clone();
    for _ in 0..SWEEPS {
        pull(labels, pulls, spare);
        let mut changed = 0usize;
        for y in 0..labels.height() {
            let row = labels.row_mut(y);
            for (x, label) in row.iter_mut().enumerate() {
                let mut best = (*label, f32::INFINITY);
                for (k, (cost, pull)) in costs.iter().zip(pulls.iter()).enumerate() {
                    let score = cost[(x, y)] - beta[(x, y)] * pull[(x, y)];
                    if score < best.1 {
                        best = (k as u8, score);
                    }
                }
                changed += usize::from(*label != best.0);
                *label = best.0;
            }
        }
        if changed == 0 {
            break;
        }
    }
    let pairs = before.data().iter().zip(labels.data());
    pairs.filter(|(a, b)| a != b).count() as f64 / labels.len() as f64
}

/// K ∗ 1k for every region.
pub(crate) fn pull(labels: &Grid<u8>, pulls: &mut [Grid<f32>], spare: &mut Grid<f32>) {
    for (k, pull) in pulls.iter_mut().enumerate() {
        for (p, &label) in pull.data_mut().iter_mut().zip(labels.data()) {
            *p = f32::from(u8::from(usize::from(label) == k));
        }
        box_blur(pull, RADIUS, spare);
        box_blur(pull, RADIUS, spare);
    }
}

/// (β/2) Σ 1k (1 − K ∗ 1k) over all regions, from the K ∗ 1k.
pub(crate) fn outline_energy(labels: &Grid<u8>, pulls: &[Grid<f32>], beta: f32) -> f64 {
    let outside = |(i, &k): (usize, &u8)| 1.0 - f64::from(pulls[usize::from(k)].data()[i]);
    0.5 * f64::from(beta) * labels.data().iter().enumerate().map(outside).sum::<f64>()
}

/// The mean over (2r+1)² pixels, the border repeated outwards.
pub(crate) fn box_blur(plane: &mut Grid<f32>, radius: usize, spare: &mut Grid<f32>) {
    let (width, height) = (plane.width(), plane.height());
    let share = 1.0 / (2 * radius + 1) as f32;
    for y in 0..height {
        let row = plane.row(y);
        let out = spare.row_mut(y);
        let at = |x: isize| row[x.clamp(0, width as isize - 1) as usize];
        let edge = radius.min(width);
        for x in (0..edge).chain(width.saturating_sub(radius).max(edge)..width) {
            let sum: f32 = (0..=2 * radius)
                .map(|d| at((x + d) as isize - radius as isize))
                .sum();
            out[x] = sum * share;
        }
        if width > 2 * radius {
            let inner = &mut out[radius..width - radius];
            let n = inner.len();
            inner.copy_from_slice(&row[..n]);
            for d in 1..=2 * radius {
                for (o, v) in inner.iter_mut().zip(&row[d..d + n]) {
                    *o += v;
                }
            }
            inner.iter_mut().for_each(|o| *o *= share);
        }
    }
    for y in 0..height {
        let at = |d: usize| (y + d).saturating_sub(radius).min(height - 1);
        let out = plane.row_mut(y);
        out.copy_from_slice(spare.row(at(0)));
        for d in 1..=2 * radius {
            for (o, v) in out.iter_mut().zip(spare.row(at(d))) {
                *o += v;
            }
        }
        out.iter_mut().for_each(|o| *o *= share);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn costs(width: usize, height: usize) -> Vec<Grid<f32>> {
        let noise = |x: usize, y: usize, k: usize| {
            ((x * 12_9898 + y * 78_233 + k * 37_719) % 1009) as f32 / 1009.0
        };
        (0..3)
            .map(|k| {
                Grid::from_fn(width, height, |x, y| {
                    noise(x, y, k) * if x % 20 < 7 * k { 1.5 } else { 0.6 }
                })
            })
            .collect()
    }

    #[test]
    fn no_sweep_raises_the_energy() {
        let costs = costs(48, 40);
        let mut labels = Grid::from_fn(48, 40, |x, y| ((x / 5 + y / 7) % 3) as u8);
        let mut pulls = vec![Grid::new(48, 40, 0.0); 3];
        let mut spare = Grid::new(48, 40, 0.0);
        let mut energy = |labels: &Grid<u8>| {
            pull(labels, &mut pulls, &mut spare);
            let data: f64 = labels
                .data()
                .iter()
                .enumerate()
                .map(|(i, &k)| f64::from(costs[usize::from(k)].data()[i]))
                .sum();
            data + outline_energy(labels, &pulls, 0.7)
        };
        let before = energy(&labels);
        let mut memory = vec![Grid::new(48, 40, 0.0); 3];
        let mut room = Grid::new(48, 40, 0.0);
        partition(
            &costs,
            &Grid::new(48, 40, 0.7),
            &mut labels,
            &mut memory,
            &mut room,
        );
        assert!(energy(&labels) < before);
    }

    #[test]
    fn a_box_is_a_mean() {
        let mut plane = Grid::from_fn(17, 13, |x, y| (x * x + 3 * y) as f32);
        let old = plane.clone();
        box_blur(&mut plane, 2, &mut Grid::new(17, 13, 0.0));
        for (x, y) in [(0, 0), (8, 6), (16, 12), (1, 11)] {
            let mut sum = 0.0;
            for dy in -2isize..=2 {
                for dx in -2isize..=2 {
                    sum += old.clamped(x as isize + dx, y as isize + dy);
                }
            }
            assert!((plane[(x, y)] - sum / 25.0).abs() < 1e-3);
        }
    }
}
