//! The lattice on which patches lie, and what it is to be a region there: pooled, wide, connected.
//!
//! A patch alone says little, and where two motions meet it shows both. So what patches say is pooled
//! over neighbours with a Gaussian, and a region counts only if it has room for a disc that no other
//! region reaches into: narrower things cannot be told from the seam between two motions. Lengths are in
//! places of the lattice, and grow with the number of patches: they are shares of the frame.

use super::patches::Patch;
use crate::grid::Grid;

/// σ of the pooling, where the frame has [`USUAL`] patches.
const POOL: f64 = 1.0;
/// Least radius of that disc, where the frame has [`USUAL`] patches: a hundredth of the frame, and half
/// as much again.
const DISC: f64 = 2.3;
/// A number of patches.
const USUAL: f64 = 1064.0;
/// A patch nearer than this to another region may show both.
const SEAM: f32 = 1.2;
/// Farther than anything on a lattice.
const FAR: f32 = 1e6;

/// Where each patch is.
#[derive(Clone)]
pub(super) struct Lattice {
    /// Column and row of each patch.
    pub places: Vec<(usize, usize)>,
    /// The patch at a place, if there is one.
    pub patch: Grid<Option<usize>>,
    /// Columns and rows, as pixels of the scale that patches were matched at.
    pub pixels: [Vec<f32>; 2],
}

impl Lattice {
    /// Finds the columns and rows on which patches lie.
    pub fn new(patches: &[Patch]) -> Self {
        let pixels = [
            distinct(patches.iter().map(|p| p.x)),
            distinct(patches.iter().map(|p| p.y)),
        ];
        let place = |p: &Patch| {
            (
                pixels[0].partition_point(|x| *x < p.x),
                pixels[1].partition_point(|y| *y < p.y),
            )
        };
        let places: Vec<_> = patches.iter().map(place).collect();
        let mut patch = Grid::new(pixels[0].len(), pixels[1].len(), None);
        for (i, &at) in places.iter().enumerate() {
            patch[at] = Some(i);
        }
        Self {
            places,
            patch,
            pixels,
        }
    }

    /// How much longer a share of the frame is here than with the usual number of patches.
    pub fn grain(&self) -> f64 {
        (self.places.len() as f64 / USUAL).sqrt()
    }

    /// The patches up to `reach` places from a column and row, both ways.
    pub fn window(&self, (x, y): (usize, usize), reach: usize) -> Vec<usize> {
        let (right, bottom) = (self.patch.width() - 1, self.patch.height() - 1);
        let rows = y.saturating_sub(reach)..=(y + reach).min(bottom);
        rows.flat_map(|row| &self.patch.row(row)[x.saturating_sub(reach)..=(x + reach).min(right)])
            .copied()
            .flatten()
            .collect()
    }

    /// Each patch's mean of `values` over its neighbours.
    pub fn pooled(&self, values: &[f64]) -> Vec<f64> {
        let sigma = POOL * self.grain();
        let reach = (2.0 * sigma).ceil() as usize;
        let kernel: Vec<f64> = (0..=reach)
            .map(|i| (-0.5 * (i as f64 / sigma).powi(2)).exp())
            .collect();
        let (width, height) = (self.patch.width(), self.patch.height());
        let mut field = Grid::new(width, height, [0.0; 2]);
        for (&at, &value) in self.places.iter().zip(values) {
            field[at] = [value, 1.0];
        }
        let sum = |at: usize, end: usize, value: &dyn Fn(usize) -> [f64; 2]| {
            let mut sum = [0.0; 2];
            for q in at.saturating_sub(reach)..=(at + reach).min(end - 1) {
                let [v, n] = value(q);
                let k = kernel[q.abs_diff(at)];
                sum[0] += k * v;
                sum[1] += k * n;
            }
            sum
        };
        let across = Grid::from_fn(width, height, |x, y| sum(x, width, &|q| field[(q, y)]));
        let down = |&(x, y): &(usize, usize)| {
            let [value, count] = sum(y, height, &|q| across[(x, q)]);
            value / count
        };
        self.places.iter().map(down).collect()
    }

