//! Where two frames show nothing of the scene, though it moves: what is transparent, black bars and borders, and what
//! stands still before a moving picture, a logo or subtitles.
//!
//! | what | is taken for absent where |
//! | --- | --- |
//! | transparent | alpha is 0 in either frame |
//! | border | brightness is at most [`BLACK`] from the frame's edge on, in the same places in both frames |
//! | before the picture | the frames differ by at most [`STILL`] all over a window whose corners would show a move of an eighth of a pixel, while [`MOVING`] of such windows elsewhere move |
//!
//! A window's corners show by the smaller eigenvalue of Σ ∇I ∇Iᵀ. Brightness is continued into such places from around
//! them, mean over mean on ever coarser pixels, so that nothing there stands still, or has an edge, for whoever reads it.

use super::frame::Frame;
use crate::grid::Grid;

/// Grey levels of what is black.
const BLACK: f32 = 4.0;
/// Share of the black at the edges, in both frames together, that is black in each.
const SAME: f64 = 0.95;
/// Shares of a frame between which a border covers it.
const BORDER: [f64; 2] = [0.005, 0.6];
/// Grey levels by which what stands still may differ.
const STILL: f32 = 1.0;
/// Half the side of a window, pixels.
const HALF: usize = 2;
/// The smaller eigenvalue for each pixel of a window, (grey levels/px)².
const CORNERS: f32 = 64.0;
/// Share of the windows with corners that move.
const MOVING: f64 = 0.8;
/// Windows that stand still, at least.
const FEWEST: usize = 8;
/// Pixels by which what stands still reaches beyond the middle of a window.
const REACH: usize = 4;

/// 1 where both frames' brightness shows nothing of the scene; `None` where it does everywhere.
pub(super) fn absent(first: &Frame, second: &Frame) -> Option<Grid<u8>> {
    let greys = [&*first.grey, &*second.grey];
    let (width, height) = (greys[0].width(), greys[0].height());
    let mut mask = Grid::new(width, height, 0u8);
    for unknown in [first, second]
        .into_iter()
        .filter_map(|f| f.unknown.as_ref())
    {
        let n = (unknown.width() / width).max(1);
        for y in 0..height {
            for (x, m) in mask.row_mut(y).iter_mut().enumerate() {
                *m |= unknown[(n * x, n * y)];
            }
        }
    }
    mark_border(greys, &mut mask);
    mark_overlay(greys, &mut mask);
    // All or nothing: then there is nothing to continue from.
    let marked = mask.data().iter().filter(|m| **m != 0).count();
    (marked > 0 && marked < mask.len()).then_some(mask)
}

/// Brightness continued from around into where `absent` is not 0.
pub(super) fn continued(grey: &Grid<f32>, absent: &Grid<u8>) -> Grid<f32> {
    fill(grey, &absent.map(|m| if m == 0 { 1.0 } else { 0.0 }))
}

fn fill(value: &Grid<f32>, weight: &Grid<f32>) -> Grid<f32> {
    let (width, height) = (value.width(), value.height());
    if width * height == 1 || weight.data().iter().all(|w| *w > 0.0) {
        return value.clone();
    }
    let [across, down] = [width, height].map(|side| side.div_ceil(2));
    let (mut mean, mut sum) = (
        Grid::new(across, down, 0.0),
        Grid::new(across, down, 0.0f32),
    );
    for y in 0..height {
        for x in 0..width {
            let at = (x / 2, y / 2);
            mean[at] += weight[(x, y)] * value[(x, y)];
            sum[at] += weight[(x, y)];
        }
    }
    for (mean, sum) in mean.data_mut().iter_mut().zip(sum.data_mut()) {
        *mean /= sum.max(1.0);
        *sum = sum.min(1.0);
    }
    let coarse = fill(&mean, &sum);
    let place = |at: usize| (at as f32 - 0.5) / 2.0;
    Grid::from_fn(width, height, |x, y| {
        if weight[(x, y)] > 0.0 {
            value[(x, y)]
        } else {
            coarse.bilinear(place(x), place(y))
        }
    })
}

fn mark_border(greys: [&Grid<f32>; 2], mask: &mut Grid<u8>) {
    let [a, b] = greys.map(black_at_edges);
    let pairs = || a.data().iter().zip(b.data());
    let both = pairs().filter(|(a, b)| **a & **b != 0).count() as f64;
    let either = pairs().filter(|(a, b)| **a | **b != 0).count() as f64;
    let share = both / a.len() as f64;
    if both < SAME * either || !(BORDER[0]..=BORDER[1]).contains(&share) {
        return;
    }
    for y in 0..a.height() {
        for x in 0..a.width() {
            if a[(x, y)] | b[(x, y)] != 0 {
                // What a lens or a codec has mixed with the picture goes along.
                spread(mask, (x, y), 2);
            }
        }
    }
}

/// 1 where brightness is black from the frame's edge on.
fn black_at_edges(grey: &Grid<f32>) -> Grid<u8> {
    let (width, height) = (grey.width(), grey.height());
    let mut found = Grid::new(width, height, 0u8);
    let sides = (0..height).flat_map(|y| [(0, y), (width - 1, y)]);
    let mut open: Vec<(usize, usize)> = (0..width)
        .flat_map(|x| [(x, 0), (x, height - 1)])
        .chain(sides)
        .collect();
    while let Some((x, y)) = open.pop() {
        if found[(x, y)] != 0 || grey[(x, y)] > BLACK {
            continue;
        }
        found[(x, y)] = 1;
        open.extend(
            [(x.wrapping_sub(1), y), (x, y.wrapping_sub(1))]
                .into_iter()
                .chain([(x + 1, y), (x, y + 1)])
                .filter(|&(x, y)| x < width && y < height),
        );
    }
    found
}

