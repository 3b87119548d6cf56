//! Many solves in a few numbers.

use relievo::Status;

use crate::measure::{Figures, Heading, Region};
use crate::statistics::{geometric_mean, greatest, mean, median};

/// Share of the frame above which a region counts as large.
const LARGE: f64 = 0.15;
/// Degrees by which a large region's translation may be off.
pub const LIMIT_LARGE: f64 = 2.0;
/// Degrees by which another's may be off.
pub const LIMIT_SMALL: f64 = 8.0;

/// So many of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Count {
    /// How many are as they should be.
    pub good: usize,
    /// Of how many.
    pub all: usize,
}

/// What is said of many solves together.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// Median share of wrong labels, where there are several regions.
    pub labels_median: Option<f64>,
    /// The worst share of wrong labels.
    pub labels_worst: Option<f64>,
    /// Geometric mean of AEE in pixels.
    pub aee: Option<f64>,
    /// Regions whose kind of motion is right.
    pub kinds: Count,
    /// Large regions whose translation is within [`LIMIT_LARGE`]; one not found is not.
    pub headings_large: Count,
    /// Other regions whose translation is within [`LIMIT_SMALL`].
    pub headings_small: Count,
    /// Mean relative error of depth over the regions whose depth shows.
    pub depth_mean: Option<f64>,
    /// The worst of them.
    pub depth_worst: Option<f64>,
    /// Regions whose depth is off by less than half of what a flat guess is.
    pub depth_halved: Count,
    /// Regions whose confidence is above one half and whose depth is better than a flat guess, of those whose confidence is.
    pub certain: Count,
    /// The largest relative rise of the energy over ten passes at most.
    pub rise: Option<f64>,
    /// Solves that converged.
    pub converged: Count,
}

impl Summary {
    /// What is to be said of `solves`.
    pub fn of(solves: &[&Figures]) -> Self {
        let labels: Vec<f64> = solves.iter().filter_map(|f| f.labels_wrong()).collect();
        let aee: Vec<f64> = solves.iter().filter_map(|f| f.scores.aee).collect();
        let regions: Vec<&Region> = solves.iter().flat_map(|f| &f.regions).collect();
        let depths: Vec<[f64; 2]> = regions.iter().filter_map(|r| r.depth).collect();
        let errors: Vec<f64> = depths.iter().map(|d| d[0]).collect();
        let rises: Vec<f64> = solves.iter().filter_map(|f| f.rise).collect();
        Self {
            labels_median: median(&labels),
            labels_worst: greatest(&labels),
            aee: geometric_mean(&aee),
            kinds: count(&regions, |r| r.kind == r.truly),
            headings_large: headings(&regions, |r| r.share > LARGE, LIMIT_LARGE),
            headings_small: headings(&regions, |r| r.share <= LARGE, LIMIT_SMALL),
            depth_mean: mean(&errors),
            depth_worst: greatest(&errors),
            depth_halved: count(&depths, |d| d[0] < 0.5 * d[1]),
            certain: certain(&regions),
            rise: greatest(&rises),
            converged: count(solves, |f| f.status == Status::Converged),
        }
    }
}

fn certain(regions: &[&Region]) -> Count {
    let sure = regions.iter().filter(|r| r.confidence > 0.5);
    let depths: Vec<[f64; 2]> = sure.filter_map(|r| r.depth).collect();
    count(&depths, |d| d[0] < d[1])
}

fn headings(regions: &[&Region], size: impl Fn(&Region) -> bool, limit: f64) -> Count {
    let these = regions.iter().filter(|r| size(r));
    let headings: Vec<Heading> = these.filter_map(|r| r.heading).collect();
    count(
        &headings,
        |h| matches!(h, Heading::Off(angle) if *angle <= limit),
    )
}

/// How many of `things` are good.
pub fn count<T>(things: &[T], good: impl Fn(&T) -> bool) -> Count {
    Count {
        good: things.iter().filter(|thing| good(thing)).count(),
        all: things.len(),
    }
}

impl std::fmt::Display for Count {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.all {
            0 => out.write_str("–"),
            all => write!(out, "{} of {all}", self.good),
        }
    }
}
