//! What is due in which pass of the coarse-to-fine solver.
//!
//! Regions start on a coarse scale: flat (ρ = 1) for some passes while threshold dynamics finds roughly
//! where they are, then with depth; curves that begin on their bodies are held meanwhile. A scale is done
//! after a set number of passes; the finest goes over from threshold dynamics to (17) and ends when all
//! stands still. Passes with depth are counted from 0:
//!
//! ```text
//!        first scale                  between                finest
//!        (three flat passes before)
//! 0 1    T is searched for
//! 1                                   depth is swept         depth is swept
//! 2                                                          kinds are chosen; from here hidden pixels are excused
//! 4      depth is swept               kinds are chosen       settled: (17), least partition, depth is swept
//! 5      depths of relief are chosen  ends                   bodies grow
//! 6      ends
//! 7                                                          kinds are chosen again
//! 8                                                          least partition, bodies grow; from here without rims
//! 9                                                          from here what covers what is held, and all may rest
//! 19                                                         rests at the latest
//! ```
//!
//! Where the first scale is the finest, its flat passes and its search come before the last column. At rest motions are
//! held, regions learn how stiff their depth is, and depth and curves go on.

/// Regions start on the coarsest scale whose shorter side is at least this: where several compete, and
/// where there is only one. At a coarse scale displacements are small, but so are the differences that tell
/// regions apart.
const STARTING: [usize; 2] = [100, 40];
/// Passes in which regions are flat.
const FLAT_PASSES: usize = 3;
/// Passes with depth on the first scale, and on each between the first and the finest.
const PASSES: [usize; 2] = [7, 6];
/// Passes of threshold dynamics on the finest scale before (17) takes over.
const THRESHOLD_PASSES: usize = 4;
/// Passes before the last of threshold dynamics on a scale that kinds of motion are chosen.
const CHOOSING: usize = 2;
/// The pass on the finest scale in which they are chosen again, depth being known in detail by then.
const CHOOSING_AGAIN: usize = THRESHOLD_PASSES + 3;
/// The pass on the finest scale before which curves and motions are not done, and the one after which motions
/// are held at the latest: curves that creep shall not keep depth waiting.
const DONE: [usize; 2] = [CHOOSING_AGAIN + 2, CHOOSING_AGAIN + 12];
/// The passes on the finest scale in which all curves move at once to the least partition: before (17) takes
/// over, and once kinds of motion are final.
const REPARTITIONING: [usize; 2] = [THRESHOLD_PASSES, CHOOSING_AGAIN + 1];
/// The passes on the finest scale in which regions are tried with what lies around them: once curves have settled,
/// and once kinds of motion are final.
const GROWING: [usize; 2] = [THRESHOLD_PASSES + 1, CHOOSING_AGAIN + 1];
/// The pass on the finest scale from which hidden pixels are excused: earlier, regions would collapse.
const EXCUSING: usize = 2;
/// The pass of a scale after which the change of light is measured.
const RELIGHTING: usize = 2;
/// Passes in which T is looked for over all directions.
const SEARCHING: usize = 2;
/// The passes with depth in which depths are swept: on the first scale, where T has to be found before; on later ones;
/// and once more when curves have settled.
const SWEEPING: [usize; 3] = [SEARCHING + 2, 1, THRESHOLD_PASSES];
/// Depths of relief that a full motion is tried with; only the first two, its mirror image and a deeper one,
/// where depth has been found on a coarser scale: what is coarse looks flat.
const RELIEFS: [f64; 5] = [-1.0, 2.0, 0.4, -2.0, -0.4];
/// Standard deviation of threshold dynamics' window in pixels: at first, with depth, and what it falls by in
/// a pass in between.
const WINDOW: [f64; 3] = [2.5, 1.8, 0.25];

/// Where the solver stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Schedule {
    /// The first scale, counted from 0, the finest.
    pub start: usize,
    /// The scale at work.
    pub level: usize,
    /// Passes made on this scale.
    pass: usize,
    /// Whether any pass has been made.
    begun: bool,
    /// Whether curves have been drawn since this scale was reached.
    redrawn: bool,
    /// Whether curves are on their bodies since they were drawn.
    on_bodies: bool,
    /// Whether regions know how stiff their depth is; `None` until motions are held.
    resting: Option<bool>,
}

impl Schedule {
    /// The start for scales whose shorter sides are `sides`, the finest first, and so many `curves`.
    pub fn new(
        sides: impl DoubleEndedIterator<Item = usize> + ExactSizeIterator,
        curves: usize,
    ) -> Self {
        let least = STARTING[usize::from(curves == 0)];
        let start = sides
            .into_iter()
            .rposition(|side| side >= least)
            .unwrap_or(0);
        Self {
            start,
            level: start,
            pass: 0,
            begun: false,
            redrawn: false,
            on_bodies: false,
            resting: None,
        }
    }

    /// The number of the pass among those with depth on this scale; `None` while regions are flat.
    pub fn deep(&self) -> Option<usize> {
        let flat = if self.level == self.start {
            FLAT_PASSES
        } else {
            0
        };
        self.pass.checked_sub(flat)
    }

    fn at_least(&self, pass: usize) -> bool {
        self.level == 0 && self.deep().is_some_and(|deep| deep >= pass)
    }

    /// Whether this is the first pass on this scale, or since curves were drawn anew.
    pub fn begins(&self) -> bool {
        self.pass == 0
    }

