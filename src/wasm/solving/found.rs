//! What a solver has found so far: pictures, numbers, files.

use std::rc::Rc;

use js_sys::{Array, Float32Array, Uint8Array};
use serde::Serialize;
use tsify::Tsify;
use wasm_bindgen::prelude::wasm_bindgen;

use super::files::{self, listed};
use super::shown::{Drawn, Shown};
use super::{Json, Mesh, Picture, Solver, Word, write};
use crate::curves::Contour;
use crate::error::Error;
use crate::file::motion::{MotionFile, RegionMotion, Seconds};
use crate::file::{png, result};
use crate::interpretation::Interpretation;
use crate::probe::probe_of;
use crate::solver::Report;
use crate::view::ViewParams;

/// Views that are saved with the results, and under which names.
pub(super) const PICTURES: [(&str, &str); 6] = [
    ("segmentation", "segmentation.png"),
    ("depth", "depth.png"),
    ("relief", "relief.png"),
    ("flow", "flow.png"),
    ("anaglyph", "anaglyph.png"),
    ("confidence", "confidence.png"),
];

/// Pixels of what is written at most: four of WebAssembly's gigabytes hold no more.
const LARGEST: usize = 25_000_000;
/// Pixels of `relief.png` at most: its surface has fewer vertices than that.
const RELIEF: usize = 2_000_000;

/// A curve as the solver has moved it.
#[derive(Serialize, Tsify)]
#[tsify(rename = "Contour")]
struct Outline<'a> {
    /// 0 for the background, k for the k-th curve.
    label: u8,
    /// Whether its end meets its start.
    closed: bool,
    /// x, y, x, y, … in pixels.
    #[tsify(type = "number[]")]
    points: &'a [f32],
}

impl<'a> Outline<'a> {
    fn of(contour: &'a Contour) -> Self {
        Self {
            label: contour.label,
            closed: contour.closed,
            points: contour.points.as_flattened(),
        }
    }
}

#[wasm_bindgen]
impl Solver {
    /// The curves: `Contour[]` as JSON.
    pub fn contours(&self) -> String {
        write(&self.curves().iter().map(Outline::of).collect::<Vec<_>>())
    }

    /// A picture of what is found so far: one of `viewCatalogue()`, with parameters of its own.
    pub fn view(&self, kind: &Word, params: &Json) -> Result<Picture, Error> {
        self.picture(&kind.view()?, &params.view_params()?)
    }

    /// What is found at a pixel: a `Probe` as JSON, `null` outside the frame. `params` are those of a view.
    pub fn probe(&self, x: usize, y: usize, params: &Json) -> Result<String, Error> {
        let params = params.view_params()?;
        let pair = self.solver().pair();
        if x >= pair.width() || y >= pair.height() {
            return Ok("null".to_owned());
        }
        let pixel = self.solver().pixel(self.worked(), (x, y));
        Ok(write(&probe_of(pair, pixel, &params.scales, (x, y))))
    }

    /// What the colours of a picture stand for: a `Legend` as JSON, `null` where they are no measure.
    pub fn legend(&self, kind: &Word, params: &Json) -> Result<String, Error> {
        self.drawn(&params.view_params()?).legend(&kind.view()?)
    }

    /// The relief, with the parameters of a view as JSON.
    pub fn mesh(&self, params: &Json) -> Result<Mesh, Error> {
        Ok(Mesh(self.drawn(&params.view_params()?).mesh().0))
    }

    /// Everything found, as an array of files `{name, bytes}`. `params` are those of [`Solver::view`]. Of frames of more than
    /// 25 megapixels all is written as of the frames shrunk until they have no more.
    #[wasm_bindgen(unchecked_return_type = "{ name: string; bytes: Uint8Array<ArrayBuffer> }[]")]
    pub fn files(&self, params: &Json) -> Result<Array, Error> {
        let mut params = params.view_params()?;
        params.pixels = params.pixels.or(Some(LARGEST));
        let mut files = self.written(&params, |found| {
            result::write(found, &self.motion_file(found))
        })?;
        for (kind, name) in PICTURES {
            let mut params = params.clone();
            if kind == "relief" {
                params.pixels = params.pixels.map(|most| most.min(RELIEF));
            }
            files.push((name, png::write_rgba(&self.picture(kind, &params)?.0)?));
        }
        Ok(listed(files))
    }

