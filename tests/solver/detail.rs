//! Frames worked on smaller than they are: what comes back is of their size, in their pixels.

use relievo::options::{Detail, Preset};
use relievo::{FramePair, Options, Shape, Solver, Status, scene, score};

const W: usize = 800;
const H: usize = 600;

fn fresh(name: &str, detail: Detail) -> (Solver, scene::Sequence) {
    let made = scene::render(name, W, H).unwrap();
    let [first, second] = made.frames.clone();
    let pair = FramePair::new(first, second).unwrap();
    let options = Options {
        detail,
        ..Options::default()
    };
    let solver = Solver::new(pair, made.truth.camera, &made.curves, options).unwrap();
    (solver, made)
}

fn solved(name: &str, detail: Detail) -> (Solver, scene::Sequence) {
    let (mut solver, made) = fresh(name, detail);
    while solver.step() == Status::Running {}
    (solver, made)
}

#[test]
fn what_is_found_comes_back_at_the_size_and_in_the_pixels_of_the_frames() {
    let (solver, made) = solved("squares", Detail::Fast);
    let report = solver.report();
    assert_eq!(report.factor, 2);
    let found = solver.interpretation();
    assert_eq!(found.camera, made.truth.camera);
    for len in [
        found.labels.len(),
        found.depth.len(),
        found.flow.u.len(),
        found.occluded.len(),
    ] {
        assert_eq!(len, W * H);
    }
    let scores = score::compare(&found, &made.truth).unwrap();
    assert!(scores.aee.unwrap() < 0.05, "{scores:?}");
    assert!(scores.labels_wrong < 0.005, "{scores:?}");
    assert!(
        scores.depth_error.iter().flatten().all(|&e| e < 0.02),
        "{scores:?}"
    );
    // As many pixels as the report says, but for those along the outlines.
    for region in &report.regions {
        let own = found.labels.data().iter();
        let own = own.filter(|&&l| usize::from(l) == region.label).count();
        assert!(
            own.abs_diff(region.pixels) < W * H / 100,
            "{own} {region:?}"
        );
    }
    // Curves lie where labels change.
    let contours = solver.contours();
    assert!(!contours.is_empty());
    for [x, y] in contours.iter().flat_map(|c| &c.points) {
        let (x, y) = (
            x.round().clamp(2.0, 797.0) as usize,
            y.round().clamp(2.0, 597.0) as usize,
        );
        let around = (0..25).map(|i| found.labels[(x + i % 5 - 2, y + i / 5 - 2)]);
        let mut around: Vec<u8> = around.collect();
        around.sort_unstable();
        let inside = x > 2 && y > 2 && x < W - 3 && y < H - 3;
        assert!(!inside || around[0] != around[24], "no outline at {x}, {y}");
    }
}

#[test]
fn outlines_follow_the_edges_of_the_frame() {
    let (solver, made) = solved("squares", Detail::Fast);
    let truth = &made.truth.labels;
    let wrong = |of: &dyn Fn(usize, usize) -> u8| {
        let all = (0..W * H).map(|i| (i % W, i / W));
        all.filter(|&(x, y)| of(x, y) != truth[(x, y)]).count()
    };
    let (full, small) = (solver.interpretation(), solver.interpretation_shrunk(2));
    assert_eq!(
        (small.labels.width(), small.labels.height()),
        (W / 2, H / 2)
    );
    assert!((small.camera.focal - full.camera.focal / 2.0).abs() < 1e-9);
    let [sharp, repeated] = [
        wrong(&|x, y| full.labels[(x, y)]),
        wrong(&|x, y| small.labels[(x / 2, y / 2)]),
    ];
    assert!(10 * sharp < 9 * repeated, "{sharp} {repeated}");
}

#[test]
fn more_detail_starts_anew_at_a_larger_size() {
    let (mut solver, made) = fresh("squares", Detail::Fast);
    solver.step();
    let options = Options {
        detail: Detail::Full,
        max_passes: 1,
        ..Options::default()
    };
    solver.set_options(options).unwrap();
    assert_eq!((solver.report().factor, solver.iterations()), (1, 0));
    // The curves are those drawn.
    let drawn = made.curves[0].level_set(W, H, 0).unwrap();
    let labels = solver.interpretation().labels;
    let differ = labels.data().iter().zip(drawn.data());
    let differ = differ.filter(|&(&l, &phi)| (l == 1) != (phi > 0.0)).count();
    assert!(differ < W * H / 200, "{differ}");
}

#[test]
fn a_smaller_picture_is_told_its_camera_and_flow() {
    let (solver, _) = fresh("squares", Detail::Full);
    assert_eq!(solver.shrunk_for(W * H), 1);
    // Smaller than the work where a picture is to be, and never so small that nothing can be seen.
    assert_eq!(solver.shrunk_for(W * H / 9), 3);
    assert_eq!(solver.shrunk_for(1000), H / 64);
    for (detail, n) in [(Detail::Fast, 2), (Detail::Full, 3), (Detail::Fast, 5)] {
        let (solver, made) = fresh("squares", detail);
        assert_eq!(solver.shrunk_for(W * H / (n * n)), n);
        let (frames, found) = (solver.frames_shrunk(n), solver.interpretation_shrunk(n));
        assert_eq!((frames.width(), frames.height()), (W / n, H / n));
        assert!(found.labels.same_size(&frames.first().rgb));
        let camera = made.truth.camera;
        assert!((found.camera.focal - camera.focal / n as f64).abs() < 1e-9);
    }
}

#[test]
fn a_pixel_is_told_as_it_is_in_all_that_is_found() {
    for detail in [Detail::Fast, Detail::Full] {
        let (mut solver, _) = fresh("squares", detail);
        solver.step();
        let (worked, whole) = (solver.worked(), solver.interpretation());
        for at in (0..W * H).step_by(97).map(|i| (i % W, i / W)) {
            assert_eq!(solver.pixel(&worked, at), whole.pixel(at), "{at:?}");
        }
    }
}

#[test]
fn curves_are_refused_in_pixels_of_the_frames() {
    let made = scene::render("squares", W, H).unwrap();
    for preset in [Preset::Best, Preset::Paper] {
        let [first, second] = made.frames.clone();
        let pair = FramePair::new(first, second).unwrap();
        let options = Options {
            detail: Detail::Fast,
            ..Options::preset(preset)
        };
        let outside = Shape::Circle {
            x: 900.0,
            y: 5.0,
            r: 30.0,
        };
        let error = Solver::new(pair, made.truth.camera, &[outside], options).err();
        let sentence = error.map_or(String::new(), |e| e.to_string());
        assert!(sentence.contains("800×600"), "{sentence}");
    }
}
