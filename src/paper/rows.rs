//! Sums along a row of pixels, and the stretches of a row that belong to one region.
//!
//! Eight partial sums side by side, so that the compiler uses the machine's vectors; a stretch is at most a row, so
//! that single precision suffices.

use std::ops::Range;

/// Σ a.
pub(super) fn sum(a: &[f32]) -> f64 {
    let mut lanes = [0.0f32; 8];
    let (whole, rest) = a.as_chunks::<8>();
    for a in whole {
        for i in 0..8 {
            lanes[i] += a[i];
        }
    }
    f64::from(lanes.iter().sum::<f32>() + rest.iter().sum::<f32>())
}

/// Σ a b.
pub(super) fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut lanes = [0.0f32; 8];
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    for (a, b) in a.iter().zip(b) {
        for i in 0..8 {
            lanes[i] += a[i] * b[i];
        }
    }
    let rest: f32 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    f64::from(lanes.iter().sum::<f32>() + rest)
}

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
