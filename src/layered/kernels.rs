//! Hot kernels by themselves, on two frames of a wavy surface, to be timed; with the feature `bench` only.
//!
//! Bytes and flops a pixel are counted as `wasm/bench.rs` has them: planes read or written once, sums, products and
//! comparisons. Semi-global matching works on bytes, sixteen at a time, where flops are four at a time.

use std::hint::black_box;

use glam::DVec3;

use super::estimate::{NormalEquations, Prior, Problem, State, Support, Surface};
use super::label::{Memory, Outlines, Reach, rigid_residual};
use super::refine::{aggregate, census, volume};
use super::region::Region;
use super::scale::Scale;
use crate::camera::{Camera, turn};
use crate::frames::{LANES, blur};
use crate::grid::Grid;
use crate::linalg::Banded;
use crate::motion_model::MotionModel;
use crate::options::Diffusion;
use crate::window::Window;

/// Enters each kernel: its name, bytes and flops a pixel, and itself.
pub(crate) fn enter(
    frames: [&Grid<f32>; 2],
    mut add: impl FnMut(&'static str, f64, f64, Box<dyn FnMut()>),
) {
    let (width, height) = (frames[0].width(), frames[0].height());
    // Steps of depth in a sweep, and regions that labels are shared out among.
    let (steps, regions) = (64, 3);
    let whole = Window::whole(width, height);
    let camera = Camera {
        focal: width as f64,
        cx: (width as f64 - 1.0) / 2.0,
        cy: (height as f64 - 1.0) / 2.0,
    };
    let scale = || {
        Scale::new(
            frames.map(|f| blur(f, 0.7)),
            frames.map(Grid::clone),
            camera,
        )
    };
    // As many control points at every size.
    let spacing = (8 * height / 240).next_power_of_two();
    let mut surface = Surface::flat(spacing, &whole);
    for (n, rho) in surface.rho.iter_mut().enumerate() {
        *rho = 1.0 + 0.2 * (0.7 * n as f32).sin();
    }
    let (nodes, bandwidth) = (surface.rho.len(), surface.bandwidth());
    let state = State {
        model: MotionModel::Full,
        translation: DVec3::new(0.01, -0.005, 0.01),
        rotation: turn(DVec3::new(0.001, 0.002, -0.002)),
        surface,
    };
    let plane = || Grid::new(width, height, 0.0f32);

    let (own, mut out) = (scale(), plane());
    add(
        "spline sampling",
        8.0,
        72.0,
        Box::new(move || {
            for y in 0..height {
                for (start, out) in out.row_mut(y).chunks_exact_mut(LANES).enumerate() {
                    let x = std::array::from_fn(|n| (LANES * start + n) as f32 + 0.3);
                    out.copy_from_slice(&own.second.at_four(x, [y as f32 + 0.4; LANES]));
                }
            }
            black_box(out.data());
        }),
    );

    let (own, labels, known) = (scale(), Grid::new(width, height, 0u8), state.clone());
    let mut equations = NormalEquations::default();
    add(
        "normal equations",
        17.0,
        370.0,
        Box::new(move || {
            let problem = Problem {
                scale: &own,
                level: 0,
                support: Support::of(&labels, 0, whole),
                prior: Prior {
                    mu: 1e5,
                    diffusion: Diffusion::Anisotropic,
                    epsilon: 2e-3,
                    sigma: 2.0,
                },
            };
            equations.gather(&problem, &known);
            black_box(equations.cost);
        }),
    );

    let mut band = Banded::default();
    let mut right = vec![[1.0f32; 8]; nodes];
    let (n, b) = (nodes as f64, bandwidth as f64);
    let pixels = (width * height) as f64;
    let flops = n * b * (b + 24.0) / pixels;
    add(
        "banded solve",
        4.0 * n * b / pixels,
        flops,
        Box::new(move || {
            band.clear(nodes, bandwidth);
            for i in 0..nodes {
                band.add(i, i, 8.0);
                band.add(i, i.saturating_sub(bandwidth), 1.0);
            }
            band.factorise();
            right.fill([1.0; 8]);
            band.solve(&mut right);
            black_box(&right);
        }),
    );

    let (own, mut residuals) = (scale(), plane());
    let mut region = Region::new(state.surface.clone());
    (region.state, region.window) = (state.clone(), Some(whole));
    add(
        "data cost",
        12.0,
        90.0,
        Box::new(move || {
            rigid_residual(&own, 0, &region, &mut residuals);
            black_box(residuals.data());
        }),
    );

    // What a cut takes depends on the picture: only what must be read and written is counted.
    let mut memory = Memory::default();
    memory.fit(width, height, regions);
    for (k, costs) in memory.costs.iter_mut().enumerate() {
        *costs = Grid::from_fn(width, height, |x, y| {
            let own = x * regions / width == k;
            ((x * 7 + y * 13) % 11) as f32 * if own { 0.5 } else { 1.0 }
        });
    }
    let picture = frames[0].clone();
    let start = Grid::from_fn(width, height, |x, _| {
        ((x + 3).min(width - 1) * regions / width) as u8
    });
    let mut labels = start.clone();
    add(
        "cuts of 3 regions, a sweep",
        2.0 + 4.0 * regions as f64,
        0.0,
        Box::new(move || {
            let outlines = Outlines {
                lambda: 8.0,
                brightness: &picture,
                sigma: 2.0,
            };
            let reach = Reach { band: 4, sweeps: 1 };
            labels.data_mut().copy_from_slice(start.data());
            memory.partition(&outlines, 16.0, reach, &mut labels);
            black_box(labels.data());
        }),
    );

    let picture = frames[0].clone();
    add(
        "census",
        8.0,
        72.0,
        Box::new(move || {
            black_box(census(&picture));
        }),
    );

    let pair = frames.map(Grid::clone);
    let (view, support) = (state.view(&camera), Grid::new(width, height, true));
    let sweep = move || volume([&pair[0], &pair[1]], &view, &support, steps, 0.0, 0.03);
    let (costs, guide) = (sweep(), frames[0].clone());
    let all = steps as f64;
    add(
        "sweep cost, 64 depths",
        8.0 + all,
        30.0 * all,
        Box::new(move || {
            black_box(sweep());
        }),
    );
    add(
        "semi-global, 64 depths",
        4.0 + 3.0 * all,
        32.0 * all,
        Box::new(move || {
            black_box(aggregate(&costs, steps, &guide));
        }),
    );
}