    /// Whether any pass has been made.
    pub fn begun(&self) -> bool {
        self.begun
    }

    /// Curves are on their bodies.
    pub fn hold_curves(&mut self) {
        self.on_bodies = true;
    }

    /// Whether curves stay where they are: on their bodies, until each region has a motion and a depth of relief,
    /// or the neighbour's, known better, would take its pixels.
    pub fn holds_curves(&self) -> bool {
        let last = if self.level == 0 {
            THRESHOLD_PASSES
        } else {
            PASSES[0]
        } - CHOOSING;
        self.on_bodies && self.level == self.start && self.deep().is_none_or(|deep| deep <= last)
    }

    /// Whether depth that is refuted is sought anew.
    pub fn sweeps(&self) -> bool {
        let [first, later, settled] = SWEEPING;
        let due = if self.level == self.start {
            first
        } else {
            later
        };
        let deep = self.deep();
        deep == Some(due) || self.level == 0 && deep == Some(settled)
    }

    /// Whether regions are where they should be, to the pixel.
    pub fn settled(&self) -> bool {
        self.at_least(THRESHOLD_PASSES)
    }

    /// Whether all curves move at once to the least partition.
    pub fn repartitions(&self) -> bool {
        self.level == 0
            && self
                .deep()
                .is_some_and(|deep| REPARTITIONING.contains(&deep))
    }

    /// Whether motions are held, and only depth and curves go on.
    pub fn rests(&self) -> bool {
        self.resting.is_some()
    }

    /// Whether regions are to find out how stiff their depth is: once, as soon as motions are held. Softer depth
    /// would take motions along wherever it follows noise.
    pub fn learns(&self) -> bool {
        self.resting == Some(false)
    }

    /// Keeps them from finding out again.
    pub fn has_learnt(&mut self) {
        self.resting = Some(true);
    }

    /// Whether regions are tried with what lies around them.
    pub fn grows(&self) -> bool {
        self.level == 0 && self.deep().is_some_and(|deep| GROWING.contains(&deep))
    }

    /// Whether a curve may still leap anywhere.
    pub fn roams(&self) -> bool {
        self.level == self.start || self.redrawn && !self.settled()
    }

    /// Whether T is looked for over all directions.
    pub fn searches(&self) -> bool {
        self.level == self.start && self.deep().is_some_and(|deep| deep < SEARCHING)
    }

    /// Whether kinds of motion are chosen.
    pub fn chooses(&self) -> bool {
        let Some(deep) = self.deep() else {
            return false;
        };
        match self.level {
            0 => deep + CHOOSING == THRESHOLD_PASSES || deep == CHOOSING_AGAIN,
            level => level < self.start && deep + CHOOSING == PASSES[1],
        }
    }

    /// Whether the depth of relief of full motions is chosen by itself: on the first scale, where kinds are
    /// not told apart yet.
    pub fn chooses_relief(&self) -> bool {
        self.level > 0
            && self.level == self.start
            && self.deep().is_some_and(|deep| deep + CHOOSING == PASSES[0])
    }

    /// Depths of relief that a full motion is tried with then.
    pub fn reliefs(&self) -> &'static [f64] {
        if self.level == 0 && (self.start > 0 || self.at_least(CHOOSING_AGAIN)) {
            &RELIEFS[..2]
        } else {
            &RELIEFS
        }
    }

    /// Whether regions do without their rim: not before kinds and depths of relief have been chosen, for which
    /// whatever tells relief is wanted.
    pub fn spares_rims(&self) -> bool {
        self.at_least(CHOOSING_AGAIN + 1)
    }

    /// Whether hidden pixels are excused.
    pub fn excuses(&self) -> bool {
        self.at_least(EXCUSING)
    }

    /// Whether what covers what is known by now: curves and cover would follow each other for ever.
    pub fn holds_cover(&self) -> bool {
        self.at_least(CHOOSING_AGAIN + 2)
    }

    /// Whether the change of light is to be measured after this pass.
    pub fn relights(&self) -> bool {
        self.pass == RELIGHTING
    }

    /// Standard deviation of threshold dynamics' window, in pixels.
    pub fn window(&self) -> f64 {
        let [first, last, fall] = WINDOW;
        match self.deep() {
            None => (first - fall * self.pass as f64).max(last),
            Some(_) => last,
        }
    }

    /// Ends a pass; whether the next finer scale is due.
    pub fn advance(&mut self) -> bool {
        self.begun = true;
        self.pass += 1;
        let most = PASSES[usize::from(self.level < self.start)];
        let done = self.level > 0 && self.deep().is_some_and(|deep| deep >= most);
        if done {
            self.level -= 1;
            self.pass = 0;
            self.redrawn = false;
        }
        done
    }

    /// Whether there is more to do than waiting for all to stand still.
    pub fn unfinished(&self) -> bool {
        !self.at_least(DONE[0])
    }

    /// Holds motions from the next pass on where all is `still`, or has had passes enough; whether that is new.
    pub fn comes_to_rest(&mut self, still: bool) -> bool {
        let due = !self.rests() && (still || self.at_least(DONE[1]));
        if due {
            self.resting = Some(false);
        }
        due
    }

    /// Lets motions go on, for settings that have changed.
    pub fn stir(&mut self) {
        self.resting = None;
    }

    /// Goes back to the first pass of this scale, for curves drawn anew.
    pub fn restart(&mut self) {
        self.pass = 0;
        self.redrawn = true;
        self.on_bodies = false;
        self.resting = None;
    }
}