fn mark_overlay([first, second]: [&Grid<f32>; 2], mask: &mut Grid<u8>) {
    let (width, height) = (first.width(), first.height());
    let margin = HALF + 1;
    if width <= 2 * margin || height <= 2 * margin {
        return;
    }
    let inner = || {
        let rows = margin..height - margin;
        rows.flat_map(move |y| (margin..width - margin).map(move |x| (x, y)))
    };
    let still = |at: (usize, usize)| window(at).all(|p| (first[p] - second[p]).abs() <= STILL);
    let shows = |at: (usize, usize)| mask[at] == 0 && corners(first, at) > CORNERS;
    // A sample of the windows tells whether the picture moves.
    let sampled = inner().filter(|(x, y)| x % 3 == 0 && y % 3 == 0 && shows((*x, *y)));
    let (mut all, mut at_rest) = (0usize, 0usize);
    for at in sampled {
        all += 1;
        at_rest += usize::from(still(at));
    }
    if at_rest as f64 > (1.0 - MOVING) * all as f64 {
        return;
    }
    let found: Vec<_> = inner().filter(|&at| still(at) && shows(at)).collect();
    if found.len() >= FEWEST {
        found.into_iter().for_each(|at| spread(mask, at, REACH));
    }
}

fn window((x, y): (usize, usize)) -> impl Iterator<Item = (usize, usize)> {
    let rows = y - HALF..=y + HALF;
    rows.flat_map(move |y| (x - HALF..=x + HALF).map(move |x| (x, y)))
}

/// The smaller eigenvalue of Σ ∇I ∇Iᵀ over a window, for each of its pixels.
fn corners(grey: &Grid<f32>, at: (usize, usize)) -> f32 {
    let (mut xx, mut xy, mut yy) = (0.0f32, 0.0f32, 0.0f32);
    for (x, y) in window(at) {
        let dx = 0.5 * (grey[(x + 1, y)] - grey[(x - 1, y)]);
        let dy = 0.5 * (grey[(x, y + 1)] - grey[(x, y - 1)]);
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    let half = 0.5 * (xx + yy);
    let pixels = (2 * HALF + 1).pow(2) as f32;
    (half - (half * half - (xx * yy - xy * xy)).max(0.0).sqrt()) / pixels
}

fn spread(mask: &mut Grid<u8>, (x, y): (usize, usize), reach: usize) {
    let (right, bottom) = (mask.width() - 1, mask.height() - 1);
    for y in y.saturating_sub(reach)..=(y + reach).min(bottom) {
        mask.row_mut(y)[x.saturating_sub(reach)..=(x + reach).min(right)].fill(1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(x: f32, y: f32) -> f32 {
        120.0 + 40.0 * (0.5 * x + 0.2 * y).sin() + 40.0 * (0.4 * y - 0.3 * x).cos()
    }

    fn frame(value: impl FnMut(usize, usize) -> f32) -> Frame {
        Frame::from_grey(Grid::from_fn(96, 64, value)).unwrap()
    }

    /// A picture that moves by `t`, between bars, with a word before it.
    fn shown(t: f32, bars: bool, word: bool) -> Frame {
        frame(|x, y| {
            let letter = (60..84).contains(&x) && (40..48).contains(&y) && (x / 3 + y / 4) % 2 == 0;
            match (bars && !(8..56).contains(&y), word && letter) {
                (true, _) => 0.0,
                (_, true) => 235.0,
                _ => texture(x as f32 - t, y as f32 - 0.4 * t),
            }
        })
    }

    #[test]
    fn bars_and_words_before_a_moving_picture_are_absent() {
        for (bars, word) in [(true, false), (false, true), (true, true)] {
            let [a, b] = [0.0, 2.0].map(|t| shown(t, bars, word));
            let mask = absent(&a, &b).unwrap();
            assert_eq!(mask[(48, 2)] != 0, bars);
            assert_eq!(mask[(72, 44)] != 0, word);
            assert_eq!(mask[(30, 30)], 0);
            // What is continued has no edge where the bar was.
            let grey = continued(&a.grey, &mask);
            if bars {
                assert!((grey[(48, 7)] - grey[(48, 10)]).abs() < 60.0);
                assert!(grey[(48, 0)] > 60.0);
            }
        }
    }

    #[test]
    fn nothing_is_absent_where_the_picture_moves_or_rests() {
        let whole = [0.0, 2.0].map(|t| shown(t, false, false));
        assert_eq!(absent(&whole[0], &whole[1]), None);
        // One thing moves before a background at rest.
        let body = |t: usize| {
            frame(|x, y| {
                let on = (30 + t..50 + t).contains(&x) && (20..40).contains(&y);
                texture(if on { x + 200 - t } else { x } as f32, y as f32)
            })
        };
        assert_eq!(absent(&body(0), &body(2)), None);
    }

    #[test]
    fn black_that_moves_is_seen() {
        let dark = |t: usize| {
            frame(|x, y| {
                if x < 20 + t {
                    0.0
                } else {
                    texture(x as f32, y as f32)
                }
            })
        };
        assert_eq!(absent(&dark(0), &dark(3)), None);
    }
}
