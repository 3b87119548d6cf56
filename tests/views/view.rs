//! Views: colours that keep their promises, geometry that can be worked out.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::file::parts::Parts;
use relievo::view::{
    self, GLASSES, Glasses, KINDS, PALETTES, Palette, Rig, ViewParams, decode, draw, dubois,
    encode, luminance, mesh, parallax, second_eye,
};
use relievo::{Camera, Contour, Error, Flow, Frame, Grid, Interpretation, RigidMotion};

const WIDTH: usize = 48;
const HEIGHT: usize = 32;

/// A frame whose every column is of another colour.
fn frame() -> Frame {
    let bytes: Vec<u8> = (0..WIDTH * HEIGHT)
        .flat_map(|i| [(i % WIDTH) as u8 * 5, 90, 255 - (i % WIDTH) as u8 * 5, 255])
        .collect();
    Frame::from_rgba8(WIDTH, HEIGHT, &bytes).unwrap()
}

/// A square of region 1 at Z = 1 before a background at Z = 2, both known and moving right.
fn square() -> Interpretation {
    let inside = |x: usize, y: usize| (16..32).contains(&x) && (8..24).contains(&y);
    Interpretation {
        camera: Camera::centred(50.0, WIDTH, HEIGHT).unwrap(),
        labels: Grid::from_fn(WIDTH, HEIGHT, |x, y| u8::from(inside(x, y))),
        depth: Grid::from_fn(WIDTH, HEIGHT, |x, y| if inside(x, y) { 1.0 } else { 2.0 }),
        flow: Flow {
            u: Grid::new(WIDTH, HEIGHT, 1.0),
            v: Grid::new(WIDTH, HEIGHT, 0.0),
        },
        confidence: Grid::new(WIDTH, HEIGHT, 1.0),
        occluded: Grid::new(WIDTH, HEIGHT, 0),
        motions: vec![RigidMotion::default(); 2],
    }
}

fn show(kind: &str, found: &Interpretation, params: &ViewParams) -> view::Picture {
    draw(kind, &frame(), found, &[], params).unwrap()
}

#[test]
fn every_view_is_opaque_and_of_the_frames_size_or_a_multiple() {
    for kind in KINDS {
        let picture = show(kind, &square(), &ViewParams::default());
        assert_eq!(picture.width() % WIDTH, 0, "{kind}");
        assert_eq!(picture.height() % HEIGHT, 0, "{kind}");
        assert!(picture.data().iter().all(|p| p[3] == 255), "{kind}");
    }
    let kinds: Vec<&str> = view::catalogue().iter().map(|v| v.kind).collect();
    assert_eq!(kinds, KINDS);
}

#[test]
fn nothing_breaks_on_numbers_that_are_none() {
    let mut found = square();
    for bad in [f32::NAN, f32::INFINITY, 0.0, -1.0] {
        found.depth = Grid::new(WIDTH, HEIGHT, bad);
        found.flow.u = Grid::new(WIDTH, HEIGHT, f32::NAN);
        found.confidence = Grid::new(WIDTH, HEIGHT, bad);
        for kind in KINDS {
            show(kind, &found, &ViewParams::default());
        }
    }
}

