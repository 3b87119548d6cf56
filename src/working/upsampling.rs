//! What was found on shrunk frames, at a larger size: joint bilateral upsampling (Kopf et al. 2007).
//!
//! ```text
//! L(p) = argmax_k Σ_{q: L(q) = k} w_pq        w_pq = exp(−‖p − q‖² / 2σs²) · exp(−‖c(p) − c(q)‖² / 2σc²)
//! ```
//!
//! p a pixel of the larger frame and c(p) its colour, q the 5×5 pixels of the shrunk frame around it and c(q) theirs. So an
//! outline goes where the larger frame changes colour. Inverse depth, flow and confidence are the same weighted means
//! over the q that share p's label and, if depth has steps, the inverse depth of the best of them. Where no
//! outline and no step is near they are bilinear.

use crate::camera::Camera;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::options::MAX_CURVES;

/// σs, pixels of the shrunk frame.
const SIGMA_SPACE: f32 = 1.2;
/// σc, grey levels of each channel.
const SIGMA_COLOUR: f32 = 12.0;
/// Pixels of the shrunk frame that are looked at on each side.
const REACH: isize = 2;
/// Inverse depths of neighbours that differ by more than this share are a step.
const STEP: f32 = 0.1;
/// Regions at most.
const REGIONS: usize = MAX_CURVES + 1;

/// `found` on a frame of colours `small`, at the size of `large`, which has `ratio` ≥ 1 times as many pixels both ways and
/// is seen by `camera`. Flow is in pixels of `large`.
pub(crate) fn upsampled(
    found: &Interpretation,
    small: &Grid<[u8; 3]>,
    large: &Grid<[u8; 3]>,
    ratio: f32,
    camera: Camera,
) -> Interpretation {
    let (width, height) = (large.width(), large.height());
    let rho = found.depth.map(f32::recip);
    let near_edge = near_edges(found, &rho);
    let planes = [&rho, &found.flow.u, &found.flow.v, &found.confidence];
    let weights = Weights::new();
    let mut out = [(); 4].map(|()| Grid::new(width, height, 0.0f32));
    let mut labels = Grid::new(width, height, 0u8);
    let mut occluded = Grid::new(width, height, 0u8);
    let columns: Vec<Between> = (0..width)
        .map(|x| Between::of(x, ratio, small.width()))
        .collect();
    // Rows of the shrunk frame between which row y lies, mixed.
    let mut mixed = [(); 4].map(|()| vec![0.0f32; small.width()]);
    for y in 0..height {
        let down = Between::of(y, ratio, small.height());
        for (mixed, plane) in mixed.iter_mut().zip(planes) {
            let rows = plane.row(down.first).iter().zip(plane.row(down.second));
            for (m, (&a, &b)) in mixed.iter_mut().zip(rows) {
                *m = a + down.fraction * (b - a);
            }
        }
        let edges = [down.first, down.second].map(|y| near_edge.row(y));
        let nearest = down.nearest();
        for (x, across) in columns.iter().enumerate() {
            let (a, b) = (across.first, across.second);
            let plain = edges.iter().all(|row| row[a] == 0 && row[b] == 0);
            let values = if plain {
                labels[(x, y)] = found.labels[(a, nearest)];
                occluded[(x, y)] = found.occluded[(a, nearest)];
                [0, 1, 2, 3].map(|i| mixed[i][a] + across.fraction * (mixed[i][b] - mixed[i][a]))
            } else {
                let vote = weights.vote(found, &rho, small, large[(x, y)], *across, down);
                labels[(x, y)] = vote.label;
                occluded[(x, y)] = u8::from(vote.occluded);
                vote.values
            };
            for (out, value) in out.iter_mut().zip(values) {
                out[(x, y)] = value;
            }
        }
    }
    let [mut depth, mut u, mut v, confidence] = out;
    depth.data_mut().iter_mut().for_each(|z| *z = z.recip());
    for flow in [&mut u, &mut v] {
        flow.data_mut().iter_mut().for_each(|w| *w *= ratio);
    }
    Interpretation {
        camera,
        labels,
        depth,
        flow: Flow { u, v },
        confidence,
        occluded,
        motions: found.motions.clone(),
    }
}

/// Where a pixel of the larger frame lies in the shrunk one, along one axis.
#[derive(Clone, Copy)]
struct Between {
    first: usize,
    second: usize,
    /// How far it is from the first to the second, 0–1.
    fraction: f32,
}

impl Between {
    fn of(x: usize, ratio: f32, count: usize) -> Self {
        let last = (count - 1) as f32;
        let at = ((x as f32 + 0.5) / ratio - 0.5).clamp(0.0, last);
        let first = at as usize;
        Self {
            first,
            second: (first + 1).min(count - 1),
            fraction: at - first as f32,
        }
    }

    fn nearest(self) -> usize {
        if self.fraction < 0.5 {
            self.first
        } else {
            self.second
        }
    }
}

