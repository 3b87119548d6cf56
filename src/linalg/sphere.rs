//! Directions spread evenly over half of the sphere, on a spiral that turns by the golden angle.

use glam::DVec3;

/// `count` unit vectors with z > 0; every direction or its opposite is near one of them.
pub(crate) fn hemisphere(count: usize) -> impl Iterator<Item = DVec3> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..count).map(move |i| {
        let z = (i as f64 + 0.5) / count as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        DVec3::new(across * cos, across * sin, z)
    })
}
