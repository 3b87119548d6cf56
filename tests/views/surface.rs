//! The relief as a surface: no holes behind silhouettes, smooth outlines, nothing beyond the range.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::view::{self, Mesh, Picture, ViewParams, draw, mesh};
use relievo::{Camera, Flow, Frame, Grid, Interpretation, RigidMotion, scene};

/// Regions by their labels, with 1/Z and colour.
fn painted(
    width: usize,
    height: usize,
    label: impl Fn(f32, f32) -> u8,
    rho: impl Fn(u8, f32, f32) -> f32,
) -> (Frame, Interpretation) {
    let grid = |value: f32| Grid::new(width, height, value);
    let labels = Grid::from_fn(width, height, |x, y| label(x as f32, y as f32));
    let regions = 1 + usize::from(labels.data().iter().copied().max().unwrap());
    let bytes: Vec<u8> = labels
        .data()
        .iter()
        .flat_map(|&k| {
            if k > 0 {
                [220, 30, 30, 255]
            } else {
                [30, 30, 220, 255]
            }
        })
        .collect();
    let depth = Grid::from_fn(width, height, |x, y| {
        1.0 / rho(labels[(x, y)], x as f32, y as f32)
    });
    let found = Interpretation {
        camera: Camera::centred(width as f64, width, height).unwrap(),
        labels,
        depth,
        flow: Flow {
            u: grid(1.0),
            v: grid(0.0),
        },
        confidence: grid(1.0),
        occluded: Grid::new(width, height, 0),
        motions: vec![RigidMotion::default(); regions],
    };
    let frame = Frame::from_rgba8(width, height, &bytes).unwrap();
    (frame, found)
}

/// A disc about the middle, `near` times as near as the ground.
fn disc(radius: f32, near: f32) -> (Frame, Interpretation) {
    painted(
        96,
        72,
        |x, y| u8::from((x - 47.5).hypot(y - 35.5) < radius),
        |k, _, _| if k > 0 { near } else { 1.0 },
    )
}

fn vertex(m: &Mesh, i: u32) -> glam::Vec3 {
    glam::Vec3::from_slice(&m.positions[3 * i as usize..])
}

/// Triangles of what is seen, of what is hidden, and of ghosts.
fn part(m: &Mesh, which: usize) -> impl Iterator<Item = &[u32]> {
    let from: u32 = m.parts[..which].iter().sum();
    m.indices[from as usize..][..m.parts[which] as usize].chunks_exact(3)
}

/// Pixels of the empty space between the surface's first and last pixel of both a row and a column, as a share.
fn holes(picture: &Picture) -> f64 {
    let (width, height) = (picture.width(), picture.height());
    // What is empty differs from row to row only, and shows in the corner.
    let empty = |x: usize, y: usize| {
        let (here, corner) = (picture[(x, y)], picture[(0, y)]);
        (0..3).all(|i| here[i].abs_diff(corner[i]) <= 1)
    };
    let between = |n: usize, is: &dyn Fn(usize) -> bool| {
        let first = (0..n).find(|&i| is(i)).unwrap_or(n);
        let last = (0..n).rfind(|&i| is(i)).unwrap_or(0);
        (first, last)
    };
    let rows: Vec<_> = (0..height)
        .map(|y| between(width, &|x| !empty(x, y)))
        .collect();
    let columns: Vec<_> = (0..width)
        .map(|x| between(height, &|y| !empty(x, y)))
        .collect();
    let (mut all, mut open) = (0.0, 0.0);
    for (y, row) in rows.iter().enumerate() {
        for (x, column) in columns.iter().enumerate() {
            if (row.0..=row.1).contains(&x) && (column.0..=column.1).contains(&y) {
                all += 1.0;
                open += f64::from(u8::from(empty(x, y)));
            }
        }
    }
    open / all
}

#[test]
fn turned_aside_the_relief_has_no_holes_behind_silhouettes() {
    for name in ["columns", "squares", "blocks"] {
        let sequence = scene::render(name, 160, 120).unwrap();
        for turn in [-30.0, 30.0] {
            let params = ViewParams {
                turn,
                ..ViewParams::default()
            };
            let picture = draw("relief", &sequence.frames[0], &sequence.truth, &[], &params);
            let open = holes(&picture.unwrap());
            assert!(open < 0.004, "{name} at {turn}°: {open}");
        }
    }
}

