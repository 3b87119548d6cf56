//! Solves two frames of one's own and prints what moves how.
//!
//!     cargo run --release --example solve_a_pair -- FIRST SECOND FOCAL

use std::error::Error;

use relievo::solver::find_curves;
use relievo::{Camera, Frame, FramePair, Options, Solver, Status};

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [first, second, focal] = &words[..] else {
        return Err("two image files and the focal length in pixels are needed".into());
    };
    let read = |path: &String| -> Result<Frame, Box<dyn Error>> {
        Ok(Frame::decode(&std::fs::read(path)?, path)?)
    };
    let pair = FramePair::new(read(first)?, read(second)?)?;
    let camera = Camera::centred(focal.parse()?, pair.width(), pair.height())?;

    // A curve roughly on each moving thing; who knows better draws them.
    let curves = find_curves(&pair, &camera);
    let mut solver = Solver::new(pair, camera, &curves, Options::default())?;
    while solver.step() == Status::Running {}

    let report = solver.report();
    println!("{:?} after {} passes", report.status, report.iterations);
    for region in report.regions {
        let (share, model) = (100.0 * region.share, region.model);
        let (t, w) = (region.translation, region.rotation);
        println!(
            "region {}: {share:.1} %, {model:?}, T {t:.3?}, ω {w:.4?} rad",
            region.label
        );
    }
    for warning in report.warnings {
        println!("note: {warning}");
    }
    Ok(())
}
