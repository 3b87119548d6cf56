//! Sums along a row of pixels.
//!
//! Eight partial sums side by side, so that the compiler uses the machine's vectors; a row is short, so that single
//! precision suffices.

/// Σ a.
pub fn sum(a: &[f32]) -> f64 {
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
pub fn dot(a: &[f32], b: &[f32]) -> f64 {
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
