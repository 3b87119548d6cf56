//! Finds the relief of a built-in sequence and writes it as a coloured surface that 3-D programs read.
//!
//!     cargo run --release --example write_a_ply -- relief.ply

use std::error::Error;

use relievo::file::ply;
use relievo::view::{self, ViewParams};
use relievo::{FramePair, Options, Solver, Status, scene};

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args().nth(1).unwrap_or("relief.ply".to_owned());
    let figure = scene::render("figure", 320, 240)?;
    let [first, second] = figure.frames;
    let pair = FramePair::new(first, second)?;
    let mut solver = Solver::new(
        pair,
        figure.truth.camera,
        &figure.curves,
        Options::default(),
    )?;
    while solver.step() == Status::Running {}

    let params = ViewParams::default();
    let mesh = view::mesh(solver.pair().first(), &solver.interpretation(), &params);
    std::fs::write(&out, ply::write(&mesh))?;
    let (vertices, faces) = (mesh.positions.len() / 3, mesh.indices.len() / 3);
    println!("{out}: {vertices} vertices, {faces} triangles");
    Ok(())
}
