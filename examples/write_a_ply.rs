//! Finds the relief of a built-in sequence and writes it as a coloured surface that 3-D programs read.
//!
//!     cargo run --release --example write_a_ply -- relief.ply

use std::error::Error;
use std::io::Write;

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
    let (vertices, faces) = (mesh.positions.len() / 3, mesh.indices.len() / 3);
    let mut file = std::io::BufWriter::new(std::fs::File::create(&out)?);
    writeln!(file, "ply\nformat ascii 1.0\nelement vertex {vertices}")?;
    for axis in ["x", "y", "z"] {
        writeln!(file, "property float {axis}")?;
    }
    for channel in ["red", "green", "blue"] {
        writeln!(file, "property uchar {channel}")?;
    }
    writeln!(
        file,
        "element face {faces}\nproperty list uchar int vertex_indices\nend_header"
    )?;
    for (p, c) in mesh.positions.chunks(3).zip(mesh.colours.chunks(3)) {
        writeln!(
            file,
            "{} {} {} {} {} {}",
            p[0], p[1], p[2], c[0], c[1], c[2]
        )?;
    }
    for corner in mesh.indices.chunks(3) {
        writeln!(file, "3 {} {} {}", corner[0], corner[1], corner[2])?;
    }
    file.flush()?;
    println!("{out}: {vertices} vertices, {faces} triangles");
    Ok(())
}
