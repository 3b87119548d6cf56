//! Outlines that cost less on edges of brightness: where motion leaves a curve open, an edge decides.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

mod discs;

use relievo::Grid;
use relievo::curves::{cost, evolve, labels, least_partition, length, outline_cost};
use relievo::frames::{blur, edge_weight};

use discs::{H, W, circle, everywhere, residuals, wrong};

/// A disc of another brightness than what is around, and texture as strong as `texture` all over.
fn picture(disc: &Grid<f32>, contrast: f32, texture: f32) -> Grid<f32> {
    let sharp = Grid::from_fn(W, H, |x, y| {
        let speck = ((x * 7919 + y * 104_729 + x * y * 31) % 101) as f32 / 50.0 - 1.0;
        100.0 + texture * speck + if disc[(x, y)] > 0.0 { contrast } else { 0.0 }
    });
    blur(&sharp, 0.6)
}

/// λ on such a picture.
fn outline(disc: &Grid<f32>, contrast: f32, lambda: f64) -> Grid<f32> {
    outline_cost(&picture(disc, contrast, 3.0), 1.0, lambda)
}

#[test]
fn an_edge_is_cheap_for_its_surroundings_and_its_size_is_no_matter() {
    let disc = circle(32.0, 28.0, 15.0);
    for contrast in [15.0, 60.0, -60.0] {
        let weight = edge_weight(&picture(&disc, contrast, 2.0), 1.0, 1.0);
        let mean_where = |within: &dyn Fn(f32) -> bool| {
            let chosen = disc.data().iter().zip(weight.data());
            let chosen: Vec<f32> = chosen
                .filter(|(p, _)| within(**p))
                .map(|(_, g)| *g)
                .collect();
            chosen.iter().sum::<f32>() / chosen.len() as f32
        };
        let (on, off) = (mean_where(&|p| p.abs() < 0.5), mean_where(&|p| p > 5.0));
        assert!(on < 0.6, "{on} on an edge of {contrast}");
        assert!(off > 1.0, "{off} inside");
    }
    assert!(
        edge_weight(&everywhere(9.0), 1.0, 1.0)
            .data()
            .iter()
            .all(|g| *g == 2.0)
    );
}

#[test]
fn brightness_units_do_not_matter() {
    let shown = picture(&circle(32.0, 28.0, 15.0), 20.0, 3.0);
    let (one, many) = (
        edge_weight(&shown, 1.0, 1.0),
        edge_weight(&shown.map(|v| 16.0 * v), 16.0, 1.0),
    );
    let differ = one
        .data()
        .iter()
        .zip(many.data())
        .map(|(a, b)| (a - b).abs());
    assert!(differ.fold(0.0, f32::max) < 1e-3);
}

#[test]
fn a_curve_comes_to_rest_on_the_edge_where_motion_leaves_it_open() {
    let disc = circle(32.0, 28.0, 15.0);
    // Within four pixels of its outline nothing tells the disc's motion from the background's.
    let mut xi = residuals(std::slice::from_ref(&disc), 4.0);
    for xi in &mut xi {
        for (xi, phi) in xi.data_mut().iter_mut().zip(disc.data()) {
            if phi.abs() < 4.0 {
                *xi = 1.0;
            }
        }
    }
    let edges = outline(&disc, 25.0, 2.0);
    for start in [circle(32.0, 28.0, 11.5), circle(32.0, 28.0, 18.0)] {
        let settle = |lambda: &Grid<f32>| {
            let mut phi = [start.clone()];
            for _ in 0..15 {
                evolve(&mut phi, &xi, lambda, 20);
            }
            wrong(&phi, std::slice::from_ref(&disc))
        };
        let (plain, drawn) = (settle(&everywhere(2.0)), settle(&edges));
        assert!(drawn < 0.012, "{drawn} wrong");
        assert!(
            plain > 3.0 * drawn,
            "{plain} wrong without edges, {drawn} with them"
        );
        // The convex relaxation has the same minimum.
        let at_once = least_partition(std::slice::from_ref(&start), &xi, &edges, f32::INFINITY);
        let at_once = wrong(&at_once, std::slice::from_ref(&disc));
        assert!(at_once < 0.015, "{at_once} wrong at once");
    }
}

#[test]
fn motion_that_tells_outweighs_any_edge() {
    // An edge that no motion has, like the rim of a shadow, beside the outline of what moves.
    let (moves, shadow) = (circle(26.0, 28.0, 12.0), circle(34.0, 28.0, 15.0));
    let xi = residuals(std::slice::from_ref(&moves), 16.0);
    let edges = outline(&shadow, 60.0, 2.0);
    let mut phi = [shadow.clone()];
    for _ in 0..8 {
        evolve(&mut phi, &xi, &edges, 20);
    }
    assert!(wrong(&phi, std::slice::from_ref(&moves)) < 0.01);
    assert!(labels(&phi, W, H).data().contains(&1));
}

#[test]
fn cost_is_length_times_what_a_pixel_costs() {
    let phi = circle(32.0, 28.0, 15.0);
    assert!((cost(&phi, &everywhere(3.0)) - 3.0 * length(&phi)).abs() < 1e-3);
    let half = Grid::from_fn(W, H, |x, _| if x < 32 { 0.0 } else { 1.0 });
    assert!((cost(&phi, &half) / length(&phi) - 0.5).abs() < 0.03);
}