#[test]
fn unknown_choices_and_numbers_out_of_range_are_refused() {
    let refused =
        |kind: &str, params: &ViewParams| draw(kind, &frame(), &square(), &[], params).unwrap_err();
    let of = |change: fn(&mut ViewParams)| {
        let mut params = ViewParams::default();
        change(&mut params);
        params
    };
    let choice = |e: Error| matches!(e, Error::Choice { .. });
    assert!(choice(refused("hologram", &ViewParams::default())));
    assert!(choice(refused("depth", &of(|p| p.palette = "mud".into()))));
    assert!(choice(refused(
        "anaglyph",
        &of(|p| p.glasses = "sun".into())
    )));
    for params in [
        of(|p| p.baseline = f64::NAN),
        of(|p| p.convergence = Some(1.5)),
        of(|p| p.scales = vec![1.0, f64::NAN]),
        of(|p| p.scales = vec![0.0]),
        of(|p| p.speed = Some(0.0)),
        of(|p| p.span = Some([2.0, 1.0])),
        of(|p| p.magnify = 0),
        of(|p| p.step = Some(0)),
    ] {
        let error = refused("depth", &params);
        assert!(matches!(error, Error::Option { .. }), "{error}");
    }
    let small = Frame::from_grey(Grid::new(16, 16, 0.0)).unwrap();
    let error = draw("depth", &small, &square(), &[], &ViewParams::default()).unwrap_err();
    assert!(matches!(error, Error::Length { .. }));
    assert!(matches!(
        ViewParams::from_json("[1"),
        Err(Error::Json { .. })
    ));
    let params = ViewParams::from_json(r#"{"baseline":0.04}"#).unwrap();
    assert_eq!((params.baseline, params.convergence), (0.04, None));
}

#[test]
fn srgb_returns_every_byte() {
    for byte in 0..=255 {
        assert_eq!(encode(decode(byte)), byte);
    }
    // Mid grey by the standard's formula: ((128/255 + 0.055)/1.055)^2.4.
    assert!((decode(128) - 0.215_860_5).abs() < 1e-6);
    assert_eq!((encode(-0.5), encode(1.7)), (0, 255));
}

#[test]
fn palettes_grow_steadily_lighter() {
    // Turbo is made to tell values apart, and is lightest in the middle.
    for choice in PALETTES.iter().filter(|choice| choice.value != "turbo") {
        let palette = Palette::named(choice.value).unwrap();
        let light = |i: usize| luminance(palette.at(i as f32 / 255.0).map(decode));
        for i in 4..256 {
            assert!(light(i) > light(i - 4), "{} at {i}", choice.value);
        }
        assert!(light(0) < 0.03 && light(255) > 0.75, "{}", choice.value);
    }
}

#[test]
fn the_weights_of_every_projection_sum_to_one() {
    for choice in GLASSES {
        let glasses = Glasses::named(choice.value).unwrap();
        for (channel, row) in glasses.0.iter().enumerate() {
            // Red/blue glasses let no green through.
            let dark = choice.value == "red-blue" && channel == 1;
            let expected = if dark { 0.0 } else { 1.0 };
            let sum: f32 = row.iter().sum();
            assert!(
                (sum - expected).abs() <= 0.002,
                "{} {channel}: {sum}",
                choice.value
            );
        }
    }
}

#[test]
fn an_anaglyph_pixel_worked_out_by_hand() {
    // Left (255, 0, 0) and right (0, 0, 255) are 1 0 0 | 0 0 1 in linear light, so that
    //   R = .4561 − .00155529 = .45454  → 1.055 · .45454^(1/2.4) − .055 = .70458 → 180
    //   G = −.0400822 − .0184503 < 0    → clipped → 0
    //   B = −.0152161 + 1.2264 = 1.2112 → clipped → 255
    // Left (200, 100, 50), right (60, 120, 180): .57758 .12744 .03190 | .04519 .18782 .45641,
    //   R = .26344 + .06378 + .00563 − .00196 − .01652 − .00071 = .31366 → .59579 → 152
    //   G = −.02315 − .00482 − .00050 + .01710 + .13779 − .00842 = .11800 → .37805 → 96
    //   B = −.00879 − .00262 − .00017 − .00326 − .02122 + .55974 = .52368 → .75074 → 191
    let left = Grid::from_vec(3, 1, vec![[255, 0, 0], [200, 100, 50], [128; 3]]).unwrap();
    let right = Grid::from_vec(3, 1, vec![[0, 0, 255], [60, 120, 180], [128; 3]]).unwrap();
    let out = dubois(&left, &right, &Glasses::named("red-cyan").unwrap());
    assert_eq!(out[(0, 0)], [180, 0, 255, 255]);
    assert_eq!(out[(1, 0)], [152, 96, 191, 255]);
    assert_eq!(
        out[(2, 0)],
        [128, 128, 128, 255],
        "both eyes alike keep their grey"
    );
}

#[test]
fn a_constant_depth_shifts_the_picture_by_f_d_over_z() {
    // f d / Z = 50 · 0.24 / 2 = 6 px to the left, by either way of reading between pixels.
    let rig = Rig {
        baseline: 0.24,
        convergence: 0.0,
    };
    let shifts = parallax(&Grid::new(WIDTH, HEIGHT, 2.0), 50.0, &rig);
    let picture = frame().rgb;
    for interpolate in [false, true] {
        let labels = Grid::new(WIDTH, HEIGHT, 0);
        let right = second_eye(&picture, &shifts, &labels, interpolate);
        for x in 0..WIDTH - 6 {
            assert_eq!(right[(x, 3)], picture[(x + 6, 3)], "column {x}");
        }
    }
    // Half a pixel further, the interpolated picture is the mean of two neighbours.
    let half = shifts.map(|s| s + 0.5);
    let right = second_eye(&picture, &half, &Grid::new(WIDTH, HEIGHT, 0), true);
    let mean = (f32::from(picture[(16, 3)][0]) + f32::from(picture[(17, 3)][0])) / 2.0;
    assert!((f32::from(right[(10, 3)][0]) - mean).abs() <= 0.5);
}

#[test]
fn the_nearer_surface_is_seen_and_the_farther_fills_the_hole() {
    // Convergence on the background: it stays, the square at Z = 1 moves left by f d (1 − ½) = 5 px.
    let found = square();
    let rig = Rig {
        baseline: 0.2,
        convergence: 0.5,
    };
    let shifts = parallax(&found.depth, 50.0, &rig);
    assert_eq!(shifts[(0, 0)], 0.0);
    let red = found
        .labels
        .map(|k| if k == 1 { [255, 0, 0] } else { [0, 0, 255] });
    let right = second_eye(&red, &shifts, &found.labels, true);
    for x in 0..WIDTH {
        let square = (11..27).contains(&x);
        let expected = if square { [255, 0, 0] } else { [0, 0, 255] };
        assert_eq!(right[(x, 16)], expected, "column {x}");
        assert_eq!(right[(x, 2)], [0, 0, 255]);
    }
}

#[test]
fn the_depth_of_convergence_has_no_parallax_and_the_widest_is_as_asked() {
    for (convergence, depth_on_screen) in [(0.0, 2.0_f32), (1.0, 1.0)] {
        let params = ViewParams {
            convergence: Some(convergence),
            baseline: 0.05,
            ..ViewParams::default()
        };
        let rig = Rig::fitted(&square(), &params);
        let shifts = parallax(&square().depth, 50.0, &rig);
        for (s, z) in shifts.data().iter().zip(square().depth.data()) {
            let expected = if *z == depth_on_screen {
                0.0
            } else {
                0.05 * WIDTH as f32 * if convergence == 0.0 { 1.0 } else { -1.0 }
            };
            assert!((s - expected).abs() < 1e-3, "{s} for {expected}");
        }
    }
}

#[test]
fn depth_is_lighter_when_nearer_and_neutral_where_unknown() {
    let mut found = square();
    let light = |picture: &view::Picture, at: (usize, usize)| {
        let [r, g, b, _] = picture[at];
        luminance([r, g, b].map(decode))
    };
    for choice in PALETTES.iter().filter(|choice| choice.value != "turbo") {
        let params = ViewParams {
            palette: choice.value.into(),
            ..ViewParams::default()
        };
        let picture = show("depth", &found, &params);
        assert!(light(&picture, (20, 16)) > light(&picture, (4, 4)) + 0.5);
        // The user says that the square is twenty times as far.
        let params = ViewParams {
            scales: vec![1.0, 20.0],
            ..params
        };
        let picture = show("depth", &found, &params);
        assert!(light(&picture, (20, 16)) < light(&picture, (4, 4)));
    }
    found.confidence = Grid::new(WIDTH, HEIGHT, 0.0);
    let one = show("depth", &found, &ViewParams::default());
    found.depth = Grid::from_fn(WIDTH, HEIGHT, |x, y| 1.0 + (x * y) as f32);
    assert_eq!(one, show("depth", &found, &ViewParams::default()));
}

#[test]
fn flow_at_rest_is_white_and_opposite_motions_have_opposite_colours() {
    let mut found = square();
    let params = ViewParams {
        legend: false,
        ..ViewParams::default()
    };
    found.flow.u = Grid::from_fn(WIDTH, HEIGHT, |x, _| [1.0, -1.0, 0.0][x % 3]);
    found.flow.u[(0, 9)] = f32::NAN;
    let picture = show("flow", &found, &params);
    let ([r, g, b, _], [l_r, l_g, l_b, _]) = (picture[(0, 0)], picture[(1, 0)]);
    assert!(
        r > 200 && g < 140 && b < 170,
        "right is red, not {r} {g} {b}"
    );
    assert!(l_r < 100 && l_g > 120 && l_b > 120, "left is green-blue");
    assert!(
        picture[(2, 0)][..3].iter().all(|&c| c >= 250),
        "rest is white"
    );
    assert!(
        picture[(0, 9)][..3].iter().all(|&c| c < 90),
        "unknown is dark"
    );
}

#[test]
fn curves_are_drawn_where_they_are_given() {
    let line = Contour {
        label: 1,
        points: vec![[5.0, 5.0], [40.0, 5.0], [40.0, 27.0], [5.0, 27.0]],
        closed: true,
    };
    let params = ViewParams {
        tint: 0.0,
        ..ViewParams::default()
    };
    let picture = draw("segmentation", &frame(), &square(), &[line], &params).unwrap();
    let [r, g, b] = view::LABEL_COLOURS[1];
    for at in [(20, 5), (40, 16), (5, 20), (20, 27)] {
        assert_eq!(picture[at], [r, g, b, 255], "{at:?}");
    }
    let [r, g, b] = frame().rgb[(20, 16)];
    assert_eq!(
        picture[(20, 16)],
        [r, g, b, 255],
        "nothing is drawn elsewhere"
    );
}

#[test]
fn the_mesh_is_cut_between_regions_and_faces_the_viewer() {
    let params = ViewParams {
        step: Some(1),
        relief: Some(1.0),
        ..ViewParams::default()
    };
    let m = mesh(&frame(), &square(), &params);
    let vertices = m.labels.len();
    assert_eq!(m.positions.len(), 3 * vertices);
    assert_eq!(m.normals.len(), 3 * vertices);
    assert_eq!(m.colours.len(), 3 * vertices);
    assert_eq!(m.uvs.len(), 2 * vertices);
    let at = |i: u32| {
        let i = 3 * i as usize;
        [m.positions[i], m.positions[i + 1], m.positions[i + 2]]
    };
    let mut area = [0.0_f32; 2];
    for t in m.indices[..m.parts[0] as usize].chunks_exact(3) {
        let label = m.labels[t[0] as usize];
        assert!(t.iter().all(|&i| m.labels[i as usize] == label), "a skirt");
        let [a, b, c] = [at(t[0]), at(t[1]), at(t[2])];
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!(twice > 0.0, "a triangle faces away");
        area[usize::from(label)] += twice / 2.0;
    }
    // Both are planes facing the viewer; the square, at half the depth, is 16 px wide at half size,
    // less its cut corners.
    for i in &m.indices[..m.parts[0] as usize] {
        let i = 3 * *i as usize;
        assert!(m.normals[i + 2] > 0.999, "{:?}", &m.normals[i..i + 3]);
        assert!(m.positions[i..i + 3].iter().all(|c| c.abs() <= 1.1));
    }
    let whole = ((WIDTH - 1) * (HEIGHT - 1)) as f32;
    let expected = 256.0 / 4.0 / (whole - 256.0);
    assert!((area[1] / area[0] - expected).abs() < 0.03 * expected);
}

#[test]
fn an_unobservable_region_has_a_flat_mesh() {
    let mut found = square();
    found.depth = Grid::from_fn(WIDTH, HEIGHT, |x, y| {
        1.0 + 0.01 * x as f32 + 0.02 * y as f32
    });
    for (c, k) in found
        .confidence
        .data_mut()
        .iter_mut()
        .zip(found.labels.data())
    {
        *c = f32::from(*k);
    }
    let m = mesh(&frame(), &found, &ViewParams::default());
    let heights = |label: u8| -> Vec<f32> {
        let of = m.labels.iter().zip(m.positions.chunks_exact(3));
        of.filter(|(k, _)| **k == label)
            .map(|(_, p)| p[2])
            .collect()
    };
    let spread = |h: &[f32]| h.iter().fold(0.0_f32, |s, z| s.max((z - h[0]).abs()));
    assert!(spread(&heights(0)) < 1e-6);
    assert!(spread(&heights(1)) > 0.05);
}

#[test]
fn the_relief_shows_a_bump_by_light_alone() {
    // A hemisphere on a plane, lit from the upper left: its upper left side is the lighter one.
    let mut found = square();
    found.labels = Grid::new(WIDTH, HEIGHT, 0);
    found.depth = Grid::from_fn(WIDTH, HEIGHT, |x, y| {
        let r2 = (x as f32 - 24.0).powi(2) + (y as f32 - 16.0).powi(2);
        2.0 - 0.02 * (100.0 - r2).max(0.0).sqrt()
    });
    let params = ViewParams {
        turn: 0.0,
        tilt: 0.0,
        ..ViewParams::default()
    };
    let picture = show("relief", &found, &params);
    let light = |x: usize, y: usize| u32::from(picture[(x, y)][1]);
    assert!(light(19, 11) > light(29, 21) + 30);
}

/// One region of `width × height` pixels whose 1/Z at (x, y) is `rho`, and a frame to it.
fn surface(width: usize, height: usize, rho: impl Fn(f32, f32) -> f32) -> (Frame, Interpretation) {
    let grid = |value: f32| Grid::new(width, height, value);
    let found = Interpretation {
        camera: Camera::centred(width as f64, width, height).unwrap(),
        labels: Grid::new(width, height, 0),
        depth: Grid::from_fn(width, height, |x, y| 1.0 / rho(x as f32, y as f32)),
        flow: Flow {
            u: grid(1.0),
            v: grid(0.0),
        },
        confidence: grid(1.0),
        occluded: Grid::new(width, height, 0),
        motions: vec![RigidMotion::default()],
    };
    (Frame::from_grey(grid(128.0)).unwrap(), found)
}

#[test]
fn a_floor_that_reaches_far_is_drawn_as_a_floor_no_deeper_than_wide() {
    // ρ of a plane is linear in the frame: this one reaches from 1 to 19 times as far.
    let (frame, found) = surface(80, 60, |_, y| 0.05 + 0.9 * y / 59.0);
    let m = mesh(&frame, &found, &ViewParams::default());
    let at = |i: usize| glam::Vec3::from_slice(&m.positions[3 * i..3 * i + 3]);
    let (a, b, c) = (at(0), at(79), at(80 * 59));
    let normal = (b - a).cross(c - a).normalize();
    let depths: Vec<f32> = (0..80 * 60).map(|i| at(i).z).collect();
    for i in 0..80 * 60 {
        let off = (at(i) - a).dot(normal);
        assert!(off.abs() < 1e-3, "vertex {i} is {off} off the plane");
    }
    let most = depths.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let least = depths.iter().copied().fold(f32::INFINITY, f32::min);
    assert!(
        (1.4..2.0).contains(&(most - least)),
        "{} deep",
        most - least
    );
    assert!(depths[80 * 59] > depths[0], "near is towards the viewer");
}

#[test]
fn nothing_spans_a_leap_that_is_spread_over_some_pixels_and_a_bulge_stays_whole() {
    // A pillar whose edges are spread over six pixels.
    let (frame, found) = surface(160, 120, |x, _| {
        1.0 + 2.0 * ((36.0 - (x - 80.0).abs()) / 6.0).clamp(0.0, 1.0)
    });
    let m = mesh(&frame, &found, &ViewParams::default());
    let z = |i: u32| m.positions[3 * i as usize + 2];
    let (low, high) = (z(0), z(160 * 60 + 80));
    for t in m.indices.chunks_exact(3) {
        let near = t.iter().filter(|&&i| z(i) > (low + high) / 2.0).count();
        assert!(near == 0 || near == 3, "near and far are joined");
    }
    assert!(m.parts[1] > 0, "nothing goes on behind the pillar");
    let (frame, found) = surface(160, 120, |x, _| {
        1.0 + 0.1 * ((36.0 - (x - 80.0).abs()) / 6.0).clamp(0.0, 1.0)
    });
    let m = mesh(&frame, &found, &ViewParams::default());
    assert_eq!(m.parts, [6 * 159 * 119, 0, 0], "a bulge is torn");
}

#[test]
fn comparing_gives_the_same_depth_the_same_colour_whatever_a_region_s_unit() {
    let truth = square();
    let found = truth.scaled(&[3.0, 0.2]);
    let params = view::same_colours(&truth, &ViewParams::default());
    let aligned = view::aligned(&found, &Parts::from(&truth)).unwrap();
    let [a, b] = [&truth, &aligned].map(|one| show("depth", one, &params));
    let differing = a.data().iter().zip(b.data());
    let worst = differing.flat_map(|(p, q)| p.iter().zip(q).map(|(a, b)| a.abs_diff(*b)));
    assert!(worst.max().unwrap() <= 1);
    // A region of which a third is twice as far keeps its colours elsewhere.
    let mut off = truth.clone();
    let far = off.depth.data_mut();
    let third = far.len() / 3;
    far[..third].iter_mut().for_each(|z| *z *= 2.0);
    let aligned = view::aligned(&off, &Parts::from(&truth)).unwrap();
    let c = show("depth", &aligned, &params);
    assert_eq!(c.data().last(), a.data().last());
}

#[test]
fn comparing_gives_the_same_speed_the_same_colour() {
    let truth = square();
    let params = view::same_colours(&truth, &ViewParams::default());
    let mut faster = truth.clone();
    faster.flow.u.data_mut()[..WIDTH * 4].fill(50.0);
    let [a, b] = [&truth, &faster].map(|one| show("flow", one, &params));
    assert_eq!(a.data()[WIDTH * 4..], b.data()[WIDTH * 4..]);
}
