//! Where two frames show nothing of the scene, though it moves: what is transparent, black bars and borders, and what
//! stands still before a moving picture, a logo or subtitles.
//!
//! | what | is taken for absent where |
//! | --- | --- |
//! | transparent | alpha is 0 in either frame |
//! | border | brightness is at most [`BLACK`] from the frame's edge on, in the same places in both frames |
//! | before the picture | pixels of one brightness differ by at most [`STILL`] between the frames and are set off sharply all around in both, while [`MOVING`] of the picture's edges move |
//!
//! A closed outline that is sharp at the same pixels in both frames does not move, in whichever direction. Brightness is
//! continued into such places from around them, mean over mean on ever coarser pixels, so that nothing there stands
//! still, or has an edge, for whoever reads it.

use super::frame::Frame;
use crate::grid::Grid;
use crate::window::places;

/// Grey levels of what is black.
const BLACK: f32 = 4.0;
/// Share of the black at the edges, in both frames together, that is black in each.
const SAME: f64 = 0.95;
/// Shares of a frame between which a border covers it.
const BORDER: [f64; 2] = [0.005, 0.6];
/// Grey levels by which what stands still may differ.
const STILL: f32 = 1.0;
/// Grey levels by which neighbours of one brightness differ at most, and others in both frames more.
const STEP: f32 = 12.0;
/// Share of the outline that is set off.
const SET_OFF: f64 = 0.9;
/// Grey levels between neighbours at an edge, and the share of such pixels that move.
const EDGE: f32 = 8.0;
const MOVING: f64 = 0.8;
/// Pixels of a letter at least, and the share of the frame that it covers at most.
const LETTER: (usize, f64) = (6, 0.05);

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
    let edge = |at: usize, side: usize| at == 0 || at + 1 == side;
    let mut open: Vec<(usize, usize)> = places(0..width, 0..height)
        .filter(|&(x, y)| edge(x, width) || edge(y, height))
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
    let still = |at: (usize, usize)| (first[at] - second[at]).abs() <= STILL;
    let (mut edges, mut at_rest) = (0usize, 0usize);
    for y in 1..height {
        for x in 1..width {
            let here = first[(x, y)];
            let step = (here - first[(x - 1, y)]).abs() + (here - first[(x, y - 1)]).abs();
            if step > EDGE && mask[(x, y)] == 0 {
                edges += 1;
                at_rest += usize::from(still((x, y)));
            }
        }
    }
    if at_rest as f64 > (1.0 - MOVING) * edges as f64 {
        return;
    }
    let most = (LETTER.1 * first.len() as f64) as usize;
    let mut seen = mask.clone();
    for start in places(0..width, 0..height) {
        if seen[start] != 0 || !still(start) {
            continue;
        }
        seen[start] = 1;
        let (mut letter, mut next) = (vec![start], 0);
        let (mut around, mut set_off) = (0usize, 0usize);
        while let Some(&at) = letter.get(next) {
            next += 1;
            for other in neighbours(at, width, height) {
                if (first[other] - first[at]).abs() <= STEP && still(other) {
                    if seen[other] == 0 {
                        seen[other] = 1;
                        letter.push(other);
                    }
                } else {
                    let off = |grey: &Grid<f32>| (grey[other] - grey[at]).abs() > STEP;
                    around += 1;
                    set_off += usize::from(off(first) && off(second));
                }
            }
        }
        let alone = set_off as f64 >= SET_OFF * around as f64;
        if alone && (LETTER.0..=most).contains(&letter.len()) {
            letter.into_iter().for_each(|at| spread(mask, at, 1));
        }
    }
}

fn neighbours(
    (x, y): (usize, usize),
    width: usize,
    height: usize,
) -> impl Iterator<Item = (usize, usize)> {
    let around = |at: usize, side: usize| at.saturating_sub(1)..(at + 2).min(side);
    places(around(x, width), around(y, height)).filter(move |&at| at != (x, y))
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
            // Thin letters: frames of a pixel's width.
            let (i, j) = (x % 8, y.wrapping_sub(40));
            let word = word && (60..84).contains(&x) && j < 8;
            let letter = i < 6 && (i == 0 || i == 5 || j == 0 || j == 7);
            match (bars && !(8..56).contains(&y), word && letter) {
                (true, _) => 0.0,
                (_, true) => 255.0,
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
