//! Cubic surfaces over a region: what depth may be without being charged for it.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::depth::Polynomials;

const W: usize = 60;
const H: usize = 48;

/// Numbers from −1 to 1 that look like noise.
fn noise(x: usize, y: usize) -> f32 {
    ((x * 7919 + y * 104_729 + x * y * 13) % 2001) as f32 / 1000.0 - 1.0
}

/// A disc, some pixels of which count half.
fn disc() -> Grid<f32> {
    Grid::from_fn(W, H, |x, y| {
        let inside = (x as f32 - 27.0).hypot(y as f32 - 22.0) < 18.0;
        f32::from(inside) * if (x + y) % 5 == 0 { 0.5 } else { 1.0 }
    })
}

/// Σ w u v / Σ w.
fn product(weight: &Grid<f32>, u: &Grid<f32>, v: &Grid<f32>) -> f64 {
    let each = (0..weight.len()).map(|i| [weight, u, v].map(|grid| f64::from(grid.data()[i])));
    let (sum, total) = each.fold((0.0, 0.0), |(sum, total), [w, u, v]| {
        (sum + w * u * v, total + w)
    });
    sum / total
}

#[test]
fn the_terms_are_apart_from_each_other_and_from_a_level_surface() {
    let region = disc();
    let cubic = Polynomials::over(&region, 3).unwrap();
    let level = Grid::new(W, H, 1.0);
    assert_eq!(cubic.terms().len(), Polynomials::TERMS);
    for (j, a) in cubic.terms().iter().enumerate() {
        assert!(product(&region, a, &level).abs() < 1e-4);
        for (k, b) in cubic.terms().iter().enumerate() {
            let expected = f64::from(u8::from(j == k));
            let found = product(&region, a, b);
            assert!((found - expected).abs() < 1e-4, "{j} and {k}: {found}");
        }
    }
}

#[test]
fn nothing_departs_from_a_cubic_but_its_mean_and_from_what_is_steeper_something_does() {
    let region = disc();
    let cubic = Polynomials::over(&region, 3).unwrap();
    let field = |f: &dyn Fn(f32, f32) -> f32| {
        Grid::from_fn(W, H, |x, y| f(x as f32 / 20.0 - 1.3, y as f32 / 20.0 - 1.0))
    };
    let spread = |rho: &Grid<f32>| {
        let mean = product(&region, rho, &Grid::new(W, H, 1.0)) as f32;
        let beyond = rho.map(|r| r - mean);
        product(&region, &beyond, &beyond).sqrt()
    };
    let smooth = field(&|x, y| 1.0 + 0.2 * x - 0.1 * x * y + 0.15 * y * y * y - 0.1 * x * x * y);
    let departure = cubic.departure(&smooth);
    assert!(spread(&departure) < 1e-4 * spread(&smooth));
    let mean = |rho| product(&region, rho, &Grid::new(W, H, 1.0));
    assert!((mean(&departure) - mean(&smooth)).abs() < 1e-5);
    let wavy = field(&|x, _| 1.0 + 0.2 * (6.0 * x).sin());
    let departure = cubic.departure(&wavy);
    assert!(spread(&departure) > 0.5 * spread(&wavy));
    // Taken twice it is what it was, and no cubic is left in it.
    let again = cubic.departure(&departure);
    for (a, b) in again.data().iter().zip(departure.data()) {
        assert!((a - b).abs() < 1e-5);
    }
    for term in cubic.terms() {
        assert!(product(&region, term, &departure).abs() < 1e-5);
    }
}

#[test]
fn what_lies_beyond_the_region_does_not_count() {
    let region = disc();
    let cubic = Polynomials::over(&region, 3).unwrap();
    let inside = |x, y| region[(x, y)] > 0.0;
    let rho = Grid::from_fn(W, H, |x, y| 1.0 + 0.1 * noise(x, y));
    let spoilt = Grid::from_fn(W, H, |x, y| rho[(x, y)] + f32::from(!inside(x, y)));
    let [a, b] = [&rho, &spoilt].map(|rho| cubic.departure(rho));
    for y in 0..H {
        for x in 0..W {
            if inside(x, y) {
                assert!((a[(x, y)] - b[(x, y)]).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn a_surface_does_not_run_away_from_its_region() {
    let corner = Grid::from_fn(400, 300, |x, y| f32::from(x < 24 && y < 20));
    let cubic = Polynomials::over(&corner, 3).unwrap();
    for term in cubic.terms() {
        let most = |inside: bool| {
            let each = term.data().iter().zip(corner.data());
            let each = each.filter(|(_, w)| (**w > 0.0) == inside);
            each.fold(0.0f32, |most, (v, _)| most.max(v.abs()))
        };
        let (within, beyond) = (most(true), most(false));
        assert!(
            within > 1.0 && beyond < 12.0 * within,
            "{beyond} beyond {within}"
        );
    }
}

#[test]
fn a_region_tells_as_many_numbers_as_it_can() {
    assert!(Polynomials::over(&Grid::new(W, H, 0.0), 3).is_none());
    let few = Grid::from_fn(W, H, |x, y| f32::from(x < 19 && y < 21));
    assert!(Polynomials::over(&few, 3).is_none());
    // Along a line x, x² and x³ are all there is; on two lines side by side y, xy and x²y besides.
    for (lines, terms) in [(1, 3), (2, 6)] {
        let line = Grid::from_fn(500, 5, |_, y| f32::from(y < lines as usize));
        let cubic = Polynomials::over(&line, 3).unwrap();
        assert_eq!(cubic.terms().len(), terms);
        for term in cubic.terms() {
            assert!(term.data().iter().all(|v| v.is_finite()));
            assert!((product(&line, term, term) - 1.0).abs() < 1e-3);
        }
    }
}
