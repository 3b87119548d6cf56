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
/// Pixels beyond which no place is looked at: 16-bit fractions leave that many.
const FARTHEST: f32 = 3e4;

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
    let end = [width, height].map(|side| (side as i32 - 1) << 16);
    for y in 0..height {
        for x in 0..width {
            let i = y * width + x;
            if !support[(x, y)] {
                continue;
            }
            let row = &mut costs[i * labels..(i + 1) * labels];
            let (start, speed) = view.line(view.turned(x, y));
            row.fill(MOST);
            let ends = [0, labels].map(|k| low + step * k as f32);
            let far = |u: f32, k: usize| (start[k] + u * speed[k]).abs() >= FARTHEST;
            if ends.iter().any(|&u| far(u, 0) || far(u, 1)) {
                continue;
            }
            // Places have 16 fractional bits.
            let fixed = |v: f32| (v * 65536.0) as i32;
            let mut at = [0, 1].map(|k| fixed(start[k] + low * speed[k]));
            let by = speed.map(|s| fixed(s * step));
            for cost in row {
                let [px, py] = at;
                at = [px + by[0], py + by[1]];
                if px < 0 || py < 0 || px >= end[0] || py >= end[1] {
                    continue;
                }
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
