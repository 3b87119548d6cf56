//! Step 3: the curves move, equation (17), as level sets φk > 0 inside.
//!
//! ```text
//! (17)  ∂γk/∂t = −( ξk − min_{j≠k} ξj + λκ ) n,   ξ = ψ²
//!       ∂φk/∂t = −( ξk − min_{j≠k} ξj ) |∇φk| + λ div(∇φk/|∇φk|) |∇φk|
//! ```
//!
//! ξ in grey levels², λ in grey levels²·px. The data part is upwind (Godunov), the curvature central. The time step
//! comes from the 70th percentile of speed along the curves: one set by the fastest pixel would pin all others. Faster
//! pixels are held to [`FASTEST`]. Stops after the number of steps asked for; works in a band around the curve, which
//! is laid anew every few steps, and asks for residuals only there.

use super::redistance::{self, Padded, Redistancing, Span};
use super::rows::{least, most};
use crate::grid::Grid;

/// A curve's greatest advance in one step, in pixels: upwind differences are stable below 1/√2.
const FASTEST: f32 = 0.7;
/// Advance in one step of a pixel that has the 70th percentile of speed, in pixels: leaves the faster ones room up to
/// [`FASTEST`].
const TYPICAL: f32 = 0.45;
/// Central curvature is stable up to λ dt = 1/4.
const STABLE: f32 = 0.2;
/// Distance in pixels up to which a neighbouring curve can take over what another leaves.
const REACH: f32 = 2.0;
/// Distance in pixels up to which speed is speed along the curve.
const ALONG: f32 = 1.5;
/// Where φ peaks, the direction of ∇φ is open: both axes then count alike, or a last pixel would never vanish.
const PEAK: f32 = 1e-6;

/// What regions compete with for a pixel.
pub trait Residuals {
    /// Writes ξ of region `k`, in grey levels², at `xi.len()` pixels of row `y` from column `first` on.
    fn write(&self, k: usize, y: usize, first: usize, xi: &mut [f32]);
}

/// Room to move curves in.
pub struct CurveEvolution {
    fronts: Vec<Front>,
    redistancing: Redistancing,
    own: Vec<f32>,
    other: Vec<f32>,
}

/// One curve as it moves.
struct Front {
    level: Padded,
    /// ξk − min ξj, where `level` has its band; grey levels².
    speed: Grid<f32>,
}

