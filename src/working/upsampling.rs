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
use crate::interpretation::{Flow, Interpretation, Pixel};
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

/// What was found on a frame of colours `small`, to be told on `large`, which has `ratio` ≥ 1 times as many pixels both ways.
/// Flow is in pixels of `large`.
pub(crate) struct Upsampling<'a> {
    found: &'a Interpretation,
    small: &'a Grid<[u8; 3]>,
    large: &'a Grid<[u8; 3]>,
    ratio: f32,
    rho: Grid<f32>,
    near_edge: Grid<u8>,
    weights: Weights,
}

impl<'a> Upsampling<'a> {
    pub fn new(
        found: &'a Interpretation,
        small: &'a Grid<[u8; 3]>,
        large: &'a Grid<[u8; 3]>,
        ratio: f32,
    ) -> Self {
        let rho = found.depth.map(f32::recip);
        Self {
            found,
            small,
            large,
            ratio,
            near_edge: near_edges(found, &rho),
            rho,
            weights: Weights::new(),
        }
    }

    /// All of it, as `camera` sees the larger frame.
    pub fn whole(&self, camera: Camera) -> Interpretation {
        let (width, height) = (self.large.width(), self.large.height());
        let planes = self.planes();
        let mut out = [(); 4].map(|()| Grid::new(width, height, 0.0f32));
        let mut labels = Grid::new(width, height, 0u8);
        let mut occluded = Grid::new(width, height, 0u8);
        let columns = self.columns();
        // Rows of the shrunk frame between which row y lies, mixed.
        let mut mixed = [(); 4].map(|()| vec![0.0f32; self.small.width()]);
        for y in 0..height {
            let down = self.row(y);
            for (mixed, plane) in mixed.iter_mut().zip(planes) {
                let rows = plane.row(down.first).iter().zip(plane.row(down.second));
                for (m, (&a, &b)) in mixed.iter_mut().zip(rows) {
                    *m = down.between(a, b);
                }
            }
            let edges = [down.first, down.second].map(|y| self.near_edge.row(y));
            let nearest = down.nearest();
            for (x, across) in columns.iter().enumerate() {
                let (a, b) = (across.first, across.second);
                let plain = edges.iter().all(|row| row[a] == 0 && row[b] == 0);
                if plain {
                    labels[(x, y)] = self.found.labels[(a, nearest)];
                    occluded[(x, y)] = self.found.occluded[(a, nearest)];
                    for (out, mixed) in out.iter_mut().zip(&mixed) {
                        out[(x, y)] = across.between(mixed[a], mixed[b]);
                    }
                } else {
                    let vote = self.vote(self.large[(x, y)], across, &down);
                    labels[(x, y)] = vote.label;
                    occluded[(x, y)] = u8::from(vote.occluded);
                    for (out, value) in out.iter_mut().zip(vote.values) {
                        out[(x, y)] = value;
                    }
                }
            }
        }
        let [mut depth, mut u, mut v, confidence] = out;
        depth.data_mut().iter_mut().for_each(|z| *z = z.recip());
        for flow in [&mut u, &mut v] {
            flow.data_mut().iter_mut().for_each(|w| *w *= self.ratio);
        }
        Interpretation {
            camera,
            labels,
            depth,
            flow: Flow { u, v },
            confidence,
            occluded,
            motions: self.found.motions.clone(),
        }
    }

    /// The labels alone.
    pub fn labels(&self) -> Grid<u8> {
        let (width, height) = (self.large.width(), self.large.height());
        let mut labels = Grid::new(width, height, 0u8);
        let columns = self.columns();
        for y in 0..height {
            let down = self.row(y);
            let edges = [down.first, down.second].map(|y| self.near_edge.row(y));
            let nearest = self.found.labels.row(down.nearest());
            for (x, across) in columns.iter().enumerate() {
                let (a, b) = (across.first, across.second);
                labels[(x, y)] = if edges.iter().all(|row| row[a] == 0 && row[b] == 0) {
                    nearest[a]
                } else {
                    self.neighbours(self.large[(x, y)], across, &down).label
                };
            }
        }
        labels
    }

    /// The same of a single pixel.
    pub fn pixel(&self, (x, y): (usize, usize)) -> Pixel {
        let (across, down) = (Between::of(x, self.ratio, self.small.width()), self.row(y));
        let (a, b) = (across.first, across.second);
        let plain = [down.first, down.second]
            .iter()
            .all(|&y| self.near_edge[(a, y)] == 0 && self.near_edge[(b, y)] == 0);
        let vote = if plain {
            let nearest = (a, down.nearest());
            let mixed = |plane: &Grid<f32>, x| {
                down.between(plane[(x, down.first)], plane[(x, down.second)])
            };
            Vote {
                label: self.found.labels[nearest],
                occluded: self.found.occluded[nearest] != 0,
                values: self
                    .planes()
                    .map(|plane| across.between(mixed(plane, a), mixed(plane, b))),
            }
        } else {
            self.vote(self.large[(x, y)], &across, &down)
        };
        let [rho, u, v, confidence] = vote.values;
        Pixel {
            label: vote.label,
            depth: rho.recip(),
            u: u * self.ratio,
            v: v * self.ratio,
            confidence,
            occluded: vote.occluded,
        }
    }

