//! A start for the motions, from where small patches go.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::DVec3;
use relievo::frames::{halved, halved_camera};
use relievo::start::{Patch, dominant, inside, patches};
use relievo::warp::Scale;
use relievo::{Camera, Grid, RigidMotion};

const W: usize = 96;
const H: usize = 72;

fn camera() -> Camera {
    Camera::centred(90.0, W, H).unwrap()
}

/// A texture with detail at several scales.
fn texture(x: f64, y: f64) -> f64 {
    120.0
        + 30.0 * (0.11 * x + 0.05 * y).sin()
        + 25.0 * (0.13 * y - 0.04 * x + 0.7).cos()
        + 15.0 * (0.5 * x - 0.37 * y).sin()
        + 15.0 * (0.43 * y + 0.41 * x + 2.0).cos()
}

fn scales(first: Grid<f32>, second: Grid<f32>, count: usize) -> Vec<Scale> {
    let mut scales = vec![Scale::new(camera(), first, second)];
    while scales.len() < count {
        let last = &scales[scales.len() - 1];
        let camera = halved_camera(&last.camera);
        let next = Scale::new(camera, halved(&last.first), halved(&last.second));
        scales.push(next);
    }
    scales
}

fn shifted(u: f64, v: f64, count: usize) -> Vec<Scale> {
    let first = Grid::from_fn(W, H, |x, y| texture(x as f64, y as f64) as f32);
    let second = Grid::from_fn(W, H, |x, y| texture(x as f64 - u, y as f64 - v) as f32);
    scales(first, second, count)
}

#[test]
fn patches_report_where_the_texture_goes() {
    for (u, v) in [(0.0, 0.0), (0.6, -0.4), (-3.0, 2.0), (5.0, 3.5)] {
        let found = patches(&shifted(u, v, 3), 0);
        assert!(found.len() > 200);
        let near = |p: &&Patch| {
            let [a, b] = p.motion.map(f64::from);
            (a - u).hypot(b - v) < 0.1
        };
        let deep = |p: &&Patch| {
            (12.0..W as f32 - 12.0).contains(&p.x) && (12.0..H as f32 - 12.0).contains(&p.y)
        };
        let all = found.iter().filter(deep).count();
        let right = found.iter().filter(deep).filter(near).count();
        assert!(right * 100 >= all * 97, "({u}, {v}): {right} of {all}");
    }
    // Asked for at a coarser scale, in that scale's pixels.
    let found = patches(&shifted(4.0, -2.0, 3), 1);
    let middle = found.iter().find(|p| p.x == 24.0 && p.y == 16.0).unwrap();
    let [u, v] = middle.motion;
    assert!((u - 2.0).abs() < 0.1 && (v + 1.0).abs() < 0.1, "({u}, {v})");
}

#[test]
fn a_straight_edge_is_not_trusted_along_itself() {
    let stripes = |shift: f64| {
        Grid::from_fn(W, H, |x, _| {
            (120.0 + 50.0 * (0.4 * (x as f64 - shift)).sin()) as f32
        })
    };
    let found = patches(&scales(stripes(0.0), stripes(0.7), 2), 0);
    for p in found.iter().filter(|p| p.x > 12.0 && p.x < 84.0) {
        assert!((p.motion[0] - 0.7).abs() < 0.1 && p.motion[1].abs() < 0.1);
        let [xx, xy, yy] = p.precision;
        assert!(xx > 50.0 * yy && xy.abs() < 0.05 * xx && yy > 0.0);
    }
    // Without any texture nothing is known, and nothing said to move.
    let flat = patches(&scales(Grid::new(W, H, 90.0), Grid::new(W, H, 90.0), 2), 0);
    let known = found[found.len() / 2].precision[0];
    assert!(flat.iter().all(|p| p.motion == [0.0; 2]));
    assert!(flat.iter().all(|p| p.precision[0] < 0.05 * known));
}

fn motion(t: [f64; 3], w: [f64; 3]) -> RigidMotion {
    RigidMotion {
        translation: DVec3::from_array(t),
        rotation: DVec3::from_array(w),
    }
}

/// Patches that move by `most`, but within the circle as `few`.
fn crowd(most: &RigidMotion, few: &RigidMotion) -> (Vec<Patch>, Vec<f64>) {
    let mut all = Vec::new();
    let mut within = Vec::new();
    for y in (4..H).step_by(4) {
        for x in (4..W).step_by(4) {
            let minority = (x as f64 - 60.0).hypot(y as f64 - 40.0) < 16.0;
            let motion = if minority { few } else { most };
            let (u, v) = camera().image_motion(motion, x as f64, y as f64, 1.0);
            all.push(Patch {
                x: x as f32,
                y: y as f32,
                motion: [u as f32, v as f32],
                precision: [400.0, 0.0, 400.0],
            });
            within.push(f64::from(minority));
        }
    }
    (all, within)
}

