//! How well curves are found where nobody draws any, and where solving from them ends.

use std::time::Instant;

use relievo::options::{Options, Preset};
use relievo::scene::Sequence;
use relievo::solver::find_curves;
use relievo::{FramePair, Shape};

use crate::Failure;
use crate::cases::Case;
use crate::measure::solve;
use crate::overlap::{Overlap, iou};
use crate::statistics::greatest;
use crate::summary::count;
use crate::table::{head, number, percent, row};
use crate::threads::try_in_order;

/// A curve covers a body when their intersection over union is larger.
const COVERED: f64 = 0.4;
/// Share of the frame by which labels may be wronger than from circles and still be as good.
const SAME: f64 = 0.005;

/// What was found in a sequence.
struct Found {
    /// Bodies that truly move by themselves.
    bodies: usize,
    curves: usize,
    /// Of each body and the curve that covers it best.
    iou: Vec<f64>,
    seconds: f64,
    /// Share of labels wrong after solving from the sequence's own circles, and from what was found.
    wrong: Option<[f64; 2]>,
}

/// Finds curves in `cases`, solves from them where asked to, and prints what comes of it.
pub fn print(cases: &[Case], solving: bool) -> Result<(), Failure> {
    head(&[
        "sequence",
        "bodies",
        "curves",
        "IoU of each body, %",
        "seconds",
        "labels wrong from circles, %",
        "from curves found, %",
    ]);
    let mut all = Vec::new();
    try_in_order(
        cases,
        |case| look(&case.render()?, solving),
        |case, found| {
            let each: Vec<String> = found.iou.iter().map(|i| percent(Some(*i), 0)).collect();
            row(&[
                format!("`{}`", case.name()),
                found.bodies.to_string(),
                found.curves.to_string(),
                each.join(" / "),
                number(Some(found.seconds), 2),
                percent(found.wrong.map(|w| w[0]), 2),
                percent(found.wrong.map(|w| w[1]), 2),
            ]);
            all.push(found);
        },
    )?;
    let covered: Vec<f64> = all.iter().flat_map(|f| f.iou.iter().copied()).collect();
    let seconds: Vec<f64> = all.iter().map(|f| f.seconds).collect();
    println!(
        "\nThe right number of curves in {}, {} bodies covered by {} % and more; {} s at most.",
        count(&all, |f| f.bodies == f.curves),
        count(&covered, |i| *i > COVERED),
        100.0 * COVERED,
        number(greatest(&seconds), 1),
    );
    let solved: Vec<[f64; 2]> = all.iter().filter_map(|f| f.wrong).collect();
    if !solved.is_empty() {
        println!(
            "Solving ends as well as from circles, or within {} points, in {}.",
            100.0 * SAME,
            count(&solved, |[circles, found]| *found <= circles + SAME),
        );
    }
    Ok(())
}

fn look(sequence: &Sequence, solving: bool) -> Result<Found, Failure> {
    let Sequence { frames, truth, .. } = sequence;
    let [first, second] = frames.clone();
    let pair = FramePair::new(first, second)?;
    let start = Instant::now();
    let curves = find_curves(&pair, &truth.camera);
    let seconds = start.elapsed().as_secs_f64();
    let wrong = |curves: &[Shape]| -> Result<f64, Failure> {
        let solver = solve(frames, truth.camera, curves, Options::preset(Preset::Best))?;
        Ok(Overlap::of(&solver.interpretation().labels, &truth.labels).wrong())
    };
    let bodies = truth.regions() - 1;
    let inside: Vec<_> = curves
        .iter()
        .map(|curve| covered(curve, sequence))
        .collect();
    let best = |body: usize| {
        let is = |label: &u8| usize::from(*label) == body;
        let each = inside
            .iter()
            .map(|curve| iou(curve.iter().copied(), truth.labels.data().iter().map(is)));
        each.fold(0.0, f64::max)
    };
    Ok(Found {
        bodies,
        curves: curves.len(),
        iou: (1..=bodies).map(best).collect(),
        seconds,
        wrong: match solving {
            true => Some([wrong(&sequence.curves)?, wrong(&curves)?]),
            false => None,
        },
    })
}

/// Which pixels a curve encloses.
fn covered(curve: &Shape, sequence: &Sequence) -> Vec<bool> {
    let width = sequence.truth.labels.width();
    let pixels = 0..sequence.truth.labels.len();
    pixels
        .map(|i| curve.signed_distance((i % width) as f64, (i / width) as f64) > 0.0)
        .collect()
}