    /// The connected parts of the patches that `owner` gives to `region`.
    pub fn parts(&self, owner: &[Option<usize>], region: usize) -> Vec<Vec<usize>> {
        let mut seen = vec![false; owner.len()];
        let mut parts = Vec::new();
        for start in 0..owner.len() {
            if owner[start] != Some(region) || seen[start] {
                continue;
            }
            seen[start] = true;
            let mut part = vec![start];
            let mut next = 0;
            while next < part.len() {
                for j in self.beside(part[next]) {
                    if owner[j] == Some(region) && !seen[j] {
                        seen[j] = true;
                        part.push(j);
                    }
                }
                next += 1;
            }
            parts.push(part);
        }
        parts
    }

    /// The patches left and right of, above and below a patch.
    pub fn beside(&self, i: usize) -> impl Iterator<Item = usize> {
        let (x, y) = self.places[i];
        [(-1, 0), (1, 0), (0, -1), (0, 1)]
            .into_iter()
            .filter_map(move |(dx, dy)| {
                let at = (x.checked_add_signed(dx)?, y.checked_add_signed(dy)?);
                (at.0 < self.patch.width() && at.1 < self.patch.height())
                    .then(|| self.patch[at])
                    .flatten()
            })
    }

    /// How many places of the rim belong to each of `regions`.
    pub fn on_rim(&self, owner: &[Option<usize>], regions: usize) -> Vec<usize> {
        let (right, bottom) = (self.patch.width() - 1, self.patch.height() - 1);
        let mut count = vec![0; regions];
        for (&(x, y), owner) in self.places.iter().zip(owner) {
            let rim = [x == 0, y == 0, x == right, y == bottom];
            if let Some(k) = *owner {
                count[k] += rim.into_iter().filter(|r| *r).count();
            }
        }
        count
    }

    /// Whether some of `patches` are far enough from all others to be a region.
    pub fn wide(&self, patches: &[usize]) -> bool {
        let inset = self.inset(patches);
        let widest = patches.iter().map(|&i| inset[self.places[i]]);
        f64::from(widest.fold(0.0, f32::max)) >= DISC * self.grain()
    }

    /// Those of `patches` that show nothing but their region; all, when those are too few.
    pub fn core(&self, patches: &[usize]) -> Vec<usize> {
        let inset = self.inset(patches);
        let core: Vec<usize> = patches
            .iter()
            .copied()
            .filter(|&i| inset[self.places[i]] > SEAM)
            .collect();
        if core.len() < 6 {
            return patches.to_vec();
        }
        core
    }

    /// Distance from each place to the nearest that is none of `patches`, in steps of 1 and √2; a
    /// region goes on beyond the frame.
    fn inset(&self, patches: &[usize]) -> Grid<f32> {
        let (width, height) = (self.patch.width(), self.patch.height());
        let mut inset = Grid::new(width, height, 0.0f32);
        for &i in patches {
            inset[self.places[i]] = FAR;
        }
        let read = |inset: &Grid<f32>, x: isize, y: isize| {
            let within = x >= 0 && y >= 0 && x < width as isize && y < height as isize;
            if within {
                inset[(x as usize, y as usize)]
            } else {
                FAR
            }
        };
        for forwards in [true, false] {
            let s: isize = if forwards { -1 } else { 1 };
            for n in 0..width * height {
                let n = if forwards { n } else { width * height - 1 - n };
                let (x, y) = ((n % width) as isize, (n / width) as isize);
                let straight = read(&inset, x + s, y).min(read(&inset, x, y + s)) + 1.0;
                let across = read(&inset, x + s, y + s).min(read(&inset, x - s, y + s));
                let least = straight.min(across + std::f32::consts::SQRT_2);
                let here = &mut inset.data_mut()[n];
                *here = here.min(least);
            }
        }
        inset
    }
}

fn distinct(values: impl Iterator<Item = f32>) -> Vec<f32> {
    let mut values: Vec<f32> = values.collect();
    values.sort_by(f32::total_cmp);
    values.dedup();
    values
}
