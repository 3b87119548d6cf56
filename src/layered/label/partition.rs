//! Labels by swaps of two regions at a time along their outline (Boykov, Veksler and Zabih 2001).
//!
//! ```text
//! E = Σx C_l(x)(x)  +  λ Σ_{x,y neighbours} w_xy g_xy [l(x) ≠ l(y)]        w = π/8 straight, π/(8√2) diagonal
//! g_xy = 1 − ε + ε / (1 + (I1(x) − I1(y))² / (κσ)²)
//! ```
//!
//! C in grey levels², λ in grey levels²·px. Over all eight neighbours the second sum is λ times the length of all outlines
//! (Boykov and Kolmogorov 2003) where brightness is even; an outline costs less where brightness steps (Boykov and Jolly
//! 2001), since on an even ground the residuals hardly tell on which side of it a pixel is. For two regions that meet, the
//! least E over all ways to share out their pixels within a band about where they meet is a cheapest cut (`max_flow.rs`),
//! so that no swap raises E. It stops when no pixel changes, or after so many sweeps over all pairs.

use super::max_flow::{Graph, NOWHERE as OUTSIDE, Node, STEPS};
use crate::grid::Grid;

/// w of straight and diagonal neighbours.
const LENGTHS: [f32; 2] = [
    std::f32::consts::PI / 8.0,
    std::f32::consts::FRAC_PI_8 * std::f32::consts::FRAC_1_SQRT_2,
];
/// ε: share of an outline's cost that an edge in brightness spares.
const EDGE: f32 = 0.8;
/// κ: a step in brightness of so many σ spares half of that.
const STEP: f32 = 4.0;

/// What outlines cost.
#[derive(Clone, Copy)]
pub(in crate::layered) struct Outlines<'a> {
    /// λ where brightness is even, grey levels²·px.
    pub lambda: f32,
    /// Brightness of the first frame, grey levels.
    pub brightness: &'a Grid<f32>,
    /// σ of the residuals, grey levels.
    pub sigma: f32,
}

impl Outlines<'_> {
    /// What it costs to part a pixel from the neighbour at a step, grey levels².
    #[inline(always)]
    fn cost(&self, here: usize, there: usize, step: usize) -> f32 {
        let brightness = self.brightness.data();
        let change = (brightness[here] - brightness[there]) / (STEP * self.sigma);
        let edge = 1.0 - EDGE + EDGE / (1.0 + change * change);
        self.lambda * LENGTHS[step / 4] * edge
    }

    /// λ Σ w g over all outlines, grey levels².
    pub fn energy(&self, labels: &Grid<u8>) -> f64 {
        let (width, height, l) = (labels.width(), labels.height(), labels.data());
        let mut sum = 0.0f64;
        for (here, &label) in l.iter().enumerate() {
            let (x, y) = (here % width, here / width);
            // Each pair of neighbours once.
            for (step, &(dx, dy)) in STEPS.iter().enumerate().step_by(2) {
                if let Some(there) = neighbour(x, y, dx, dy, width, height)
                    && l[there] != label
                {
                    sum += f64::from(self.cost(here, there, step));
                }
            }
        }
        sum
    }
}

/// The pixel a step from (x, y), if the frame has it.
#[inline(always)]
fn neighbour(
    x: usize,
    y: usize,
    dx: isize,
    dy: isize,
    width: usize,
    height: usize,
) -> Option<usize> {
    let (x, y) = (x.wrapping_add_signed(dx), y.wrapping_add_signed(dy));
    (x < width && y < height).then(|| y * width + x)
}

/// How far swaps reach.
#[derive(Clone, Copy)]
pub(in crate::layered) struct Reach {
    /// Pixels to each side of an outline that may change region in one swap.
    pub band: usize,
    /// Sweeps over all pairs of regions at most.
    pub sweeps: usize,
}

/// Memory for swaps.
#[derive(Default)]
pub(super) struct Swaps {
    graph: Graph,
    /// Pixels beside an outline, and the region on its other side.
    beside: Vec<(u32, u8)>,
    /// The pixels in the graph.
    pixels: Vec<u32>,
    /// For each pixel of the frame its number in the graph.
    number: Vec<u32>,
}