#[test]
fn a_disc_ends_on_its_circle_and_not_on_the_stairs_of_pixels() {
    // All at Z = 1 and nothing deepened, so that a vertex's place is its pixel's, in half the longer side.
    let (frame, found) = disc(20.0, 1.0);
    let params = ViewParams {
        step: Some(1),
        relief: Some(1.0),
        ..ViewParams::default()
    };
    let m = mesh(&frame, &found, &params);
    let mut sides = std::collections::HashMap::new();
    for t in part(&m, 0).filter(|t| m.labels[t[0] as usize] == 1) {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            *sides.entry((a.min(b), a.max(b))).or_insert(0) += 1;
        }
    }
    let rim = sides.into_iter().filter(|(_, count)| *count == 1);
    let mut worst = 0.0f32;
    let mut count = 0;
    for ((a, b), _) in rim {
        for i in [a, b] {
            let p = vertex(&m, i) * 48.0;
            worst = worst.max((p.x.hypot(p.y) - 20.0).abs());
            count += 1;
        }
    }
    assert!(count > 200, "{count} points on the rim");
    assert!(worst < 0.3, "{worst} px off the circle");
}

#[test]
fn what_a_region_hides_goes_on_behind_it_darker_as_the_plane_that_it_is() {
    // The ground is a slanted plane: 1/Z is linear in the frame.
    let ground = |x: f32, y: f32| 0.6 + 0.002 * x + 0.003 * y;
    let (frame, found) = painted(
        96,
        72,
        |x, y| u8::from((x - 40.0).abs() < 9.0 && (y - 30.0).abs() < 9.0),
        |k, x, y| if k > 0 { 2.0 } else { ground(x, y) },
    );
    let params = ViewParams {
        step: Some(1),
        relief: Some(1.0),
        ..ViewParams::default()
    };
    let m = mesh(&frame, &found, &params);
    let at = |(x, y): (usize, usize)| vertex(&m, (96 * y + x) as u32);
    let (a, b, c) = (at((2, 2)), at((93, 2)), at((2, 69)));
    let normal = (b - a).cross(c - a).normalize();
    let mut middle = 0;
    for i in part(&m, 1).flatten() {
        assert_eq!(m.labels[*i as usize], 0);
        let off = (vertex(&m, *i) - a).dot(normal);
        assert!(off.abs() < 0.02, "{off} off the plane");
        assert!(m.colours[3 * *i as usize + 2] < 140, "not darker");
        let [u, v] = [m.uvs[2 * *i as usize], m.uvs[2 * *i as usize + 1]];
        middle +=
            usize::from((96.0 * u - 40.5).abs() < 2.0 && (72.0 * (1.0 - v) - 30.5).abs() < 2.0);
    }
    assert!(middle > 0, "nothing behind the middle");
}

#[test]
fn a_region_stands_before_the_ground_whatever_its_unit_unless_it_is_put_elsewhere() {
    let (frame, found) = disc(20.0, 1.0);
    let (_, true_one) = disc(20.0, 2.0);
    let front = |found: &Interpretation, scales: &[f64]| {
        let params = ViewParams {
            step: Some(1),
            relief: Some(1.0),
            scales: scales.to_vec(),
            ..ViewParams::default()
        };
        let m = mesh(&frame, found, &params);
        vertex(&m, 96 * 36 + 48).z - vertex(&m, 96 * 5 + 5).z
    };
    // Three times as far as the ground: brought up to it.
    let behind = found.scaled(&[1.0, 3.0]);
    assert!(front(&behind, &[]) > -1e-4);
    // Before it already: left where it is.
    assert!((front(&true_one, &[]) - 1.0).abs() < 0.05);
    assert!(front(&behind, &[1.0, 1.5]) < -0.1);
}

#[test]
fn a_few_wild_depths_neither_stretch_the_scene_nor_leave_it() {
    let wild = |x: f32, y: f32| (x * 7.0 + y * 13.0 + 5.0) % 101.0 < 1.0;
    let hill =
        |x: f32, y: f32| 1.0 + 0.3 * (-((x - 48.0).powi(2) + (y - 36.0).powi(2)) / 200.0).exp();
    let (frame, tame) = painted(96, 72, |_, _| 0, |_, x, y| hill(x, y));
    let (_, found) = painted(
        96,
        72,
        |_, _| 0,
        |_, x, y| {
            if wild(x, y) { 0.001 } else { hill(x, y) }
        },
    );
    let [a, b] = [&tame, &found].map(|one| {
        let m = mesh(&frame, one, &ViewParams::default());
        let z = m.positions.chunks_exact(3).map(|p| p[2]);
        z.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], z| {
            [low.min(z), high.max(z)]
        })
    });
    assert!((b[1] - b[0]) < 1.3 * (a[1] - a[0]), "{a:?} {b:?}");
}

