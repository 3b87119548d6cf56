//! The solver on two frames.

use js_sys::{Float32Array, Uint8Array};
use serde::Deserialize;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

use super::{Frame, read, write};
use crate::camera::Camera;
use crate::curves::Shape;
use crate::error::Error;
use crate::frames::FramePair;
use crate::options::Options;

#[wasm_bindgen]
extern "C" {
    /// Milliseconds since some moment; workers and Node have it.
    #[wasm_bindgen(js_namespace = performance, js_name = now)]
    fn milliseconds() -> f64;
}

/// A camera as JavaScript writes it: without a principal point it looks at the centre.
#[derive(Deserialize)]
struct CameraJson {
    focal: f64,
    cx: Option<f64>,
    cy: Option<f64>,
}

/// Finds regions, motions and depth of two frames.
#[wasm_bindgen]
pub struct Solver(pub(super) crate::Solver);

#[wasm_bindgen]
impl Solver {
    /// A solver at its start. `camera` is `{"focal", "cx"?, "cy"?}`, `shapes` an array of
    /// `{"kind": "circle", "x", "y", "r"}` and `{"kind": "polygon", "points": [[x, y], …]}`, `options`
    /// an object of what differs from the preset; all three are JSON.
    #[wasm_bindgen(constructor)]
    pub fn new(
        first: &Frame,
        second: &Frame,
        camera: &str,
        shapes: &str,
        options: &str,
    ) -> Result<Solver, JsError> {
        let pair = FramePair::new(first.0.clone(), second.0.clone())?;
        let camera = camera_of(&pair, camera)?;
        let shapes: Vec<Shape> = read("curves", shapes)?;
        let options = Options::from_json(options)?;
        let mut solver = crate::Solver::new(pair, camera, &shapes, options)?;
        solver.set_clock(|| milliseconds() / 1000.0);
        Ok(Self(solver))
    }

    /// One pass, motion → depth → curves: `running`, `converged`, `exhausted` or `diverged`.
    pub fn step(&mut self) -> String {
        self.0.step();
        self.status()
    }

    /// Step 1 alone.
    #[wasm_bindgen(js_name = stepMotion)]
    pub fn step_motion(&mut self) {
        self.0.step_motion();
    }

    /// Step 2 alone.
    #[wasm_bindgen(js_name = stepDepth)]
    pub fn step_depth(&mut self) {
        self.0.step_depth();
    }

    /// Step 3 alone.
    #[wasm_bindgen(js_name = stepCurves)]
    pub fn step_curves(&mut self) {
        self.0.step_curves();
    }

    /// Back to the start, with the curves and options as they were set last.
    pub fn reset(&mut self) {
        self.0.reset();
    }

    /// Where it stands: `running`, `converged`, `exhausted` or `diverged`.
    #[wasm_bindgen(getter)]
    pub fn status(&self) -> String {
        write(&self.0.status()).trim_matches('"').to_owned()
    }

    /// Changes options while it runs; on an error they stay.
    #[wasm_bindgen(js_name = setOptions)]
    pub fn set_options(&mut self, options: &str) -> Result<(), JsError> {
        Ok(self.0.set_options(Options::from_json(options)?)?)
    }

    /// Changes the curves while it runs; on an error they stay.
    #[wasm_bindgen(js_name = setCurves)]
    pub fn set_curves(&mut self, shapes: &str) -> Result<(), JsError> {
        let shapes: Vec<Shape> = read("curves", shapes)?;
        Ok(self.0.set_curves(&shapes)?)
    }

    /// Status, energy, regions, weights, warnings and times, as JSON.
    pub fn report(&self) -> String {
        write(&self.0.report())
    }

    /// 0 where the background is seen, k inside the k-th curve; row order.
    pub fn labels(&self) -> Uint8Array {
        Uint8Array::from(self.0.interpretation().labels.data())
    }

    /// Z in row order, in units of its own for each region.
    pub fn depth(&self) -> Float32Array {
        Float32Array::from(self.0.interpretation().depth.data())
    }

    /// How far depth is observable, 0–1, in row order.
    pub fn confidence(&self) -> Float32Array {
        Float32Array::from(self.0.interpretation().confidence.data())
    }

    /// Image motion to the right in pixels per frame, in row order.
    #[wasm_bindgen(js_name = flowU)]
    pub fn flow_u(&self) -> Float32Array {
        Float32Array::from(self.0.interpretation().flow.u.data())
    }

    /// Image motion downwards in pixels per frame, in row order.
    #[wasm_bindgen(js_name = flowV)]
    pub fn flow_v(&self) -> Float32Array {
        Float32Array::from(self.0.interpretation().flow.v.data())
    }
}

fn camera_of(pair: &FramePair, json: &str) -> Result<Camera, Error> {
    let given: CameraJson = read("camera", json)?;
    let mut camera = Camera::centred(given.focal, pair.width(), pair.height())?;
    camera.cx = given.cx.unwrap_or(camera.cx);
    camera.cy = given.cy.unwrap_or(camera.cy);
    Camera::new(camera.focal, camera.cx, camera.cy)
}
