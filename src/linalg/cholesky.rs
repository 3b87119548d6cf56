//! Small symmetric positive definite systems by Cholesky's factorisation.

/// Solves A x = b for a symmetric positive definite A, of which the lower triangle is read.
///
/// Columns are scaled to a unit diagonal first: in a motion step they carry units as different as
/// pixels and radians. `None` when a pivot falls below 1e-12 of its column, that is when the data
/// leave x undetermined.
pub(crate) fn solve_positive<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<[f64; N]> {
    let mut scale = [0.0; N];
    for i in 0..N {
        if a[i][i].is_nan() || a[i][i] <= 0.0 {
            return None;
        }
        scale[i] = a[i][i].sqrt().recip();
    }
    let mut l = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let dot: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
            let rest = a[i][j] * scale[i] * scale[j] - dot;
            if i == j {
                if rest.is_nan() || rest < 1e-12 {
                    return None;
                }
                l[i][i] = rest.sqrt();
            } else {
                l[i][j] = rest / l[j][j];
            }
        }
    }
    let mut x = [0.0; N];
    for i in 0..N {
        let dot: f64 = (0..i).map(|k| l[i][k] * x[k]).sum();
        x[i] = (b[i] * scale[i] - dot) / l[i][i];
    }
    for i in (0..N).rev() {
        let dot: f64 = (i + 1..N).map(|k| l[k][i] * x[k]).sum();
        x[i] = (x[i] - dot) / l[i][i];
    }
    for i in 0..N {
        x[i] *= scale[i];
    }
    Some(x)
}
