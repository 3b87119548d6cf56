//! How far residuals spread, whatever a minority does.

/// Least σ that is believed, grey levels: frames of 8 bits are not known better, derivatives included.
pub(crate) const LEAST_SIGMA: f64 = 0.4;

/// σ of residuals: 1.4826 times their median size, as for a Gaussian; 0 of none. Puts them into another order.
pub(crate) fn spread(residuals: &mut [f32]) -> f64 {
    if residuals.is_empty() {
        return 0.0;
    }
    let middle = residuals.len() / 2;
    let by_size = |a: &f32, b: &f32| a.abs().total_cmp(&b.abs());
    let (_, median, _) = residuals.select_nth_unstable_by(middle, by_size);
    1.4826 * f64::from(median.abs())
}
