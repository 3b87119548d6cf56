//! The joint step of motion and depth.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::DVec3;
use relievo::depth::{Bends, FieldPrior, Polynomials};
use relievo::motion::{Joint, JointStep, Kind, held};
use relievo::options::Diffusion;
use relievo::warp::{RESIDUAL, Row, Scale};
use relievo::{Camera, Grid, RigidMotion};

const W: usize = 72;
const H: usize = 56;

fn camera() -> Camera {
    Camera::centred(60.0, W, H).unwrap()
}

fn motion(t: [f64; 3], w: [f64; 3]) -> RigidMotion {
    RigidMotion {
        translation: DVec3::from_array(t),
        rotation: DVec3::from_array(w),
    }
}

fn degrees(a: DVec3, b: DVec3) -> f64 {
    a.angle_between(b).to_degrees()
}

fn texture(x: f64, y: f64) -> f64 {
    120.0
        + 30.0 * (0.45 * x + 0.1 * y).sin()
        + 30.0 * (0.4 * y - 0.13 * x + 0.7).cos()
        + 20.0 * (0.3 * x + 0.31 * y).cos()
}

fn relief() -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| {
        let (x, y) = (x as f64 / 9.0, y as f64 / 8.0);
        (1.0 + 0.35 * x.sin() * y.cos()) as f32
    })
}

/// 1 in the middle.
fn saddle() -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| {
        let (x, y) = (x as f32 / 36.0 - 1.0, y as f32 / 28.0 - 1.0);
        1.0 + 0.25 * (x * x - y * y) + 0.1 * x * y * y
    })
}

/// Two frames of a scene of inverse depth `rho` that moves by `motion`.
fn filmed(motion: &RigidMotion, rho: &Grid<f32>) -> Scale {
    let camera = camera();
    let first = Grid::from_fn(W, H, |x, y| {
        let (px, py) = (x as f64, y as f64);
        let (u, v) = camera
            .displacement(motion, px, py, f64::from(rho[(x, y)]))
            .unwrap();
        texture(px + u, py + v) as f32
    });
    let second = Grid::from_fn(W, H, |x, y| texture(x as f64, y as f64) as f32);
    Scale::new(camera, first, second)
}

/// How depth is smoothed.
fn prior(strength: f64) -> FieldPrior {
    FieldPrior {
        diffusion: Diffusion::Isotropic,
        strength,
        epsilon: 0.01,
        creases: None,
        within: None,
        relief: 0.0,
    }
}

/// How ρ bends about its own slope.
fn about_slope(rho: &Grid<f32>) -> Bends {
    Bends::about_slope(rho, &rho.map(|_| 1.0), [0.0; 2], 8.0)
}

/// How what departs from `surface` steps from pixel to pixel.
fn departing(rho: &Grid<f32>, surface: Option<&Polynomials>) -> Bends {
    Bends::of(&surface.map_or_else(|| rho.clone(), |cubic| cubic.departure(rho)))
}

/// How steps are taken.
struct Manner<'a> {
    kind: Kind,
    prior: FieldPrior,
    surface: Option<&'a Polynomials>,
    keeps_shown: bool,
}

impl Manner<'_> {
    fn of(kind: Kind, strength: f64) -> Self {
        Self {
            kind,
            prior: prior(strength),
            surface: None,
            keeps_shown: false,
        }
    }
}

/// A joint step from `motion` and `rho`, smoothness acting on `bends`.
fn step(
    scale: &Scale,
    motion: &RigidMotion,
    rho: &Grid<f32>,
    manner: &Manner,
    bends: &Bends,
) -> Joint {
    let line = scale.linearise(motion, rho, scale.whole());
    let weight = line.inside.map(f32::from);
    let edges = manner.prior.edges(bends);
    let each =
        |of: fn(&Row) -> f32| Grid::from_fn(W, H, |x, y| weight[(x, y)] * of(&line.rows[(x, y)]));
    let data = each(|row| row[0] * row[0]);
    JointStep {
        rows: &line.rows,
        weight: &weight,
        system: &edges.system(W, H, data.clone().into_vec()),
        data: &data,
        force: &each(|row| -row[0] * row[RESIDUAL]),
        pull: &edges.pull(bends),
        surface: manner.surface,
        rotation_prior: 0.0,
        kind: manner.kind,
        keeps_shown: manner.keeps_shown,
        longest: 2.0 / scale.camera.focal,
    }
    .solve(motion)
}

