//! Figures as text: Markdown tables, and words for what is not a number.

use relievo::MotionModel;
use relievo::Status;
use relievo::options::Preset;

use crate::measure::{Figures, Heading, Region};

/// Prints the head of a table.
pub fn head(columns: &[&str]) {
    row(columns);
    println!("|{}", "---|".repeat(columns.len()));
}

/// Prints a row of a table.
pub fn row(cells: &[impl AsRef<str>]) {
    let cells: Vec<&str> = cells.iter().map(AsRef::as_ref).collect();
    println!("| {} |", cells.join(" | "));
}

/// A number with so many digits after the point, or a dash.
pub fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |v| format!("{v:.digits$}"))
}

/// A share as a percentage, or a dash.
pub fn percent(share: Option<f64>, digits: usize) -> String {
    number(share.map(|s| 100.0 * s), digits)
}

/// A cell with an entry for each region.
pub fn each(regions: &[Region], text: impl Fn(&Region) -> String) -> String {
    regions.iter().map(text).collect::<Vec<_>>().join(" / ")
}

/// How a region's translation compares, where it truly shows.
pub fn heading(region: &Region) -> String {
    match region.heading {
        None => "–".to_owned(),
        Some(Heading::Missed) => "missed".to_owned(),
        Some(Heading::Off(angle)) => format!("{angle:.1}"),
    }
}

/// What is found of every region's kind of motion, a letter each.
pub fn kinds(figures: &Figures) -> String {
    figures.regions.iter().map(|r| letter(r.kind)).collect()
}

/// What is true of it.
pub fn true_kinds(figures: &Figures) -> String {
    figures.regions.iter().map(|r| letter(r.truly)).collect()
}

/// A motion model as a letter.
pub fn letter(kind: MotionModel) -> char {
    match kind {
        MotionModel::Still => 'S',
        MotionModel::Rotation => 'R',
        MotionModel::Translation => 'T',
        MotionModel::Full => 'F',
    }
}

/// What the command line calls a preset.
pub fn preset(preset: Preset) -> &'static str {
    match preset {
        Preset::Paper => "paper",
        Preset::Best => "best",
    }
}

/// How a solve ended.
pub fn status(status: Status) -> &'static str {
    match status {
        Status::Running => "running",
        Status::Converged => "converged",
        Status::Exhausted => "out of passes",
        Status::Diverged => "diverged",
    }
}
