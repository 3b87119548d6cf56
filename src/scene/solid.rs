//! Solids, and where a ray meets them.
//!
//! A solid lives in a frame of its own: x right, y down, z away, centred on the origin unless said
//! otherwise. A ray is o + t d with t > 0; d need not be of unit length, and t counts in lengths of d,
//! so that it survives a rigid change of frame and, for camera rays with d.z = 1, is the depth Z.

use glam::DVec3;

use super::terrain::Terrain;

/// A shape without place or colour.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// The box |x| ≤ h.x, |y| ≤ h.y, |z| ≤ h.z.
    Cuboid(DVec3),
    /// The ellipsoid with these half axes.
    Ellipsoid(DVec3),
    /// The plane y = 0, seen from above (y < 0).
    Floor,
    /// A cylinder round the y axis, with flat ends.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Half its height.
        half: f64,
    },
    /// A land of hills y = −height(x, z).
    Terrain(Terrain),
}

/// Where a ray first meets a solid.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// How far along the ray.
    pub t: f64,
    /// The outward normal, of unit length.
    pub normal: DVec3,
}

impl Solid {
    /// The same, `share` times as large; what has no end stays as it is.
    pub fn scaled(self, share: f64) -> Self {
        match self {
            Solid::Cuboid(half) => Solid::Cuboid(half * share),
            Solid::Ellipsoid(radii) => Solid::Ellipsoid(radii * share),
            Solid::Cylinder { radius, half } => Solid::Cylinder {
                radius: radius * share,
                half: half * share,
            },
            Solid::Floor | Solid::Terrain(_) => self,
        }
    }

    /// The first meeting of the ray o + t d with t > 0, o outside the solid. Marching through terrain
    /// starts at `from`, which a caller who knows that nothing is nearer sets above 0.
    pub fn hit(&self, o: DVec3, d: DVec3, from: f64) -> Option<Hit> {
        match self {
            &Solid::Cuboid(half) => hit_cuboid(half, o, d),
            &Solid::Ellipsoid(radii) => hit_ellipsoid(radii, o, d),
            Solid::Floor => {
                let t = -o.y / d.y;
                (d.y > 0.0 && t > 0.0).then_some(Hit {
                    t,
                    normal: DVec3::NEG_Y,
                })
            }
            &Solid::Cylinder { radius, half } => hit_cylinder(radius, half, o, d),
            Solid::Terrain(terrain) => terrain.hit(o, d, from),
        }
    }

    /// Radius of a sphere round the origin that holds the solid; infinite for floors and terrain.
    pub fn bound(&self) -> f64 {
        match *self {
            Solid::Cuboid(half) => half.length(),
            Solid::Ellipsoid(radii) => radii.max_element(),
            Solid::Cylinder { radius, half } => radius.hypot(half),
            Solid::Floor | Solid::Terrain(_) => f64::INFINITY,
        }
    }
}

fn hit_cuboid(half: DVec3, o: DVec3, d: DVec3) -> Option<Hit> {
    let inverse = d.recip();
    let centre = -o * inverse;
    let reach = half * inverse.abs();
    let (enter, leave) = (centre - reach, centre + reach);
    let t = enter.max_element();
    if t <= 0.0 || t > leave.min_element() {
        return None;
    }
    let normal = if enter.x == t {
        DVec3::X
    } else if enter.y == t {
        DVec3::Y
    } else {
        DVec3::Z
    };
    let normal = if normal.dot(d) > 0.0 { -normal } else { normal };
    Some(Hit { t, normal })
}

fn hit_ellipsoid(radii: DVec3, o: DVec3, d: DVec3) -> Option<Hit> {
    // A unit sphere once space is squeezed.
    let (so, sd) = (o / radii, d / radii);
    let a = sd.length_squared();
    let b = so.dot(sd);
    let inside = b * b - a * (so.length_squared() - 1.0);
    if inside < 0.0 {
        return None;
    }
    let t = (-b - inside.sqrt()) / a;
    (t > 0.0).then(|| Hit {
        t,
        normal: ((so + sd * t) / radii).normalize(),
    })
}

fn hit_cylinder(radius: f64, half: f64, o: DVec3, d: DVec3) -> Option<Hit> {
    let a = d.x * d.x + d.z * d.z;
    let b = o.x * d.x + o.z * d.z;
    let inside = b * b - a * (o.x * o.x + o.z * o.z - radius * radius);
    if inside > 0.0 {
        let t = (-b - inside.sqrt()) / a;
        if t > 0.0 && (o.y + t * d.y).abs() <= half {
            let p = o + d * t;
            return Some(Hit {
                t,
                normal: DVec3::new(p.x, 0.0, p.z) / radius,
            });
        }
    }
    let side = -d.y.signum();
    let t = (side * half - o.y) / d.y;
    let (x, z) = (o.x + t * d.x, o.z + t * d.z);
    (t > 0.0 && x * x + z * z <= radius * radius).then_some(Hit {
        t,
        normal: DVec3::Y * side,
    })
}
