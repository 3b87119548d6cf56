//! Where light leaves nothing to be seen, saturated sky and black cloth: no body and no depth of its own, and confidence
//! says so.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::solver::find_curves;
use relievo::{Camera, Grid, Solver};

use crate::support::{best, grey_pair, noise, run, texture};

const W: usize = 160;
const H: usize = 120;

/// ρ of the scene, a wave of relief; a point moves by 3 ρ pixels.
fn rho(x: f64) -> f64 {
    1.0 + 0.25 * (0.06 * x).sin()
}

/// What lights a point: a lamp behind the upper left, none at all on the lower right, and how far inside either it is,
/// in pixels.
fn light(x: f64, y: f64) -> (f64, f64) {
    let from_lamp = 28.0 - (x - 45.0).hypot(y - 40.0);
    let from_dark = 28.0 - (x - 115.0).hypot(y - 80.0);
    let step = |d: f64| 1.0 / (1.0 + (-d).exp());
    (
        300.0 * step(from_lamp) - 300.0 * step(from_dark),
        from_lamp.max(from_dark),
    )
}

/// The scene filmed in passing by a camera that clips and whose noise is `grain` grey levels: black is not quite still.
fn filmed(grain: f64) -> [Grid<f32>; 2] {
    [0.0, 1.0].map(|t| {
        let noise = noise(W, H, 7 + t as u64);
        Grid::from_fn(W, H, |px, y| {
            // The point of the first frame that is seen here.
            let (px, y) = (px as f64, y as f64);
            let x = (0..20).fold(px, |x, _| px - 3.0 * t * rho(x));
            let level = (texture(x, y) + light(x, y).0).clamp(0.0, 250.0);
            (level + grain * noise[(px as usize, y as usize)]).clamp(0.0, 255.0) as f32
        })
    })
}

#[test]
fn what_light_hides_is_no_body_has_no_depth_of_its_own_and_is_not_believed() {
    for grain in [0.0, 1.5] {
        let [first, second] = filmed(grain);
        let pair = grey_pair(first, second);
        let camera = Camera::centred(160.0, W, H).unwrap();
        assert_eq!(find_curves(&pair, &camera), [], "noise of {grain}");
        let mut solver = Solver::new(pair, camera, &[], best()).unwrap();
        let found = run(&mut solver);
        let (mut hidden, mut seen) = ([0.0; 3], [0.0; 3]);
        for (x, y) in (6..W - 6).flat_map(|x| (6..H - 6).map(move |y| (x, y))) {
            let inside = light(x as f64, y as f64).1;
            let part = match inside {
                i if i > 9.0 => &mut hidden,
                i if i < -6.0 => &mut seen,
                _ => continue,
            };
            let off = f64::from(found.flow.u[(x, y)]) - 3.0 * rho(x as f64);
            part[0] += f64::from(found.confidence[(x, y)]);
            part[1] += off.hypot(f64::from(found.flow.v[(x, y)]));
            part[2] += 1.0;
        }
        let means = [hidden, seen].map(|[c, off, n]| [c / n, off / n]);
        let [[hidden, apart], [seen, off]] = means;
        assert!(
            hidden < 0.15 && seen > 0.7,
            "noise of {grain}: confidence {hidden} hidden, {seen} seen"
        );
        assert!(
            apart < 0.3 && off < 0.1,
            "noise of {grain}: flow {apart} px off, {off} px where seen"
        );
    }
}
