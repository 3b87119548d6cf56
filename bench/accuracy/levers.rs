//! What each option of `best` is worth: it is switched off, or set otherwise, alone.
//!
//! The levers are read from the catalogue: every toggle that is on, and every other word of every
//! choice. A new one is here as soon as it is there.

use relievo::Options;
use relievo::options::{Control, Preset, catalogue};
use relievo::scene::Sequence;
use serde_json::{Map, Value, json};

use crate::Failure;
use crate::cases::Case;
use crate::measure::{Figures, solve};
use crate::summary::{LIMIT_LARGE, LIMIT_SMALL, Summary};
use crate::table::{head, number, percent, row};
use crate::threads::{all, in_groups};

/// One setting that differs from the preset.
struct Lever {
    name: String,
    options: Options,
}

/// Solves `cases` with each lever and prints what that costs.
pub fn print(cases: &[Case]) -> Result<(), Failure> {
    let sequences = all(cases, Case::render)?;
    let levers: Vec<(Lever, Vec<&Sequence>)> = levers()?
        .into_iter()
        .map(|lever| (lever, sequences.iter().collect()))
        .collect();
    head(&[
        "`best` with",
        "labels wrong: median, %",
        "worst, %",
        "AEE: geometric mean, px",
        "times that of `best`",
        "depth error: mean, %",
        "right kind",
        &format!("T within {LIMIT_LARGE}°, large regions"),
        &format!("within {LIMIT_SMALL}°, others"),
        "converged",
    ]);
    let mut plain = None;
    in_groups(&levers, measure, |lever, figures| {
        let summary = Summary::of(&figures.iter().collect::<Vec<_>>());
        let base = *plain.get_or_insert(summary.aee);
        print_row(lever, &summary, base);
    })
}

/// The preset itself, then each of its levers.
fn levers() -> Result<Vec<Lever>, Failure> {
    let preset = serde_json::to_value(Options::preset(Preset::Best))?;
    let mut levers = vec![lever("all options", None)?];
    for option in catalogue() {
        let now = &preset[option.key];
        match option.control {
            Control::Toggle if now == &Value::Bool(true) => {
                let name = format!("{} off", option.key);
                levers.push(lever(&name, Some((option.key, Value::Bool(false))))?);
            }
            Control::Choice { choices } => {
                for word in choices.iter().map(|c| c.value).filter(|word| now != word) {
                    let name = format!("{}: {word}", option.key);
                    levers.push(lever(&name, Some((option.key, Value::from(word))))?);
                }
            }
            _ => {}
        }
    }
    Ok(levers)
}

fn lever(name: &str, setting: Option<(&str, Value)>) -> Result<Lever, Failure> {
    let mut given = Map::from_iter([("preset".to_owned(), json!(Preset::Best))]);
    given.extend(setting.map(|(key, value)| (key.to_owned(), value)));
    Ok(Lever {
        name: name.to_owned(),
        options: Options::from_json(&Value::Object(given).to_string())?,
    })
}

fn measure(lever: &Lever, sequence: &&Sequence) -> Result<Figures, Failure> {
    let camera = sequence.truth.camera;
    let options = lever.options.clone();
    let solver = solve(&sequence.frames, camera, &sequence.curves, options)?;
    Figures::of(&solver, &sequence.truth)
}

fn print_row(lever: &Lever, summary: &Summary, base: Option<f64>) {
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
    ]);
}
