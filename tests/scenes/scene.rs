//! The built-in sequences: their truth agrees with the camera, and their frames with their truth.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::scene::{self, Draw, Sequence};
use relievo::{Error, MotionModel, Shape};

const W: usize = 96;
const H: usize = 72;

fn all() -> impl Iterator<Item = Sequence> {
    scene::names().map(|name| scene::render(name, W, H).expect(name))
}

fn draw(base: &str, seed: u64, noise_sigma: f32, displacement: f64, size: [usize; 2]) -> Draw<'_> {
    Draw {
        base,
        seed,
        noise_sigma,
        displacement,
        size,
    }
}

fn pixels(sequence: &Sequence) -> impl Iterator<Item = (usize, usize)> + use<> {
    let (w, h) = (
        sequence.truth.labels.width(),
        sequence.truth.labels.height(),
    );
    (0..w * h).map(move |i| (i % w, i / w))
}

/// Mean difference in grey levels between the frames where the second still shows the first: as they
/// are, and with the second warped back by the true flow.
fn differences(sequence: &Sequence) -> (f64, f64) {
    let [first, second] = &sequence.frames;
    let truth = &sequence.truth;
    let (mut still, mut warped, mut n) = (0.0, 0.0, 0.0);
    for (x, y) in pixels(sequence).filter(|&at| truth.occluded[at] == 0) {
        let at = (x, y);
        let (u, v) = (truth.flow.u[at], truth.flow.v[at]);
        let there = second.grey.bilinear(x as f32 + u, y as f32 + v);
        still += f64::from((second.grey[at] - first.grey[at]).abs());
        warped += f64::from((there - first.grey[at]).abs());
        n += 1.0;
    }
    (still / n, warped / n)
}

#[test]
fn flow_is_the_motion_of_the_surface_seen() {
    for sequence in all() {
        let truth = &sequence.truth;
        for (x, y) in pixels(&sequence) {
            let at = (x, y);
            let motion = &truth.motions[usize::from(truth.labels[at])];
            let point = truth.camera.ray(x as f64, y as f64) * f64::from(truth.depth[at]);
            let (qx, qy) = truth.camera.project(motion.apply(point));
            let error = (qx - x as f64 - f64::from(truth.flow.u[at]))
                .hypot(qy - y as f64 - f64::from(truth.flow.v[at]));
            assert!(error < 1e-5, "{} at {at:?}: {error}", sequence.name);
        }
    }
}

#[test]
fn the_second_frame_is_the_first_moved_by_the_true_flow() {
    for name in scene::names() {
        // Large enough for displacements to tell against the error of interpolation.
        let sequence = scene::render(name, 200, 150).expect(name);
        let (still, warped) = differences(&sequence);
        assert!(warped < 2.5, "{name}: {warped} grey levels");
        assert!(warped < 0.5 * still, "{name}: {warped} against {still}");
    }
}

#[test]
fn every_region_is_seen_and_a_third_of_it_lies_in_its_circle() {
    for sequence in all() {
        let truth = &sequence.truth;
        assert_eq!(sequence.curves.len() + 1, truth.regions());
        for (k, curve) in sequence.curves.iter().enumerate() {
            assert!(matches!(curve, Shape::Circle { .. }));
            let object: Vec<_> = pixels(&sequence)
                .filter(|&at| usize::from(truth.labels[at]) == k + 1)
                .collect();
            let inside = object
                .iter()
                .filter(|&&(x, y)| curve.signed_distance(x as f64, y as f64) > 0.0)
                .count();
            let share = inside as f64 / object.len() as f64;
            let what = format!("{}, object {}", sequence.name, k + 1);
            assert!(object.len() * 50 > W * H, "{what}: {} px", object.len());
            assert!((0.28..0.38).contains(&share), "{what}: {share}");
        }
    }
}

#[test]
fn the_number_of_regions_is_as_announced() {
    let regions = |name| {
        scene::render(name, 16, 16)
            .expect("a built-in sequence")
            .truth
            .regions()
    };
    assert_eq!(
        scene::names().map(regions).collect::<Vec<_>>(),
        [3, 3, 2, 2, 1, 1, 4]
    );
}

