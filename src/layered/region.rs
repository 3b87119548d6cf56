//! What is known of one region.

use super::estimate::{NormalEquations, Outcome, PlanarFlow, State, Surface};
use super::label::LENGTH_OF_PULL;
use crate::window::Window;

/// One region: the background or the inside of a curve.
pub(crate) struct Region {
    /// Its image motion as a plane, before depth is looked for.
    pub flow: PlanarFlow,
    /// Its motion and surface.
    pub state: State,
    pub model: crate::motion::Kind,
    /// Other models that explain it nearly as well.
    pub alternatives: Vec<(crate::motion::Kind, State)>,
    /// What the last step left.
    pub outcome: Outcome,
    pub equations: NormalEquations,
    /// Whether the equations are those of the state, the labels and the scale as they are.
    pub fresh: bool,
    /// Pixels of the scale at work around what it owns; `None` when it owns nothing.
    pub window: Option<Window>,
    /// The same around what it owns and what is offered to it.
    pub reach: Option<Window>,
    /// Whether a second explanation, its mirror image, fits as well.
    pub ambiguous: bool,
}

impl Region {
    pub fn new(surface: Surface) -> Self {
        let _ = LENGTH_OF_PULL;
        Self {
            flow: PlanarFlow::default(),
            state: State::still(surface),
            model: crate::motion::Kind::Full,
            alternatives: Vec::new(),
            outcome: Outcome::default(),
            equations: NormalEquations::default(),
            fresh: false,
            window: None,
            reach: None,
            ambiguous: false,
        }
    }
}
