//! What is known of one region.

use super::estimate::{Estimator, PlanarFlow, State, Surface};
use crate::grid::Grid;
use crate::motion_model::MotionModel;
use crate::window::Window;

/// One region: the background or the inside of a curve.
pub(super) struct Region {
    /// Its image motion as a plane, before depth is looked for.
    pub flow: PlanarFlow,
    /// Its motion and surface.
    pub state: State,
    /// Other models and directions that explain it nearly as well.
    pub alternatives: Vec<State>,
    /// Whether one of them explains it as well.
    pub ambiguous: bool,
    pub estimator: Estimator,
    /// Whether its equations are those of the state, the labels and the scale as they are.
    pub fresh: bool,
    /// Pixels of the scale at work around what it owns; `None` when it owns nothing.
    pub window: Option<Window>,
    /// The same around what it owns and what is offered to it.
    pub reach: Option<Window>,
    /// ρ pixel by pixel at the frame's size, where depth has steps.
    pub dense: Option<Grid<f32>>,
    /// Whether a rigid motion fits it, as far as matches tell.
    pub rigid: bool,
    /// The region with which one motion explains it as well.
    pub part_of: Option<usize>,
    /// Whether it hides a part of the background.
    pub hides: bool,
}

impl Region {
    /// Nothing is known yet.
    pub fn new(surface: Surface) -> Self {
        Self {
            flow: PlanarFlow::default(),
            state: State {
                model: MotionModel::Full,
                ..State::still(surface)
            },
            alternatives: Vec::new(),
            ambiguous: false,
            estimator: Estimator::default(),
            fresh: false,
            window: None,
            reach: None,
            dense: None,
            rigid: true,
            part_of: None,
            hides: false,
        }
    }

    /// ρ at a pixel of the frame.
    pub fn rho(&self, x: usize, y: usize) -> f32 {
        match &self.dense {
            Some(dense) => dense[(x, y)],
            None => self.state.surface.at(x as f32, y as f32),
        }
    }
}
