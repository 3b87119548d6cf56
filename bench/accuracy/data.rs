//! The table of recorded sequences: what is known of each is compared, the rest is printed as found.

use std::path::Path;

use relievo::FramePair;
use relievo::options::{Options, Preset};

use crate::Failure;
use crate::figures::baseline;
use crate::measure::{Figures, Region, solve};
use crate::recorded::{Reading, Recorded};
use crate::table::{each, head, heading, kinds, number, percent, preset, row, status};
use crate::threads::in_order;

const COLUMNS: [&str; 16] = [
    "recorded sequence",
    "preset",
    "labels wrong, %",
    "AEE, px",
    "Horn–Schunck, px",
    "AAE, °",
    "Horn–Schunck, °",
    "T off by, °",
    "depth error, %",
    "flat guess, %",
    "share found, %",
    "kinds",
    "T",
    "ω, °",
    "passes",
    "status",
];

/// Solves the sequences of `data` and prints a row for each preset; one that cannot be worked on gets a
/// row that says why.
pub fn print(sequences: &[&Recorded], data: &Path, presets: &[Preset]) {
    head(&COLUMNS);
    in_order(
        sequences,
        |sequence| measure(sequence, data, presets),
        |sequence, result| match result {
            Ok(rows) => rows.iter().for_each(|cells| row(cells)),
            Err(error) => {
                let mut cells = vec![String::new(); COLUMNS.len()];
                cells[0] = format!("`{}`", sequence.name);
                cells[COLUMNS.len() - 1] = error.to_string();
                row(&cells);
            }
        },
    );
    println!("\nT is in units in which its region's mean 1/Z is 1, ω is per frame.\n");
}

fn measure(
    sequence: &Recorded,
    data: &Path,
    presets: &[Preset],
) -> Result<Vec<Vec<String>>, Failure> {
    let reading = sequence.read(data)?;
    let [first, second] = reading.frames.clone();
    let baseline = baseline(&FramePair::new(first, second)?, &reading.truth)?;
    let cells = |&which: &Preset| {
        let options = Options::preset(which);
        let camera = reading.truth.camera;
        let solver = solve(&reading.frames, camera, &reading.curves, options)?;
        let figures = Figures::of(&solver, &reading.truth)?;
        let before = [format!("`{}`", sequence.name), preset(which).to_owned()];
        Ok([before.to_vec(), cells(&reading, &figures, baseline)].concat())
    };
    presets.iter().map(cells).collect()
}

fn cells(reading: &Reading, figures: &Figures, baseline: Option<(f64, f64)>) -> Vec<String> {
    let regions = &figures.regions;
    let known = |text: String| {
        if reading.moved {
            text
        } else {
            "–".to_owned()
        }
    };
    let labels_wrong = figures.labels_wrong().filter(|_| reading.labelled);
    let depth = |r: &Region| percent(r.depth.map(|d| d[0]), 1);
    let flat = |r: &Region| percent(r.depth.map(|d| d[1]), 1);
    vec![
        percent(labels_wrong, 1),
        number(figures.scores.aee, 3),
        number(baseline.map(|b| b.0), 3),
        number(figures.scores.aae, 2),
        number(baseline.map(|b| b.1), 2),
        known(each(regions, heading)),
        known(each(regions, depth)),
        known(each(regions, flat)),
        each(regions, |r| percent(Some(r.found_share), 1)),
        kinds(figures),
        each(regions, |r| vector(r.motion.translation.to_array(), 4)),
        each(regions, |r| {
            vector(r.motion.rotation.to_array().map(f64::to_degrees), 3)
        }),
        figures.passes.to_string(),
        status(figures.status).to_owned(),
    ]
}

fn vector(parts: [f64; 3], digits: usize) -> String {
    let parts = parts.map(|part| format!("{part:.digits$}"));
    format!("({})", parts.join(", "))
}
