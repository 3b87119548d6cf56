//! The bytes are a short film of hostile frames and what a person does while it is solved.

use arbitrary::{Result, Unstructured};
use relievo::options::{Diffusion, Preset};
use relievo::solver::find_curves;
use relievo::view::{self, ViewParams};
use relievo::{Camera, Frame, FramePair, Grid, Options, Solver, Status, init};

use super::settings::curve;

/// A solver that takes what it is given ends, and gives numbers whenever it is asked.
pub fn solves(bytes: &[u8]) {
    // What is refused, and bytes that end too early, are no fault.
    let _ = film(&mut Unstructured::new(bytes));
}

fn film(u: &mut Unstructured) -> Result<()> {
    let (width, height) = (u.int_in_range(16..=32)?, u.int_in_range(16..=24)?);
    let first = picture(u, width, height)?;
    let second = match u.int_in_range(0..=3)? {
        0 => moved(u, &first)?,
        1 => touched(u, &first)?,
        2 => first.map(|g| 255.0 - g),
        _ => picture(u, width, height)?,
    };
    let frame = |grey| Frame::from_grey(grey).unwrap();
    let Ok(pair) = FramePair::new(frame(first), frame(second.clone())) else {
        return Ok(());
    };
    let Ok(camera) = camera(u, width, height) else {
        return Ok(());
    };
    if u.ratio(1, 8)? {
        for shape in find_curves(&pair, &camera) {
            shape.level_set(width, height, 0).unwrap();
        }
        if let Some(found) = init::focal_length(&pair, &camera) {
            assert!(found.focal.is_finite() && found.focal > 0.0);
        }
    }
    let count = u.int_in_range(0..=3)?;
    let curves = (0..count).map(|_| curve(u)).collect::<Result<Vec<_>>>()?;
    let options = options(u)?;
    // Bad curves are refused, which `settings` looks at: what is left is solved without any.
    let made = Solver::new(pair.clone(), camera, &curves, options.clone());
    let mut solver = made.unwrap_or_else(|_| Solver::new(pair, camera, &[], options).unwrap());
    for _ in 0..u.int_in_range(1..=5)? {
        match u.int_in_range(0..=9)? {
            0 => solver.step_motion(),
            1 => drop(solver.step_depth()),
            2 => solver.step_curves(),
            3 => solver.reset(),
            4 => solver.set_options(self::options(u)?).unwrap(),
            5 => drop(solver.set_curves(&[curve(u)?])),
            6 => drop(solver.next(frame(touched(u, &second)?))),
            _ => run(&mut solver),
        }
        whole(&solver);
    }
    run(&mut solver);
    whole(&solver);
    if u.ratio(1, 8)? {
        drawn(&solver);
    }
    Ok(())
}

fn run(solver: &mut Solver) {
    // 60 at most by the options below, and some more for a film.
    for _ in 0..200 {
        if solver.step() != Status::Running {
            return;
        }
    }
    panic!("it does not end");
}

fn whole(solver: &Solver) {
    let found = solver.interpretation();
    let depth = found.depth.data();
    assert!(depth.iter().all(|z| z.is_finite() && *z > 0.0), "depth");
    let flow = found.flow.u.data().iter().chain(found.flow.v.data());
    assert!(flow.clone().all(|w| w.is_finite()), "flow");
    let regions = found.regions();
    assert!(
        found
            .labels
            .data()
            .iter()
            .all(|&l| usize::from(l) < regions)
    );
    let confidence = found.confidence.data();
    assert!(confidence.iter().all(|c| (0.0..=1.0).contains(c)));
    for motion in &found.motions {
        assert!(motion.translation.is_finite() && motion.rotation.is_finite());
    }
    let report = solver.report();
    assert!(report.weights.sigma.is_finite() && report.weights.mu.is_finite());
    let points = solver.contours();
    let mut points = points.iter().flat_map(|c| &c.points);
    assert!(points.all(|[x, y]| x.is_finite() && y.is_finite()));
}

fn drawn(solver: &Solver) {
    let (found, frame) = (solver.interpretation(), solver.pair().first());
    let params = ViewParams::default();
    for kind in view::KINDS {
        view::draw(kind, frame, &found, &solver.contours(), &params).unwrap();
    }
    view::mesh(frame, &found, &params);
}

