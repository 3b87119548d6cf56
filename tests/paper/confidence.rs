//! How far depth shows.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Grid;
use relievo::paper::confidence;

#[test]
fn confidence_grows_with_what_shows() {
    let of = |slope: f32, sigma: f64| confidence(&Grid::new(31, 31, slope), sigma)[(15, 15)];
    assert_eq!(of(0.0, 1.0), 0.0);
    let mut before = 0.0;
    for slope in [0.1, 0.3, 1.0, 3.0, 10.0] {
        let c = of(slope, 1.0);
        assert!(c > before && c < 1.0);
        assert_eq!(of(-slope, 1.0), c);
        assert!(of(slope, 2.0) < c);
        before = c;
    }
    assert!(before > 0.99);
    // ½ where ρ is known to 0.15: 4π 2.5² pixels of slope a know it to σ / (a √(4π 2.5²)).
    let pixels = 4.0 * std::f64::consts::PI * 2.5 * 2.5;
    for sigma in [0.5, 2.0] {
        let half = (sigma / (0.15 * pixels.sqrt())) as f32;
        assert!((of(half, sigma) - 0.5).abs() < 1e-3);
    }
}

#[test]
fn confidence_reaches_as_far_as_smoothing_does() {
    let slope = Grid::from_fn(60, 20, |x, _| if x < 30 { 4.0 } else { 0.0 });
    let c = confidence(&slope, 1.0);
    assert!(c[(10, 10)] > 0.9 && c[(29, 10)] > 0.5);
    assert_eq!(c[(50, 10)], 0.0);
    for x in 0..59 {
        assert!(c[(x + 1, 10)] <= c[(x, 10)] + 1e-6);
    }
}
