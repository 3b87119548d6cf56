//! Hot kernels by themselves, to be timed from JavaScript; with the feature `bench` only.
//!
//! A kernel is a closure on planes of its own. What it must move and compute for each pixel is stated beside it:
//! bytes count every input plane read once and every output plane written once, flops every sum and product. The
//! first two are loops that do nothing else, which tell what this module can move and compute at most.

use std::hint::black_box;

use serde::Serialize;
use wasm_bindgen::prelude::wasm_bindgen;

use super::write;
use crate::frames::{Derivatives, Spline, blur, halved};
use crate::grid::Grid;
use crate::layered;

/// Multiplications with additions in flight at once: enough to hide what each waits for.
const LANES: usize = 32;

/// A kernel, ready to run.
#[derive(Serialize)]
struct Kernel {
    name: &'static str,
    pixels: usize,
    /// Per pixel.
    bytes: f64,
    /// Per pixel.
    flops: f64,
    #[serde(skip)]
    run: Box<dyn FnMut()>,
}

/// The kernels, on frames of one size.
#[wasm_bindgen]
pub struct Kernels(Vec<Kernel>);

#[wasm_bindgen]
impl Kernels {
    /// Makes planes of `width × height` pixels and the kernels on them.
    #[wasm_bindgen(constructor)]
    pub fn new(width: usize, height: usize) -> Kernels {
        let plane = |phase: f32| {
            Grid::from_fn(width, height, |x, y| {
                let (x, y) = (x as f32, y as f32);
                128.0 + 60.0 * (0.31 * x + phase).sin() * (0.23 * y - phase).cos()
            })
        };
        let mut all = Registry {
            pixels: width * height,
            kernels: Vec::new(),
        };
        bounds(&mut all, plane(0.0));
        frames(&mut all, &plane(0.0), &plane(0.4));
        layered::kernels::enter([&plane(0.0), &plane(0.4)], |name, bytes, flops, run| {
            all.add(name, bytes, flops, run);
        });
        Self(all.kernels)
    }

    /// `[{"name", "pixels", "bytes", "flops"}]`, bytes and flops per pixel, as JSON.
    pub fn list(&self) -> String {
        write(&self.0)
    }

    /// Runs kernel `i` so many times.
    pub fn run(&mut self, i: usize, times: usize) {
        if let Some(kernel) = self.0.get_mut(i) {
            for _ in 0..times {
                (kernel.run)();
            }
        }
    }
}

/// Where kernels are entered.
struct Registry {
    pixels: usize,
    kernels: Vec<Kernel>,
}

impl Registry {
    /// Enters `run` with what it must move and compute for each pixel. What it makes is kept from being
    /// optimised away.
    fn add<T>(
        &mut self,
        name: &'static str,
        bytes: f64,
        flops: f64,
        mut run: impl FnMut() -> T + 'static,
    ) {
        self.kernels.push(Kernel {
            name,
            pixels: self.pixels,
            bytes,
            flops,
            run: Box::new(move || {
                black_box(run());
            }),
        });
    }
}

/// The two loops that bound all others.
fn bounds(all: &mut Registry, from: Grid<f32>) {
    let mut to = from.clone();
    all.add("copy", 8.0, 0.0, move || {
        // Not known to be nothing, or the loop would be a call of the engine's own.
        let offset = black_box(0.0);
        for (to, from) in to.data_mut().iter_mut().zip(from.data()) {
            *to = from + offset;
        }
        black_box(to.data());
    });
    let pixels = all.pixels;
    all.add("multiply-add", 0.0, 2.0 * LANES as f64, move || {
        let (share, offset) = (black_box(0.75_f32), black_box(0.5_f32));
        let mut sums = [1.0_f32; LANES];
        for _ in 0..pixels {
            for sum in &mut sums {
                *sum = *sum * share + offset;
            }
        }
        sums
    });
}

/// What is done to frames once.
fn frames(all: &mut Registry, first: &Grid<f32>, second: &Grid<f32>) {
    let picture = first.clone();
    all.add("spline prefilter", 8.0, 10.0, move || {
        Spline::through(&picture)
    });
    let picture = first.clone();
    all.add("halving", 5.0, 21.0, move || halved(&picture));
    let picture = first.clone();
    all.add("Gaussian, σ = 1", 8.0, 20.0, move || blur(&picture, 1.0));
    let pair = [first.clone(), second.clone()];
    all.add("derivatives", 20.0, 13.0, move || {
        Derivatives::between(&pair[0], &pair[1])
    });
}