/// `steps` joint steps from `motion` and a level surface, smoothness acting on the `bends` of ρ as it is.
fn refine(
    scale: &Scale,
    mut motion: RigidMotion,
    steps: usize,
    manner: &Manner,
    bends: impl Fn(&Grid<f32>) -> Bends,
) -> (RigidMotion, Grid<f32>) {
    let mut rho = Grid::new(W, H, 1.0f32);
    for _ in 0..steps {
        let step = step(scale, &motion, &rho, manner, &bends(&rho));
        motion = step.motion;
        for (r, d) in rho.data_mut().iter_mut().zip(step.depth_step.data()) {
            *r += d;
        }
    }
    (motion, rho)
}

#[test]
fn joint_steps_lead_from_a_rough_motion_to_the_true_one() {
    let truth = motion([0.05, 0.02, 0.02], [0.01, -0.012, 0.015]);
    let scale = filmed(&truth, &relief());
    let rough = motion([0.048, 0.032, 0.012], [0.004, -0.004, 0.005]);
    let before = degrees(rough.translation, truth.translation);
    let manner = Manner::of(Kind::Full, 0.01);
    let (found, rho) = refine(&scale, rough, 12, &manner, Bends::of);
    let off = degrees(found.translation, truth.translation);
    assert!(before > 10.0 && off < 2.0, "T is off by {off}°");
    let turn = (found.rotation - truth.rotation).length();
    assert!(turn < 1e-3, "ω is off by {turn}");
    // Depth comes with it, up to the scale that nothing tells.
    let mean = |g: &Grid<f32>| g.data().iter().sum::<f32>() / g.len() as f32;
    let (relief, scale) = (relief(), mean(&rho) / mean(&relief()));
    let pairs = rho.data().iter().zip(relief.data());
    let error = pairs.map(|(a, b)| (a / scale - b).abs()).sum::<f32>() / rho.len() as f32;
    assert!(error < 0.04, "1/Z is off by {error}");
}

/// However stiff depth is otherwise. What is stiff and has no such surface comes out flat, and T with it.
#[test]
fn a_saddle_keeps_its_relief_where_cubic_surfaces_are_free() {
    let saddle = saddle();
    let truth = motion([0.05, 0.02, 0.02], [0.01, -0.012, 0.015]);
    let scale = filmed(&truth, &saddle);
    let cubic = Polynomials::over(&Grid::new(W, H, 1.0), 3).unwrap();
    let found = |surface: Option<&Polynomials>| {
        let rough = motion([0.048, 0.032, 0.012], [0.004, -0.004, 0.005]);
        let stiff = Manner {
            surface,
            ..Manner::of(Kind::Full, 1000.0)
        };
        let bends = |rho: &Grid<f32>| departing(rho, surface);
        let (motion, rho) = refine(&scale, rough, 15, &stiff, bends);
        let mean = |g: &Grid<f32>| g.data().iter().sum::<f32>() / g.len() as f32;
        let (of_found, of_truth) = (mean(&rho), mean(&saddle));
        let pairs = rho.data().iter().zip(saddle.data());
        let (mut both, mut square) = (0.0, 0.0);
        for (a, b) in pairs {
            let b = b / of_truth - 1.0;
            both += (a / of_found - 1.0) * b;
            square += b * b;
        }
        (
            both / square,
            degrees(motion.translation, truth.translation),
        )
    };
    let (relief, off) = found(Some(&cubic));
    assert!((relief - 1.0).abs() < 0.05, "{relief} of the relief");
    assert!(off < 1.0, "T is off by {off}°");
    let (relief, off) = found(None);
    assert!(relief < 0.5 && off > 1.0, "{relief}, {off}° without");
}

