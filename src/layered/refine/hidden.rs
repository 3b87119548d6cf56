//! Which pixels are hidden in the second frame, and depth for them from behind.
//!
//! Every pixel goes to its target; where another lands on the same pixel nearer to the camera, by more than a
//! tolerance, it is hidden, and so it is outside the frame. What hides is in front, so a hidden pixel takes the
//! depth of the farther side: of what is seen in the eight directions within 40 pixels, the lower quarter.

use crate::grid::Grid;
use crate::layered::view::View;

/// How far to look for what is seen, in pixels.
const FARTHEST: isize = 40;
/// The ways in which it is looked.
const AROUND: [(isize, isize); 8] = [
    (-1, -1),
    (-1, 0),
    (-1, 1),
    (0, -1),
    (0, 1),
    (1, -1),
    (1, 0),
    (1, 1),
];

/// What arrives at each pixel of the second frame.
pub struct Arrivals {
    /// ρ of the nearest, `f32::MIN` where nothing arrives.
    nearest: Grid<f32>,
}

impl Arrivals {
    /// Sends every pixel of `support` to its target.
    pub fn new(rho: &Grid<f32>, view: &View, support: &Grid<bool>) -> Self {
        let (width, height) = (rho.width(), rho.height());
        let mut nearest = Grid::new(width, height, f32::MIN);
        for y in 0..height {
            for x in 0..width {
                let r = rho[(x, y)];
                if support[(x, y)]
                    && let Some(place) = landing(view.target(x, y, r), width, height)
                {
                    nearest[place] = nearest[place].max(r);
                }
            }
        }
        Self { nearest }
    }

    /// Whether a point at inverse depth `rho` that goes to `target` is seen there: nothing nearer covers it.
    pub fn sees(&self, target: [f32; 2], rho: f32, tolerance: f32) -> bool {
        landing(target, self.nearest.width(), self.nearest.height())
            .is_some_and(|place| self.nearest[place] <= rho + tolerance)
    }
}

/// The pixel nearest to a target, if the target is on the frame.
fn landing([x, y]: [f32; 2], width: usize, height: usize) -> Option<(usize, usize)> {
    let on = x >= 0.0 && y >= 0.0 && x <= width as f32 - 1.0 && y <= height as f32 - 1.0;
    on.then_some(((x + 0.5) as usize, (y + 0.5) as usize))
}

/// Which pixels of `support` are hidden, covered or outside; `tolerance` is in units of `rho`.
pub fn hidden(rho: &Grid<f32>, view: &View, support: &Grid<bool>, tolerance: f32) -> Grid<bool> {
    let arrivals = Arrivals::new(rho, view, support);
    Grid::from_fn(rho.width(), rho.height(), |x, y| {
        let r = rho[(x, y)];
        support[(x, y)] && !arrivals.sees(view.target(x, y, r), r, tolerance)
    })
}

/// Continues ρ to pixels that leave the frame: along the row or column by which they leave, with the slope of the
/// pixels that are seen.
pub fn continue_outside(rho: &mut Grid<f32>, view: &View, hidden: &Grid<bool>, step: f32) {
    /// Pixels over which the slope is taken.
    const RUN: isize = 8;
    let (width, height) = (rho.width() as isize, rho.height() as isize);
    let seen = rho.clone();
    for y in 0..height {
        for x in 0..width {
            let at = (x as usize, y as usize);
            if !hidden[at] {
                continue;
            }
            let [tx, ty] = view.target(at.0, at.1, seen[at]);
            let beyond = |t: f32, side: isize| (-t).max(0.0) - (t - side as f32 + 1.0).max(0.0);
            let (bx, by) = (beyond(tx, width), beyond(ty, height));
            if bx == 0.0 && by == 0.0 {
                continue;
            }
            let (dx, dy) = if bx.abs() > by.abs() {
                (bx.signum() as isize, 0)
            } else {
                (0, by.signum() as isize)
            };
            let on = |k: isize| {
                let (u, v) = (x + k * dx, y + k * dy);
                let inside = u >= 0 && v >= 0 && u < width && v < height;
                inside.then_some((u as usize, v as usize))
            };
            let mut k = 1;
            while let Some(p) = on(k) {
                if !hidden[p] {
                    break;
                }
                k += 1;
            }
            let Some(first) = on(k) else { continue };
            let slope = match on(k + RUN) {
                Some(last) if !hidden[last] && (seen[last] - seen[first]).abs() < step => {
                    (seen[last] - seen[first]) / RUN as f32
                }
                _ => 0.0,
            };
            rho[at] = seen[first] - slope * k as f32;
        }
    }
}

/// Gives hidden pixels a depth from behind.
pub fn fill(rho: &mut Grid<f32>, hidden: &Grid<bool>) {
    let seen = rho.clone();
    let (width, height) = (rho.width() as isize, rho.height() as isize);
    for y in 0..height {
        for x in 0..width {
            if !hidden[(x as usize, y as usize)] {
                continue;
            }
            let mut around = [0.0f32; 8];
            let mut count = 0;
            for (dx, dy) in AROUND {
                for k in 1..=FARTHEST {
                    let (u, v) = (x + k * dx, y + k * dy);
                    if u < 0 || v < 0 || u >= width || v >= height {
                        break;
                    }
                    let at = (u as usize, v as usize);
                    if !hidden[at] {
                        around[count] = seen[at];
                        count += 1;
                        break;
                    }
                }
            }
            if count > 0 {
                let around = &mut around[..count];
                around.sort_unstable_by(f32::total_cmp);
                rho[(x as usize, y as usize)] = around[(count - 1) / 4];
            }
        }
    }
}

#[cfg(test)]
mod tests;
