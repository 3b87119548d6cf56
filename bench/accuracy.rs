//! What the method reaches on the built-in sequences: `npm run accuracy [-- NAME…]`.
//!
//! Two tables for each preset, at 320×240 and from the curves that come with a sequence: how far the
//! result is from the truth, Horn–Schunck beside it, and how much the regions depend on where the
//! curves were drawn. Nothing here is timed; each row takes seconds.

use std::error::Error;

use relievo::curves::Shape;
use relievo::horn_schunck::{self, ALPHA, SWEEPS};
use relievo::options::{Options, Preset};
use relievo::scene::{self, Sequence};
use relievo::score::{Scores, compare, compare_flow};
use relievo::{FramePair, Solver, Status};

const SIZE: [usize; 2] = [320, 240];

/// Sequences whose regions are compared between placements of their curves.
const PLACED: [&str; 3] = ["squares", "blocks", "carousel"];

/// Placements: what a circle's centre moves by, in radii, and what its radius is multiplied by. Every
/// second circle moves the other way.
const PLACEMENTS: [[f64; 3]; 5] = [
    [0.0, 0.0, 1.0],
    [0.33, 0.0, 1.0],
    [0.0, -0.33, 1.0],
    [-0.25, 0.25, 0.8],
    [-0.2, -0.2, 1.25],
];

fn main() -> Result<(), Box<dyn Error>> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &&&str| asked.is_empty() || asked.iter().any(|a| a == **name);
    let names: Vec<&str> = scene::names().iter().filter(wanted).copied().collect();
    for &preset in Preset::ALL {
        println!("## Preset {preset:?}, {}×{} pixels\n", SIZE[0], SIZE[1]);
        accuracy(preset, &names)?;
        placements(preset, &names)?;
    }
    Ok(())
}

fn accuracy(preset: Preset, names: &[&str]) -> Result<(), Box<dyn Error>> {
    println!(
        "| sequence | labels wrong, % | AEE, px | Horn–Schunck, px | AAE, ° | T off by, ° | depth error, % | flat guess, % | passes | status | energy's rise, % |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for &name in names {
        let sequence = scene::render(name, SIZE[0], SIZE[1])?;
        let solver = solve(&sequence, &sequence.curves, preset)?;
        let truth = &sequence.truth;
        let scores = compare(&solver.interpretation(), truth)?;
        let baseline = horn_schunck::solve(solver.pair(), ALPHA, SWEEPS);
        let baseline = compare_flow(&baseline, &truth.flow, None)?;
        println!(
            "| `{name}` | {:.1} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            100.0 * scores.labels_wrong,
            number(scores.aee, 3),
            number(baseline.map(|(aee, _)| aee), 3),
            number(scores.aae, 2),
            list(&scores.translation_angle, 1.0),
            list(&observable(&scores, &scores.depth_error), 100.0),
            list(&observable(&scores, &scores.flat_depth_error), 100.0),
            solver.iterations(),
            word(solver.status()),
            number(rise(&solver).map(|r| 100.0 * r), 2),
        );
    }
    println!(
        "\nWhere there are several regions: the background's figure first, then each curve's.\n"
    );
    Ok(())
}

fn placements(preset: Preset, names: &[&str]) -> Result<(), Box<dyn Error>> {
    println!(
        "| sequence | labels wrong in each of five placements, % | pixels that differ, at most, % |"
    );
    println!("|---|---|---|");
    for name in names.iter().filter(|name| PLACED.contains(name)) {
        let sequence = scene::render(name, SIZE[0], SIZE[1])?;
        let truth = sequence.truth.labels.data();
        let mut found: Vec<Vec<u8>> = Vec::new();
        for placement in PLACEMENTS {
            let curves = placed(&sequence.curves, placement);
            let solver = solve(&sequence, &curves, preset)?;
            found.push(solver.interpretation().labels.data().to_vec());
        }
        let wrong: Vec<Option<f64>> = found.iter().map(|f| Some(differing(f, truth))).collect();
        let pairs = found
            .iter()
            .flat_map(|a| found.iter().map(|b| differing(a, b)));
        let most = pairs.fold(0.0, f64::max);
        println!(
            "| `{name}` | {} | {:.2} |",
            list(&wrong, 100.0),
            100.0 * most
        );
    }
    println!();
    Ok(())
}

fn solve(sequence: &Sequence, curves: &[Shape], preset: Preset) -> Result<Solver, Box<dyn Error>> {
    let [first, second] = sequence.frames.clone();
    let pair = FramePair::new(first, second)?;
    let options = Options::preset(preset);
    let mut solver = Solver::new(pair, sequence.truth.camera, curves, options)?;
    while solver.step() == Status::Running {}
    Ok(solver)
}

fn placed(curves: &[Shape], [right, down, grow]: [f64; 3]) -> Vec<Shape> {
    let numbered = curves.iter().enumerate();
    numbered
        .map(|(k, curve)| {
            let way = if k % 2 == 0 { 1.0 } else { -1.0 };
            match curve {
                Shape::Circle { x, y, r } => Shape::Circle {
                    x: x + way * right * r,
                    y: y + way * down * r,
                    r: grow * r,
                },
                other => other.clone(),
            }
        })
        .collect()
}

/// Depth figures of the regions that translate; the depth of others cannot be seen.
fn observable(scores: &Scores, figures: &[Option<f64>]) -> Vec<Option<f64>> {
    let translates = scores.translation_angle.iter().map(Option::is_some);
    let pairs = figures.iter().zip(translates);
    pairs.map(|(&f, t)| if t { f } else { None }).collect()
}

/// The largest relative rise of the energy from a pass to one of the ten after it; energies of
/// different scales do not compare.
fn rise(solver: &Solver) -> Option<f64> {
    let history = solver.history();
    let later = |i: usize| history.iter().skip(i + 1).take(10);
    let passes = history.iter().enumerate();
    let rises = passes.flat_map(|(i, e)| later(i).map(move |l| l / e - 1.0));
    (solver.report().levels == 1).then(|| rises.fold(0.0, f64::max))
}

fn differing(a: &[u8], b: &[u8]) -> f64 {
    a.iter().zip(b).filter(|(a, b)| a != b).count() as f64 / a.len() as f64
}

fn word(status: Status) -> &'static str {
    match status {
        Status::Running => "running",
        Status::Converged => "converged",
        Status::Exhausted => "out of iterations",
        Status::Diverged => "diverged",
    }
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |v| format!("{v:.digits$}"))
}

fn list(values: &[Option<f64>], unit: f64) -> String {
    let texts = values.iter().map(|v| number(v.map(|v| unit * v), 1));
    texts.collect::<Vec<_>>().join(" / ")
}
