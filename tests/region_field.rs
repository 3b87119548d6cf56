//! A region's inverse depth: what smooths it, and how far it shows.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::depth::{Bends, Edges, FieldPrior, Plane};
use relievo::options::Diffusion;

const W: usize = 13;
const H: usize = 9;

/// Numbers from −1 to 1 that look like noise.
fn noise(x: usize, y: usize) -> f32 {
    ((x * 7919 + y * 104_729 + x * y * 13) % 2001) as f32 / 1000.0 - 1.0
}

fn rough() -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| 0.5 * noise(x, y) + 0.1 * x as f32)
}

fn prior(diffusion: Diffusion) -> FieldPrior {
    FieldPrior {
        diffusion,
        strength: 0.3,
        epsilon: 0.5,
        creases: None,
        within: None,
        relief: 0.0,
    }
}

fn dot(a: &Grid<f32>, b: &Grid<f32>) -> f64 {
    let pairs = a.data().iter().zip(b.data());
    pairs.map(|(a, b)| f64::from(*a) * f64::from(*b)).sum()
}

/// What smoothing charges for all of the field.
fn whole(edges: &Edges, bends: &Bends) -> f64 {
    edges.energy(bends, &Grid::new(W, H, 1.0))
}

#[test]
fn the_pull_is_down_the_slope_of_the_energy() {
    let field = rough();
    let edges = prior(Diffusion::Isotropic).edges(&Bends::of(&field));
    let pull = edges.pull(&Bends::of(&field));
    for at in [(0, 0), (W - 1, 0), (0, H - 1), (W - 1, H - 1), (5, 4)] {
        let energy = |by: f32| {
            let mut moved = field.clone();
            moved[at] += by;
            whole(&edges, &Bends::of(&moved))
        };
        let slope = (energy(0.1) - energy(-0.1)) / 0.2;
        let half = -0.5 * slope;
        let found = f64::from(pull[at]);
        assert!(
            (found - half).abs() < 1e-4 * (1.0 + half.abs()),
            "{found} against {half}"
        );
    }
    // Smoothing moves depth about, and makes none.
    assert!(pull.data().iter().sum::<f32>().abs() < 1e-4);
}

#[test]
fn energy_pull_and_system_are_one_operator() {
    for diffusion in [Diffusion::Isotropic, Diffusion::Anisotropic] {
        let field = rough();
        let edges = prior(diffusion).edges(&Bends::of(&field));
        let pull = edges.pull(&Bends::of(&field));
        // ρᵀLρ = −ρ·pull(ρ).
        let energy = whole(&edges, &Bends::of(&field));
        assert!((energy + dot(&field, &pull)).abs() < 1e-4 * energy);
        // With d = 1: (1 + L) ρ = ρ − pull(ρ).
        let system = edges.system(W, H, vec![1.0; W * H]);
        let right = field.data().iter().zip(pull.data());
        let right: Vec<[f32; 1]> = right.map(|(r, p)| [r - p]).collect();
        let mut found = vec![[0.0f32; 1]; W * H];
        system.solve(&right, &mut found, 1e-6, 100);
        for ([a], b) in found.iter().zip(field.data()) {
            assert!((a - b).abs() < 1e-3, "{a} for {b}");
        }
        // And data that weigh what a spike there pays, which is Σ c around it, determine half a value.
        for at in [(0, 0), (W - 1, 3), (6, H - 1), (6, 4)] {
            let mut spike = Grid::new(W, H, 0.0f32);
            spike[at] = 1.0;
            spike[at] = whole(&edges, &Bends::of(&spike)) as f32;
            assert!((edges.determined(&spike) - 0.5).abs() < 1e-4);
        }
    }
}

#[test]
fn an_edge_of_depth_is_smoothed_less_where_edges_are_kept() {
    let step = Grid::from_fn(W, H, |x, _| if x < 6 { 0.0 } else { 5.0 });
    let at_step = |diffusion| {
        let mut spike = Grid::new(W, H, 0.0f32);
        spike[(5, 4)] = 1.0;
        let edges = prior(diffusion).edges(&Bends::of(&step));
        whole(&edges, &Bends::of(&spike))
    };
    assert!(at_step(Diffusion::Anisotropic) < 0.6 * at_step(Diffusion::Isotropic));
    // Far below ε both are the same.
    let faint = rough().map(|r| 1e-4 * r);
    let (a, b) = [Diffusion::Anisotropic, Diffusion::Isotropic]
        .map(|d| {
            let edges = prior(d).edges(&Bends::of(&faint));
            whole(&edges, &Bends::of(&faint))
        })
        .into();
    assert!((a - b).abs() < 1e-5 * b);
}

