//! What each option of `best` is worth, in accuracy and in time: it is switched off alone, and it is left on alone.
//!
//! The levers are read from the catalogue: every toggle that is on, and every other word of every
//! choice. A new one is here as soon as it is there. Seconds are of the clock, two solves at a time on two cores.

use std::time::Instant;

use relievo::Options;
use relievo::options::{Control, Preset, catalogue};
use relievo::scene::Sequence;
use serde_json::{Map, Value, json};

use crate::Failure;
use crate::cases::Case;
use crate::measure::{Figures, solve};
use crate::statistics::mean;
use crate::summary::{LIMIT_LARGE, LIMIT_SMALL, Summary};
use crate::table::{head, number, percent, row};
use crate::threads::{all, in_groups};

/// Settings that differ from the preset.
struct Lever {
    name: String,
    options: Options,
    /// Whether a table begins with it.
    first: bool,
}

/// Solves `cases` with each lever and prints what that costs.
pub fn print(cases: &[Case]) -> Result<(), Failure> {
    let sequences = all(cases, Case::render)?;
    let levers: Vec<(Lever, Vec<&Sequence>)> = levers()?
        .into_iter()
        .map(|lever| (lever, sequences.iter().collect()))
        .collect();
    let mut base = None;
    in_groups(&levers, measure, |lever, solves| {
        let (figures, seconds): (Vec<&Figures>, Vec<f64>) =
            solves.iter().map(|(f, s)| (f, *s)).unzip();
        let summary = Summary::of(&figures);
        if lever.first {
            base = summary.aee;
            print_head(&lever.name);
        }
        print_row(lever, &summary, base, mean(&seconds));
    })
}

/// The preset itself and with each option off, then with all of them off and with each alone.
fn levers() -> Result<Vec<Lever>, Failure> {
    let preset = serde_json::to_value(Options::preset(Preset::Best))?;
    let mut off: Vec<(String, &str, Value)> = Vec::new();
    for option in catalogue() {
        let now = &preset[option.key];
        match option.control {
            Control::Toggle if now == &Value::Bool(true) => {
                off.push((
                    format!("{} off", option.key),
                    option.key,
                    Value::Bool(false),
                ));
            }
            Control::Choice { choices } => {
                for word in choices.iter().map(|c| c.value).filter(|word| now != word) {
                    off.push((format!("{}: {word}", option.key), option.key, word.into()));
                }
            }
            _ => {}
        }
    }
    let mut levers = vec![lever("all options", true, &[])?];
    for setting in &off {
        levers.push(lever(&setting.0, false, std::slice::from_ref(setting))?);
    }
    levers.push(lever("no options", true, &off)?);
    for (_, key, _) in &off {
        let others: Vec<_> = off
            .iter()
            .filter(|(_, other, _)| other != key)
            .cloned()
            .collect();
        levers.push(lever(&format!("only {key}"), false, &others)?);
    }
    Ok(levers)
}

fn lever(name: &str, first: bool, settings: &[(String, &str, Value)]) -> Result<Lever, Failure> {
    let mut given = Map::from_iter([("preset".to_owned(), json!(Preset::Best))]);
    given.extend(
        settings
            .iter()
            .map(|(_, key, value)| ((*key).to_owned(), value.clone())),
    );
    Ok(Lever {
        name: name.to_owned(),
        options: Options::from_json(&Value::Object(given).to_string())?,
        first,
    })
}

/// The figures of a solve, and its seconds.
fn measure(lever: &Lever, sequence: &&Sequence) -> Result<(Figures, f64), Failure> {
    let camera = sequence.truth.camera;
    let options = lever.options.clone();
    let start = Instant::now();
    let solver = solve(&sequence.frames, camera, &sequence.curves, options)?;
    let seconds = start.elapsed().as_secs_f64();
    Ok((Figures::of(&solver, &sequence.truth)?, seconds))
}

fn print_head(first: &str) {
    println!();
    head(&[
        "`best` with",
        "labels wrong: median, %",
        "worst, %",
        "AEE: geometric mean, px",
        &format!("times that with {first}"),
        "depth error: mean, %",
        "right kind",
        &format!("T within {LIMIT_LARGE}°, large regions"),
        &format!("within {LIMIT_SMALL}°, others"),
        "converged",
        "seconds",
    ]);
}

fn print_row(lever: &Lever, summary: &Summary, base: Option<f64>, seconds: Option<f64>) {
    row(&[
        lever.name.clone(),
        percent(summary.labels_median, 2),
        percent(summary.labels_worst, 1),
        number(summary.aee, 4),
        number(summary.aee.zip(base).map(|(aee, base)| aee / base), 2),
        percent(summary.depth_mean, 1),
        summary.kinds.to_string(),
        summary.headings_large.to_string(),
        summary.headings_small.to_string(),
        summary.converged.to_string(),
        number(seconds, 2),
    ]);
}
