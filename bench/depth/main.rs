//! The chain for one rigid scene, measured: matches → motion → plane sweep → dense inverse depth.
//!
//! `cargo run --release --example depth [-- DATA]` prints a line a scene: error of the image motion in pixels, of T in
//! degrees, and milliseconds. DATA is the folder of recorded sequences.

use std::path::Path;
use std::time::Instant;

use relievo::file::flo;
use relievo::{Flow, Frame, scene};

// What is measured is private to the crate, so its files are taken in here.
mod camera {
    pub use relievo::camera::{Camera, RigidMotion};
}
mod frames {
    pub use relievo::frames::{halved, halved_camera};
}
mod grid {
    pub use relievo::Grid;
}
#[allow(dead_code, unused_imports)]
#[path = "../../src/init/mod.rs"]
mod init;
#[allow(dead_code, unused_imports)]
#[path = "../../src/layered/mod.rs"]
mod layered;
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
    region: Region,
}

/// The pixels that move as one body.
enum Region {
    Frame,
    /// Those whose flow is known.
    Known,
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
        region: Region::Frame,
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
        // The sky over Yosemite is not rigid.
        region: match name {
            "yosemite" => Region::Known,
            _ => Region::Frame,
        },
    })
}

/// AEE in pixels and AAE in degrees.
fn score(scene: &Scene, motion: &RigidMotion, rho: &Grid<f32>) -> (f64, f64) {
    let (width, height) = (rho.width(), rho.height());
    let mut flow = Flow {
        u: Grid::new(width, height, 0.0),
        v: Grid::new(width, height, 0.0),
    };
    for y in 0..height {
        for x in 0..width {
            let r = f64::from(rho[(x, y)]);
            if let Some((u, v)) = scene.camera.displacement(motion, x as f64, y as f64, r) {
                flow.u[(x, y)] = u as f32;
                flow.v[(x, y)] = v as f32;
            }
        }
    }
    let scores = relievo::score::compare_flow(&flow, &scene.flow, None);
    scores.ok().flatten().unwrap_or((f64::NAN, f64::NAN))
}

/// AEE after the sweep and after the refinement; `None` where the matches determine no translation.
fn measure(scene: &Scene) -> Option<[f64; 2]> {
    let [first, second] = &scene.frames;
    let frames = [first, second];
    let support = match scene.region {
        Region::Frame => Grid::new(first.width(), first.height(), true),
        Region::Known => scene.flow.u.map(f32::is_finite),
    };
    let clock = Instant::now();
    let ms = || clock.elapsed().as_secs_f64() * 1e3;
    let mut found = init::matches(first, second);
    found.retain(|m| support[(m.at[0] as usize, m.at[1] as usize)]);
    let t_match = ms();
    let motion = init::epipolar_motion(&found, &scene.camera)?;
    let t_motion = ms();
    let range = layered::refine::match_range(&found, &motion, &scene.camera)?;
    let swept = layered::refine::sweep(frames, &scene.camera, &motion.motion, &support, range);
    let t_sweep = ms();
    let refined = layered::refine::refine(
        frames,
        &scene.camera,
        &swept.motion,
        &support,
        swept.rho.clone(),
    );
    let t_dense = ms();
    let angle = |m: &RigidMotion| {
        scene.motion.map_or(f64::NAN, |truth| {
            truth.translation.angle_between(m.translation).to_degrees()
        })
    };
    let (sweep_aee, _) = score(scene, &swept.motion, &swept.rho);
    let (aee, aae) = score(scene, &refined.motion, &refined.rho);
    println!(
        "{:22} sweep {sweep_aee:.3} dense {aee:.4} px {aae:.3}° | T {:.2}° then {:.2}° sigma {:.2} | ms match {:.0} motion {:.0} sweep {:.0} dense {:.0} all {:.0}",
        scene.name,
        angle(&motion.motion),
        angle(&refined.motion),
        refined.sigma,
        t_match,
        t_motion - t_match,
        t_sweep - t_motion,
        t_dense - t_sweep,
        t_dense,
    );
    Some([sweep_aee, aee])
}

fn main() -> Result<(), Failure> {
    for name in ["flight", "columns"] {
        measure(&built_in(scene::render(name, 320, 240)?));
    }
    let mut drawn = Vec::new();
    for k in 0..20 {
        drawn.extend(measure(&passing(k)?));
    }
    let mean = |k: usize| {
        let logarithms = drawn.iter().map(|s| s[k].ln());
        (logarithms.sum::<f64>() / drawn.len() as f64).exp()
    };
    println!(
        "passing, geometric mean: sweep {:.4} dense {:.4}",
        mean(0),
        mean(1)
    );
    if let Some(data) = std::env::args().nth(1) {
        for case in RECORDED {
            measure(&recorded(Path::new(&data), case)?);
        }
    }
    Ok(())
}
