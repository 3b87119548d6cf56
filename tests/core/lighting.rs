//! Changes of brightness between two frames as a whole.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::support::{changed, start};
use relievo::frames::Lighting;
use relievo::{Grid, Options, Solver, scene};

const W: usize = 80;
const H: usize = 60;

fn picture() -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| {
        let (x, y) = (x as f32, y as f32);
        110.0 + 50.0 * (0.31 * x + 0.1 * y).sin() + 35.0 * (0.23 * y - 0.07 * x).cos()
    })
}

fn lit(picture: &Grid<f32>, light: Lighting) -> Grid<f32> {
    picture.map(|v| light.gain as f32 * v + light.offset as f32)
}

fn light(gain: f64, offset: f64) -> Lighting {
    Lighting { gain, offset }
}

#[test]
fn gain_and_offset_are_found() {
    let first = picture();
    for (gain, offset) in [(0.8, 10.0), (1.3, -20.0), (1.0, 12.0), (0.5, 0.0)] {
        let found = Lighting::between(&first, &lit(&first, light(gain, offset)));
        assert!((found.gain - gain).abs() < 1e-4, "{found:?}");
        assert!((found.offset - offset).abs() < 1e-2, "{found:?}");
    }
}

#[test]
fn it_does_not_matter_where_brightness_is() {
    let first = picture();
    let mirrored = Grid::from_fn(W, H, |x, y| first[(W - 1 - x, H - 1 - y)]);
    let change = light(0.8, 10.0);
    let found = Lighting::between(&first, &lit(&mirrored, change));
    assert_eq!(found, Lighting::between(&first, &lit(&first, change)));
}

#[test]
fn what_only_moved_is_lit_as_before() {
    for name in ["squares", "blocks", "head", "carousel"] {
        let [first, second] = scene::render(name, 160, 120).unwrap().frames;
        let found = Lighting::between(&first.grey, &second.grey);
        assert_eq!(found, Lighting::default(), "{name}");
        let darker = lit(&second.grey, light(0.8, 10.0));
        let found = Lighting::between(&first.grey, &darker);
        assert!((found.gain - 0.8).abs() < 0.04, "{name}: {found:?}");
        assert!((found.offset - 10.0).abs() < 5.0, "{name}: {found:?}");
    }
}

#[test]
fn a_blank_frame_tells_nothing() {
    let blank = Grid::new(W, H, 90.0);
    assert_eq!(Lighting::between(&blank, &picture()), Lighting::default());
    assert_eq!(Lighting::between(&picture(), &blank), Lighting::default());
}

#[test]
fn one_change_then_another_is_a_change() {
    let (a, b) = (light(0.8, 10.0), light(1.5, -7.0));
    let twice = lit(&lit(&picture(), a), b);
    let once = lit(&picture(), a.then(b));
    for (twice, once) in twice.data().iter().zip(once.data()) {
        assert!((twice - once).abs() < 1e-3);
    }
    assert_eq!(a.then(Lighting::default()), a);
    assert_eq!(Lighting::default().then(a), a);
    assert_ne!(a.then(b), b.then(a));
}

#[test]
fn light_may_be_allowed_for_or_not_while_it_runs() {
    let sequence = scene::render("squares", 96, 72).unwrap();
    let sequence = changed(sequence, |i, _, v| if i == 1 { 1.2 * v } else { v });
    let start = |options| start(&sequence, &sequence.curves, options);
    let off = Options {
        lighting: false,
        ..Options::default()
    };
    let noise = |solver: &mut Solver| {
        for _ in 0..5 {
            solver.step();
        }
        solver.report().weights.sigma
    };
    let allowed = noise(&mut start(Options::default()));
    let mut solver = start(off.clone());
    let blind = noise(&mut solver);
    assert!(blind > 3.0 * allowed, "{blind} and {allowed} grey levels");
    solver.set_options(Options::default()).unwrap();
    assert_eq!(noise(&mut solver), allowed);
    solver.set_options(off).unwrap();
    assert_eq!(noise(&mut solver), blind);
}