/// Else a soft prior would leave noise that is a pixel wide standing.
#[test]
fn a_pixel_that_sticks_out_is_smoothed_more_than_a_step_as_high() {
    let cost = |rho: &dyn Fn(usize, usize) -> bool| {
        let bends = Bends::of(&Grid::from_fn(W, H, |x, y| 5.0 * f32::from(rho(x, y))));
        let [kept, level] = [Diffusion::Anisotropic, Diffusion::Isotropic]
            .map(|diffusion| whole(&prior(diffusion).edges(&bends), &bends));
        kept / level
    };
    let (speck, step) = (cost(&|x, y| (x, y) == (6, 4)), cost(&|x, _| x > 6));
    assert!(
        speck > 2.0 * step,
        "a pixel {speck}, a step {step} of what they cost without edges"
    );
}

#[test]
fn a_step_on_a_crease_costs_its_share_and_a_gentle_bend_costs_the_same() {
    let share = 0.1;
    let creased = FieldPrior {
        creases: Some([
            Grid::from_fn(W, H, |x, _| if x == 5 { share } else { 1.0 }),
            Grid::new(W, H, 1.0),
        ]),
        ..prior(Diffusion::Anisotropic)
    };
    let cost = |prior: &FieldPrior, after: usize, height: f32| {
        let step = Grid::from_fn(W, H, |x, _| if x <= after { 0.0 } else { height });
        let bends = Bends::of(&step);
        whole(&prior.edges(&bends), &bends)
    };
    let plain = prior(Diffusion::Anisotropic);
    let ratio = |after, height| cost(&creased, after, height) / cost(&plain, after, height);
    assert!((ratio(5, 500.0) - f64::from(share)).abs() < 1e-3);
    assert!((ratio(5, 1e-4) - 1.0).abs() < 1e-3);
    assert!((ratio(8, 500.0) - 1.0).abs() < 1e-6);
}

/// Else what depth is carried on to would hold it along its curve, as a frame does a cloth.
#[test]
fn smoothing_lets_go_where_a_region_ends() {
    let region = Grid::from_fn(W, H, |x, _| if x < 6 { 0.5 } else { 0.0 });
    for diffusion in [Diffusion::Isotropic, Diffusion::Anisotropic] {
        let within = FieldPrior {
            within: Some(region.clone()),
            ..prior(diffusion)
        };
        let share = |at: (usize, usize)| {
            let mut spike = Grid::new(W, H, 0.0f32);
            spike[at] = 1.0;
            let bends = Bends::of(&spike);
            let [a, b] = [&within, &prior(diffusion)].map(|p| whole(&p.edges(&bends), &bends));
            a / b
        };
        assert!((share((3, 4)) - 1.0).abs() < 1e-6);
        assert!((share((9, 4)) - 0.1).abs() < 1e-6);
        // Of four edges three lie within on one side of the curve, and none on the other.
        let (last, next) = (share((5, 4)), share((6, 4)));
        assert!(last > 0.6 && last < 0.95, "{last}");
        assert!((next - 0.1).abs() < 1e-6, "{next}");
    }
}

#[test]
fn a_plane_costs_nothing() {
    let plane = Grid::from_fn(W, H, |x, y| 1.3 - 0.04 * x as f32 + 0.07 * y as f32);
    // Known in a corner only, the plane goes on beyond.
    let corner = Grid::from_fn(W, H, |x, y| f32::from(x < 5 && y < 4));
    // What lies outside the weight does not count.
    let spoilt = Grid::from_fn(W, H, |x, y| {
        plane[(x, y)] + if x < 5 && y < 4 { 0.0 } else { noise(x, y) }
    });
    let fitted = Plane::fit(&spoilt, &corner);
    let heights = Grid::from_fn(W, H, |x, y| fitted.at(x as f64, y as f64) as f32);
    for (a, b) in heights.data().iter().zip(plane.data()) {
        assert!((a - b).abs() < 1e-4, "{a} for {b}");
    }
    let [right, down] = fitted.slope();
    assert!((right + 0.04).abs() < 1e-5 && (down - 0.07).abs() < 1e-5);
    let nothing = Grid::new(W, H, 0.0f32);
    let departure = Bends::about_slope(&plane, &nothing, fitted.slope(), 3.0);
    let plane_steps = Bends::of(&plane);
    for diffusion in [Diffusion::Isotropic, Diffusion::Anisotropic] {
        let prior = prior(diffusion);
        let edges = prior.edges(&departure);
        let steep = whole(&prior.edges(&plane_steps), &plane_steps);
        assert!(whole(&edges, &departure) < 1e-6 * steep);
    }
    // What the field does beyond the region is no part of its energy.
    let bends = Bends::of(&spoilt);
    let edges = prior(Diffusion::Isotropic).edges(&bends);
    let inner = Grid::from_fn(W, H, |x, y| f32::from(x < 4 && y < 3));
    let spared = Bends::of(&plane);
    let within = edges.energy(&bends, &inner);
    assert!((within - edges.energy(&spared, &inner)).abs() < 1e-4 * within);
    assert!(whole(&edges, &bends) > 10.0 * within);
    // Nothing known: the depth that every region starts from.
    let nowhere = Plane::fit(&plane, &nothing);
    assert!(nowhere.slope() == [0.0; 2] && nowhere.at(3.0, 5.0) == 1.0);
}

