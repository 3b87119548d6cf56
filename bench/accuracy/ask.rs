//! The command line: what to measure, and what to print.

use std::path::PathBuf;

use relievo::options::Preset;

use crate::Failure;
use crate::cases::{Filming, SEED};

/// What `--help` prints.
pub const HELP: &str = "\
npm run accuracy -- [NAME…] [--preset best|paper] [--seed N] [--passing|--mild] [--tsv FILE] [--data DIR]
npm run accuracy -- --levers [NAME…] [--seed N] [--passing|--mild]
npm run accuracy -- --starts [NAME…] [--preset best|paper] [--seed N]
npm run accuracy -- --auto|--find|--focal [NAME…] [--seed N] [--passing|--mild]
npm run accuracy -- --export DIR [NAME…] [--seed N] [--passing|--mild]

Solves the built-in sequences and 20 random variants, and says how far each result is from the truth.

NAME          only these: blocks, carousel-1003, …
--preset      only this preset
--seed N      draw the variants from the seeds N to N+19 instead of 1000 to 1019
--passing     variants that stand still and are filmed in passing, with no curve drawn; nothing built in
--mild        variants with a background of little relief before a camera that shifts and turns; nothing built in
--tsv FILE    write name, preset, AEE and labels wrong as well
--data DIR    the recorded sequences in DIR instead, from curves found and drawn, beside TV-L1 and DIS
--levers      what each option of `best` is worth and costs: it is switched off alone, and left on alone
--starts      how much the result depends on where the circles are drawn
--auto        which curves are found where nobody draws any, and where `best` ends from them
--find        the same, without solving
--focal       which focal length is found
--export DIR  solve nothing; write frames and truth into a folder for each sequence";

/// What a run does.
#[derive(Clone, Debug, PartialEq)]
pub enum Work {
    /// Prints what to type.
    Help,
    /// Prints the table of figures.
    Figures,
    /// Prints what each option is worth.
    Levers,
    /// Prints how results depend on the curves.
    Starts,
    /// Prints which curves are found, and where solving from them ends if that is wanted too.
    Automatic {
        /// Whether to solve.
        solving: bool,
    },
    /// Prints which focal length is found.
    Focal,
    /// Writes frames and truth.
    Export(PathBuf),
}

/// What was asked for.
#[derive(Clone, Debug)]
pub struct Asked {
    /// What to do.
    pub work: Work,
    /// Sequences to pick; none for all of them.
    pub names: Vec<String>,
    /// Presets to measure.
    pub presets: Vec<Preset>,
    /// The first variant's seed.
    pub seed: u64,
    /// How variants are filmed.
    pub filming: Filming,
    /// Where to write figures for other programs.
    pub tsv: Option<PathBuf>,
    /// Where recorded sequences are.
    pub data: Option<PathBuf>,
}

impl Asked {
    /// Reads the words of a command line.
    pub fn read(mut words: impl Iterator<Item = String>) -> Result<Self, Failure> {
        let mut asked = Self {
            work: Work::Figures,
            names: Vec::new(),
            presets: Preset::ALL.to_vec(),
            seed: SEED,
            filming: Filming::Moving,
            tsv: None,
            data: None,
        };
        while let Some(word) = words.next() {
            let mut value = || {
                let next = words.next();
                next.ok_or_else(|| format!("{word} needs a value"))
            };
            match word.as_str() {
                "--help" => asked.work = Work::Help,
                "--levers" => asked.work = Work::Levers,
                "--starts" => asked.work = Work::Starts,
                "--auto" => asked.work = Work::Automatic { solving: true },
                "--find" => asked.work = Work::Automatic { solving: false },
                "--focal" => asked.work = Work::Focal,
                "--passing" => asked.filming = Filming::Passing,
                "--mild" => asked.filming = Filming::Mild,
                "--export" => asked.work = Work::Export(value()?.into()),
                "--tsv" => asked.tsv = Some(value()?.into()),
                "--data" => asked.data = Some(value()?.into()),
                "--preset" => asked.presets = vec![preset(&value()?)?],
                "--seed" => {
                    let text = value()?;
                    let seed = text.parse();
                    asked.seed = seed.map_err(|_| format!("--seed {text} is no whole number"))?;
                }
                option if option.starts_with('-') => {
                    return Err(format!("{option} is not known\n\n{HELP}").into());
                }
                _ => asked.names.push(word),
            }
        }
        Ok(asked)
    }

    /// Whether the sequence of this name is to be measured.
    pub fn wants(&self, name: &str) -> bool {
        self.names.is_empty() || self.names.iter().any(|asked| asked == name)
    }
}

fn preset(word: &str) -> Result<Preset, Failure> {
    let quoted = serde_json::to_value(word)?;
    serde_json::from_value(quoted).map_err(|_| format!("{word} is no preset").into())
}