impl CurveEvolution {
    /// Room for a `width × height` frame.
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            fronts: Vec::new(),
            redistancing: Redistancing::new(width, height),
            own: vec![0.0; width],
            other: Vec::new(),
        }
    }

    /// Moves the level sets `phi` (of labels 1…), which are distances next to their zero lines, by `steps` steps of
    /// (17). They come back so, and at least six pixels or so large farther off.
    pub fn run(&mut self, phi: &mut [Grid<f32>], xi: &impl Residuals, lambda: f32, steps: usize) {
        let Some(first) = phi.first() else {
            return;
        };
        let (width, height) = (first.width(), first.height());
        self.fronts.resize_with(phi.len(), || Front {
            level: Padded::new(width, height),
            speed: Grid::new(width, height, 0.0),
        });
        for (k, phi_k) in phi.iter().enumerate() {
            self.fronts[k].level.read(phi_k);
            self.find_speed(k, phi, xi);
        }
        let Some(typical) = self.typical_speed() else {
            return;
        };
        let dt = least(TYPICAL / most(typical, 1e-12), STABLE / most(lambda, 1e-12));
        for k in 0..phi.len() {
            for step in 0..steps {
                // Differences reach one pixel a step: by then the neighbours of the line feel the end of the band.
                if step > 0 && step % (redistance::REACH as usize - 2) == 0 {
                    self.redistancing.run(&mut self.fronts[k].level);
                    self.find_speed(k, phi, xi);
                }
                self.advance(k, dt, lambda);
            }
            self.redistancing.run(&mut self.fronts[k].level);
        }
        for (front, phi) in self.fronts.iter().zip(phi) {
            front.level.write(phi);
        }
    }

    /// What moves curve `k` in its band: ξk − min_{j≠k} ξj. Inside γk only the background and regions within reach count:
    /// what γk leaves to a region far away would fall to whoever is there, whatever that costs. `phi` is where the curves
    /// were at first, for all steps.
    fn find_speed(&mut self, k: usize, phi: &[Grid<f32>], xi: &impl Residuals) {
        let Front { level, speed } = &mut self.fronts[k];
        for span in &level.band {
            let (y, first, n) = (span.row - 1, span.first - 1, span.len());
            let pixels = first..first + n;
            let own = &phi[k].row(y)[pixels.clone()];
            let speed = &mut speed.row_mut(y)[pixels.clone()];
            self.other.resize(n, 0.0);
            let rival = &mut self.own[..n];
            xi.write(0, y, first, rival);
            for (j, phi) in (1..).zip(phi).filter(|&(j, _)| j != k + 1) {
                xi.write(j, y, first, &mut self.other);
                let reach = &phi.row(y)[pixels.clone()];
                for i in 0..n {
                    let counts = own[i] <= 0.0 || reach[i] > -REACH;
                    let lower = least(rival[i], self.other[i]);
                    rival[i] = if counts { lower } else { rival[i] };
                }
            }
            xi.write(k + 1, y, first, speed);
            for (s, &r) in speed.iter_mut().zip(rival.iter()) {
                *s -= r;
            }
        }
    }

    /// The 70th percentile of |speed| along the curves; `None` without any curve.
    fn typical_speed(&mut self) -> Option<f32> {
        let found = &mut self.other;
        found.clear();
        for Front { level, speed } in &self.fronts {
            for span in &level.band {
                let phi = &level.phi.row(span.row)[span.first..span.end];
                let speed = &speed.row(span.row - 1)[span.first - 1..span.end - 1];
                let along = phi.iter().zip(speed).filter(|(p, _)| p.abs() < ALONG);
                found.extend(along.map(|(_, s)| s.abs()));
            }
        }
        if found.is_empty() {
            return None;
        }
        let rank = found.len() * 7 / 10;
        let (_, typical, _) = found.select_nth_unstable_by(rank, f32::total_cmp);
        Some(*typical)
    }

    /// One step of curve `k`.
    fn advance(&mut self, k: usize, dt: f32, lambda: f32) {
        let Front { level, speed } = &mut self.fronts[k];
        // All changes first, then all are added: neighbours are read as they were.
        let pixels: usize = level.band.iter().map(Span::len).sum();
        self.other.resize(pixels, 0.0);
        let mut rest = &mut self.other[..];
        for span in &level.band {
            let (change, after) = rest.split_at_mut(span.len());
            rest = after;
            let around = |row: usize| &level.phi.row(row)[span.first - 1..=span.end];
            let rows = [span.row - 1, span.row, span.row + 1].map(around);
            let speed = &speed.row(span.row - 1)[span.first - 1..span.end - 1];
            changes(rows, speed, dt, lambda, change);
        }
        let mut rest = &self.other[..];
        for span in &level.band {
            let (change, after) = rest.split_at(span.len());
            rest = after;
            let phi = &mut level.phi.row_mut(span.row)[span.first..span.end];
            for (p, c) in phi.iter_mut().zip(change) {
                *p += c;
            }
        }
        level.repeat_border();
    }
}

/// dt ∂φ/∂t along a span; the three rows of φ around it begin a pixel before it and end a pixel after.
fn changes([up, here, down]: [&[f32]; 3], speed: &[f32], dt: f32, lambda: f32, change: &mut [f32]) {
    let n = change.len();
    let (up, here, down) = (&up[..n + 2], &here[..n + 2], &down[..n + 2]);
    let speed = &speed[..n];
    for i in 0..n {
        let (p, left, right) = (here[i + 1], here[i], here[i + 2]);
        let (above, below) = (up[i + 1], down[i + 1]);
        let advance = most(-FASTEST, least(FASTEST, dt * speed[i]));
        // |∇φ| from the side that the curve comes from.
        let way = if advance > 0.0 { 1.0 } else { -1.0 };
        let slope = |back: f32, ahead: f32| {
            let (b, a) = (most(way * (p - back), 0.0), most(way * (p - ahead), 0.0));
            let steeper = most(a, b);
            steeper * steeper
        };
        let norm = (slope(left, right) + slope(above, below)).sqrt();
        let bend = bend(
            [right - left, below - above],
            [right - 2.0 * p + left, below - 2.0 * p + above],
            down[i + 2] - down[i] - up[i + 2] + up[i],
        );
        let moved = dt * lambda * bend - advance * norm;
        change[i] = if p.abs() < redistance::REACH - 1.0 {
            moved
        } else {
            0.0
        };
    }
}

/// div(∇φ/|∇φ|) |∇φ| from twice the first differences, the second differences, and four times the mixed one; held to
/// curvatures that a pixel grid can show.
#[inline]
fn bend(twice: [f32; 2], [xx, yy]: [f32; 2], mixed: f32) -> f32 {
    let [gx, gy] = twice.map(|g| 0.5 * g);
    let xy = 0.25 * mixed;
    let (gx2, gy2) = (gx * gx + PEAK, gy * gy + PEAK);
    let bend = (xx * gy2 - 2.0 * xy * gx * gy + yy * gx2) / (gx2 + gy2);
    most(-1.0, least(1.0, bend))
}