#[test]
fn moving_bodies_hide_something_only_near_edges_of_depth() {
    for name in scene::names() {
        let sequence = scene::render(name, 200, 150).expect(name);
        let hidden: usize = sequence
            .truth
            .occluded
            .data()
            .iter()
            .map(|&o| usize::from(o))
            .sum();
        assert!(hidden > 10, "{name}: {hidden} pixels");
        assert!(hidden < 200 * 150 / 50, "{name}: {hidden} pixels");
    }
}

#[test]
fn what_is_marked_hidden_lies_outside_or_behind() {
    // A hidden pixel's target shows another surface: nearer than the point that went there.
    let sequence = scene::variant(&draw("blocks", 3, 0.0, 8.0, [200, 150])).expect("a variant");
    let truth = &sequence.truth;
    let (mut hidden, mut explained) = (0, 0);
    for at in pixels(&sequence).filter(|&at| truth.occluded[at] == 1) {
        let (x, y) = (
            at.0 as f32 + truth.flow.u[at],
            at.1 as f32 + truth.flow.v[at],
        );
        hidden += 1;
        // Who lands there, other than this body?
        let lands = |other: (usize, usize)| {
            truth.labels[other] != truth.labels[at]
                && (other.0 as f32 + truth.flow.u[other] - x).abs() < 1.0
                && (other.1 as f32 + truth.flow.v[other] - y).abs() < 1.0
        };
        let outside = x < -0.5 || y < -0.5 || x >= 199.5 || y >= 149.5;
        if outside || pixels(&sequence).any(lands) {
            explained += 1;
        }
    }
    assert!(hidden > 100, "{hidden}");
    // The rest is hidden by a face that could not be seen in the first frame.
    assert!(explained * 10 > hidden * 6, "{explained} of {hidden}");
}

#[test]
fn depth_shows_only_where_the_body_translates() {
    let blocks = scene::render("blocks", W, H).expect("blocks");
    for at in pixels(&blocks) {
        let expected = if blocks.truth.labels[at] == 0 {
            0.0
        } else {
            1.0
        };
        assert_eq!(blocks.truth.confidence[at], expected);
    }
}

#[test]
fn motion_is_small_and_scales_with_the_picture() {
    let fastest = |s: &Sequence| {
        pixels(s)
            .map(|at| s.truth.flow.u[at].hypot(s.truth.flow.v[at]))
            .fold(0.0, f32::max)
            / s.truth.labels.width() as f32
    };
    for name in scene::names() {
        let (small, large) = (
            scene::render(name, 64, 48).expect(name),
            scene::render(name, 160, 120).expect(name),
        );
        let (a, b) = (fastest(&small), fastest(&large));
        assert!(
            (a / b - 1.0).abs() < 0.1,
            "{name}: {a} and {b} of the width"
        );
        // Between a half and two pixels at a width of 320, and twice as much where the camera passes something near.
        let most = if name == "columns" { 4.0 } else { 2.0 };
        assert!((0.5..most).contains(&(320.0 * b)), "{name}: {}", 320.0 * b);
    }
}

#[test]
fn any_size_within_the_limits_will_do() {
    for name in scene::names() {
        for (w, h) in [(16, 16), (37, 23), (17, 90), (150, 16)] {
            let sequence = scene::render(name, w, h).expect(name);
            assert_eq!(sequence.frames[0].width(), w);
            assert_eq!(sequence.frames[1].height(), h);
            assert!(sequence.truth.depth.data().iter().all(|&z| z > 0.0));
            for (k, curve) in sequence.curves.iter().enumerate() {
                curve.level_set(w, h, k).expect("a curve on the frame");
            }
        }
        for (w, h) in [(0, 0), (15, 20), (20, 15), (30_001, 16)] {
            assert!(matches!(
                scene::render(name, w, h),
                Err(Error::Size { width, height, .. }) if (width, height) == (w, h)
            ));
        }
    }
}

