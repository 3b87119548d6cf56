//! The three steps in turn: motion, depth, curves; and what a person may do meanwhile.
//!
//! Only this module knows the order of the steps; none of them calls another. A pass is
//! motion → depth → curves, and ends with the curves, taken singly or not; `history.rs` says when it stops.

mod approach;
mod find;
mod history;
mod report;
mod state;
mod weights;

pub(crate) use approach::{Approach, Next};
pub use find::find_curves;
pub use history::Status;
pub use report::{Expected, LastPass, RegionReport, Report, Seconds, Stage};
pub use weights::Weights;

use std::cell::RefCell;
use std::rc::Rc;

use history::History;

use crate::camera::Camera;
use crate::curves::{Contour, Shape, contours, differing, smoothed};
use crate::energy::Energy;
use crate::error::Error;
use crate::frames::{Frame, FramePair, shrunk_camera, shrunk_colours};
use crate::grid::Grid;
use crate::interpretation::{Interpretation, Pixel};
use crate::layered::Layered;
use crate::options::{Options, Preset};
use crate::paper::Paper;
use crate::window::Window;
use crate::working::{Upsampling, Working, downsampled, factor_to_draw};

/// Finds regions, motions and depth of a pair of frames.
///
/// Frames, camera and curves are given, and results told, in pixels of the frames as they are; the option *Detail* says at
/// what size they are worked on.
///
/// ```
/// use relievo::options::Preset;
/// use relievo::{FramePair, Options, Solver, Status, scene};
///
/// let film = scene::render_film("blocks", 64, 48, 3)?;
/// let [first, second, third] = [0, 1, 2].map(|i| film.frames[i].clone());
/// let pair = FramePair::new(first, second)?;
/// let camera = film.truths[0].camera;
/// let mut solver = Solver::new(pair, camera, &film.curves, Options::default())?;
///
/// // A pass at a time; what has been found so far can be looked at in between.
/// while solver.step() == Status::Running {
///     let report = solver.report();
///     println!("pass {}: energy {:.0}", report.iterations, report.energy.total);
/// }
/// assert_eq!(solver.interpretation().regions(), 3);
///
/// // The following frame, from what was found; then all of it with other settings.
/// solver.next(third)?;
/// while solver.step() == Status::Running {}
/// solver.set_options(Options::preset(Preset::Paper))?;
/// assert_eq!(solver.step(), Status::Running);
/// # Ok::<(), relievo::Error>(())
/// ```
pub struct Solver {
    pair: Rc<FramePair>,
    camera: Camera,
    working: Working,
    /// The frames last shown smaller than they are, and how many times.
    shown: RefCell<Option<(usize, Rc<FramePair>)>>,
    /// The first frame's colours where outlines are told.
    outlined: RefCell<Option<Grid<[u8; 3]>>>,
    shapes: Vec<Shape>,
    options: Options,
    approach: Box<dyn Approach>,
    status: Status,
    history: History,
    seconds: Seconds,
    clock: fn() -> f64,
}

/// Outlines of frames that were shrunk are drawn on frames of at most so many pixels.
const OUTLINED: usize = 2_000_000;

impl Solver {
    /// A solver at its start: the curves as drawn, the same depth everywhere, nothing moving.
    ///
    /// # Errors
    /// What [`Shape::level_set`] finds wrong with a curve, [`Error::TooManyCurves`], and what [`Options::validate`] finds
    /// wrong with a setting.
    pub fn new(
        pair: FramePair,
        camera: Camera,
        shapes: &[Shape],
        options: Options,
    ) -> Result<Self, Error> {
        options.validate()?;
        let camera = Camera::new(camera.focal, camera.cx, camera.cy)?;
        let pair = Rc::new(pair);
        let working = Working::new(&pair, &camera, options.detail);
        let level_sets = working.level_sets(shapes, &pair)?;
        Ok(Self {
            approach: begin(&working, level_sets, &options),
            pair,
            camera,
            working,
            shown: RefCell::default(),
            outlined: RefCell::default(),
            shapes: shapes.to_vec(),
            options,
            status: Status::Running,
            history: History::default(),
            seconds: Seconds::default(),
            clock: || 0.0,
        })
    }