/// Smoothness flattens relief as it is; T shall not turn to where the same film has less of it.
#[test]
fn t_stays_where_it_is_headed_where_it_keeps_how_much_relief_shows() {
    let truth = motion([0.05, 0.02, 0.03], [0.01, -0.012, 0.015]);
    let leap = Grid::from_fn(W, H, |x, y| {
        let near = (20..50).contains(&x) && (14..42).contains(&y);
        if near { 1.6f32 } else { 0.7 + 0.006 * y as f32 }
    });
    let scale = filmed(&truth, &leap);
    let off = |keeps_shown| {
        let manner = Manner {
            keeps_shown,
            ..Manner::of(Kind::Full, 0.1)
        };
        let (found, _) = refine(&scale, truth, 20, &manner, Bends::of);
        degrees(found.translation, truth.translation)
    };
    let (shown, length) = (off(true), off(false));
    assert!(shown < 1.5, "T is off by {shown}°");
    assert!(length > 4.0, "{length}° where T keeps its length");
}

/// Smoothness about its own slope lets a saddle be as deep as it likes, but what is expected follows a step behind.
#[test]
fn relief_comes_with_motion_in_a_few_steps_where_a_step_takes_quadratics_at_once() {
    let saddle = Grid::from_fn(W, H, |x, y| {
        let (x, y) = (x as f32 / 36.0 - 1.0, y as f32 / 28.0 - 1.0);
        1.0 + 0.25 * (x * x - y * y) + 0.1 * x
    });
    let truth = motion([0.05, 0.02, 0.02], [0.01, -0.012, 0.015]);
    let scale = filmed(&truth, &saddle);
    let quadratic = Polynomials::over(&Grid::new(W, H, 1.0), 2).unwrap();
    let off = |surface: Option<&Polynomials>| {
        let rough = motion([0.048, 0.032, 0.012], [0.004, -0.004, 0.005]);
        let stiff = Manner {
            surface,
            ..Manner::of(Kind::Full, 1000.0)
        };
        let (found, _) = refine(&scale, rough, 4, &stiff, about_slope);
        degrees(found.translation, truth.translation)
    };
    let (at_once, behind) = (off(Some(&quadratic)), off(None));
    assert!(at_once < 1.0, "T is off by {at_once}° after four steps");
    assert!(behind > 3.0 * at_once, "{behind}° without, {at_once}° with");
}

/// Each number that is free lowers the energy no further: neither motion, nor a surface, nor what departs from it.
#[test]
fn a_step_ends_where_its_energy_is_least() {
    let scale = filmed(&motion([0.05, 0.02, 0.02], [0.0; 3]), &saddle());
    let cubic = Polynomials::over(&Grid::new(W, H, 1.0), 3).unwrap();
    let from = motion([0.05, 0.021, 0.019], [0.0; 3]);
    let rho = saddle().map(|r| 0.5 * r + 0.5);
    let line = scale.linearise(&from, &rho, scale.whole());
    let weight = line.inside.map(f32::from);
    let departure = cubic.departure(&rho);
    let edges = prior(100.0).edges(&Bends::of(&departure));
    let whole = Grid::new(W, H, 1.0);
    // The step's model: data around where it starts, and smoothness of what departs from a cubic.
    let energy = |step: &[f64; 6], departs: &Grid<f32>, surface: &Grid<f32>| {
        let mut data = 0.0;
        for (i, row) in line.rows.data().iter().enumerate() {
            let by_motion: f64 = (0..6).map(|r| f64::from(row[1 + r]) * step[r]).sum();
            let by_depth = f64::from(row[0] * (departs.data()[i] + surface.data()[i]));
            let r = f64::from(row[RESIDUAL]) + by_motion + by_depth;
            data += f64::from(weight.data()[i]) * r * r;
        }
        let smoothed = Grid::from_fn(W, H, |x, y| departure[(x, y)] + departs[(x, y)]);
        data + edges.energy(&Bends::of(&smoothed), &whole)
    };
    let taken = step(
        &scale,
        &from,
        &rho,
        &Manner {
            surface: Some(&cubic),
            ..Manner::of(Kind::Translation, 100.0)
        },
        &departing(&rho, Some(&cubic)),
    );
    let moved = taken.motion.translation - from.translation;
    let shift = [moved.x, moved.y, moved.z, 0.0, 0.0, 0.0];
    // The part of δρ that the surfaces are is not told: any split costs least with that which smoothness likes best.
    let best = |shift: &[f64; 6], rho_step: &Grid<f32>| {
        let mut surface = Grid::new(W, H, 0.0f32);
        for _ in 0..8 {
            for term in cubic.terms() {
                let cost = |by: f32| {
                    let surface = Grid::from_fn(W, H, |x, y| surface[(x, y)] + by * term[(x, y)]);
                    let departs = Grid::from_fn(W, H, |x, y| rho_step[(x, y)] - surface[(x, y)]);
                    energy(shift, &departs, &surface)
                };
                let (a, b, c) = (cost(-0.1), cost(0.0), cost(0.1));
                let by = 0.05 * (a - c) / (a + c - 2.0 * b).max(1e-12);
                for (s, t) in surface.data_mut().iter_mut().zip(term.data()) {
                    *s += by as f32 * t;
                }
            }
        }
        let departs = Grid::from_fn(W, H, |x, y| rho_step[(x, y)] - surface[(x, y)]);
        energy(shift, &departs, &surface)
    };
    let none = [0.0; 6];
    let start = best(&none, &Grid::new(W, H, 0.0));
    let end = best(&shift, &taken.depth_step);
    assert!(end < 0.5 * start, "{start}, then {end}");
    let across = from.translation.any_orthonormal_pair();
    let less = |shift: &[f64; 6], step: &Grid<f32>, what: &str| {
        let cost = best(shift, step);
        assert!(
            cost > end - 2e-4 * (start - end),
            "{what}: {end}, then {cost}"
        );
    };
    for d in [across.0, across.1, -across.0, -across.1] {
        let mut other = shift;
        for (s, d) in other.iter_mut().zip(d.to_array()) {
            *s += 1e-4 * d;
        }
        less(&other, &taken.depth_step, "another T");
    }
    for term in cubic.terms() {
        for by in [0.01, -0.01] {
            let other = Grid::from_fn(W, H, |x, y| taken.depth_step[(x, y)] + by * term[(x, y)]);
            less(&shift, &other, "another surface");
        }
    }
    let waves = Grid::from_fn(W, H, |x, y| (0.7 * x as f32).sin() * (0.5 * y as f32).cos());
    for by in [0.01, -0.01] {
        let other = Grid::from_fn(W, H, |x, y| taken.depth_step[(x, y)] + by * waves[(x, y)]);
        less(&shift, &other, "another departure");
    }
}

