//! Depth that steps where brightness does.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::depth::creases;
use relievo::options::Preset;
use relievo::score::compare_flow;
use relievo::{Camera, Flow, Frame, FramePair, Grid, Options, Solver, Status};

/// Numbers from −1 to 1 that look like noise.
fn noise(x: usize, y: usize) -> f32 {
    ((x * 7919 + y * 104_729 + x * y * 13) % 2001) as f32 / 1000.0 - 1.0
}

#[test]
fn creases_lie_across_edges_that_stand_clear_of_noise() {
    let picture = |contrast: f32| {
        Grid::from_fn(64, 48, |x, y| {
            100.0 + 2.0 * noise(x, y) + if x < 32 { 0.0 } else { contrast }
        })
    };
    let (far, on) = ((12, 24), (31, 24));
    let owned = Grid::new(64, 48, 1.0);
    for contrast in [60.0, -60.0] {
        let [right, down] = creases(&picture(contrast), 1.0, &owned);
        assert!(right[on] < 0.1, "{} across an edge", right[on]);
        assert!(down[on] > 0.5, "{} along it", down[on]);
        assert!(right[far] > 0.5, "{} off it", right[far]);
        assert!(right.data().iter().all(|s| *s > 0.0 && *s <= 1.0));
    }
    // The same picture where noise is as strong as its edge.
    assert!(creases(&picture(60.0), 60.0, &owned)[0][on] > 0.9);
    // And where another region begins at the edge.
    let left = Grid::from_fn(64, 48, |x, _| f32::from(x < 32));
    assert!(creases(&picture(60.0), 1.0, &left)[0][on] >= 1.0);
}

#[test]
fn a_wall_before_another_keeps_its_edge() {
    const SIZE: (usize, usize) = (128, 96);
    // Columns that each wall moves by, the near one on the left, and where it ends.
    let (moves, end) = ([1.7f32, 0.6], 64.0f32);
    let texture = |x: f32, y: f32| {
        let waves = (0.9 * x).sin() * (0.7 * y).cos() + (0.31 * x + 0.43 * y).sin();
        18.0 * waves
    };
    let shot = |t: f32| {
        Grid::from_fn(SIZE.0, SIZE.1, |x, y| {
            let (column, y_) = (x as f32, y as f32);
            let near = column < end + t * moves[0];
            let k = usize::from(!near);
            [100.0, 140.0][k]
                + texture(column - t * moves[k], y_ + 40.0 * k as f32)
                + 4.0 * noise(x, y)
        })
    };
    let truth = Flow {
        u: Grid::from_fn(SIZE.0, SIZE.1, |x, _| moves[usize::from(x as f32 >= end)]),
        v: Grid::new(SIZE.0, SIZE.1, 0.0),
    };
    let off = |edges: bool| {
        let frames = [0.0, 1.0].map(|t| Frame::from_grey(shot(t)).unwrap());
        let [first, second] = frames;
        let mut options = Options::preset(Preset::Best);
        options.edges = edges;
        // Softer depth steps by itself, at the price of noise.
        options.cross_validation = false;
        let camera = Camera::centred(128.0, SIZE.0, SIZE.1).unwrap();
        let pair = FramePair::new(first, second).unwrap();
        let mut solver = Solver::new(pair, camera, &[], options).unwrap();
        while solver.step() == Status::Running {}
        let found = solver.interpretation().flow;
        compare_flow(&found, &truth, None).unwrap().unwrap().0
    };
    let (with, without) = (off(true), off(false));
    assert!(
        with < 0.8 * without,
        "{with} px off with edges, {without} without"
    );
}
