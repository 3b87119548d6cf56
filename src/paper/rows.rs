//! The stretches of a row that belong to one region, and what is asked at each of its pixels.

use std::ops::Range;

/// The stretches of equal labels in a row, from left to right.
pub(super) fn runs(labels: &[u8]) -> impl Iterator<Item = (usize, Range<usize>)> {
    let mut end = 0;
    labels.chunk_by(|a, b| a == b).map(move |run| {
        let start = end;
        end += run.len();
        (usize::from(run[0]), start..end)
    })
}

/// The lesser of two numbers, one machine instruction: `f32::min` also looks for what is no number.
pub(super) fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater of two numbers.
pub(super) fn most(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
