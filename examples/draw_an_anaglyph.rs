//! Finds the depth of a built-in sequence and draws it for red-cyan glasses.
//!
//!     cargo run --release --example draw_an_anaglyph -- anaglyph.png

use std::error::Error;

use relievo::view::{self, ViewParams};
use relievo::{FramePair, Options, Solver, Status, file::png, scene};

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args().nth(1).unwrap_or("anaglyph.png".to_owned());
    let columns = scene::render("columns", 320, 240)?;
    let [first, second] = columns.frames;
    let pair = FramePair::new(first, second)?;
    let mut solver = Solver::new(pair, columns.truth.camera, &[], Options::default())?;
    while solver.step() == Status::Running {}

    let params = ViewParams {
        glasses: "red-cyan".to_owned(),
        // Parallax between the farthest and the nearest, as a share of the frame's width.
        baseline: 0.03,
        ..ViewParams::default()
    };
    let (frame, found) = (solver.pair().first(), solver.interpretation());
    let picture = view::draw("anaglyph", frame, &found, &[], &params)?;
    std::fs::write(&out, png::write_rgba(&picture)?)?;
    println!("{out}");
    Ok(())
}
