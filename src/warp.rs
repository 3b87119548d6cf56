//! The constraint linearised around a motion that is known already, for displacements of any size.
//!
//! With the displacement w of a region's present (ρ, T, ω), the residual r = I2(x + w) − I1(x) changes
//! by ψ's coefficients *at the point reached*: with P'ρ = R(ω) ray + ρT = (X, Y, D), x' = (fX/D, fY/D),
//!
//! ```text
//! r(ρ+δρ, T+δT, δω∘ω) ≈ r + (s·T/D) δρ + (ρ/D) s·δT + q·δω        s, q of constraint.rs at x'
//! ```
//!
//! where δω turns the point after it has moved: P'' = R(δω) P' + δT. The motion is exact here, not
//! (1): past a few pixels the difference counts. ∇I is the mean of I1's and the warped I2's gradient.
//! Grey levels throughout; x' in pixels from the principal point.

use crate::camera::{Camera, RigidMotion};
use crate::frames::{FramePair, Lighting, Spline, blur, gradient, halved, halved_camera};
use crate::grid::Grid;
use crate::window::Window;

/// No scale of [`pyramid`] has a side shorter than this, unless the frames have.
pub const SMALLEST: usize = 28;

/// ∂r/∂ρ, ∂r/∂T (3), ∂r/∂ω (3) and r at one pixel.
pub type Row = [f32; 8];

/// Index of r in a [`Row`].
pub const RESIDUAL: usize = 7;

/// Two frames at one scale with what warping them needs.
#[derive(Clone, Debug)]
pub struct Scale {
    /// The camera at this scale.
    pub camera: Camera,
    /// Brightness of the first frame.
    pub first: Grid<f32>,
    /// Brightness of the second frame.
    pub second: Grid<f32>,
    /// The second frame between its pixels.
    pub between: Spline,
    /// ∂/∂x and ∂/∂y of the first frame.
    pub first_gradient: (Grid<f32>, Grid<f32>),
    /// ∂/∂x and ∂/∂y of the second frame.
    pub second_gradient: (Grid<f32>, Grid<f32>),
    /// ‖∇(∂I/∂x)‖² + ‖∇(∂I/∂y)‖² of the first frame.
    pub bend: Grid<f32>,
}

/// A region's constraint at every pixel of a window of the frame.
#[derive(Clone, Debug)]
pub struct Linearisation {
    /// The window; all grids have its size.
    pub window: Window,
    /// Derivatives and residual; all 0 where the point leaves the frame.
    pub rows: Grid<Row>,
    /// ∇I, grey levels per pixel.
    pub gradient: Grid<[f32; 2]>,
    /// The displacement w that it is linearised around, in pixels.
    pub flow: Grid<[f32; 2]>,
    /// Whether the point is still in the frame.
    pub inside: Grid<bool>,
}

impl Scale {
    /// Prepares two frames of the same size.
    pub fn new(camera: Camera, first: Grid<f32>, second: Grid<f32>) -> Self {
        let first_gradient = gradient(&first);
        let (xx, xy) = gradient(&first_gradient.0);
        let (yx, yy) = gradient(&first_gradient.1);
        let bend = Grid::from_fn(first.width(), first.height(), |x, y| {
            [&xx, &xy, &yx, &yy].map(|d| d[(x, y)].powi(2)).iter().sum()
        });
        Self {
            first_gradient,
            second_gradient: gradient(&second),
            bend,
            between: Spline::through(&second),
            camera,
            first,
            second,
        }
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.first.width()
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.first.height()
    }

    /// Changes the first frame's brightness to what it is in the light of the second.
    pub fn relight(&mut self, lighting: Lighting) {
        let (gain, offset) = (lighting.gain as f32, lighting.offset as f32);
        let scale = |grid: &mut Grid<f32>, gain: f32, offset: f32| {
            grid.data_mut()
                .iter_mut()
                .for_each(|v| *v = gain * *v + offset);
        };
        scale(&mut self.first, gain, offset);
        scale(&mut self.first_gradient.0, gain, 0.0);
        scale(&mut self.first_gradient.1, gain, 0.0);
        scale(&mut self.bend, gain * gain, 0.0);
    }