/// What smoothing charges for a field over 60 × 48 pixels, after its slope around and without.
fn charged(rho: &Grid<f32>) -> (f64, f64) {
    let owned = rho.map(|_| 1.0);
    let plane = Plane::fit(rho, &owned);
    let prior = prior(Diffusion::Isotropic);
    let cost = |bends: &Bends| prior.edges(bends).energy(bends, &owned);
    let about = Bends::about_slope(rho, &owned, plane.slope(), 5.0);
    (cost(&about), cost(&Bends::of(rho)))
}

#[test]
fn slopes_that_change_slowly_cost_next_to_nothing_and_steps_do() {
    let field = |f: &dyn Fn(f32, f32) -> f32| Grid::from_fn(60, 48, |x, y| f(x as f32, y as f32));
    let (cost, of_all) = charged(&field(&|x, y| 1.3 - 0.004 * x + 0.007 * y));
    assert!(cost < 1e-6 * of_all, "a plane costs {cost} of {of_all}");
    let (cost, of_all) = charged(&field(&|x, y| {
        1.0 + 0.2 * (x / 18.0).sin() + 0.15 * (y / 20.0 + 0.4).cos()
    }));
    assert!(cost < 0.05 * of_all, "a wave costs {cost} of {of_all}");
    let (cost, of_all) = charged(&field(&|x, _| 1.0 + 0.01 * (x - 30.0).abs()));
    assert!(cost < 0.2 * of_all, "a fold costs {cost} of {of_all}");
    let (cost, of_all) = charged(&field(&|x, _| if x < 30.0 { 1.0 } else { 1.3 }));
    assert!(cost > 0.6 * of_all, "a step costs {cost} of {of_all}");
}

#[test]
fn a_round_surface_hardly_bends_at_its_curve() {
    let inward = |x: usize, y: usize| 22.0 - (x as f32 - 30.0).hypot(y as f32 - 24.0);
    let rho = Grid::from_fn(60, 48, |x, y| 1.0 + 1e-4 * (22.0 - inward(x, y)).powi(2));
    let ring = |from: f32, to: f32| {
        Grid::from_fn(60, 48, |x, y| f32::from((from..to).contains(&inward(x, y))))
    };
    let owned = ring(0.0, 40.0);
    let prior = prior(Diffusion::Isotropic);
    let cost = |bends: &Bends, of: &Grid<f32>| prior.edges(bends).energy(bends, of);
    let bends = Bends::about_slope(&rho, &owned, Plane::fit(&rho, &owned).slope(), 5.0);
    let all = cost(&Bends::of(&rho), &owned);
    let of_rim = cost(&bends, &ring(0.0, 5.0));
    // After a mean of the steps around it is 0.036 of all.
    assert!(of_rim < 0.03 * all, "the rim costs {of_rim} of {all}");
}

#[test]
fn where_nothing_is_known_the_plane_is_expected() {
    let plane = |x: usize, y: usize| 1.0 + 0.003 * x as f32 - 0.002 * y as f32;
    let known = |x: usize| x < 20;
    let rho = Grid::from_fn(60, 48, |x, y| {
        plane(x, y)
            + if known(x) {
                0.1 * (x as f32 / 4.0).sin()
            } else {
                0.0
            }
    });
    let owned = Grid::from_fn(60, 48, |x, _| f32::from(known(x)));
    let far = Grid::from_fn(60, 48, |x, _| f32::from(x > 45));
    let bends = Bends::about_slope(&rho, &owned, Plane::fit(&rho, &far).slope(), 4.0);
    let edges = prior(Diffusion::Isotropic).edges(&bends);
    let pull = edges.pull(&bends);
    assert!((48..60).all(|x| pull[(x, 24)].abs() < 1e-5));
    assert!((4..16).any(|x| pull[(x, 24)].abs() > 1e-3));
}
