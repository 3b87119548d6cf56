//! How near to the truth anything could come on these frames, region by region.

use relievo::motion::Kind;
use relievo::options::Options;
use relievo::scene::Sequence;
use relievo::score::compare;
use relievo::warp::{RESIDUAL, pyramid};
use relievo::{FramePair, Grid, Interpretation, RigidMotion};

use crate::Failure;
use crate::cases::Case;
use crate::information::{AtBest, Pixel, at_best};
use crate::measure::seen;
use crate::statistics::median;
use crate::table::{head, number, percent, row};
use crate::threads::try_in_order;

/// Pixels this near to another region, or to the frame's border, show more than their own region.
const RIM: usize = 2;

/// Prints for each region of `cases` what its frames tell of it at best.
pub fn print(cases: &[Case]) -> Result<(), Failure> {
    head(&[
        "sequence",
        "depth error at best, %",
        "half a flat guess, %",
        "T off at best, °",
    ]);
    try_in_order(
        cases,
        |case| of(&case.render()?),
        |case, regions| {
            let each = |text: &dyn Fn(&Limits) -> String| {
                regions.iter().map(text).collect::<Vec<_>>().join(" / ")
            };
            row(&[
                format!("`{}`", case.name()),
                each(&|r| percent(r.at_best.map(|b| b.depth), 2)),
                each(&|r| percent(r.half_flat, 2)),
                each(&|r| number(r.at_best.map(|b| b.heading), 1)),
            ]);
        },
    )
}

/// What can be reached in a region; nothing where it does not translate.
struct Limits {
    at_best: Option<AtBest>,
    half_flat: Option<f64>,
}

fn of(sequence: &Sequence) -> Result<Vec<Limits>, Failure> {
    let truth = &sequence.truth;
    let [first, second] = sequence.frames.clone();
    let pair = FramePair::new(first, second)?;
    let flat = compare(truth, truth)?.flat_depth_error;
    let region = |k: usize| {
        let (_, kind) = seen(truth, k);
        let translates = kind.translates();
        Limits {
            at_best: translates.then(|| told(&pair, truth, k, kind)).flatten(),
            half_flat: flat[k].filter(|_| translates).map(|error| 0.5 * error),
        }
    };
    Ok((0..truth.regions()).map(region).collect())
}

/// What region k's pixels tell of its truth.
fn told(pair: &FramePair, truth: &Interpretation, k: usize, kind: Kind) -> Option<AtBest> {
    let places = inner(truth, k);
    let rho = |at: (usize, usize)| 1.0 / f64::from(truth.depth[at]);
    let mean = places.iter().map(|at| rho(*at)).sum::<f64>() / places.len() as f64;
    let motion = RigidMotion {
        translation: truth.motions[k].translation * mean,
        rotation: truth.motions[k].rotation,
    };
    let (width, height) = (truth.labels.width(), truth.labels.height());
    let field = Grid::from_fn(width, height, |x, y| (rho((x, y)) / mean) as f32);
    // Derivatives need brightness smoothed as the solver has it; smoothed noise would look less than it is.
    let [smooth, raw] = [Options::default().smoothing, 0.0].map(|smoothing| {
        let scales = pyramid(pair, truth.camera, smoothing);
        scales[0].linearise(&motion, &field, scales[0].whole())
    });
    let kept: Vec<(usize, usize)> = places.into_iter().filter(|at| raw.inside[*at]).collect();
    let residuals = kept
        .iter()
        .map(|at| f64::from(raw.rows[*at][RESIDUAL]).abs());
    // Of normal noise half is below 0.6745 standard deviations.
    let sigma = median(&residuals.collect::<Vec<_>>())? / 0.6745;
    let pixel = |at: &(usize, usize)| (smooth.rows[*at], [at.0 as f64, at.1 as f64]);
    let pixels: Vec<Pixel> = kept.iter().map(pixel).collect();
    at_best(&pixels, sigma, &motion, kind.rotates())
}

/// Pixels of region k that are seen in both frames, away from its rim.
fn inner(truth: &Interpretation, k: usize) -> Vec<(usize, usize)> {
    let (width, height) = (truth.labels.width(), truth.labels.height());
    let own = |x: usize, y: usize| usize::from(truth.labels[(x, y)]) == k;
    let alone = |x: usize, y: usize| {
        let mut around = (y - RIM..=y + RIM).flat_map(|y| (x - RIM..=x + RIM).map(move |x| (x, y)));
        around.all(|(x, y)| own(x, y))
    };
    let places = (RIM..height - RIM).flat_map(|y| (RIM..width - RIM).map(move |x| (x, y)));
    places
        .filter(|&(x, y)| truth.depth[(x, y)] > 0.0 && truth.depth[(x, y)].is_finite())
        .filter(|&(x, y)| truth.occluded[(x, y)] == 0 && alone(x, y))
        .collect()
}
