//! How a region's ρ bends: what its smoothness acts on.
//!
//! The steps of ρ to the right and down, less those that are expected: a line through ρ's own steps over some pixels
//! around ([`local_line`]), and where the region has no pixels those of a plane that is given. Slanted and gently
//! curved surfaces bend next to not at all, up to the region's curve; folds and steps do.

use super::local_line::local_line;
use crate::grid::Grid;

/// How the steps of a field to the right and down differ from those expected of it.
#[derive(Clone, Debug)]
pub struct Bends {
    /// To the right; 0 in the last column.
    pub(super) right: Grid<f32>,
    /// Down; 0 in the last row.
    pub(super) down: Grid<f32>,
}

impl Bends {
    /// All steps of `field`, none being expected.
    pub fn of(field: &Grid<f32>) -> Self {
        let (width, height) = (field.width(), field.height());
        let step = |x: usize, y: usize, nx: usize, ny: usize| {
            if nx < width && ny < height {
                field[(nx, ny)] - field[(x, y)]
            } else {
                0.0
            }
        };
        Self {
            right: Grid::from_fn(width, height, |x, y| step(x, y, x + 1, y)),
            down: Grid::from_fn(width, height, |x, y| step(x, y, x, y + 1)),
        }
    }

    /// What is left of the steps of `rho` after those that `owned` pixels around let expect; where there are none,
    /// after `slope`, per pixel to the right and down. `reach` is the standard deviation of "around", in pixels.
    pub fn about_slope(rho: &Grid<f32>, owned: &Grid<f32>, slope: [f64; 2], reach: f64) -> Self {
        let steps = Self::of(rho);
        let (width, height) = (rho.width(), rho.height());
        let bent = |steps: &Grid<f32>, ahead: (usize, usize), slope: f64| {
            let slope = slope as f32;
            let within = |x: usize, y: usize| x + ahead.0 < width && y + ahead.1 < height;
            let weight = Grid::from_fn(width, height, |x, y| {
                if within(x, y) {
                    owned[(x, y)] * owned[(x + ahead.0, y + ahead.1)]
                } else {
                    0.0
                }
            });
            let mut beyond = steps.clone();
            for (b, w) in beyond.data_mut().iter_mut().zip(weight.data()) {
                *b = w * (*b - slope);
            }
            let expected = local_line(&weight, &beyond, reach);
            Grid::from_fn(width, height, |x, y| {
                if within(x, y) {
                    steps[(x, y)] - slope - expected[(x, y)]
                } else {
                    0.0
                }
            })
        };
        Self {
            right: bent(&steps.right, (1, 0), slope[0]),
            down: bent(&steps.down, (0, 1), slope[1]),
        }
    }
}