#[test]
fn the_truth_tells_models() {
    let truth = scene::render("blocks", 160, 120).unwrap().truth;
    use MotionModel::{Still, Translation};
    assert_eq!(truth.models(), [Still, Translation, Translation]);
    // In other units of depth the same motion is seen.
    let scaled = truth.scaled(&[3.0, 0.2, 7.0]);
    assert_eq!(scaled.models(), truth.models());
}

#[test]
fn the_same_again_is_the_same() {
    assert_eq!(
        scene::render("carousel", 40, 30),
        scene::render("carousel", 40, 30)
    );
    let made = |seed| scene::variant(&draw("blocks", seed, 2.0, 3.0, [40, 30])).expect("a variant");
    assert_eq!(made(5), made(5));
    assert_ne!(made(5).frames, made(6).frames);
}

#[test]
fn frames_hold_whole_numbers_as_files_do() {
    for sequence in all() {
        for frame in &sequence.frames {
            for at in pixels(&sequence) {
                let [r, g, b] = frame.rgb[at].map(f32::from);
                let luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
                assert!((frame.grey[at] - luma).abs() < 1e-3);
            }
        }
    }
}

#[test]
fn variants_keep_their_promises() {
    for (base, regions) in [("blocks", 3), ("carousel", 4), ("crowd", 5)] {
        for seed in 0..9 {
            let displacement = [1.0, 4.0, 12.0][seed as usize % 3];
            let sequence =
                scene::variant(&draw(base, seed, 0.0, displacement, [120, 90])).expect("a variant");
            let truth = &sequence.truth;
            let what = &sequence.name;
            assert_eq!(truth.regions(), regions);
            for k in 1..truth.regions() {
                let object: Vec<_> = pixels(&sequence)
                    .filter(|&at| usize::from(truth.labels[at]) == k)
                    .collect();
                let share = object.len() as f64 / (120.0 * 90.0);
                assert!((0.03..0.22).contains(&share), "{what}: {share}");
                let circle = &sequence.curves[k - 1];
                let inside = object
                    .iter()
                    .filter(|&&(x, y)| circle.signed_distance(x as f64, y as f64) > 0.0)
                    .count() as f64
                    / object.len() as f64;
                assert!((0.2..0.4).contains(&inside), "{what}: {inside}");
            }
            let fastest = pixels(&sequence)
                .map(|at| truth.flow.u[at].hypot(truth.flow.v[at]))
                .fold(0.0, f32::max);
            // Stated for a width of 320.
            let ratio = f64::from(fastest) / displacement * 320.0 / 120.0;
            assert!((0.9..1.2).contains(&ratio), "{what}: {ratio}");
            let (still, warped) = differences(&sequence);
            assert!(warped < 6.0 && warped < still, "{what}: {warped}, {still}");
        }
    }
}

#[test]
fn what_is_filmed_in_passing_is_one_scene_whose_depth_leaps() {
    for base in ["blocks", "carousel"] {
        for seed in 0..4 {
            let sequence = scene::passing(&draw(base, seed, 0.0, 4.0, [120, 90])).expect("a scene");
            let (truth, what) = (&sequence.truth, &sequence.name);
            assert_eq!(truth.regions(), 1, "{what}");
            assert!(sequence.curves.is_empty(), "{what}");
            let fastest = pixels(&sequence)
                .map(|at| truth.flow.u[at].hypot(truth.flow.v[at]))
                .fold(0.0, f32::max);
            let ratio = f64::from(fastest) / 4.0 * 320.0 / 120.0;
            assert!((0.9..1.2).contains(&ratio), "{what}: {ratio}");
            // Beside an edge of a body what is behind is nearly twice as far, or more.
            let leaps = pixels(&sequence)
                .filter(|&(x, _)| x > 0)
                .filter(|&(x, y)| {
                    let ratio = truth.depth[(x, y)] / truth.depth[(x - 1, y)];
                    !(1.0 / 1.8..1.8).contains(&ratio)
                })
                .count();
            assert!(leaps > 40, "{what}: {leaps}");
            let (still, warped) = differences(&sequence);
            assert!(warped < 6.0 && warped < still, "{what}: {warped}, {still}");
        }
    }
}

