//! Watches two circles become the outlines of two squares, a pass at a time, while the energy falls.
//!
//!     cargo run --release --example watch_a_solve

use relievo::options::Preset;
use relievo::{Error, FramePair, Grid, Options, Solver, Status, scene};

fn main() -> Result<(), Error> {
    let squares = scene::render("squares", 160, 120)?;
    let [first, second] = squares.frames;
    let pair = FramePair::new(first, second)?;
    let options = Options::preset(Preset::Paper);
    let mut solver = Solver::new(pair, squares.truth.camera, &squares.curves, options)?;
    show(&solver.interpretation().labels);
    while solver.step() == Status::Running {
        let energy = solver.energy();
        println!(
            "pass {}: data {:.0} + smoothness {:.0} + length {:.0} = {:.0}",
            solver.iterations(),
            energy.data,
            energy.smoothness,
            energy.length,
            energy.total()
        );
        if solver.iterations().is_multiple_of(10) {
            show(&solver.interpretation().labels);
        }
    }
    show(&solver.interpretation().labels);
    println!("{:?}", solver.status());
    Ok(())
}

/// A letter for every four by eight pixels.
fn show(labels: &Grid<u8>) {
    for y in (4..labels.height()).step_by(8) {
        let row = (2..labels.width()).step_by(4);
        let line: String = row
            .map(|x| ['.', 'a', 'b'][usize::from(labels[(x, y)])])
            .collect();
        println!("{line}");
    }
}
