//! The rotation that explains most matches by itself, T = 0.
//!
//! ```text
//! minimise  Σ w |π(R p) − q|²        R ← exp([δ]×) R        w = 1/(1 + |e|²/s²)²,  s = 8, 3, 1.5, … px, as in [`SCALES`]
//! ```
//!
//! p and q are the rays of a match in the first and the second frame, π the projection. Radians and pixels.

use glam::{DMat3, DVec3};

use super::epipolar::{Pair, SCALES, median};
use crate::camera::{omega, turn};
use crate::linalg::solve;

/// ω and the median of what it leaves, in pixels. `focal` in pixels.
pub fn rotation_alone(pairs: &[Pair], focal: f64) -> (DVec3, f64) {
    let mut rotation = DMat3::IDENTITY;
    for scale in SCALES {
        let mut normal = [[0.0; 3]; 3];
        let mut right = [0.0; 3];
        for pair in pairs {
            let (x, y, ex, ey) = residual(pair, &rotation, focal);
            let jx = [-x * y, 1.0 + x * x, -y].map(|v| v * focal);
            let jy = [-1.0 - y * y, x * y, x].map(|v| v * focal);
            let weight = (1.0 + (ex * ex + ey * ey) / (scale * scale)).powi(-2);
            for k in 0..3 {
                for l in 0..3 {
                    normal[k][l] += weight * (jx[k] * jx[l] + jy[k] * jy[l]);
                }
                right[k] -= weight * (jx[k] * ex + jy[k] * ey);
            }
        }
        if let Some(step) = solve(&normal, &right) {
            rotation = turn(DVec3::from_array(step)) * rotation;
        }
    }
    let left = pairs.iter().map(|pair| {
        let (_, _, ex, ey) = residual(pair, &rotation, focal);
        ex.hypot(ey)
    });
    (omega(&rotation), median(left.collect()))
}

/// π(R p) and, in pixels, how far it is from q.
fn residual(pair: &Pair, rotation: &DMat3, focal: f64) -> (f64, f64, f64, f64) {
    let p = *rotation * pair.p;
    let (x, y) = (p.x / p.z, p.y / p.z);
    (x, y, (x - pair.q.x) * focal, (y - pair.q.y) * focal)
}
