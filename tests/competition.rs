//! What regions compete with, threshold dynamics, and who hides whom.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::curves::{Measure, labels, threshold};
use relievo::occlusion::{Cover, Landing};
use relievo::warp::{Linearisation, RESIDUAL, Scale};
use relievo::{Camera, Grid, RigidMotion, Window};

const W: usize = 60;
const H: usize = 44;

/// A linearisation that holds residuals and one gradient only.
fn residuals(r: &[f32], gradient: [f32; 2]) -> Linearisation {
    let n = r.len();
    let mut rows = Grid::new(n, 1, [0.0f32; 8]);
    for (row, &r) in rows.data_mut().iter_mut().zip(r) {
        row[RESIDUAL] = r;
    }
    Linearisation {
        window: Window::whole(n, 1),
        rows,
        gradient: Grid::new(n, 1, gradient),
        flow: Grid::new(n, 1, [0.0; 2]),
        inside: Grid::new(n, 1, true),
    }
}

/// ξ by brightness alone.
fn xi(line: &Linearisation, sigma: f64, normalised: bool) -> Vec<f32> {
    let (width, height) = (line.window.width, line.window.height);
    let dark = Grid::new(width, height, 0.0);
    let camera = Camera::centred(60.0, width, height).unwrap();
    let measure = Measure {
        sigma,
        gradient_sigma: None,
        normalised,
    };
    let xi = measure.residual_in_units(line, &Scale::new(camera, dark.clone(), dark));
    xi.into_vec()
}

#[test]
fn small_residuals_count_by_their_square_and_large_ones_alike() {
    let r = [0.0, 0.1, -0.1, 0.2, 8.0, 1e3, 1e6];
    let xi = xi(&residuals(&r, [0.0, 0.0]), 2.0, true);
    assert_eq!(xi[0], 0.0);
    assert_eq!(xi[1], xi[2]);
    // Without texture r² itself, in grey levels².
    assert!((xi[1] - 0.01).abs() < 1e-4 && (xi[3] / xi[1] - 4.0).abs() < 0.01);
    // r = τσ, four standard deviations, pays half of the most there is: τ²σ² = 64.
    assert!((xi[4] - 32.0).abs() < 1e-3);
    assert!(xi[5] < 64.0 && xi[5] > 63.9 && xi[6] <= 64.0 && xi[6] > 63.9);
    assert!(xi.windows(2).skip(2).all(|pair| pair[0] < pair[1] + 1e-4));
}

#[test]
fn strong_texture_does_not_out_vote_weak() {
    // The same error of position, a quarter of a pixel, on faint and on strong texture.
    let (faint, strong) = (
        residuals(&[1.0], [4.0, 0.0]),
        residuals(&[20.0], [0.0, 80.0]),
    );
    // q from ξ = σ² τ² q / (τ² + q), with τ = 4.
    let sigma = 0.5;
    let of = |line: &Linearisation, normalised| {
        let share = f64::from(xi(line, sigma, normalised)[0]) / (sigma * sigma * 16.0);
        16.0 * share / (1.0 - share)
    };
    assert!(of(&strong, true) < 1.5 * of(&faint, true));
    assert!(of(&strong, false) > 100.0 * of(&faint, false));
    // r = √(σ² + (δ‖∇I‖)²) is one standard deviation.
    let line = residuals(&[(0.25f32 + 1.0).sqrt()], [2.4, 3.2]);
    assert!((of(&line, true) - 1.0).abs() < 1e-4);
}

#[test]
fn what_leaves_the_frame_is_neither_confirmed_nor_refuted() {
    let mut line = residuals(&[0.0, 0.0, 100.0], [0.0, 0.0]);
    line.inside.data_mut()[0] = false;
    let xi = xi(&line, 1.5, true);
    assert!(xi[1] < xi[0] && xi[0] < xi[2]);
}

fn texture(x: f64, y: f64) -> f64 {
    120.0 + 35.0 * (0.9 * x + 0.2 * y).sin() + 30.0 * (0.8 * y - 0.3 * x + 0.7).cos()
}

/// Mean ξ of no motion away from the border, for a second frame that shows what `second` says.
fn mean_xi(gradient_sigma: Option<f64>, second: impl Fn(f64, f64) -> f64) -> f64 {
    let filmed =
        |of: &dyn Fn(f64, f64) -> f64| Grid::from_fn(W, H, |x, y| of(x as f64, y as f64) as f32);
    let camera = Camera::centred(60.0, W, H).unwrap();
    let scale = Scale::new(camera, filmed(&texture), filmed(&second));
    let still = RigidMotion::default();
    let line = scale.linearise(&still, &Grid::new(W, H, 1.0), scale.whole());
    let measure = Measure {
        sigma: 2.0,
        gradient_sigma,
        normalised: true,
    };
    let xi = measure.residual_in_units(&line, &scale);
    let inner = (3..H - 3).flat_map(|y| (3..W - 3).map(move |x| (x, y)));
    let sum: f64 = inner.clone().map(|at| f64::from(xi[at])).sum();
    sum / inner.count() as f64
}