    /// All of the frame.
    pub fn whole(&self) -> Window {
        Window::whole(self.width(), self.height())
    }

    /// Linearises around `motion` at inverse depth `rho`, given at every pixel of `window`.
    pub fn linearise(
        &self,
        motion: &RigidMotion,
        rho: &Grid<f32>,
        window: Window,
    ) -> Linearisation {
        let (width, height) = (window.width, window.height);
        let mut rows = Grid::new(width, height, [0.0; 8]);
        let mut gradient = Grid::new(width, height, [0.0; 2]);
        let mut flow = Grid::new(width, height, [0.0; 2]);
        let mut inside = Grid::new(width, height, false);
        let turn = motion.matrix().as_mat3();
        let t = motion.translation.as_vec3();
        let f = self.camera.focal as f32;
        let (cx, cy) = (self.camera.cx as f32, self.camera.cy as f32);
        let (right, bottom) = ((self.width() - 1) as f32, (self.height() - 1) as f32);
        for y in 0..height {
            for x in 0..width {
                let at = (x, y);
                let (px, py) = (window.left + x, window.top + y);
                let here = (px, py);
                let ray = glam::Vec3::new((px as f32 - cx) / f, (py as f32 - cy) / f, 1.0);
                let rho = rho[at];
                let moved = turn * ray + t * rho;
                if moved.z < 1e-3 {
                    continue;
                }
                let over = moved.z.recip();
                let (x, y) = (f * moved.x * over, f * moved.y * over);
                let (qx, qy) = (x + cx, y + cy);
                if !(qx >= 0.0 && qy >= 0.0 && qx <= right && qy <= bottom) {
                    continue;
                }
                inside[at] = true;
                let ix =
                    0.5 * (self.first_gradient.0[here] + self.second_gradient.0.bilinear(qx, qy));
                let iy =
                    0.5 * (self.first_gradient.1[here] + self.second_gradient.1.bilinear(qx, qy));
                let residual = self.between.at(qx, qy) - self.first[here];
                let e = x * ix + y * iy;
                let s = glam::Vec3::new(f * ix, f * iy, -e);
                let near = rho * over;
                rows[at] = [
                    s.dot(t) * over,
                    s.x * near,
                    s.y * near,
                    s.z * near,
                    -f * iy - y * e / f,
                    f * ix + x * e / f,
                    x * iy - y * ix,
                    residual,
                ];
                gradient[at] = [ix, iy];
                flow[at] = [qx - px as f32, qy - py as f32];
            }
        }
        Linearisation {
            window,
            rows,
            gradient,
            flow,
            inside,
        }
    }
}

impl Linearisation {
    /// Takes a change of brightness, in grey levels, out of the residuals of points that stay in the frame.
    pub fn allow_for(&mut self, change: &Grid<f32>) {
        let points = self.rows.data_mut().iter_mut().zip(self.inside.data());
        for ((row, _), change) in points
            .zip(change.data())
            .filter(|((_, inside), _)| **inside)
        {
            row[RESIDUAL] -= change;
        }
    }

    /// The second frame's gradient at the place reached less the first's, at pixel `i` of the window.
    pub fn gradient_change(&self, scale: &Scale, i: usize) -> [f32; 2] {
        let at = self.window.place(i);
        let [ix, iy] = self.gradient.data()[i];
        let (first_x, first_y) = &scale.first_gradient;
        [2.0 * (ix - first_x[at]), 2.0 * (iy - first_y[at])]
    }
}

/// Two frames, smoothed with standard deviation `smoothing`, and halved until a side would fall below
/// [`SMALLEST`]: the finest scale first.
pub fn pyramid(pair: &FramePair, mut camera: Camera, smoothing: f64) -> Vec<Scale> {
    let mut first = blur(&pair.first().grey, smoothing);
    let mut second = blur(&pair.second().grey, smoothing);
    let mut scales = Vec::new();
    loop {
        let smaller = first.width().min(first.height()) / 2;
        let next = (smaller >= SMALLEST).then(|| (halved(&first), halved(&second)));
        scales.push(Scale::new(camera, first, second));
        let Some(halves) = next else {
            return scales;
        };
        (first, second) = halves;
        camera = halved_camera(&camera);
    }
}
