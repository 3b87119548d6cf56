//! The solver on two frames.

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

use js_sys::Reflect;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::wasm_bindgen;
use web_sys::Performance;

use super::camera::camera_of;
use super::{Frame, Json, write};
use crate::curves::{Contour, Shape};
use crate::error::Error;
use crate::frames::FramePair;
use crate::interpretation::Interpretation;
use crate::options::Options;

/// Seconds since some moment, 0 where there is no clock. Windows, workers and Node all have one, under this name.
fn now() -> f64 {
    thread_local! {
        static CLOCK: Option<Performance> = Reflect::get(&js_sys::global(), &"performance".into())
            .ok()
            .filter(|clock| clock.is_object())
            .map(JsCast::unchecked_into);
    }
    CLOCK.with(|clock| clock.as_ref().map_or(0.0, |clock| clock.now() / 1000.0))
}

/// Finds regions, motions and depth of two frames.
#[wasm_bindgen]
pub struct Solver {
    solver: crate::Solver,
    /// What it has found, as it is worked on, asked for by several views of the same pass.
    pub(super) worked: OnceCell<Rc<Interpretation>>,
    /// The same at the size of the frames.
    pub(super) found: OnceCell<Rc<Interpretation>>,
    /// The same on frames shrunk so many times, the last that was drawn on.
    pub(super) shrunk: RefCell<Option<(usize, Rc<Interpretation>)>>,
    /// Its curves.
    pub(super) curves: OnceCell<Vec<Contour>>,
}

#[wasm_bindgen]
impl Solver {
    /// A solver at its start. `camera` is `{"focal", "cx"?, "cy"?}`, `shapes` an array of
    /// `{"kind": "circle", "x", "y", "r"}` and `{"kind": "polygon", "points": [[x, y], …]}`, `options`
    /// an object of what differs from the preset, `"preset": "best"` where it names none; all three as
    /// JSON or as they are.
    #[wasm_bindgen(constructor)]
    pub fn new(
        first: &Frame,
        second: &Frame,
        camera: &Json,
        shapes: &Json,
        options: &Json,
    ) -> Result<Solver, Error> {
        let pair = FramePair::new(first.0.clone(), second.0.clone())?;
        let camera = camera_of(&pair, camera)?;
        let shapes: Vec<Shape> = shapes.list("curves")?;
        let options = Options::from_json(&options.text("options")?)?;
        let mut solver = crate::Solver::new(pair, camera, &shapes, options)?;
        solver.set_clock(now);
        Ok(Self {
            solver,
            worked: OnceCell::new(),
            found: OnceCell::new(),
            shrunk: RefCell::default(),
            curves: OnceCell::new(),
        })
    }

    /// One pass, motion → depth → curves: `running`, `converged`, `exhausted` or `diverged`.
    #[wasm_bindgen(unchecked_return_type = "Status")]
    pub fn step(&mut self) -> String {
        self.change().step();
        self.status()
    }

    /// Step 1 alone.
    #[wasm_bindgen(js_name = stepMotion)]
    pub fn step_motion(&mut self) {
        self.change().step_motion();
    }

    /// Step 2 alone.
    #[wasm_bindgen(js_name = stepDepth)]
    pub fn step_depth(&mut self) -> Result<(), Error> {
        self.change().step_depth()
    }

    /// Step 3 alone.
    #[wasm_bindgen(js_name = stepCurves)]
    pub fn step_curves(&mut self) {
        self.change().step_curves();
    }

    /// Back to the start, with the curves and options as they were set last.
    pub fn reset(&mut self) {
        self.change().reset();
    }

    /// Takes the following frame of the film: the second becomes the first, and what was found is the first guess for
    /// the new pair. Curves keep their numbers, and a solver that had stopped goes on. `frame` stays as it is; on an
    /// error the solver does, too.
    pub fn next(&mut self, frame: &Frame) -> Result<(), Error> {
        self.change().next(frame.0.clone())
    }

    /// The first frame as it is shown and solved: both are stretched alike where they use few levels.
    pub fn first(&self) -> Frame {
        Frame(self.solver.pair().first().clone())
    }

    /// The second frame, the same way.
    pub fn second(&self) -> Frame {
        Frame(self.solver.pair().second().clone())
    }

    /// Where it stands: `running`, `converged`, `exhausted` or `diverged`.
    #[wasm_bindgen(getter, unchecked_return_type = "Status")]
    pub fn status(&self) -> String {
        write(&self.solver.status()).trim_matches('"').to_owned()
    }

    /// Changes options while it runs; on an error they stay.
    #[wasm_bindgen(js_name = setOptions)]
    pub fn set_options(&mut self, options: &Json) -> Result<(), Error> {
        self.change()
            .set_options(Options::from_json(&options.text("options")?)?)
    }

    /// Changes the curves while it runs; on an error they stay.
    #[wasm_bindgen(js_name = setCurves)]
    pub fn set_curves(&mut self, shapes: &Json) -> Result<(), Error> {
        let shapes: Vec<Shape> = shapes.list("curves")?;
        self.change().set_curves(&shapes)
    }

    /// Status, energy, regions, weights, warnings and times: a `Report` as JSON.
    pub fn report(&self) -> String {
        write(&self.solver.report())
    }
}

impl Solver {
    pub(super) fn solver(&self) -> &crate::Solver {
        &self.solver
    }

    pub(super) fn change(&mut self) -> &mut crate::Solver {
        self.worked.take();
        self.found.take();
        self.shrunk.take();
        self.curves.take();
        &mut self.solver
    }
}
