//! Triangles into pixels, the nearest seen.

use glam::{Vec2, Vec3};

use crate::grid::Grid;

/// A corner as it is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Place in the picture, in pixels.
    pub at: Vec2,
    /// Nearness: the greater is seen.
    pub near: f32,
    /// Linear light.
    pub light: Vec3,
}

/// A picture in linear light with a depth for each pixel.
pub(super) struct Raster {
    /// What is seen; not-a-number where nothing is.
    pub light: Grid<Vec3>,
    near: Grid<f32>,
}

impl Raster {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            light: Grid::new(width, height, Vec3::NAN),
            near: Grid::new(width, height, f32::NEG_INFINITY),
        }
    }

    /// Draws what `other` shows nearer.
    pub fn add(&mut self, other: Self) {
        let mine = self.light.data_mut().iter_mut().zip(self.near.data_mut());
        let theirs = other.light.data().iter().zip(other.near.data());
        for ((light, near), (&other_light, &other_near)) in mine.zip(theirs) {
            if other_near > *near {
                (*light, *near) = (other_light, other_near);
            }
        }
    }

    /// Draws a triangle, whichever way it is turned.
    pub fn triangle(&mut self, [a, b, c]: [Corner; 3]) {
        let area = (b.at - a.at).perp_dot(c.at - a.at);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let low = a.at.min(b.at).min(c.at).ceil().max(Vec2::ZERO);
        let last = Vec2::new(
            self.near.width() as f32 - 1.0,
            self.near.height() as f32 - 1.0,
        );
        let high = a.at.max(b.at).max(c.at).floor().min(last);
        if low.x > high.x || low.y > high.y {
            return;
        }
        for y in low.y as usize..=high.y as usize {
            for x in low.x as usize..=high.x as usize {
                let p = Vec2::new(x as f32, y as f32);
                let wa = (b.at - p).perp_dot(c.at - p) / area;
                let wb = (c.at - p).perp_dot(a.at - p) / area;
                let wc = 1.0 - wa - wb;
                // A hair over the edge, so that no pixel falls between two triangles.
                if wa.min(wb).min(wc) < -1e-4 {
                    continue;
                }
                let near = wa * a.near + wb * b.near + wc * c.near;
                if near > self.near[(x, y)] {
                    self.near[(x, y)] = near;
                    self.light[(x, y)] = wa * a.light + wb * b.light + wc * c.light;
                }
            }
        }
    }
}
