//! The chain for one rigid scene, measured: matches → motion → plane sweep → dense inverse depth.
//!
//! `cargo run --release --example depth [-- DATA]` prints a line a scene: error of the image motion in pixels, of T in
//! degrees, and milliseconds. DATA is the folder of recorded sequences.

use std::path::Path;
use std::time::Instant;

use relievo::file::flo;
use relievo::{Flow, Frame, scene};

// The modules under test are private to the crate.
mod camera {
    pub use relievo::camera::{Camera, RigidMotion};
}
mod frames {
    pub use relievo::frames::halved;
}
mod grid {
    pub use relievo::Grid;
}
#[allow(dead_code, unused_imports)]
#[path = "../../src/init/mod.rs"]
mod init;
#[allow(dead_code, unused_imports)]
#[path = "../../src/linalg/mod.rs"]
mod linalg;

use camera::{Camera, RigidMotion};
use grid::Grid;

struct Scene {
    name: String,
    frames: [Grid<f32>; 2],
    camera: Camera,
    flow: Flow,
    motion: Option<RigidMotion>,
}

type Failure = Box<dyn std::error::Error>;

fn built_in(sequence: scene::Sequence) -> Scene {
    let [first, second] = sequence.frames;
    Scene {
        name: sequence.name,
        frames: [first.grey, second.grey],
        camera: sequence.truth.camera,
        flow: sequence.truth.flow,
        motion: Some(sequence.truth.motions[0]),
    }
}

const NOISES: [f32; 5] = [1.0, 2.0, 3.0, 4.0, 6.0];
const DISPLACEMENTS: [f64; 5] = [2.0, 4.0, 6.0, 9.0, 12.0];

/// The scenes that `bench/accuracy` draws from seeds 1000 on.
fn passing(k: u64) -> Result<Scene, Failure> {
    let base = ["blocks", "carousel"][(k % 2) as usize];
    let noise = NOISES[(k / 2 % 5) as usize];
    let displacement = DISPLACEMENTS[((k / 2 * 3 + k / 10) % 5) as usize];
    let drawn = scene::passing(base, 1000 + k, noise, displacement, 320, 240)?;
    Ok(built_in(drawn))
}

/// Name, frames, flow, f and, where it is not the middle, the principal point.
type Recorded = (&'static str, [u8; 2], &'static str, f64, Option<[f64; 2]>);

const RECORDED: [Recorded; 5] = [
    ("motorcycle", [10, 11], "flow10.flo", 397.0, None),
    ("urban3", [10, 11], "flow10.flo", 640.0, None),
    (
        "kitti74",
        [10, 11],
        "flow10.flo",
        359.4,
        Some([304.0, 86.0]),
    ),
    ("venus", [10, 11], "flow10.flo", 420.0, None),
    ("yosemite", [9, 10], "flow09.flo", 337.0, None),
];

fn recorded(data: &Path, (name, numbers, flow, focal, centre): Recorded) -> Result<Scene, Failure> {
    let folder = data.join(name);
    let frame = |n: u8| -> Result<Grid<f32>, Failure> {
        let bytes = std::fs::read(folder.join(format!("frame{n:02}.png")))?;
        Ok(Frame::decode(&bytes, name)?.grey)
    };
    let frames = [frame(numbers[0])?, frame(numbers[1])?];
    let camera = match centre {
        Some([cx, cy]) => Camera::new(focal, cx, cy)?,
        None => Camera::centred(focal, frames[0].width(), frames[0].height())?,
    };
    Ok(Scene {
        name: name.to_owned(),
        flow: flo::read(&std::fs::read(folder.join(flow))?, name)?,
        frames,
        camera,
        motion: None,
    })
}

fn measure(scene: &Scene) {
    let [first, second] = &scene.frames;
    let clock = Instant::now();
    let found = init::matches(first, second);
    let t_match = clock.elapsed().as_secs_f64() * 1e3;
    let clock = Instant::now();
    let motion = init::epipolar_motion(&found, &scene.camera);
    let t_motion = clock.elapsed().as_secs_f64() * 1e3;
    let mut errors: Vec<f32> = found
        .iter()
        .map(|m| {
            let at = (m.at[0] as usize, m.at[1] as usize);
            let [u, v] = m.displacement();
            (u - scene.flow.u[at]).hypot(v - scene.flow.v[at])
        })
        .filter(|e| e.is_finite())
        .collect();
    errors.sort_by(f32::total_cmp);
    let bad = errors.iter().filter(|&&e| e > 1.0).count() as f32 / errors.len().max(1) as f32;
    print!(
        "{:22} n {:5} median {:.3} bad {:4.1}% ",
        scene.name,
        found.len(),
        errors.get(errors.len() / 2).unwrap_or(&f32::NAN),
        100.0 * bad
    );
    if let Some(m) = motion {
        let t = m.motion.translation;
        let angle = scene.motion.map_or(f64::NAN, |truth| {
            truth.translation.angle_between(t).to_degrees()
        });
        print!(
            "{:?} T [{:.3} {:.3} {:.3}] {angle:.2}° w {:.4?} sigma {:.3} inliers {:.3}",
            m.model,
            t.x,
            t.y,
            t.z,
            m.motion.rotation.to_array(),
            m.sigma,
            m.inliers
        );
    }
    println!(" | ms match {t_match:.1} motion {t_motion:.1}");
}

fn main() -> Result<(), Failure> {
    let mut scenes = Vec::new();
    for name in ["flight", "columns"] {
        scenes.push(built_in(scene::render(name, 320, 240)?));
    }
    for k in 0..20 {
        scenes.push(passing(k)?);
    }
    if let Some(data) = std::env::args().nth(1) {
        for case in RECORDED {
            scenes.push(recorded(Path::new(&data), case)?);
        }
    }
    for scene in &scenes {
        measure(scene);
    }
    Ok(())
}
