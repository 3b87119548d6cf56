//! The native side of the speed tables: reads requests, a line of JSON each, and answers each with a line of JSON.
//!
//! `scripts/bench.js` starts it and asks. A request is `{"work": …, "folder": …}`:
//!
//! - `render` (with `scene`, `width`, `height`) writes three frames and their truth into `folder`;
//! - `trial` (with `preset`) solves once and scores every pass, `solve` solves against the clock, `memory` solves and
//!   says by how much the process has grown.

mod memory;
mod protocol;
mod render;
mod scores;
mod sequence;
mod solve;

use std::error::Error;
use std::io::{BufRead, Write, stdin, stdout};

use protocol::Request;
use serde_json::{Value, json};

/// What goes wrong, as a sentence.
type Failure = Box<dyn Error>;

fn main() -> Result<(), Failure> {
    let base = memory::resident();
    for line in stdin().lock().lines() {
        let answer = answer(&line?, base).unwrap_or_else(|e| json!({ "error": e.to_string() }));
        writeln!(stdout(), "{answer}")?;
        stdout().flush()?;
    }
    Ok(())
}

fn answer(line: &str, base: Option<u64>) -> Result<Value, Failure> {
    let request: Request = serde_json::from_str(line)?;
    Ok(match request {
        Request::Render {
            folder,
            scene,
            width,
            height,
        } => json!(render::render(&scene, width, height, &folder)?),
        Request::Trial { folder, preset } => json!(solve::trial(&folder, preset)?),
        Request::Solve {
            folder,
            preset,
            usable,
        } => json!(solve::timed(&folder, preset, usable)?),
        Request::Memory { folder, preset } => {
            solve::only(&folder, preset)?;
            json!({ "bytes": memory::peak().zip(base).map(|(peak, base)| peak - base) })
        }
    })
}