#[test]
fn gradients_tell_another_texture_from_another_light() {
    let light = |x: f64, y: f64| texture(x, y) + 30.0 + 0.1 * x - 0.08 * y;
    let moved = |x: f64, y: f64| texture(x + 2.3, y - 1.1);
    let [without, with] =
        [None, Some(1.0)].map(|sigma| (mean_xi(sigma, light), mean_xi(sigma, moved)));
    // By brightness alone the light refutes as well as the texture does.
    assert!(without.0 > 0.5 * without.1, "{without:?}");
    assert!(with.0 < 0.6 * without.0, "{with:?} against {without:?}");
    assert!(with.1 > 0.8 * without.1, "{with:?} against {without:?}");
    assert!(with.0 < 0.7 * with.1, "{with:?}");
    // Nothing changed, nothing to pay.
    assert!(mean_xi(Some(1.0), texture) < 1e-6 * with.1);
}

#[test]
fn no_residual_pays_more_than_one_that_refutes_altogether() {
    let measure = Measure {
        sigma: 1.5,
        gradient_sigma: None,
        normalised: false,
    };
    let xi = xi(&residuals(&[0.1, 1e6], [0.0, 0.0]), 1.5, false);
    assert!((xi[1] - measure.refuted()).abs() < 1e-3 * measure.refuted());
    assert!(xi[0] < measure.hidden() && measure.hidden() < measure.refuted());
}

/// ξ of a background and of a disc that each fit where they are, with noise of either sign.
fn disc(cx: f32, cy: f32, r: f32) -> Vec<Grid<f32>> {
    let inside = |x: usize, y: usize| (x as f32 - cx).hypot(y as f32 - cy) < r;
    let noise = |x: usize, y: usize| ((x * 7919 + y * 104_729) % 101) as f32 / 101.0;
    [false, true]
        .map(|own| {
            Grid::from_fn(W, H, |x, y| {
                let fits = inside(x, y) == own;
                if fits {
                    1.4 * noise(x, y)
                } else {
                    1.0 + 0.6 * noise(y, x)
                }
            })
        })
        .into()
}

#[test]
fn threshold_dynamics_finds_a_disc_wherever_it_started() {
    let (cx, cy, r) = (38.0, 20.0, 10.0);
    let phi = threshold(&disc(cx, cy, r), 1.2);
    assert_eq!(phi.len(), 1);
    let found = labels(&phi, W, H);
    let (mut wrong, mut border) = (0, 0);
    for y in 0..H {
        for x in 0..W {
            let distance = r - (x as f32 - cx).hypot(y as f32 - cy);
            wrong += usize::from((found[(x, y)] == 1) != (distance > 0.0));
            // Signed distances, φ > 0 inside.
            if distance.abs() < 4.0 {
                assert!((phi[0][(x, y)] - distance).abs() < 2.0, "({x}, {y})");
                border += 1;
            }
        }
    }
    assert!(border > 100 && wrong < 25, "{wrong} pixels wrong");
}

#[test]
fn a_large_window_closes_what_is_small() {
    let xi = disc(30.0, 20.0, 2.0);
    let pixels = |sigma| {
        let found = labels(&threshold(&xi, sigma), W, H);
        found.data().iter().filter(|&&l| l == 1).count()
    };
    assert!(pixels(0.5) >= 5);
    assert_eq!(pixels(5.0), 0);
    assert!(threshold(&xi[..1], 1.0).is_empty());
}

#[test]
fn each_pixel_goes_to_the_least_of_several() {
    let xi: Vec<Grid<f32>> = (0..4)
        .map(|k| Grid::from_fn(W, H, |x, _| if x / 15 == k { 0.0 } else { 1.0 }))
        .collect();
    let found = labels(&threshold(&xi, 1.0), W, H);
    for y in 0..H {
        for x in 0..W {
            // Exactly on a border either side may have it.
            if (1..14).contains(&(x % 15)) {
                assert_eq!(usize::from(found[(x, y)]), x / 15);
            }
        }
    }
}

/// Where each pixel of a region goes that moves by (`u`, `v`), and χ² of it.
fn landing(u: isize, v: isize, chi2: impl Fn(isize, isize) -> f32) -> Landing {
    Landing {
        target: Grid::from_fn(W, H, |x, y| {
            [(x as isize + u) as f32, (y as isize + v) as f32]
        }),
        chi2: Grid::from_fn(W, H, |x, y| chi2(x as isize, y as isize)),
    }
}

fn square(x: isize, y: isize) -> bool {
    (20..32).contains(&x) && (15..27).contains(&y)
}

/// A square that slides by (`u`, `v`) over a background at rest: labels and landings as they are when
/// motions are right. What is covered shows something else in the second frame.
fn sliding(u: isize, v: isize) -> (Grid<u8>, Vec<Landing>) {
    let labels = Grid::from_fn(W, H, |x, y| u8::from(square(x as isize, y as isize)));
    let covered = move |x, y| if square(x - u, y - v) { 40.0 } else { 0.5 };
    let moving = move |x, y| if square(x, y) { 0.5 } else { 40.0 };
    (labels, vec![landing(0, 0, covered), landing(u, v, moving)])
}

