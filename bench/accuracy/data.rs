//! The table of recorded sequences, each from curves that are found, and from drawn ones where the list has some: what is
//! known is compared, the rest is printed as found.

use std::path::{Path, PathBuf};
use std::process::Command;

use relievo::options::{Options, Preset};
use relievo::solver::RegionReport;
use relievo::solver::find_curves;
use relievo::{FramePair, Shape};

use crate::Failure;
use crate::figures::baseline;
use crate::measure::{Figures, Region, solve};
use crate::recorded::{Reading, Recorded};
use crate::table::{each, head, heading, letter, number, percent, preset, row, status};
use crate::threads::in_order;

const COLUMNS: [&str; 20] = [
    "recorded sequence",
    "preset",
    "start",
    "curves",
    "truly",
    "labels wrong, %",
    "AEE, px",
    "TV-L1, px",
    "DIS, px",
    "over the better flow",
    "Horn–Schunck, px",
    "AAE, °",
    "T off by, °",
    "depth error, %",
    "flat guess, %",
    "share found, %",
    "kinds",
    "ω, °",
    "passes",
    "status",
];

/// Where Python may be that has the peers' packages.
const PYTHONS: [&str; 4] = [
    "out/peers/bin/python",
    "out/peers/Scripts/python.exe",
    "python3",
    "python",
];

/// AEE of others on a sequence, in pixels.
#[derive(Clone, Copy)]
struct Others {
    horn_schunck: Option<f64>,
    /// TV-L1 and DIS.
    peers: Option<[f64; 2]>,
}

/// Solves the sequences of `data` and prints a row for each preset and start; one that cannot be worked on gets a
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
    println!("\nω is per frame. TV-L1 and DIS need Python packages: see bench/peers/README.md.\n");
}

fn measure(
    sequence: &Recorded,
    data: &Path,
    presets: &[Preset],
) -> Result<Vec<Vec<String>>, Failure> {
    let reading = sequence.read(data)?;
    let [first, second] = reading.frames.clone();
    let pair = FramePair::new(first, second)?;
    let others = Others {
        horn_schunck: baseline(&pair, &reading.truth)?.map(|(aee, _)| aee),
        peers: sequence.files(data).and_then(|files| peers(&files)),
    };
    let camera = reading.truth.camera;
    let found = find_curves(&pair, &camera);
    let mut starts: Vec<(&str, &[Shape])> = vec![("found", &found)];
    if !reading.curves.is_empty() {
        starts.insert(0, ("drawn", &reading.curves));
    }
    let mut rows = Vec::new();
    for &which in presets {
        for (start, curves) in &starts {
            let solver = solve(&reading.frames, camera, curves, Options::preset(which))?;
            let figures = Figures::of(&solver, &reading.truth)?;
            let before = [
                format!("`{}`", sequence.name),
                preset(which).to_owned(),
                (*start).to_owned(),
                curves.len().to_string(),
                sequence.bodies.to_string(),
            ];
            // Curves that are found bear no numbers of the truth's.
            let numbered = *start == "drawn" || curves.is_empty();
            rows.push(
                [
                    before.to_vec(),
                    cells(
                        &reading,
                        &figures,
                        &solver.report().regions,
                        others,
                        numbered,
                    ),
                ]
                .concat(),
            );
        }
    }
    Ok(rows)
}

/// AEE of TV-L1 and DIS; `None` where Python or its packages are missing.
fn peers(files: &[PathBuf; 3]) -> Option<[f64; 2]> {
    PYTHONS.iter().find_map(|python| {
        let mut command = Command::new(python);
        let output = command.arg("bench/peers/pair.py").args(files).output();
        let text = String::from_utf8(output.ok()?.stdout).ok()?;
        let mut numbers = text.split_whitespace().map(|n| n.parse().ok());
        Some([numbers.next()??, numbers.next()??])
    })
}

fn cells(
    reading: &Reading,
    figures: &Figures,
    found: &[RegionReport],
    others: Others,
    numbered: bool,
) -> Vec<String> {
    let regions = &figures.regions;
    let of_found = |text: &dyn Fn(&RegionReport) -> String| {
        found.iter().map(text).collect::<Vec<_>>().join(" / ")
    };
    let known = |text: String| {
        if reading.moved && numbered {
            text
        } else {
            "–".to_owned()
        }
    };
    let labels_wrong = figures
        .labels_wrong()
        .filter(|_| reading.labelled && numbered);
    let depth = |r: &Region| percent(r.depth.map(|d| d[0]), 1);
    let flat = |r: &Region| percent(r.depth.map(|d| d[1]), 1);
    let peer = |k: usize| others.peers.map(|p| p[k]);
    let better = others.peers.map(|[a, b]| a.min(b));
    let ratio = figures.scores.aee.zip(better).map(|(own, best)| own / best);
    vec![
        percent(labels_wrong, 1),
        number(figures.scores.aee, 3),
        number(peer(0), 3),
        number(peer(1), 3),
        number(ratio, 2),
        number(others.horn_schunck, 3),
        number(figures.scores.aae, 2),
        known(each(regions, heading)),
        known(each(regions, depth)),
        known(each(regions, flat)),
        of_found(&|r| percent(Some(r.share), 1)),
        found.iter().map(|r| letter(r.model)).collect(),
        of_found(&|r| vector(r.rotation.map(f64::to_degrees), 3)),
        figures.passes.to_string(),
        status(figures.status).to_owned(),
    ]
}

fn vector(parts: [f64; 3], digits: usize) -> String {
    let parts = parts.map(|part| format!("{part:.digits$}"));
    format!("({})", parts.join(", "))
}