/// The largest difference in image motion between two flat motions, over the patches, in pixels.
fn apart(a: &RigidMotion, b: &RigidMotion, patches: &[Patch]) -> f64 {
    let at =
        |m: &RigidMotion, p: &Patch| camera().image_motion(m, f64::from(p.x), f64::from(p.y), 1.0);
    let each = patches.iter().map(|p| {
        let ((u, v), (s, t)) = (at(a, p), at(b, p));
        (u - s).hypot(v - t)
    });
    each.fold(0.0, f64::max)
}

#[test]
fn a_minority_does_not_sway_the_background() {
    for (t, w) in [
        ([0.0; 3], [0.0; 3]),
        ([0.03, -0.01, 0.02], [0.004, 0.0, -0.01]),
        ([0.0, 0.0, 0.05], [0.0; 3]),
    ] {
        let most = motion(t, w);
        let few = motion([t[0] - 0.05, t[1] + 0.03, t[2]], w);
        let (patches, within) = crowd(&most, &few);
        let share = within.iter().sum::<f64>() / within.len() as f64;
        assert!(share > 0.08 && share < 0.25);
        let found = dominant(&camera(), &patches, &vec![1.0; patches.len()]);
        let off = apart(&found, &most, &patches);
        assert!(off < 0.15, "{t:?}: off by {off} px");
    }
}

#[test]
fn a_curve_finds_the_minority_that_it_only_partly_covers() {
    let most = motion([0.03, -0.01, 0.02], [0.004, 0.0, -0.01]);
    let few = motion([-0.02, 0.02, 0.02], [0.004, 0.0, -0.01]);
    let (patches, within) = crowd(&most, &few);
    // A curve that holds as much of the background as of the object.
    let circle = |p: &Patch| f64::from((p.x - 72.0).hypot(p.y - 40.0) < 14.0);
    let weight: Vec<f64> = patches.iter().map(circle).collect();
    let own: f64 = weight.iter().zip(&within).map(|(a, b)| a * b).sum();
    let total: f64 = weight.iter().sum();
    assert!(own > 4.0 && own < 0.6 * total, "{own} of {total}");
    let found = inside(&camera(), &patches, &weight, &most, &[]);
    let minority: Vec<Patch> = patches
        .iter()
        .zip(&within)
        .filter(|(_, w)| **w > 0.0)
        .map(|(p, _)| *p)
        .collect();
    let (before, off) = (
        apart(&most, &few, &minority),
        apart(&found, &few, &minority),
    );
    assert!(off < 0.2 * before, "off by {off} of {before} px");
    // Where there is no patch to tell, the background's motion is as good as any.
    let nothing = vec![0.0; patches.len()];
    assert_eq!(inside(&camera(), &patches, &nothing, &most, &[]), most);
}

#[test]
fn a_curve_half_on_what_another_is_on_finds_its_own() {
    let most = motion([0.0; 3], [0.0; 3]);
    let few = motion([-0.02, 0.02, 0.0], [0.0; 3]);
    let rival = motion([0.05, 0.01, 0.0], [0.0; 3]);
    let (mut patches, within) = crowd(&most, &few);
    for p in patches.iter_mut().filter(|p| p.x > 78.0) {
        let (u, v) = camera().image_motion(&rival, f64::from(p.x), f64::from(p.y), 1.0);
        p.motion = [u as f32, v as f32];
    }
    let weight: Vec<f64> = patches
        .iter()
        .map(|p| f64::from((p.x - 84.0).hypot(p.y - 40.0) < 18.0))
        .collect();
    let minority: Vec<Patch> = patches
        .iter()
        .zip(&within)
        .filter(|(p, w)| **w > 0.0 && p.x <= 78.0)
        .map(|(p, _)| *p)
        .collect();
    let off = |others: &[RigidMotion], truth: &RigidMotion| {
        let found = inside(&camera(), &patches, &weight, &most, others);
        apart(&found, truth, &minority)
    };
    let before = apart(&few, &rival, &minority);
    assert!(
        off(&[], &rival) < 0.2 * before,
        "most of the curve is on the other thing"
    );
    assert!(off(&[rival], &few) < 0.2 * before);
    // With nothing of its own in it, the other's is better than none.
    let weight: Vec<f64> = patches
        .iter()
        .map(|p| f64::from((p.x - 100.0).hypot(p.y - 40.0) < 12.0))
        .collect();
    let found = inside(&camera(), &patches, &weight, &most, &[rival]);
    assert!(apart(&found, &rival, &minority) < 0.2 * before);
}