fn camera(u: &mut Unstructured, width: usize, height: usize) -> Result<Camera> {
    let focal = match u.int_in_range(0..=5)? {
        0 => 1.0,
        1 => 1e6,
        2 => u.arbitrary()?,
        _ => f64::from(u.int_in_range(8u8..=200)?),
    };
    let seen = if u.ratio(1, 6)? {
        Camera::new(focal, u.arbitrary()?, u.arbitrary()?)
    } else {
        Camera::centred(focal, width, height)
    };
    seen.map_err(|_| arbitrary::Error::IncorrectFormat)
}

fn options(u: &mut Unstructured) -> Result<Options> {
    let preset = *u.choose(Preset::ALL)?;
    let weight = |u: &mut Unstructured| {
        Ok(match u.int_in_range(0..=5)? {
            0 => Some(0.0),
            1 => Some(u.arbitrary()?),
            2 => Some(f64::from(u.arbitrary::<i8>()? / 4).exp2()),
            _ => None,
        })
    };
    let usual = Options::preset(preset);
    let all = Options {
        mu: weight(u)?,
        lambda: weight(u)?,
        diffusion: *u.choose(&[Diffusion::Anisotropic, Diffusion::Isotropic])?,
        epsilon: weight(u)?.unwrap_or(usual.epsilon),
        smoothing: weight(u)?.unwrap_or(usual.smoothing),
        lighting: u.arbitrary()?,
        model_selection: u.arbitrary()?,
        occlusion: u.arbitrary()?,
        discontinuities: u.arbitrary()?,
        rotation_ridge: weight(u)?.unwrap_or(usual.rotation_ridge),
        depth_steps: u.int_in_range(1..=20)?,
        curve_steps: u.int_in_range(1..=20)?,
        max_passes: u.int_in_range(1..=60)?,
        tolerance: weight(u)?.unwrap_or(usual.tolerance),
        ..usual.clone()
    };
    Ok(if all.validate().is_ok() { all } else { usual })
}

/// Waves, stripes, a step, one pixel on a wall, extremes, noise, or brightness as it comes.
fn picture(u: &mut Unstructured, width: usize, height: usize) -> Result<Grid<f32>> {
    let kind = u.int_in_range(0..=7)?;
    let [a, b, c, d] = u.arbitrary::<[u8; 4]>()?;
    let [p, q] = [a, b].map(|k| f32::from(k) / 40.0);
    let mut state = u32::from_le_bytes([a, b, c, d]) | 1;
    let mut picture = Grid::from_fn(width, height, |x, y| {
        let (fx, fy) = (x as f32, y as f32);
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let random = state >> 24;
        match kind {
            0 => 128.0 + 60.0 * (p * fx).sin() + 60.0 * (q * fy).cos(),
            1 => 128.0 + f32::from(c) / 2.0 * (p * fx + q * fy).sin(),
            2 => f32::from(if x < usize::from(a) % width { c } else { d }),
            3 => f32::from(c),
            4 => 255.0 * (random & 1) as f32,
            5 => 255.0 * ((x / (1 + usize::from(a % 4)) + y / (1 + usize::from(b % 4))) % 2) as f32,
            6 => random as f32,
            _ => f32::from(c) + random as f32 * 1e-4,
        }
    });
    if kind == 3 {
        picture[(usize::from(a) % width, usize::from(b) % height)] = f32::from(d);
    }
    if u.ratio(1, 4)? {
        for g in picture.data_mut() {
            *g = f32::from(u.arbitrary::<u8>().unwrap_or(128));
        }
    }
    Ok(picture)
}

/// The picture moved by whole pixels, around its borders.
fn moved(u: &mut Unstructured, picture: &Grid<f32>) -> Result<Grid<f32>> {
    let (width, height) = (picture.width(), picture.height());
    let (dx, dy) = (
        u.int_in_range(0..=width - 1)?,
        u.int_in_range(0..=height - 1)?,
    );
    Ok(Grid::from_fn(width, height, |x, y| {
        picture[((x + dx) % width, (y + dy) % height)]
    }))
}

/// The picture with a few pixels changed.
fn touched(u: &mut Unstructured, picture: &Grid<f32>) -> Result<Grid<f32>> {
    let mut changed = picture.clone();
    for _ in 0..u.int_in_range(1..=4)? {
        let x = u.int_in_range(0..=picture.width() - 1)?;
        let y = u.int_in_range(0..=picture.height() - 1)?;
        changed[(x, y)] = f32::from(u.arbitrary::<u8>()?);
    }
    Ok(changed)
}