    /// What is mixed: inverse depth, u, v, confidence.
    fn planes(&self) -> [&Grid<f32>; 4] {
        let Flow { u, v } = &self.found.flow;
        [&self.rho, u, v, &self.found.confidence]
    }

    fn columns(&self) -> Vec<Between> {
        (0..self.large.width())
            .map(|x| Between::of(x, self.ratio, self.small.width()))
            .collect()
    }

    fn row(&self, y: usize) -> Between {
        Between::of(y, self.ratio, self.small.height())
    }
}

/// Where a pixel of the larger frame lies in the shrunk one, along one axis.
struct Between {
    first: usize,
    second: usize,
    /// How far it is from the first to the second, 0–1.
    fraction: f32,
    /// Weights by distance of the [`REACH`] pixels on each side of the nearest one.
    near: [f32; 2 * REACH as usize + 1],
}

impl Between {
    fn of(x: usize, ratio: f32, count: usize) -> Self {
        let last = (count - 1) as f32;
        let at = ((x as f32 + 0.5) / ratio - 0.5).clamp(0.0, last);
        let first = at as usize;
        let mut between = Self {
            first,
            second: (first + 1).min(count - 1),
            fraction: at - first as f32,
            near: [0.0; 2 * REACH as usize + 1],
        };
        let (nearest, at) = (between.nearest() as isize, first as f32 + between.fraction);
        for (weight, step) in between.near.iter_mut().zip(-REACH..) {
            let d = (nearest + step) as f32 - at;
            *weight = (-d * d / (2.0 * SIGMA_SPACE * SIGMA_SPACE)).exp();
        }
        between
    }

    fn nearest(&self) -> usize {
        if self.fraction < 0.5 {
            self.first
        } else {
            self.second
        }
    }

    /// The value there, of those of the first and of the second.
    fn between(&self, a: f32, b: f32) -> f32 {
        a + self.fraction * (b - a)
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

    /// The weight of a pixel of one colour for another's.
    fn of(&self, own: [u8; 3], other: [u8; 3]) -> f32 {
        let mut squares = 0;
        for (a, b) in own.into_iter().zip(other) {
            let d = i32::from(a) - i32::from(b);
            squares += d * d;
        }
        let step = (squares as f32 / 3.0 / STEP_COLOUR) as usize;
        self.colour[step.min(self.colour.len() - 1)]
    }
}

/// The pixels of the shrunk frame around a place, and the label that most of them say.
struct Neighbours {
    near: [((usize, usize), f32, u8); 25],
    count: usize,
    label: u8,
}

impl Upsampling<'_> {
    fn neighbours(&self, own: [u8; 3], across: &Between, down: &Between) -> Neighbours {
        let centre = (across.nearest() as isize, down.nearest() as isize);
        let (width, height) = (self.small.width() as isize, self.small.height() as isize);
        let mut near = [((0usize, 0usize), 0.0f32, 0u8); 25];
        let mut count = 0;
        let mut sums = [0.0f32; REGIONS];
        for (dy, wy) in (-REACH..=REACH).zip(down.near) {
            let y = centre.1 + dy;
            if y < 0 || y >= height {
                continue;
            }
            for (dx, wx) in (-REACH..=REACH).zip(across.near) {
                let x = centre.0 + dx;
                if x < 0 || x >= width {
                    continue;
                }
                let q = (x as usize, y as usize);
                let weight = wy * wx * self.weights.of(own, self.small[q]);
                let label = self.found.labels[q];
                sums[usize::from(label)] += weight;
                near[count] = (q, weight, label);
                count += 1;
            }
        }
        let mut label = 0;
        for (k, sum) in sums.iter().enumerate() {
            if *sum >= sums[label] {
                label = k;
            }
        }
        Neighbours {
            near,
            count,
            label: label as u8,
        }
    }

    fn vote(&self, own: [u8; 3], across: &Between, down: &Between) -> Vote {
        let Neighbours { near, count, label } = self.neighbours(own, across, down);
        let own = || near[..count].iter().filter(|(.., l)| *l == label);
        let best = own().max_by(|a, b| a.1.total_cmp(&b.1));
        let level = best.map_or(1.0, |(q, ..)| self.rho[*q]);
        let planes = self.planes();
        let (mut total, mut values, mut hidden) = (0.0, [0.0; 4], 0.0);
        for &(q, weight, _) in own() {
            if (self.rho[q] - level).abs() <= STEP * level {
                for (sum, plane) in values.iter_mut().zip(planes) {
                    *sum += weight * plane[q];
                }
                hidden += weight * f32::from(self.found.occluded[q]);
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
