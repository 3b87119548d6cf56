//! The energy that a solver reports is (7) of what it has found.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::constraint::Coefficients;
use relievo::frames::{Derivatives, blur};

use crate::support::{pair, small};

#[test]
fn each_term_is_that_of_7() {
    let (sequence, mut solver) = small();
    for _ in 0..4 {
        solver.step();
    }
    let (found, options, weights) = (
        solver.interpretation(),
        solver.options(),
        solver.report().weights,
    );
    let pair = pair(&sequence);
    let smooth = |grey| blur(grey, options.smoothing);
    let d = Derivatives::between(&smooth(&pair.first().grey), &smooth(&pair.second().grey));
    let z = &found.depth;
    let (mut data, mut smoothness) = (0.0, 0.0);
    for y in 0..48 {
        for x in 0..64 {
            let at = (x, y);
            let here = f64::from(z[at]);
            let motion = &found.motions[usize::from(found.labels[at])];
            let [ix, iy, it] = [&d.ix, &d.iy, &d.it].map(|d| f64::from(d[at]));
            let c = Coefficients::at(&found.camera, x as f64, y as f64, ix, iy);
            data += c.psi(it, motion, here.recip()).powi(2);
            let dx = f64::from(z[((x + 1).min(63), y)]) - here;
            let dy = f64::from(z[(x, (y + 1).min(47))]) - here;
            let r2 = (dx * dx + dy * dy) / options.epsilon.powi(2);
            smoothness += weights.mu * (2.0 * (1.0 + r2).sqrt() - 2.0);
        }
    }
    let energy = solver.energy();
    assert!(
        (energy.data / data - 1.0).abs() < 1e-4,
        "{} {data}",
        energy.data
    );
    let ratio = energy.smoothness / smoothness;
    assert!(
        (ratio - 1.0).abs() < 1e-4,
        "{} {smoothness}",
        energy.smoothness
    );
    let mut length = 0.0;
    for curve in solver.contours() {
        let next = curve.points.iter().cycle().skip(1);
        let sides = curve.points.iter().zip(next);
        length += sides
            .map(|(a, b)| f64::from((a[0] - b[0]).hypot(a[1] - b[1])))
            .sum::<f64>();
    }
    let ratio = energy.length / (weights.lambda * length);
    assert!((ratio - 1.0).abs() < 0.1, "{ratio} of the curves' length");
}