    /// One of those that measure, `labels.png`, `depth.pfm`, `depth16.png`, `flow.flo`, `occlusion.png`, `motion.json`, as large
    /// as [`Solver::files`] has them; or the relief under the first frame, `relief.glb`, or with a colour for each vertex,
    /// `relief.ply`, of at most `pixels`.
    #[wasm_bindgen(unchecked_return_type = "Uint8Array<ArrayBuffer>")]
    pub fn file(&self, name: &Word, params: &Json) -> Result<Uint8Array, Error> {
        let mut params = params.view_params()?;
        params.pixels = params.pixels.or(Some(LARGEST));
        let name = name.text("name of the file")?;
        self.written(&params, |found| {
            files::one(&name, found, &self.motion_file(found), || {
                self.drawn(&params).mesh()
            })
        })
    }

    /// 0 where the background is seen, k inside the k-th curve; row order.
    pub fn labels(&self) -> Uint8Array {
        Uint8Array::from(self.found().labels.data())
    }

    /// Z in row order, in units of its own for each region.
    pub fn depth(&self) -> Float32Array {
        Float32Array::from(self.found().depth.data())
    }

    /// How far depth is observable, 0–1, in row order.
    pub fn confidence(&self) -> Float32Array {
        Float32Array::from(self.found().confidence.data())
    }

    /// Image motion to the right in pixels per frame, in row order.
    #[wasm_bindgen(js_name = flowU)]
    pub fn flow_u(&self) -> Float32Array {
        Float32Array::from(self.found().flow.u.data())
    }

    /// Image motion downwards in pixels per frame, in row order.
    #[wasm_bindgen(js_name = flowV)]
    pub fn flow_v(&self) -> Float32Array {
        Float32Array::from(self.found().flow.v.data())
    }
}

impl Solver {
    pub(super) fn shown(&self) -> Shown {
        Shown {
            pair: self.solver().frames_shrunk(1),
            found: self.found().clone(),
        }
    }

    fn curves(&self) -> &[Contour] {
        (self.curves).get_or_init(|| self.solver().contours_of(self.worked()))
    }

    fn worked(&self) -> &Rc<Interpretation> {
        (self.worked).get_or_init(|| Rc::new(self.solver().worked()))
    }

    pub(super) fn found(&self) -> &Rc<Interpretation> {
        self.found.get_or_init(|| self.resized(1))
    }

    fn resized(&self, n: usize) -> Rc<Interpretation> {
        let worked = self.worked();
        if n == self.solver().worked_shrunk() {
            return worked.clone();
        }
        Rc::new(self.solver().resized(worked, n))
    }

    /// Does something with what files are written of, whatever size pictures are asked for.
    fn written<T>(&self, params: &ViewParams, write: impl FnOnce(&Interpretation) -> T) -> T {
        let n = self.solver().shrunk_for(LARGEST);
        let shrunk;
        let found = if n == 1 {
            self.found()
        } else {
            shrunk = self.found_shrunk(n);
            &shrunk
        };
        if params.scales.iter().all(|&s| s == 1.0) {
            write(found)
        } else {
            write(&found.scaled(&params.scales))
        }
    }

    fn found_shrunk(&self, n: usize) -> Rc<Interpretation> {
        if n == 1 {
            return self.found().clone();
        }
        if n == self.solver().worked_shrunk() {
            return self.worked().clone();
        }
        let mut shrunk = self.shrunk.borrow_mut();
        match &*shrunk {
            Some((last, found)) if *last == n => found.clone(),
            _ => {
                let found = self.resized(n);
                *shrunk = Some((n, found.clone()));
                found
            }
        }
    }

    /// Frames and what is found of them, as large as a picture is to be drawn.
    fn drawn(&self, params: &ViewParams) -> Drawn {
        let solver = self.solver();
        let n = params.pixels.map_or(1, |most| solver.shrunk_for(most));
        Drawn::of(
            n,
            solver.frames_shrunk(n),
            self.found_shrunk(n),
            params.clone(),
        )
    }

    fn picture(&self, kind: &str, params: &ViewParams) -> Result<Picture, Error> {
        // No other view shows curves.
        let contours = if kind == "segmentation" {
            self.curves()
        } else {
            &[]
        };
        self.drawn(params).picture(kind, contours)
    }

    fn motion_file(&self, found: &Interpretation) -> MotionFile {
        let Report {
            iterations,
            history,
            seconds,
            regions,
            ..
        } = self.solver().report();
        let models: Vec<_> = regions.iter().map(|region| region.model).collect();
        let mut motions = RegionMotion::list(&found.motions, &models);
        for (motion, region) in motions.iter_mut().zip(&regions) {
            motion.rigid = (!region.rigid).then_some(false);
        }
        MotionFile {
            regions: motions,
            status: self.status(),
            iterations,
            energy: history,
            seconds: Seconds {
                total: seconds.total,
                motion: seconds.steps.motion,
                depth: seconds.steps.depth,
                curves: seconds.steps.curves,
            },
            depth_scale: None,
        }
    }
}