#[test]
fn what_is_of_unknown_depth_is_a_ghost_and_no_wall() {
    let (frame, mut found) = disc(20.0, 2.0);
    for (c, k) in found
        .confidence
        .data_mut()
        .iter_mut()
        .zip(found.labels.data())
    {
        *c = f32::from(*k);
    }
    let m = mesh(&frame, &found, &ViewParams::default());
    assert!(part(&m, 0).all(|t| m.labels[t[0] as usize] == 1));
    assert!(part(&m, 2).any(|t| m.labels[t[0] as usize] == 0));
    assert!(part(&m, 2).flatten().all(|i| m.known[*i as usize] == 0));
}

/// Colours of a picture at the pixels where `holds`.
fn colours_where(picture: &Picture, holds: impl Fn(usize, usize) -> bool) -> Vec<[u8; 4]> {
    let (width, height) = (picture.width(), picture.height());
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let held = places.filter(|&(x, y)| holds(x, y));
    held.map(|at| picture[at]).collect()
}

#[test]
fn the_second_eye_sees_the_ground_beside_a_body_and_no_shreds_of_it() {
    // The ground on the screen, the disc 5 px before it: in the right eye's picture it lies 5 px further left.
    let (frame, found) = disc(20.0, 2.0);
    let params = ViewParams {
        baseline: 5.0 / 96.0,
        convergence: Some(0.0),
        ..ViewParams::default()
    };
    let picture = draw("stereo", &frame, &found, &[], &params).unwrap();
    let from = |x: usize, y: usize| (x as f32 - 96.0 - 42.5).hypot(y as f32 - 35.5);
    let outside = colours_where(&picture, |x, y| x >= 96 && from(x, y) > 21.5);
    assert!(
        outside.iter().all(|c| c[2] > 150 && c[0] < 90),
        "red beside the disc"
    );
    let inside = colours_where(&picture, |x, y| x >= 96 && from(x, y) < 18.5);
    assert!(
        inside.iter().all(|c| c[0] > 150 && c[2] < 90),
        "blue in the disc"
    );
}

#[test]
fn layouts_and_swapped_eyes() {
    let (frame, found) = disc(20.0, 2.0);
    let shown = |layout: &str, swap: bool| {
        let params = ViewParams {
            layout: layout.into(),
            swap,
            ..ViewParams::default()
        };
        draw("stereo", &frame, &found, &[], &params).unwrap()
    };
    let parallel = shown("parallel", false);
    let half = |picture: &Picture, which: usize| {
        Grid::from_fn(96, 72, |x, y| picture[(96 * which + x, y)])
    };
    for other in [shown("crossed", false), shown("parallel", true)] {
        assert!(half(&other, 0) == half(&parallel, 1) && half(&other, 1) == half(&parallel, 0));
    }
    assert!(half(&parallel, 0) != half(&parallel, 1));
    assert_eq!(shown("half", false).width(), 96);
    // Each output channel of half colour is of one eye alone.
    let params = ViewParams {
        glasses: "half-colour".into(),
        ..ViewParams::default()
    };
    let mixed = draw("anaglyph", &frame, &found, &[], &params).unwrap();
    let right = half(&parallel, 1);
    let same = mixed.data().iter().zip(right.data());
    assert!(
        same.into_iter()
            .all(|(a, b)| a[1].abs_diff(b[1]) <= 1 && a[2].abs_diff(b[2]) <= 1)
    );
}

#[test]
fn convergence_keeps_what_touches_the_sides_from_being_cut_off_before_the_screen() {
    let params = ViewParams::default();
    // In the middle, near things may come out by half of the parallax.
    let (_, found) = disc(20.0, 2.0);
    let rig = view::Rig::fitted(&found, &params);
    assert!((rig.convergence - 1.5).abs() < 0.02, "{}", rig.convergence);
    // A pillar at the left border stays on the screen.
    let (_, found) = painted(
        96,
        72,
        |x, _| u8::from(x < 12.0),
        |k, _, _| if k > 0 { 2.0 } else { 1.0 },
    );
    let rig = view::Rig::fitted(&found, &params);
    assert!((rig.convergence - 2.0).abs() < 0.02, "{}", rig.convergence);
}