    /// Gives the solver a clock, in seconds; without one the times in its report stay 0. (The core has
    /// none of its own: WebAssembly offers none.)
    pub fn set_clock(&mut self, clock: fn() -> f64) {
        self.clock = clock;
    }

    /// One pass: motion → depth → curves. Does nothing once the solver has stopped.
    pub fn step(&mut self) -> Status {
        if self.status == Status::Running {
            self.step_motion();
            self.find_depth();
            self.step_curves();
        }
        self.status
    }

    /// Counts a pass whose steps have been taken; `before` is who owned which pixel.
    fn end_pass(&mut self, before: &Grid<u8>) {
        let energy = self.energy().total();
        let changed = differing(before.data(), self.approach.labels().data());
        let (level, _) = self.approach.scale();
        self.history.last = Some(LastPass {
            stage: self.approach.stage(),
            level,
            changed: self.in_frame(changed, level),
            taken_back: self.approach.taken_back(),
            adopted: self.approach.adopted(),
        });
        let changed = changed as f64 / before.len() as f64;
        let still = self.history.enter(energy, changed, self.options.tolerance);
        let next = self.approach.end_pass(changed, still, &self.options);
        self.status = self.history.leave(next, &self.options);
    }

    /// How many pixels of the frames so many of a scale stand for.
    fn in_frame(&self, pixels: usize, level: usize) -> usize {
        (pixels << (2 * level)) * self.working.factor.pow(2)
    }

    /// Takes the following frame of the film: the second frame becomes the first. Curves, motions and depth as they are
    /// carry over as the first guess, and a solver that had stopped goes on. Curves are numbered as before.
    ///
    /// # Errors
    /// What [`FramePair::new`] finds wrong with the new pair; then nothing is changed.
    pub fn next(&mut self, frame: Frame) -> Result<(), Error> {
        let pair = self.pair.following(frame)?;
        self.pair = Rc::new(pair);
        self.working = Working::new(&self.pair, &self.camera, self.options.detail);
        self.shown.take();
        self.outlined.take();
        self.approach
            .advance(self.working.pair.clone(), &self.options);
        self.history.draw();
        self.resume();
        Ok(())
    }

    /// Step 1 alone: the motion of every region, for the present depth and curves.
    pub fn step_motion(&mut self) {
        let start = (self.clock)();
        self.approach.find_motions(&self.options);
        self.seconds.motion += (self.clock)() - start;
    }

    /// Step 2 alone: depth, for the present motions and curves.
    ///
    /// # Errors
    /// [`Error::Planes`] where there is no depth yet; then nothing is changed.
    pub fn step_depth(&mut self) -> Result<(), Error> {
        self.approach.check_depth()?;
        self.find_depth();
        Ok(())
    }

    fn find_depth(&mut self) {
        let start = (self.clock)();
        self.approach.find_depth(&self.options);
        self.seconds.depth += (self.clock)() - start;
    }

    /// Step 3 alone: the curves, for the present motions and depth. It ends the pass.
    pub fn step_curves(&mut self) {
        let before = self.approach.labels().clone();
        let start = (self.clock)();
        self.approach.move_curves(&self.options);
        self.seconds.curves += (self.clock)() - start;
        self.end_pass(&before);
    }

    /// The three terms of (7) as they stand.
    pub fn energy(&self) -> Energy {
        self.approach.energy(&self.options)
    }

    /// Whether there is more to do.
    pub fn status(&self) -> Status {
        self.status
    }

    /// Passes made.
    pub fn iterations(&self) -> usize {
        self.history.energies.len()
    }

    /// The total energy after each pass.
    pub fn history(&self) -> &[f64] {
        &self.history.energies
    }

