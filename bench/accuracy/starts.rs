//! How much regions depend on where the circles are drawn.

use relievo::Shape;
use relievo::options::{Options, Preset};
use relievo::scene::Sequence;

use crate::Failure;
use crate::cases::Case;
use crate::measure::solve;
use crate::placements::{PLANNED, drawn, planned};
use crate::statistics::{greatest, median};
use crate::summary::{Count, count};
use crate::table::{head, percent, preset, row};
use crate::threads::{all, in_groups};

/// Built-in sequences that are measured unless others are named.
const BUILT_IN: [&str; 3] = ["squares", "blocks", "carousel"];
/// Variants measured unless others are named: the first of them.
const VARIANTS: usize = 4;
/// Sets of circles drawn by lot.
const DRAWN: usize = 20;
/// Share of the frame by which an end may have more labels wrong than the best and still be as good.
const SAME: f64 = 0.005;
/// What the circles are drawn from.
const SEED: u64 = 7;

/// The cases to measure when none is named.
pub fn usual(cases: &[Case]) -> Vec<Case> {
    let built_in = cases
        .iter()
        .filter(|c| BUILT_IN.contains(&c.name().as_str()));
    let variants = cases.iter().filter(|c| c.drawn()).take(VARIANTS);
    built_in.chain(variants).cloned().collect()
}

/// A row to be: a sequence and a preset.
struct Row<'a> {
    sequence: &'a Sequence,
    preset: Preset,
}

/// What one start leads to.
struct End {
    wrong: f64,
    labels: Vec<u8>,
}

/// Solves `cases` from many starts and prints how the ends differ.
pub fn print(cases: &[Case], presets: &[Preset]) -> Result<(), Failure> {
    let sequences = all(cases, Case::render)?;
    let several = sequences.iter().filter(|s| !s.curves.is_empty());
    let rows: Vec<(Row, Vec<Vec<Shape>>)> = several
        .flat_map(|sequence| {
            let by_lot = drawn(&sequence.curves, &sequence.truth.labels, DRAWN, SEED);
            let starts = [planned(&sequence.curves), by_lot].concat();
            let row = move |&preset| (Row { sequence, preset }, starts.clone());
            presets.iter().map(row)
        })
        .collect();
    head(&[
        "sequence",
        "preset",
        &format!("{PLANNED} placements: labels wrong, %"),
        "pixels that differ at most, %",
        "random circles: labels wrong at best, %",
        "median, %",
        "at worst, %",
        &format!("within {} points of the best", 100.0 * SAME),
    ]);
    let mut same: Vec<(Preset, Count)> = Vec::new();
    in_groups(
        &rows,
        |row, curves| solve_from(row, curves),
        |row, ends| {
            let (planned, by_lot) = ends.split_at(PLANNED);
            same.push((row.preset, print_row(row, planned, by_lot)));
        },
    )?;
    println!();
    for &which in presets {
        let these = same.iter().filter(|s| s.0 == which).map(|s| s.1);
        let sum = these.fold(Count::default(), |a, b| Count {
            good: a.good + b.good,
            all: a.all + b.all,
        });
        println!(
            "{}: {sum} random starts end as well as the best.",
            preset(which)
        );
    }
    Ok(())
}

fn solve_from(row: &Row, curves: &[Shape]) -> Result<End, Failure> {
    let Sequence { frames, truth, .. } = row.sequence;
    let solver = solve(frames, truth.camera, curves, Options::preset(row.preset))?;
    let labels = solver.interpretation().labels.data().to_vec();
    Ok(End {
        wrong: differing(&labels, truth.labels.data()),
        labels,
    })
}

/// Prints a row, and counts the drawn starts that end as well as the best.
fn print_row(of: &Row, planned: &[End], by_lot: &[End]) -> Count {
    let pairs = planned
        .iter()
        .flat_map(|a| planned.iter().map(move |b| (a, b)));
    let differ = pairs.map(|(a, b)| differing(&a.labels, &b.labels));
    let placements: Vec<String> = planned
        .iter()
        .map(|end| percent(Some(end.wrong), 1))
        .collect();
    let wrong: Vec<f64> = by_lot.iter().map(|end| end.wrong).collect();
    let best = wrong.iter().copied().min_by(f64::total_cmp);
    let same = count(&wrong, |w| best.is_some_and(|best| *w <= best + SAME));
    row(&[
        format!("`{}`", of.sequence.name),
        preset(of.preset).to_owned(),
        placements.join(" / "),
        percent(greatest(&differ.collect::<Vec<_>>()), 2),
        percent(best, 1),
        percent(median(&wrong), 1),
        percent(greatest(&wrong), 1),
        same.to_string(),
    ]);
    same
}

fn differing(a: &[u8], b: &[u8]) -> f64 {
    a.iter().zip(b).filter(|(a, b)| a != b).count() as f64 / a.len() as f64
}