/// Frames 1 and 2 of a film, with the truth about them, under the film's name.
fn later(name: &str, film: &scene::Film) -> Sequence {
    Sequence {
        name: name.to_owned(),
        title: String::new(),
        lesson: String::new(),
        frames: [film.frames[1].clone(), film.frames[2].clone()],
        curves: Vec::new(),
        truth: film.truths[1].clone(),
    }
}

#[test]
fn a_film_goes_on_as_its_sequence_began() {
    for name in scene::names() {
        let (sequence, film) = (
            scene::render(name, 200, 150).expect(name),
            scene::render_film(name, 200, 150, 3).expect(name),
        );
        assert_eq!(film.frames[..2], sequence.frames);
        assert_eq!(
            (&film.curves, &film.truths[0]),
            (&sequence.curves, &sequence.truth)
        );
        assert_eq!((film.frames.len(), film.truths.len()), (3, 2));
        assert_eq!(film.truths[1].motions, sequence.truth.motions);
        let (still, warped) = differences(&later(name, &film));
        assert!(warped < 2.5, "{name}: {warped} grey levels");
        assert!(warped < 0.5 * still, "{name}: {warped} against {still}");
    }
}

#[test]
fn a_variant_s_film_has_its_frames_and_noise_of_its_own_in_each() {
    let size = [96, 72];
    let sequence = scene::variant(&draw("crowd", 3, 2.0, 4.0, size)).expect("a variant");
    let film = |noise| scene::variant_film(&draw("crowd", 3, noise, 4.0, size), 3).expect("a film");
    let (noisy, clean) = (film(2.0), film(0.0));
    assert_eq!(noisy.frames[..2], sequence.frames);
    let noise = |i: usize| {
        let pairs = noisy.frames[i].grey.data().iter();
        pairs.zip(clean.frames[i].grey.data()).map(|(a, b)| a - b)
    };
    let product = |i, j| noise(i).zip(noise(j)).map(|(a, b)| a * b).sum::<f32>();
    assert!(product(1, 2).abs() < 0.1 * product(2, 2));
}

#[test]
fn noise_has_the_strength_asked_for() {
    let render =
        |sigma| scene::variant(&draw("carousel", 9, sigma, 2.0, [96, 72])).expect("a variant");
    let (clean, noisy) = (render(0.0), render(6.0));
    assert_eq!(clean.truth, noisy.truth);
    for i in 0..2 {
        let square: f32 = pixels(&clean)
            .map(|at| (noisy.frames[i].grey[at] - clean.frames[i].grey[at]).powi(2))
            .sum();
        let sigma = (square / (96.0 * 72.0)).sqrt();
        assert!((sigma - 6.0).abs() < 0.3, "{sigma}");
    }
}

#[test]
fn what_does_not_exist_is_refused() {
    assert!(matches!(
        scene::render("circus", 64, 48),
        Err(Error::Choice { choices, .. }) if choices.contains("carousel")
    ));
    assert!(matches!(
        scene::variant(&draw("head", 1, 0.0, 1.0, [64, 48])),
        Err(Error::Choice { .. })
    ));
    for frames in [0, 1, 101] {
        assert!(matches!(
            scene::render_film("head", 64, 48, frames),
            Err(Error::Count { .. })
        ));
    }
    for (noise, displacement) in [(-1.0, 1.0), (f32::NAN, 1.0), (0.0, f64::NAN), (0.0, 100.0)] {
        assert!(matches!(
            scene::variant(&draw("blocks", 1, noise, displacement, [64, 48])),
            Err(Error::Option { .. })
        ));
    }
}

#[test]
fn the_catalogue_names_every_sequence() {
    assert!(scene::names().eq(scene::catalogue().iter().map(|e| e.name)));
    for entry in scene::catalogue() {
        let sequence = scene::render(entry.name, 16, 16).expect(entry.name);
        assert_eq!(
            (sequence.title.as_str(), sequence.lesson.as_str()),
            (entry.title, entry.lesson)
        );
        assert!(entry.lesson.len() > 40);
    }
}