impl Swaps {
    /// Relabels; `unit`, grey levels², is what costs are about as large as.
    pub fn partition(
        &mut self,
        costs: &[Grid<f32>],
        outlines: &Outlines,
        unit: f32,
        reach: Reach,
        labels: &mut Grid<u8>,
    ) {
        self.number.clear();
        self.number.resize(labels.len(), OUTSIDE);
        let count = costs.len() as u8;
        for _ in 0..reach.sweeps {
            self.find_outlines(labels);
            let mut changed = false;
            for a in 0..count {
                for b in a + 1..count {
                    self.find_band([a, b], reach.band, labels);
                    self.build([a, b], costs, outlines, unit, labels);
                    self.graph.cut();
                    changed |= self.share_out([a, b], labels);
                }
            }
            if !changed {
                break;
            }
        }
    }

    /// Finds all pixels that have another region beside them.
    fn find_outlines(&mut self, labels: &Grid<u8>) {
        let (width, l) = (labels.width(), labels.data());
        self.beside.clear();
        for (here, &label) in l.iter().enumerate() {
            let mut meet = |there: usize| {
                if l[there] != label {
                    self.beside.push((here as u32, l[there]));
                    self.beside.push((there as u32, label));
                }
            };
            if here + width < l.len() {
                meet(here + width);
            }
            if (here + 1) % width != 0 {
                meet(here + 1);
            }
        }
    }

    /// Numbers the pixels of two regions near where they meet.
    fn find_band(&mut self, [a, b]: [u8; 2], band: usize, labels: &Grid<u8>) {
        let (width, height) = (labels.width(), labels.height());
        self.pixels.clear();
        for &(at, other) in &self.beside {
            let own = labels.data()[at as usize];
            if (own, other) != (a, b) && (own, other) != (b, a) {
                continue;
            }
            let (x, y) = (at as usize % width, at as usize / width);
            for y in y.saturating_sub(band)..(y + band + 1).min(height) {
                for x in x.saturating_sub(band)..(x + band + 1).min(width) {
                    let own = labels[(x, y)];
                    let number = &mut self.number[y * width + x];
                    if *number == OUTSIDE && (own == a || own == b) {
                        *number = 0;
                        self.pixels.push((y * width + x) as u32);
                    }
                }
            }
        }
        // Neighbours lie near each other in memory.
        self.pixels.sort_unstable();
        for (n, &i) in self.pixels.iter().enumerate() {
            self.number[i as usize] = n as u32;
        }
    }

    /// The graph of these pixels: what is around them keeps its labels. Costs are counted in `unit`, so that the graph
    /// knows what is rounding.
    fn build(
        &mut self,
        [a, b]: [u8; 2],
        costs: &[Grid<f32>],
        outlines: &Outlines,
        unit: f32,
        labels: &Grid<u8>,
    ) {
        let (width, height) = (labels.width(), labels.height());
        let [of_a, of_b] = [a, b].map(|k| costs[usize::from(k)].data());
        self.graph.nodes.clear();
        for &i in &self.pixels {
            let here = i as usize;
            let (x, y) = (here % width, here / width);
            let mut node = Node {
                terminal: (of_b[here] - of_a[here]) / unit,
                ..Node::default()
            };
            for (step, &(dx, dy)) in STEPS.iter().enumerate() {
                let Some(there) = neighbour(x, y, dx, dy, width, height) else {
                    continue;
                };
                let cost = outlines.cost(here, there, step) / unit;
                let (number, label) = (self.number[there], labels.data()[there]);
                if number != OUTSIDE {
                    node.capacities[step] = cost;
                    node.neighbours[step] = number;
                } else if label == a {
                    node.terminal += cost;
                } else if label == b {
                    node.terminal -= cost;
                }
            }
            self.graph.nodes.push(node);
        }
    }

