//! Whole-pixel displacements of 8×8 blocks by their sum of absolute differences (SAD), coarse to fine.
//!
//! ```text
//! SAD(x, d) = Σ_{r in 8×8} min( |A(x + r) − B(x + d + r)|, 50 )
//! ```
//!
//! Grey levels, frames less their local mean. A point every 4 pixels. On the coarsest level, some 40 pixels wide, every
//! displacement within 20 % of the width and height is tried; on each finer one those of the nine nearest coarse points,
//! then the neighbours' in two sweeps over the frame, each with its eight neighbours, at most two steps.

use crate::grid::Grid;

/// Pixels between points.
pub const SPACING: usize = 4;
/// Largest displacement, as a share of the frame's width and height.
const REACH: f32 = 0.2;
/// Side of a block in pixels; a frame is continued by as many on all sides, since blocks stick out.
const BLOCK: usize = 8;
/// Steps of a grey level, so that 16-bit whole numbers do.
const STEPS: f32 = 8.0;
/// A difference above this many steps counts as this many.
const CLIP: i16 = 400;
/// The cost of a block that lies outside the other frame.
const OUTSIDE: i32 = 1 << 20;

/// A picture in whole steps, continued outwards.
pub struct Blocks {
    width: usize,
    height: usize,
    stride: usize,
    steps: Vec<i16>,
}

impl Blocks {
    /// From a picture in grey levels between -255 and 255.
    pub fn new(picture: &Grid<f32>) -> Self {
        let (width, height) = (picture.width(), picture.height());
        let stride = width + 2 * BLOCK;
        let mut steps = Vec::with_capacity(stride * (height + 2 * BLOCK));
        for y in 0..height + 2 * BLOCK {
            let row = picture.row(y.saturating_sub(BLOCK).min(height - 1));
            let step = |v: f32| (v * STEPS) as i16;
            steps.extend(std::iter::repeat_n(step(row[0]), BLOCK));
            steps.extend(row.iter().map(|&v| step(v)));
            steps.extend(std::iter::repeat_n(step(row[width - 1]), BLOCK));
        }
        Self {
            width,
            height,
            stride,
            steps,
        }
    }

    /// Where the block around pixel (x, y) begins. A block may stick out by half of it.
    fn offset(&self, x: i32, y: i32) -> usize {
        let first = BLOCK as i32 / 2;
        (y + first) as usize * self.stride + (x + first) as usize
    }

    fn sad(&self, other: &Self, [x, y]: [i32; 2], [dx, dy]: [i32; 2]) -> i32 {
        let (tx, ty) = (x + dx, y + dy);
        let (right, bottom) = (other.width as i32 + 2, other.height as i32 + 2);
        if tx < -2 || ty < -2 || tx >= right || ty >= bottom {
            return OUTSIDE;
        }
        let here = &self.steps[self.offset(x, y)..][..7 * self.stride + BLOCK];
        let there = &other.steps[other.offset(tx, ty)..][..7 * other.stride + BLOCK];
        let mut sums = [0i16; BLOCK];
        for r in 0..BLOCK {
            let a = &here[r * self.stride..][..BLOCK];
            let b = &there[r * other.stride..][..BLOCK];
            for c in 0..BLOCK {
                sums[c] += (a[c] - b[c]).abs().min(CLIP);
            }
        }
        sums.iter().map(|&s| i32::from(s)).sum()
    }
}

/// The pixel of point (i, j) of a `width × height` frame.
pub fn point(i: usize, j: usize, width: usize, height: usize) -> [i32; 2] {
    let at = |k: usize, side: usize| (SPACING * k + SPACING / 2).min(side - 1) as i32;
    [at(i, width), at(j, height)]
}

/// dx, dy in whole pixels from `first` to `second` at each point of the finest level; both are pyramids, finest first.
pub fn search(first: &[Blocks], second: &[Blocks]) -> Grid<[i32; 2]> {
    let mut levels = first.iter().zip(second).rev();
    let (a, b) = levels.next().expect("a pyramid has a level");
    let mut found = Level { a, b }.coarsest();
    for (a, b) in levels {
        found = Level { a, b }.finer(&found);
    }
    found
}

struct Level<'a> {
    a: &'a Blocks,
    b: &'a Blocks,
}

/// The best displacement of one point so far.
#[derive(Clone, Copy)]
struct Best {
    at: [i32; 2],
    displacement: [i32; 2],
    cost: i32,
}

impl Level<'_> {
    fn coarsest(&self) -> Grid<[i32; 2]> {
        let [mx, my] = [self.a.width, self.a.height].map(|side| (REACH * side as f32) as i32);
        self.visit(|_, _, best| {
            for dy in -my..=my {
                for dx in -mx..=mx {
                    // Where there is no texture, stay: a pixel costs a grey level.
                    let extra = STEPS as i32 * (dx.abs() + dy.abs());
                    best.test(self, [dx, dy], extra);
                }
            }
        })
    }

    fn finer(&self, coarse: &Grid<[i32; 2]>) -> Grid<[i32; 2]> {
        self.visit(|i, j, best| {
            let (ci, cj) = (i / 2, j / 2);
            let mut tried = [[i32::MAX; 2]; 9];
            let mut count = 0;
            for q in cj.saturating_sub(1)..(cj + 2).min(coarse.height()) {
                for p in ci.saturating_sub(1)..(ci + 2).min(coarse.width()) {
                    let d = coarse[(p, q)].map(|d| 2 * d);
                    if !tried[..count].contains(&d) {
                        tried[count] = d;
                        count += 1;
                        best.test(self, d, 0);
                    }
                }
            }
        })
    }

    /// Fills the points: `propose` tests candidates, then the neighbours' displacements and small steps follow.
    fn visit(&self, propose: impl Fn(usize, usize, &mut Best)) -> Grid<[i32; 2]> {
        let (width, height) = (self.a.width, self.a.height);
        let [across, down] = [width, height].map(|side| side.div_ceil(SPACING));
        let mut all = Grid::from_fn(across, down, |i, j| Best {
            at: point(i, j, width, height),
            displacement: [0, 0],
            cost: OUTSIDE,
        });
        for j in 0..down {
            for i in 0..across {
                let mut best = all[(i, j)];
                propose(i, j, &mut best);
                if i > 0 {
                    best.test(self, all[(i - 1, j)].displacement, 0);
                }
                if j > 0 {
                    best.test(self, all[(i, j - 1)].displacement, 0);
                }
                best.descend(self);
                all[(i, j)] = best;
            }
        }
        for j in (0..down).rev() {
            for i in (0..across).rev() {
                let mut best = all[(i, j)];
                if i + 1 < across {
                    best.test(self, all[(i + 1, j)].displacement, 0);
                }
                if j + 1 < down {
                    best.test(self, all[(i, j + 1)].displacement, 0);
                }
                all[(i, j)] = best;
            }
        }
        all.map(|best| best.displacement)
    }
}

impl Best {
    fn test(&mut self, level: &Level, displacement: [i32; 2], extra: i32) {
        if displacement == self.displacement && self.cost < OUTSIDE {
            return;
        }
        let cost = level.a.sad(level.b, self.at, displacement) + extra;
        if cost < self.cost {
            self.cost = cost;
            self.displacement = displacement;
        }
    }

    fn descend(&mut self, level: &Level) {
        for _ in 0..2 {
            let middle = self.displacement;
            for dy in -1..=1 {
                for dx in -1..=1 {
                    self.test(level, [middle[0] + dx, middle[1] + dy], 0);
                }
            }
            if self.displacement == middle {
                break;
            }
        }
    }
}
