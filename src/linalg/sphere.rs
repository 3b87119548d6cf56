//! Directions spread evenly over half of the unit sphere.
//!
//! The Fibonacci lattice: point i of n has z = (i + ½)/n and turns by the golden angle from the one before, so that
//! every direction has the same area, 2π/n.

use glam::DVec3;

/// `count` directions with z > 0.
pub fn hemisphere(count: usize) -> impl Iterator<Item = DVec3> {
    let golden_angle = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..count).map(move |i| {
        let z = (i as f64 + 0.5) / count as f64;
        let (sin, cos) = (i as f64 * golden_angle).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cos, radius * sin, z)
    })
}

/// Two unit vectors that with the unit vector `direction` make an orthonormal base.
pub fn tangents(direction: DVec3) -> [DVec3; 2] {
    let helper = if direction.z.abs() < 0.7 {
        DVec3::Z
    } else {
        DVec3::X
    };
    let first = direction.cross(helper).normalize();
    [first, direction.cross(first)]
}

#[cfg(test)]
mod tests {
    use super::{hemisphere, tangents};
    use glam::DVec3;

    #[test]
    fn every_direction_has_a_near_neighbour() {
        let all: Vec<DVec3> = hemisphere(120).collect();
        assert_eq!(all.len(), 120);
        for probe in hemisphere(1001) {
            let nearest = all.iter().map(|d| d.dot(probe).abs()).fold(0.0, f64::max);
            assert!(nearest.acos().to_degrees() < 11.0, "{probe}");
        }
    }

    #[test]
    fn tangents_are_orthonormal() {
        for t in hemisphere(50) {
            let [a, b] = tangents(t);
            for (p, q, expected) in [(a, b, 0.0), (a, t, 0.0), (b, t, 0.0), (a, a, 1.0)] {
                assert!((p.dot(q) - expected).abs() < 1e-12);
            }
        }
    }
}