    /// Labels by the sides of the cut; whether any changes.
    fn share_out(&mut self, [a, b]: [u8; 2], labels: &mut Grid<u8>) -> bool {
        let mut changed = false;
        for (n, &i) in self.pixels.iter().enumerate() {
            self.number[i as usize] = OUTSIDE;
            let label = &mut labels.data_mut()[i as usize];
            let best = if self.graph.is_a(n) { a } else { b };
            changed |= *label != best;
            *label = best;
        }
        changed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From 0 to 1, the same in every run.
    fn noise(x: usize, y: usize, k: usize) -> f32 {
        let mixed = (x * 73_856_093) ^ (y * 19_349_663) ^ (k * 83_492_791);
        (mixed % 1009) as f32 / 1009.0
    }

    fn costs(width: usize, height: usize, count: usize) -> Vec<Grid<f32>> {
        let cost = |x, y, k| noise(x, y, k) * if x % 20 < 7 * k { 1.5 } else { 0.6 };
        (0..count)
            .map(|k| Grid::from_fn(width, height, |x, y| cost(x, y, k)))
            .collect()
    }

    fn energy(costs: &[Grid<f32>], outlines: &Outlines, labels: &Grid<u8>) -> f64 {
        let own = labels.data().iter().enumerate();
        let data: f64 = own
            .map(|(i, &k)| f64::from(costs[usize::from(k)].data()[i]))
            .sum();
        data + outlines.energy(labels)
    }

    fn brightness(width: usize, height: usize) -> Grid<f32> {
        Grid::from_fn(width, height, |x, y| 100.0 * noise(x, y, 9))
    }

    #[test]
    fn no_sweep_raises_the_energy() {
        let (costs, brightness) = (costs(48, 40, 3), brightness(48, 40));
        let outlines = Outlines {
            lambda: 0.5,
            brightness: &brightness,
            sigma: 4.0,
        };
        let mut labels = Grid::from_fn(48, 40, |x, y| ((x / 5 + y / 7) % 3) as u8);
        let mut swaps = Swaps::default();
        let before = energy(&costs, &outlines, &labels);
        let mut last = before;
        for _ in 0..4 {
            let reach = Reach { band: 2, sweeps: 1 };
            swaps.partition(&costs, &outlines, 1.0, reach, &mut labels);
            let now = energy(&costs, &outlines, &labels);
            assert!(now <= last + 1e-3, "{now} after {last}");
            last = now;
        }
        assert!(last < 0.8 * before, "{last} after {before}");
    }

    #[test]
    fn two_regions_get_the_least_energy_of_all_labellings() {
        let (width, height) = (4, 3);
        for draw in 0..60 {
            let costs: Vec<Grid<f32>> = (0..2)
                .map(|k| Grid::from_fn(width, height, |x, y| noise(x, y, 2 * draw + k)))
                .collect();
            let brightness = brightness(width, height);
            let outlines = Outlines {
                lambda: 0.02 * draw as f32,
                brightness: &brightness,
                sigma: 5.0,
            };
            let labelling = |bits: u32| {
                Grid::from_fn(width, height, |x, y| (bits >> (y * width + x) & 1) as u8)
            };
            let least = (0..1 << (width * height))
                .map(|bits| energy(&costs, &outlines, &labelling(bits)))
                .fold(f64::INFINITY, f64::min);
            let mut labels = labelling(0b1010_0110_0011);
            let reach = Reach { band: 4, sweeps: 1 };
            Swaps::default().partition(&costs, &outlines, 1.0, reach, &mut labels);
            let found = energy(&costs, &outlines, &labels);
            assert!((found - least).abs() < 1e-4, "{found} for {least}");
        }
    }

    #[test]
    fn an_outline_costs_its_length_in_every_direction() {
        let brightness = Grid::new(90, 90, 0.0);
        let outlines = Outlines {
            lambda: 2.0,
            brightness: &brightness,
            sigma: 1.0,
        };
        // 1 where a x ≥ b y + c, and how long the line between is.
        let lines = [
            ([1, 0, 45], 90.0),
            ([1, 1, 0], 90.0 * 2f64.sqrt()),
            ([2, 1, 22], 45.0 * 5f64.sqrt()),
        ];
        for ([a, b, c], length) in lines {
            let labels = Grid::from_fn(90, 90, |x, y| u8::from(a * x >= b * y + c));
            let ratio = outlines.energy(&labels) / (2.0 * length);
            assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
        }
    }

    #[test]
    fn outlines_settle_where_brightness_steps() {
        // Costs do not tell columns 16 to 24 apart; brightness does, at 21.
        let cost = |left: bool| {
            move |x: usize, _: usize| {
                let own = if left { x < 16 } else { x > 24 };
                f32::from(u8::from(!own && !(16..=24).contains(&x)))
            }
        };
        let costs = [
            Grid::from_fn(40, 20, cost(true)),
            Grid::from_fn(40, 20, cost(false)),
        ];
        let brightness = Grid::from_fn(40, 20, |x, _| if x < 21 { 50.0 } else { 90.0 });
        let outlines = Outlines {
            lambda: 1.5,
            brightness: &brightness,
            sigma: 2.0,
        };
        let mut labels = Grid::from_fn(40, 20, |x, _| u8::from(x >= 17));
        let reach = Reach { band: 8, sweeps: 1 };
        Swaps::default().partition(&costs, &outlines, 1.0, reach, &mut labels);
        for y in 0..20 {
            for x in 0..40 {
                assert_eq!(labels[(x, y)], u8::from(x >= 21), "({x}, {y})");
            }
        }
    }
}