/// 1 where its owner's pixel is hidden.
fn hidden(labels: &Grid<u8>, landings: &[Landing]) -> Grid<u8> {
    let cover = Cover::of(labels, landings);
    Grid::from_fn(W, H, |x, y| {
        let k = usize::from(labels[(x, y)]);
        u8::from(cover.hides(k, landings[k].target[(x, y)]))
    })
}

#[test]
fn a_sliding_square_hides_the_strip_in_front_of_it() {
    for (u, v) in [(4, 0), (-3, 0), (0, 5), (2, -2), (0, 0)] {
        let (labels, landings) = sliding(u, v);
        let hidden = hidden(&labels, &landings);
        for y in 0..H as isize {
            for x in 0..W as isize {
                let covered = !square(x, y) && square(x - u, y - v);
                let found = hidden[(x as usize, y as usize)];
                assert_eq!(found, u8::from(covered), "({x}, {y}) by ({u}, {v})");
            }
        }
        let moves = (u, v) != (0, 0);
        let behind = Cover::of(&labels, &landings).behind();
        assert!(behind[0].is_empty());
        assert_eq!(behind[1] == [0], moves, "{behind:?} by ({u}, {v})");
    }
}

#[test]
fn what_moves_by_parts_of_a_pixel_leaves_no_gaps_in_what_it_hides() {
    let (labels, mut landings) = sliding(4, 0);
    // Spread over one and a half times its width.
    for y in 0..H {
        for x in 0..W {
            let wide = 26.0 + 1.4 * (x as f32 - 26.0);
            landings[1].target[(x, y)] = [wide, y as f32];
        }
    }
    let hidden = hidden(&labels, &landings);
    for y in 15..27 {
        assert!(
            (18..20).chain(32..34).all(|x| hidden[(x, y)] == 1),
            "row {y}"
        );
    }
}

#[test]
fn a_bad_pixel_alone_is_not_hidden_and_nothing_is_beyond_the_frame() {
    let (labels, mut landings) = sliding(4, 0);
    // Nobody lands on it: it only fits badly.
    landings[0].chi2[(5, 5)] = 100.0;
    assert_eq!(hidden(&labels, &landings)[(5, 5)], 0);
    let (labels, landings) = sliding(0, 24);
    let cover = Cover::of(&labels, &landings);
    for to in [
        [25.0, H as f32],
        [-1.0, 20.0],
        [W as f32, 41.0],
        [f32::NAN; 2],
    ] {
        assert!(!cover.hides(0, to), "{to:?}");
    }
    assert!(cover.hides(0, [25.0, 41.0]));
}

#[test]
fn the_background_is_never_in_front() {
    // All evidence is for the background: then the square hides nothing, but is not hidden either.
    let (labels, mut landings) = sliding(4, 0);
    landings[0].chi2.data_mut().fill(0.0);
    landings[1].chi2.data_mut().fill(90.0);
    let cover = Cover::of(&labels, &landings);
    assert!(cover.is_in_front(1, 0) && !cover.is_in_front(0, 1));
    assert!(cover.behind()[0].is_empty());
    assert!(hidden(&labels, &landings).data().iter().all(|h| *h == 0));
}

#[test]
fn of_two_bodies_the_one_that_is_seen_is_in_front() {
    let other = |x: isize, y: isize| (34..46).contains(&x) && (15..27).contains(&y);
    let labels = Grid::from_fn(W, H, |x, y| {
        let (x, y) = (x as isize, y as isize);
        if square(x, y) {
            1
        } else {
            2 * u8::from(other(x, y))
        }
    });
    // The first slides to the second's place, which stays.
    let (u, v) = (6, 0);
    let meeting = |x, y| square(x - u, y - v) && other(x, y);
    for first_in_front in [true, false] {
        let unseen = |hides: bool| if hides { 30.0 } else { 0.6 };
        let landings = [
            landing(0, 0, move |x, y| unseen(square(x - u, y - v))),
            landing(u, v, move |x, y| {
                unseen(!first_in_front && meeting(x + u, y + v))
            }),
            landing(0, 0, move |x, y| unseen(first_in_front && meeting(x, y))),
        ];
        let cover = Cover::of(&labels, &landings);
        assert_eq!(cover.is_in_front(1, 2), first_in_front);
        assert_eq!(cover.is_in_front(2, 1), !first_in_front);
        let (front, back) = if first_in_front { (1, 2) } else { (2, 1) };
        assert!(cover.behind()[front].contains(&back));
        assert!(!cover.behind()[back].contains(&front));
        let hidden = hidden(&labels, &landings);
        for y in 0..H as isize {
            for x in 0..W as isize {
                let found = hidden[(x as usize, y as usize)] == 1;
                let expected = match labels[(x as usize, y as usize)] {
                    0 => square(x - u, y - v) && !other(x, y),
                    1 => !first_in_front && meeting(x + u, y + v),
                    _ => first_in_front && meeting(x, y),
                };
                assert_eq!(found, expected, "({x}, {y})");
            }
        }
    }
}
