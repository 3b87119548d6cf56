//! One solve: scored pass by pass, or against the clock.
//!
//! A solve takes the same passes each time, so a trial finds out which pass has the first usable picture, and a timed
//! solve reads the clock after that pass: nothing is scored while the clock runs.

use std::path::Path;
use std::sync::LazyLock;
use std::time::Instant;

use relievo::options::Preset;
use relievo::{Options, Solver, Status};

use crate::Failure;
use crate::protocol::{Seconds, Trial};
use crate::scores::Score;
use crate::sequence::{Sequence, Truth};

static START: LazyLock<Instant> = LazyLock::new(Instant::now);

fn now() -> f64 {
    START.elapsed().as_secs_f64()
}

/// Scores every pass.
pub fn trial(folder: &Path, preset: Preset) -> Result<Trial, Failure> {
    let sequence = Sequence::read(folder)?;
    let truth = Truth::read(folder, 0)?;
    let mut solver = begin(&sequence, preset)?;
    let mut scores = Vec::new();
    let status = loop {
        let status = solver.step();
        scores.push(Score::of(&solver.interpretation(), &truth)?);
        if status != Status::Running {
            break status;
        }
    };
    let next = if solver.next(sequence.frames[2].clone()).is_ok() {
        while solver.step() == Status::Running {}
        Some(Score::of(
            &solver.interpretation(),
            &Truth::read(folder, 1)?,
        )?)
    } else {
        None
    };
    Ok(Trial {
        status,
        scores,
        next,
    })
}

/// Solves against the clock, and goes on with the third frame. `usable` is the pass that a trial found.
pub fn timed(folder: &Path, preset: Preset, usable: Option<usize>) -> Result<Seconds, Failure> {
    let sequence = Sequence::read(folder)?;
    let third = sequence.frames[2].clone();
    let start = now();
    let mut solver = begin(&sequence, preset)?;
    let (mut pass, mut usable_at) = (0, None);
    loop {
        let status = solver.step();
        pass += 1;
        if Some(pass) == usable {
            usable_at = Some(now() - start);
        }
        if status != Status::Running {
            break;
        }
    }
    let total = now() - start;
    let steps = solver.report().seconds.steps;
    let start = now();
    let next = solver.next(third).is_ok().then(|| {
        while solver.step() == Status::Running {}
        now() - start
    });
    Ok(Seconds {
        total,
        motion: steps.motion,
        depth: steps.depth,
        curves: steps.curves,
        usable: usable_at,
        next,
    })
}

/// Solves, and nothing else.
pub fn only(folder: &Path, preset: Preset) -> Result<(), Failure> {
    let mut solver = begin(&Sequence::read(folder)?, preset)?;
    while solver.step() == Status::Running {}
    Ok(())
}

fn begin(sequence: &Sequence, preset: Preset) -> Result<Solver, Failure> {
    let options = Options::preset(preset);
    let mut solver = Solver::new(sequence.pair()?, sequence.camera, &sequence.curves, options)?;
    solver.set_clock(now);
    Ok(solver)
}