#[test]
fn a_kind_of_motion_forbids_what_it_says() {
    let truth = motion([0.04, 0.02, 0.0], [0.0, 0.0, 0.02]);
    let scale = filmed(&truth, &relief());
    let shift = motion([0.03, 0.0, 0.01], [0.0; 3]);
    let turn = motion([0.0; 3], [0.005, 0.0, 0.0]);
    let (still, _) = refine(
        &scale,
        RigidMotion::default(),
        2,
        &Manner::of(Kind::Still, 0.01),
        Bends::of,
    );
    assert_eq!(still, RigidMotion::default());
    let (turned, _) = refine(
        &scale,
        turn,
        2,
        &Manner::of(Kind::Rotation, 0.01),
        Bends::of,
    );
    assert_eq!(turned.translation, DVec3::ZERO);
    assert!((turned.rotation - turn.rotation).length() > 1e-3);
    let (shifted, _) = refine(
        &scale,
        shift,
        2,
        &Manner::of(Kind::Translation, 0.01),
        Bends::of,
    );
    assert_eq!(shifted.rotation, DVec3::ZERO);
    assert!((shifted.translation - shift.translation).length() > 1e-3);
    let (full, _) = refine(&scale, shift, 2, &Manner::of(Kind::Full, 0.01), Bends::of);
    assert!(full.rotation.length() > 1e-3);
}

#[test]
fn a_step_is_held_as_a_whole() {
    let length = |s: &[f64]| s.iter().map(|x| x * x).sum::<f64>().sqrt();
    let short = [0.3, 0.0, 0.4, 0.0, 0.1, 0.0];
    assert_eq!(held(short, 0.6), short);
    let long = [3.0, 0.0, 4.0, 0.0, 1.0, 2.0];
    let step = held(long, 0.5);
    assert!((length(&step[..3]) - 0.5).abs() < 1e-12);
    for (a, b) in step.iter().zip(long) {
        assert!((a - 0.1 * b).abs() < 1e-12);
    }
    let turning = held([0.0, 0.1, 0.0, 0.0, 0.0, -4.0], 1.0);
    assert!((turning[5] + 1.0).abs() < 1e-12 && (turning[1] - 0.025).abs() < 1e-12);
    assert_eq!(held([0.0; 6], 1.0), [0.0; 6]);
}
