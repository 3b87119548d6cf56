use super::super::normal_equations::tests::Made;
use super::*;
use crate::options::Diffusion;

fn energy(made: &Made, state: &State) -> f64 {
    let problem = made.problem(4);
    let mut estimator = Estimator::default();
    estimator.improve(&problem, &mut state.clone(), MotionModel::Still, 0, false)
}

#[test]
fn a_step_lowers_the_energy_and_moves_only_what_is_free() {
    use MotionModel::{Full, Rotation, Still, Translation};
    let made = Made::usual();
    let start = made.off();
    for free in [Still, Translation, Rotation, Full] {
        // `Still` leaves depth alone free.
        let mut state = start.clone();
        let problem = made.problem(4);
        let told = Estimator::default().improve(&problem, &mut state, free, 1, false);
        let [before, after] = [&start, &state].map(|s| energy(&made, s));
        assert!(after < 0.95 * before, "{free:?}: {after} after {before}");
        assert!((told / after - 1.0).abs() < 1e-6);
        let same = |a: DVec3, b: DVec3| (a.normalize() - b.normalize()).length() < 1e-6;
        let turned = (state.omega() - start.omega()).length() > 1e-6;
        assert_eq!(turned, free.rotates(), "{free:?}");
        let headed = !same(state.translation, start.translation);
        assert_eq!(headed, free.translates(), "{free:?}");
        assert_eq!(state.surface.rho == start.surface.rho, free == Rotation);
    }
}

#[test]
fn no_number_of_steps_raises_the_energy_and_the_truth_is_found() {
    let made = Made::usual();
    let mut state = made.off();
    let problem = made.problem(4);
    let mut estimator = Estimator::default();
    let mut before = energy(&made, &state);
    for step in 0..12 {
        estimator.improve(&problem, &mut state, MotionModel::Full, 1, step > 0);
        let after = energy(&made, &state);
        assert!(
            after <= before * (1.0 + 1e-9),
            "step {step}: {after} after {before}"
        );
        before = after;
    }
    let truth = &made.truth;
    let angle = state
        .translation
        .angle_between(truth.translation)
        .to_degrees();
    assert!(angle < 5.0, "T is {angle}° off");
    let off = (state.omega() - truth.omega()).length();
    assert!(off < 1.5e-3, "ω is {off} off");
    // ρ has mean 1 where something is seen.
    let mean = estimator
        .equations
        .mean(&state.surface, |n| state.surface.rho[n]);
    assert!((mean - 1.0).abs() < 1e-3);
}

/// What a change of scale is, changes nothing: T twice as long and ρ half as large are the same.
#[test]
fn the_mean_of_depth_goes_to_the_translation() {
    let made = Made::usual();
    let problem = made.problem(4);
    let [one, other] = [1.0f32, 0.5].map(|share| {
        let mut state = made.truth.clone();
        state.surface.rho.iter_mut().for_each(|rho| *rho *= share);
        state.translation /= f64::from(share);
        Estimator::default().improve(&problem, &mut state, MotionModel::Full, 3, false);
        state
    });
    let ratio = one.translation.length() / other.translation.length();
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
    assert!(
        one.translation
            .angle_between(other.translation)
            .to_degrees()
            < 2.0
    );
}

#[test]
fn a_surfaces_gradient_is_that_of_its_energy() {
    let made = Made::usual();
    let surface = made.off().surface;
    for diffusion in [Diffusion::Isotropic, Diffusion::Anisotropic] {
        let prior = Prior {
            mu: 5e3,
            diffusion,
            epsilon: 2e-3,
            sigma: 30.0,
        };
        let mut estimator = Estimator::default();
        let cells = (surface.columns - 1) * (surface.rows - 1);
        estimator.equations.cells.resize(cells, Default::default());
        estimator.assemble(&surface, &prior);
        let largest = estimator
            .cross
            .iter()
            .map(|c| c[5].abs())
            .fold(0.0, f32::max);
        for n in (0..surface.rho.len()).step_by(3) {
            let at = |by: f32| {
                let mut moved = surface.clone();
                moved.rho[n] += by;
                surface_energy(&moved, &prior)
            };
            let slope = (at(2e-3) - at(-2e-3)) / (4.0 * 2e-3);
            let own = f64::from(estimator.cross[n][5]);
            let enough = (own - slope).abs() < 0.02 * f64::from(largest);
            assert!(enough, "{diffusion:?}, {n}: {own}, {slope}");
        }
    }
}

#[test]
fn planes_cost_nothing_and_relief_is_its_variance() {
    let made = Made::usual();
    let mut surface = made.truth.surface.clone();
    for i in 0..surface.columns {
        for j in 0..surface.rows {
            let node = surface.node(i, j);
            surface.rho[node] = 1.0 + 0.1 * i as f32 - 0.05 * j as f32;
        }
    }
    let mut prior = made.problem(4).prior;
    prior.sigma = 0.0;
    let bent = surface_energy(&made.truth.surface, &prior);
    assert!(surface_energy(&surface, &prior) < 1e-6 * bent);
    let mut equations = NormalEquations::default();
    equations.gather(&made.problem(0), &made.truth);
    surface.rho.fill(1.0);
    assert_eq!(equations.relief(&surface), 0.0);
    assert!(equations.relief(&made.truth.surface) > 0.005);
}
