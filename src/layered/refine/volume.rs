//! What it costs to see a pixel of the first frame at each of some places of the second.
//!
//! ```text
//! C = min(11/16 |I2' − I1'|, 18) + 3/2 · (bits in which the 5×5 census differs)
//! ```
//!
//! I' in grey levels less the mean of 17×17 pixels, I2' bilinear; a place outside of the frame costs 18. Pixels outside of the
//! support cost nothing at any place, so that they follow what is around them. In whole numbers of sixteenths.

use super::census::census;
use crate::grid::Grid;
use crate::init::less_box_mean;
use crate::layered::view::View;

/// Most that brightness costs.
const MOST: u8 = 18;

/// C of every pixel of `support` for `labels` steps of u from `low` on, pixels in row order.
pub fn volume(
    frames: [&Grid<f32>; 2],
    view: &View,
    support: &Grid<bool>,
    labels: usize,
    low: f32,
    step: f32,
) -> Vec<u8> {
    let (width, height) = (frames[0].width(), frames[0].height());
    let bits = frames.map(census);
    // Sixteenths of a grey level.
    let greys = frames.map(|frame| {
        let rest = less_box_mean(frame, 8);
        rest.data()
            .iter()
            .map(|v| (v * 16.0) as i16)
            .collect::<Vec<i16>>()
    });
    let mut costs = vec![0u8; labels * width * height];
    for y in 0..height {
        for x in 0..width {
            let i = y * width + x;
            if !support[(x, y)] {
                continue;
            }
            let row = &mut costs[i * labels..(i + 1) * labels];
            let (start, speed) = view.line(view.turned(x, y));
            let line = Line {
                start: [start[0] + low * speed[0], start[1] + low * speed[1]],
                step: speed.map(|s| s * step),
            };
            row.fill(MOST);
            let Some((first, last)) = line.within(width, height, labels) else {
                continue;
            };
            // Places have 16 fractional bits.
            let fixed = |v: f32| (v * 65536.0) as i32;
            let end = [width, height].map(|side| ((side as i32 - 1) << 16) - 1);
            let mut at = [0, 1].map(|k| fixed(line.start[k] + line.step[k] * first as f32));
            let by = line.step.map(fixed);
            for cost in &mut row[first..=last] {
                let [px, py] = [at[0].clamp(0, end[0]), at[1].clamp(0, end[1])];
                let (xi, yi) = ((px >> 16) as usize, (py >> 16) as usize);
                let (tx, ty) = ((px >> 8) & 255, (py >> 8) & 255);
                let o = yi * width + xi;
                let (top, bottom) = (&greys[1][o..o + 2], &greys[1][o + width..o + width + 2]);
                let [a, b, c, d] = [top[0], top[1], bottom[0], bottom[1]].map(i32::from);
                let upper = a * 256 + tx * (b - a);
                let lower = c * 256 + tx * (d - c);
                let grey = (upper >> 8) + ((ty * ((lower - upper) >> 8)) >> 8);
                let difference = (grey - i32::from(greys[0][i])).abs();
                let nearest = o + (tx >> 7) as usize + (ty >> 7) as usize * width;
                let differing = (bits[0][i] ^ bits[1][nearest]).count_ones() as i32;
                *cost = cost_of(difference, differing);
                at = [at[0] + by[0], at[1] + by[1]];
            }
        }
    }
    costs
}

/// C of a difference in sixteenths of a grey level and a number of census bits.
fn cost_of(difference: i32, differing: i32) -> u8 {
    let grey = (11 * difference / 16).min(16 * i32::from(MOST));
    ((grey + 24 * differing) / 16) as u8
}

/// Where a pixel goes, label by label.
struct Line {
    start: [f32; 2],
    step: [f32; 2],
}

impl Line {
    /// First and last label whose target lies on the frame.
    fn within(&self, width: usize, height: usize, labels: usize) -> Option<(usize, usize)> {
        let (mut first, mut last) = (0.0f32, (labels - 1) as f32);
        for (k, side) in [width, height].into_iter().enumerate() {
            let most = side as f32 - 1.002;
            let (a, s) = (self.start[k], self.step[k]);
            if s.abs() < 1e-6 {
                if !(a >= 0.0 && a <= most) {
                    return None;
                }
            } else {
                let (p, q) = (-a / s, (most - a) / s);
                first = first.max(p.min(q));
                last = last.min(p.max(q));
            }
        }
        let (first, last) = (first.ceil(), last.floor());
        (first <= last).then_some((first as usize, last as usize))
    }
}