/// 1 within reach of an outline, a step of depth or the border of what is hidden.
fn near_edges(found: &Interpretation, rho: &Grid<f32>) -> Grid<u8> {
    let (width, height) = (rho.width(), rho.height());
    let mut edge = Grid::new(width, height, 0u8);
    let mut mark = |a: (usize, usize), b: (usize, usize)| {
        let step = (rho[a] - rho[b]).abs() > STEP * rho[a].max(rho[b]);
        let differ = found.labels[a] != found.labels[b] || found.occluded[a] != found.occluded[b];
        if step || differ {
            edge[a] = 1;
            edge[b] = 1;
        }
    };
    for y in 0..height {
        for x in 0..width {
            if x + 1 < width {
                mark((x, y), (x + 1, y));
            }
            if y + 1 < height {
                mark((x, y), (x, y + 1));
            }
        }
    }
    // Two pixels around, one axis after the other.
    let reach = REACH as usize;
    let across = Grid::from_fn(width, height, |x, y| {
        let row = &edge.row(y)[x.saturating_sub(reach)..(x + reach + 1).min(width)];
        u8::from(row.contains(&1))
    });
    Grid::from_fn(width, height, |x, y| {
        let rows = y.saturating_sub(reach)..(y + reach + 1).min(height);
        u8::from(rows.into_iter().any(|y| across[(x, y)] != 0))
    })
}

/// What a pixel near an edge gets.
struct Vote {
    label: u8,
    occluded: bool,
    /// Inverse depth, u, v, confidence.
    values: [f32; 4],
}

struct Weights {
    /// By squared difference of colours, in steps of [`STEP_COLOUR`].
    colour: Vec<f32>,
}

/// Steps of squared difference, grey levels².
const STEP_COLOUR: f32 = 8.0;

impl Weights {
    fn new() -> Self {
        let of = |i: usize| (-(i as f32) * STEP_COLOUR / (2.0 * SIGMA_COLOUR * SIGMA_COLOUR)).exp();
        // Never 0: where no colour is alike, nearness decides.
        let colour = (0..512).map(|i| of(i).max(1e-6)).collect();
        Self { colour }
    }

    fn vote(
        &self,
        found: &Interpretation,
        rho: &Grid<f32>,
        small: &Grid<[u8; 3]>,
        own: [u8; 3],
        across: Between,
        down: Between,
    ) -> Vote {
        let centre = (across.nearest() as isize, down.nearest() as isize);
        let at = (
            across.first as f32 + across.fraction,
            down.first as f32 + down.fraction,
        );
        let (width, height) = (small.width() as isize, small.height() as isize);
        let gauss = |d: f32| (-d * d / (2.0 * SIGMA_SPACE * SIGMA_SPACE)).exp();
        let mut near = [((0usize, 0usize), 0.0f32, 0u8); 25];
        let mut count = 0;
        let mut sums = [0.0f32; REGIONS];
        for dy in -REACH..=REACH {
            let y = centre.1 + dy;
            if y < 0 || y >= height {
                continue;
            }
            let wy = gauss(y as f32 - at.1);
            for dx in -REACH..=REACH {
                let x = centre.0 + dx;
                if x < 0 || x >= width {
                    continue;
                }
                let q = (x as usize, y as usize);
                let squares = own.iter().zip(small[q]).map(|(&a, b)| {
                    let d = i32::from(a) - i32::from(b);
                    d * d
                });
                let squared = squares.sum::<i32>() as f32 / 3.0;
                let step = ((squared / STEP_COLOUR) as usize).min(self.colour.len() - 1);
                let weight = wy * gauss(x as f32 - at.0) * self.colour[step];
                let label = found.labels[q];
                sums[usize::from(label)] += weight;
                near[count] = (q, weight, label);
                count += 1;
            }
        }
        let near = &near[..count];
        let most = |a: &usize, b: &usize| sums[*a].total_cmp(&sums[*b]);
        let label = (0..REGIONS).max_by(most).unwrap_or(0) as u8;
        let own = || near.iter().filter(|(.., l)| *l == label);
        let best = own().max_by(|a, b| a.1.total_cmp(&b.1));
        let level = best.map_or(1.0, |(q, ..)| rho[*q]);
        let (mut total, mut values, mut hidden) = (0.0, [0.0; 4], 0.0);
        for &(q, weight, _) in own() {
            if (rho[q] - level).abs() <= STEP * level {
                let all = [
                    rho[q],
                    found.flow.u[q],
                    found.flow.v[q],
                    found.confidence[q],
                ];
                for (sum, value) in values.iter_mut().zip(all) {
                    *sum += weight * value;
                }
                hidden += weight * f32::from(found.occluded[q]);
                total += weight;
            }
        }
        Vote {
            label,
            occluded: hidden > 0.5 * total,
            values: values.map(|sum| sum / total),
        }
    }
}