    /// The frames.
    pub fn pair(&self) -> &FramePair {
        &self.pair
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Changes settings while the solver runs; curves, depth and motions stay, unless the way depth is
    /// held changes, the size worked on, or whether light may: then they start anew from the curves drawn last, since what was
    /// found in another light may be nothing to go on from. A solver that had stopped goes on.
    ///
    /// # Errors
    /// What [`Options::validate`] finds; then nothing is changed.
    pub fn set_options(&mut self, options: Options) -> Result<(), Error> {
        options.validate()?;
        let anew = options.preset != self.options.preset
            || options.detail != self.options.detail
            || options.preset == Preset::Best && options.lighting != self.options.lighting;
        self.options = options;
        if anew {
            self.reset();
        } else {
            self.approach.reconsider(&self.options);
            self.resume();
        }
        Ok(())
    }

    /// Puts the curves elsewhere while the solver runs; depth stays, and motions are found anew in the
    /// next pass. A solver that had stopped goes on.
    ///
    /// # Errors
    /// What [`Solver::new`] would find wrong with the curves; then nothing is changed.
    pub fn set_curves(&mut self, shapes: &[Shape]) -> Result<(), Error> {
        let level_sets = self.working.level_sets(shapes, &self.pair)?;
        self.shapes = shapes.to_vec();
        self.approach.replace_curves(level_sets, &self.options);
        self.history.draw();
        self.resume();
        Ok(())
    }

    /// Back to the start: the curves as drawn last, the same depth everywhere, nothing moving.
    pub fn reset(&mut self) {
        self.outlined.take();
        self.working = Working::new(&self.pair, &self.camera, self.options.detail);
        let level_sets = self.working.level_sets(&self.shapes, &self.pair);
        let level_sets = level_sets.unwrap_or_default();
        self.approach = begin(&self.working, level_sets, &self.options);
        self.history = History::default();
        self.seconds = Seconds::default();
        self.resume();
    }

    /// What the frames are taken for at present, at their size.
    pub fn interpretation(&self) -> Interpretation {
        self.interpretation_shrunk(1)
    }

    /// The same on the frames shrunk `n` times, which [`Solver::shrunk_for`] gives.
    pub fn interpretation_shrunk(&self, n: usize) -> Interpretation {
        let found = self.worked();
        if n == self.working.factor {
            return found;
        }
        self.resized(&found, n)
    }

    /// The same as it is worked on. Those at other sizes are made of it.
    pub fn worked(&self) -> Interpretation {
        let mut found = self.approach.interpretation(&self.options);
        if let Some(absent) = self.working.pair.absent() {
            let confidence = found.confidence.data_mut().iter_mut();
            let gone = confidence.zip(absent.data()).filter(|(_, a)| **a != 0);
            gone.for_each(|(c, _)| *c = 0.0);
        }
        found
    }

    /// How many times frames are shrunk for the work.
    pub fn worked_shrunk(&self) -> usize {
        self.working.factor
    }

    /// What [`Solver::worked`] gave, on the frames shrunk `n` times, which [`Solver::shrunk_for`] gives.
    pub fn resized(&self, worked: &Interpretation, n: usize) -> Interpretation {
        let camera = shrunk_camera(&self.camera, n);
        let factor = self.working.factor;
        if n < factor {
            let large = self.frames_shrunk(n);
            return self.upsampling(worked, &large, n).whole(camera);
        }
        let size = (self.pair.width() / n, self.pair.height() / n);
        downsampled(worked, size, n as f32 / factor as f32, camera)
    }

    /// What [`Solver::worked`] gave, at one pixel of the frame.
    pub fn pixel(&self, worked: &Interpretation, at: (usize, usize)) -> Pixel {
        if self.working.factor == 1 {
            worked.pixel(at)
        } else {
            self.upsampling(worked, &self.pair, 1).pixel(at)
        }
    }

    /// For frames that are shrunk `n` times, less than for the work.
    fn upsampling<'a>(
        &'a self,
        worked: &'a Interpretation,
        large: &'a FramePair,
        n: usize,
    ) -> Upsampling<'a> {
        let small = &self.working.pair.first().rgb;
        let ratio = self.working.factor as f32 / n as f32;
        Upsampling::new(worked, small, &large.first().rgb, ratio)
    }

    /// The frames shrunk `n` times, which [`Solver::shrunk_for`] gives.
    pub fn frames_shrunk(&self, n: usize) -> Rc<FramePair> {
        if n == 1 {
            return self.pair.clone();
        }
        if n == self.working.factor {
            return self.working.pair.clone();
        }
        let mut shown = self.shown.borrow_mut();
        match &*shown {
            Some((last, pair)) if *last == n => pair.clone(),
            _ => {
                let pair = Rc::new(self.pair.shrunk(n));
                *shown = Some((n, pair.clone()));
                pair
            }
        }
    }

    /// The least number by which frames can be shrunk so that they have at most `pixels`; never more than leaves 64 pixels of
    /// their shorter side, or than they are for the work.
    pub fn shrunk_for(&self, pixels: usize) -> usize {
        factor_to_draw(self.pair.first(), self.working.factor, pixels)
    }

    /// The curves as sub-pixel polylines, in the order of their labels.
    pub fn contours(&self) -> Vec<Contour> {
        if self.working.factor > 1 {
            return self.outlines(&self.worked());
        }
        self.zeros()
    }

    /// The same where [`Solver::worked`] gave `worked`.
    pub fn contours_of(&self, worked: &Interpretation) -> Vec<Contour> {
        if self.working.factor > 1 {
            self.outlines(worked)
        } else {
            self.zeros()
        }
    }

    /// Where level sets are 0.
    fn zeros(&self) -> Vec<Contour> {
        let level_sets = self.approach.level_sets();
        let numbered = level_sets.iter().zip(1..);
        numbered.flat_map(|(phi, k)| contours(phi, k)).collect()
    }

    /// The outlines of labels that were brought back to the frames, at [`OUTLINED`] pixels at most.
    fn outlines(&self, worked: &Interpretation) -> Vec<Contour> {
        let n = self.shrunk_for(OUTLINED).min(self.working.factor);
        let labels = if n == self.working.factor {
            worked.labels.clone()
        } else {
            let small = &self.working.pair.first().rgb;
            let ratio = self.working.factor as f32 / n as f32;
            let mut shrunk = self.outlined.borrow_mut();
            let large = shrunk.get_or_insert_with(|| shrunk_colours(&self.pair.first().rgb, n));
            Upsampling::new(worked, small, large, ratio).labels()
        };
        let (width, height) = (labels.width(), labels.height());
        let regions = worked.regions() as u8;
        let outlines = |k: u8| {
            let own = |i: usize| labels.data()[i] == k;
            let window = Window::around(width, height, own)?;
            // With a margin, so that an outline ends at the window's border only where the frame does.
            let (left, top) = (window.left.saturating_sub(3), window.top.saturating_sub(3));
            let right = (window.left + window.width + 3).min(width);
            let bottom = (window.top + window.height + 3).min(height);
            let inside = Grid::from_fn(right - left, bottom - top, |x, y| {
                labels[(left + x, top + y)] == k
            });
            let place = move |mut c: Contour| {
                for p in &mut c.points {
                    *p = [p[0] + left as f32, p[1] + top as f32];
                }
                c.enlarged(n)
            };
            Some(contours(&smoothed(&inside, 1.0), k).into_iter().map(place))
        };
        (1..regions).filter_map(outlines).flatten().collect()
    }

    /// Where the solver stands, in numbers.
    pub fn report(&self) -> Report {
        Report::of(self)
    }

    fn resume(&mut self) {
        self.status = self.history.resume(&self.options);
    }
}

/// The approach that the options ask for, at its start.
fn begin(working: &Working, level_sets: Vec<Grid<f32>>, options: &Options) -> Box<dyn Approach> {
    let (pair, camera) = (working.pair.clone(), working.camera);
    match options.preset {
        Preset::Paper => Box::new(Paper::new(pair, camera, level_sets, options)),
        Preset::Best => Box::new(Layered::new(pair, camera, level_sets, options)),
    }
}
