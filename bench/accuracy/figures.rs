//! The table of figures: a row for each sequence and preset, then what they come to.

use std::fmt::Write as _;
use std::fs;

use relievo::horn_schunck::{self, ALPHA, SWEEPS};
use relievo::options::{Options, Preset};
use relievo::score::compare_flow;
use relievo::{FramePair, Interpretation};

use crate::Failure;
use crate::ask::Asked;
use crate::cases::Case;
use crate::measure::{Figures, solve};
use crate::statistics::geometric_mean;
use crate::summary::{LIMIT_LARGE, LIMIT_SMALL, Summary};
use crate::table::{each, head, heading, kinds, number, percent, preset, row, status, true_kinds};
use crate::threads::try_in_order;

/// What is known of one case: a result for each preset, and the baseline's AEE.
struct Measured {
    drawn: bool,
    name: String,
    solves: Vec<(Preset, Figures)>,
    baseline: Option<f64>,
}

/// Measures `cases` and prints what they reach.
pub fn print(cases: &[Case], asked: &Asked) -> Result<(), Failure> {
    head(&[
        "sequence",
        "preset",
        "labels wrong, %",
        "AEE, px",
        "Horn–Schunck, px",
        "AAE, °",
        "least IoU, %",
        "T off by, °",
        "ω off by, °",
        "depth error, %",
        "flat guess, %",
        "kinds",
        "true kinds",
        "passes",
        "status",
    ]);
    let mut all = Vec::new();
    try_in_order(
        cases,
        |case| measure(case, &asked.presets),
        |_, measured| {
            rows(&measured);
            all.push(measured);
        },
    )?;
    println!(
        "\nWhere there are several regions, the background's figure comes first, then each curve's. S: still, \
         R: rotation, T: translation, F: full motion.\n"
    );
    summaries(&all, &asked.presets);
    if let Some(path) = &asked.tsv {
        let written = fs::write(path, tsv(&all));
        written.map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(())
}

fn measure(case: &Case, presets: &[Preset]) -> Result<Measured, Failure> {
    let sequence = case.render()?;
    let truth = &sequence.truth;
    let [first, second] = sequence.frames.clone();
    let baseline = baseline(&FramePair::new(first, second)?, truth)?;
    relievo::layered::ORACLE.with(|o| *o.borrow_mut() = Some(truth.labels.clone()));
    let mut solves = Vec::new();
    for &preset in presets {
        let options = Options::preset(preset);
        let solver = solve(&sequence.frames, truth.camera, &sequence.curves, options)?;
        solves.push((preset, Figures::of(&solver, truth)?));
    }
    Ok(Measured {
        drawn: case.drawn(),
        name: case.name(),
        solves,
        baseline: baseline.map(|(aee, _)| aee),
    })
}

/// Horn–Schunck's AEE and AAE.
pub fn baseline(pair: &FramePair, truth: &Interpretation) -> Result<Option<(f64, f64)>, Failure> {
    let flow = horn_schunck::solve(
        pair,
        ALPHA,
        if std::env::var("NOHS").is_ok() {
            1
        } else {
            SWEEPS
        },
    );
    Ok(compare_flow(&flow, &truth.flow, None)?)
}

fn rows(measured: &Measured) {
    for (which, figures) in &measured.solves {
        let regions = &figures.regions;
        row(&[
            format!("`{}`", measured.name),
            preset(*which).to_owned(),
            percent(figures.labels_wrong(), 1),
            number(figures.scores.aee, 3),
            number(measured.baseline, 3),
            number(figures.scores.aae, 2),
            percent(figures.least_iou(), 1),
            each(regions, heading),
            each(regions, |r| number(r.rotation_off, 3)),
            each(regions, |r| percent(r.depth.map(|d| d[0]), 1)),
            each(regions, |r| percent(r.depth.map(|d| d[1]), 1)),
            kinds(figures),
            true_kinds(figures),
            figures.passes.to_string(),
            status(figures.status).to_owned(),
        ]);
    }
}

fn summaries(all: &[Measured], presets: &[Preset]) {
    head(&[
        "preset",
        "sequences",
        "labels wrong: median, %",
        "worst, %",
        "AEE: geometric mean, px",
        "Horn–Schunck, px",
        "right kind",
        &format!("T within {LIMIT_LARGE}°, large regions"),
        &format!("within {LIMIT_SMALL}°, others"),
        "depth error: mean, %",
        "worst, %",
        "under half a flat guess",
        "converged",
        "energy's rise, %",
    ]);
    let groups = [
        ("built-in", Some(false)),
        ("variants", Some(true)),
        ("all", None),
    ];
    for &which in presets {
        for (group, drawn) in groups {
            let belongs = |m: &&Measured| drawn.is_none_or(|drawn| drawn == m.drawn);
            let these: Vec<&Measured> = all.iter().filter(belongs).collect();
            // All of one sort are said once.
            if these.is_empty() || (drawn.is_some() && these.len() == all.len()) {
                continue;
            }
            summary(which, group, &these);
        }
    }
    println!();
}

fn summary(which: Preset, group: &str, these: &[&Measured]) {
    let solves = these.iter().flat_map(|m| &m.solves);
    let figures: Vec<&Figures> = solves.filter(|s| s.0 == which).map(|s| &s.1).collect();
    let summary = Summary::of(&figures);
    let baselines: Vec<f64> = these.iter().filter_map(|m| m.baseline).collect();
    row(&[
        preset(which).to_owned(),
        group.to_owned(),
        percent(summary.labels_median, 2),
        percent(summary.labels_worst, 1),
        number(summary.aee, 4),
        number(geometric_mean(&baselines), 4),
        summary.kinds.to_string(),
        summary.headings_large.to_string(),
        summary.headings_small.to_string(),
        percent(summary.depth_mean, 1),
        percent(summary.depth_worst, 1),
        summary.depth_halved.to_string(),
        summary.converged.to_string(),
        percent(summary.rise, 2),
    ]);
}

fn tsv(all: &[Measured]) -> String {
    let mut text = "name\tpreset\taee\tlabels_wrong\n".to_owned();
    for measured in all {
        for (which, figures) in &measured.solves {
            let cell = |value: Option<f64>| value.map_or_else(String::new, |v| v.to_string());
            let _ = writeln!(
                text,
                "{}\t{}\t{}\t{}",
                measured.name,
                preset(*which),
                cell(figures.scores.aee),
                cell(figures.labels_wrong()),
            );
        }
    }
    text
}
