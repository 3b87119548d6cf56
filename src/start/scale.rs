//! Two frames at one scale, with the gradients that patches are matched by.

use crate::camera::Camera;
use crate::frames::gradient;
use crate::grid::Grid;

/// No coarser scale has a side shorter than this, pixels.
pub(super) const SMALLEST: usize = 28;

/// Two frames at one scale.
#[derive(Clone, Debug)]
pub struct Scale {
    /// The camera at this scale.
    pub camera: Camera,
    /// Brightness of the first frame.
    pub first: Grid<f32>,
    /// Brightness of the second frame.
    pub second: Grid<f32>,
    /// ∂/∂x and ∂/∂y of the first frame.
    pub first_gradient: (Grid<f32>, Grid<f32>),
    /// ∂/∂x and ∂/∂y of the second frame.
    pub second_gradient: (Grid<f32>, Grid<f32>),
}

impl Scale {
    /// Prepares two frames of the same size.
    pub fn new(camera: Camera, first: Grid<f32>, second: Grid<f32>) -> Self {
        Self {
            first_gradient: gradient(&first),
            second_gradient: gradient(&second),
            camera,
            first,
            second,
        }
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.first.width()
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.first.height()
    }
}
