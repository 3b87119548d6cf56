//! What the method reaches on sequences whose truth is known: `npm run accuracy -- --help`.
//!
//! At 320×240, from the circles that come with a sequence, with the weights that the method chooses
//! itself. Times are those of a machine whose every core is busy.

mod ask;
mod automatic;
mod cases;
mod data;
#[allow(dead_code, reason = "scenes need more of it")]
#[path = "../../src/scene/dice.rs"]
mod dice;
mod export;
mod figures;
mod focal;
mod levers;
mod measure;
mod overlap;
mod placements;
mod recorded;
mod starts;
mod statistics;
mod summary;
mod table;
mod threads;

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use ask::{Asked, HELP, Work};
use cases::{Case, Filming};
use recorded::{RECORDED, Recorded};

/// What goes wrong, as a sentence; it may come from another thread.
type Failure = Box<dyn Error + Send + Sync>;

fn main() -> ExitCode {
    match Asked::read(std::env::args().skip(1)).and_then(|asked| run(&asked)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(asked: &Asked) -> Result<(), Failure> {
    let variants = Case::variants(asked.seed, asked.filming);
    let cases = match asked.filming {
        Filming::Moving => [Case::built_in(), variants].concat(),
        Filming::Passing | Filming::Mild => variants,
    };
    let recorded: Vec<&Recorded> = match asked.data {
        Some(_) => RECORDED.iter().collect(),
        None => Vec::new(),
    };
    check(asked, &cases, &recorded)?;
    let wanted = |case: &Case| asked.wants(&case.name());
    let cases: Vec<Case> = cases.into_iter().filter(wanted).collect();
    match asked.work.clone() {
        Work::Help => println!("{HELP}"),
        Work::Export(folder) => export(&cases, &folder)?,
        Work::Automatic { solving } => automatic::print(&cases, solving)?,
        Work::Focal => focal::print(&cases)?,
        Work::Levers => levers::print(&cases)?,
        Work::Starts if asked.names.is_empty() => {
            starts::print(&starts::usual(&cases), &asked.presets)?;
        }
        Work::Starts => starts::print(&cases, &asked.presets)?,
        Work::Figures => {
            // Recorded sequences alone, unless others are named.
            let own = asked.data.is_none() || !asked.names.is_empty();
            if own && !cases.is_empty() {
                figures::print(&cases, asked)?;
            }
            if let Some(folder) = &asked.data {
                let wanted = recorded.into_iter().filter(|r| asked.wants(r.name));
                data::print(&wanted.collect::<Vec<_>>(), folder, &asked.presets);
            }
        }
    }
    Ok(())
}

/// Refuses names that nothing bears.
fn check(asked: &Asked, cases: &[Case], recorded: &[&Recorded]) -> Result<(), Failure> {
    let names = cases.iter().map(Case::name);
    let known: Vec<String> = names
        .chain(recorded.iter().map(|r| r.name.to_owned()))
        .collect();
    match asked.names.iter().find(|name| !known.contains(name)) {
        Some(name) => Err(format!("{name} is none of {}", known.join(", ")).into()),
        None => Ok(()),
    }
}

fn export(cases: &[Case], folder: &Path) -> Result<(), Failure> {
    let write = |case: &Case| export::write(&case.render()?, folder);
    threads::try_in_order(cases, write, |case, ()| println!("{}", case.name()))
}
