//! Small symmetric positive definite systems by Cholesky's factorisation.

/// Solves A x = b for a symmetric positive definite A, of which the lower triangle is read.
///
/// Columns are scaled to a unit diagonal first: in a motion step they carry units as different as
/// pixels and radians. `None` when a pivot falls below 1e-12 of its column, that is when the data
/// leave x undetermined.
pub fn solve<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<[f64; N]> {
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

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn solves_a_badly_scaled_system() {
        let a = [[4e8, 2e3, 0.0], [2e3, 3e-2, 1e-3], [0.0, 1e-3, 5e-4]];
        let known = [1e-4, 2.0, -30.0];
        let b = a.map(|row| row.iter().zip(&known).map(|(a, x)| a * x).sum());
        let found = solve(&a, &b).unwrap();
        for (x, y) in found.iter().zip(&known) {
            assert!((x - y).abs() < 1e-8 * y.abs(), "{x} for {y}");
        }
    }

    #[test]
    fn says_when_nothing_is_determined() {
        assert_eq!(solve(&[[1.0, 1.0], [1.0, 1.0]], &[1.0, 1.0]), None);
        assert_eq!(solve(&[[f64::NAN]], &[1.0]), None);
        assert_eq!(solve(&[[-1.0]], &[1.0]), None);
    }
}
