//! How far residuals spread, whatever a minority does.

/// Least σ that is believed, grey levels: frames of 8 bits are not known better, derivatives included.
pub(crate) const LEAST_SIGMA: f64 = 0.4;

/// σ of residuals: 1.4826 times their median size, as for a Gaussian; 0 of none. Takes their signs and puts them into
/// another order.
pub(crate) fn spread(residuals: &mut [f32]) -> f64 {
    if residuals.is_empty() {
        return 0.0;
    }
    let middle = residuals.len() / 2;
    for residual in &mut *residuals {
        *residual = residual.abs();
    }
    let (_, median, _) = residuals.select_nth_unstable_by(middle, f32::total_cmp);
    1.4826 * f64::from(*median)
}
