//! Step 3: the curves move, equation (17), as level sets φk > 0 inside.
//!
//! ```text
//! (17)  ∂γk/∂t = −( ξk − min_{j≠k} ξj + λκ ) n
//!       ∂φk/∂t = −( ξk − min_{j≠k} ξj ) |∇φk| + λ div(∇φk/|∇φk|) |∇φk| + ∇λ·∇φk
//! ```
//!
//! ξ in grey levels² (ψ² in the paper), λ in grey levels²·px. λ may differ from place to place (`geodesic.rs`):
//! the last term, nought in the paper, takes curves to where it is less. The data part is upwind (Godunov), and
//! so is that term; the curvature is central. The time step comes from the 70th percentile of speed along the
//! curves: one set by the fastest pixel would pin all others. Faster pixels are held to [`FASTEST`]. Stops after
//! the number of steps asked for; redistances every few of them, and works on a band around the curve.

use super::redistance::redistance;
use crate::grid::Grid;

/// A curve's greatest advance in one step, in pixels.
const FASTEST: f32 = 0.7;
/// Advance in one step of a pixel that has the 70th percentile of speed.
const TYPICAL: f32 = 0.45;
/// Half width of the band, in pixels, and steps after which it is laid anew.
const BAND: (f32, usize) = (6.0, 5);

/// Distance in pixels up to which a neighbouring curve can take over what another leaves.
const REACH: f32 = 2.0;

/// Moves the level sets `phi` (of labels 1…) by `steps` steps of (17). `xi[j]` is region j's residual,
/// `xi[0]` the background's; `lambda` is what a pixel of curve costs at every place.
pub fn evolve(phi: &mut [Grid<f32>], xi: &[Grid<f32>], lambda: &Grid<f32>, steps: usize) {
    let speeds: Vec<Grid<f32>> = (1..xi.len()).map(|k| speed(phi, xi, k)).collect();
    let Some(typical) = typical_speed(phi, &speeds) else {
        return;
    };
    let most = lambda.data().iter().copied().fold(1e-12, f32::max);
    // Central curvature is stable up to λ dt = 1/4.
    let dt = (TYPICAL / typical.max(1e-12)).min(0.2 / most);
    for (phi, speed) in phi.iter_mut().zip(&speeds) {
        let mut band = Vec::new();
        for step in 0..steps {
            if step % BAND.1 == 0 {
                redistance(phi);
                band = inside_band(phi);
            }
            advance(phi, speed, &band, dt, lambda);
        }
        redistance(phi);
    }
}

/// What the zero line of φ costs where a pixel of it costs `lambda`, grey levels²·px.
pub fn cost(phi: &Grid<f32>, lambda: &Grid<f32>) -> f64 {
    let mut sum = 0.0;
    for y in 0..phi.height() {
        for x in 0..phi.width() {
            let p = phi[(x, y)];
            if p.abs() < 1.0 {
                let (gx, gy) = central(phi, x, y);
                sum += f64::from((1.0 - p.abs()) * gx.hypot(gy) * lambda[(x, y)]);
            }
        }
    }
    sum
}

/// ξk − min_{j≠k} ξj. Inside γk only the background and regions within reach count: what γk leaves to
/// a region far away would fall to whoever is there, whatever that costs.
fn speed(phi: &[Grid<f32>], xi: &[Grid<f32>], k: usize) -> Grid<f32> {
    let own = phi[k - 1].data();
    let mut rival = Grid::new(xi[k].width(), xi[k].height(), f32::INFINITY);
    for (j, other) in xi.iter().enumerate().filter(|&(j, _)| j != k) {
        for (i, (r, &o)) in rival.data_mut().iter_mut().zip(other.data()).enumerate() {
            if j == 0 || own[i] <= 0.0 || phi[j - 1].data()[i] > -REACH {
                *r = r.min(o);
            }
        }
    }
    for (r, &own) in rival.data_mut().iter_mut().zip(xi[k].data()) {
        *r = own - *r;
    }
    rival
}

/// The 70th percentile of |speed| within a pixel and a half of the curves; `None` without any curve.
fn typical_speed(phi: &[Grid<f32>], speeds: &[Grid<f32>]) -> Option<f32> {
    let mut found: Vec<f32> = Vec::new();
    for (phi, speed) in phi.iter().zip(speeds) {
        let near = phi.data().iter().zip(speed.data());
        found.extend(near.filter(|(p, _)| p.abs() < 1.5).map(|(_, s)| s.abs()));
    }
    if found.is_empty() {
        return None;
    }
    let rank = found.len() * 7 / 10;
    let (_, value, _) = found.select_nth_unstable_by(rank, f32::total_cmp);
    Some(*value)
}

fn inside_band(phi: &Grid<f32>) -> Vec<(usize, usize)> {
    let width = phi.width();
    let near = phi.data().iter().enumerate();
    near.filter(|(_, p)| p.abs() < BAND.0)
        .map(|(i, _)| (i % width, i / width))
        .collect()
}

fn advance(
    phi: &mut Grid<f32>,
    speed: &Grid<f32>,
    band: &[(usize, usize)],
    dt: f32,
    lambda: &Grid<f32>,
) {
    let before = phi.clone();
    for &(x, y) in band {
        let advance = (dt * speed[(x, y)]).clamp(-FASTEST, FASTEST);
        let data = advance * upwind(&before, x, y, advance);
        let length = lambda[(x, y)] * bend(&before, x, y) + slide(&before, lambda, x, y);
        phi[(x, y)] += dt * length - data;
    }
}

/// ∇λ·∇φ, the latter from the side that it is carried from, up λ's slope.
fn slide(phi: &Grid<f32>, lambda: &Grid<f32>, x: usize, y: usize) -> f32 {
    let (lx, ly) = central(lambda, x, y);
    let (x, y) = (x as isize, y as isize);
    let step = |slope: f32, dx: isize, dy: isize| {
        if slope > 0.0 {
            phi.clamped(x + dx, y + dy) - phi.clamped(x, y)
        } else {
            phi.clamped(x, y) - phi.clamped(x - dx, y - dy)
        }
    };
    lx * step(lx, 1, 0) + ly * step(ly, 0, 1)
}

/// |∇φ| taken from the side that information comes from, for ∂φ/∂t = −F |∇φ|.
fn upwind(phi: &Grid<f32>, x: usize, y: usize, advance: f32) -> f32 {
    let (x, y) = (x as isize, y as isize);
    let here = phi.clamped(x, y);
    let back = [here - phi.clamped(x - 1, y), here - phi.clamped(x, y - 1)];
    let ahead = [phi.clamped(x + 1, y) - here, phi.clamped(x, y + 1) - here];
    let mut sum = 0.0;
    for (b, a) in back.into_iter().zip(ahead) {
        let (b, a) = if advance > 0.0 {
            (b.max(0.0), a.min(0.0))
        } else {
            (b.min(0.0), a.max(0.0))
        };
        sum += (b * b).max(a * a);
    }
    sum.sqrt()
}

/// div(∇φ/|∇φ|) |∇φ|, held to curvatures that a pixel grid can show.
fn bend(phi: &Grid<f32>, x: usize, y: usize) -> f32 {
    let (gx, gy) = central(phi, x, y);
    let (xi, yi) = (x as isize, y as isize);
    let at = |dx: isize, dy: isize| phi.clamped(xi + dx, yi + dy);
    let xx = at(1, 0) - 2.0 * at(0, 0) + at(-1, 0);
    let yy = at(0, 1) - 2.0 * at(0, 0) + at(0, -1);
    let xy = 0.25 * (at(1, 1) - at(-1, 1) - at(1, -1) + at(-1, -1));
    // Where φ peaks the direction is open: both count alike, or a last pixel would never vanish.
    let (gx2, gy2) = (gx * gx + 1e-6, gy * gy + 1e-6);
    let bend = (xx * gy2 - 2.0 * xy * gx * gy + yy * gx2) / (gx2 + gy2);
    bend.clamp(-1.0, 1.0)
}

fn central(phi: &Grid<f32>, x: usize, y: usize) -> (f32, f32) {
    let (x, y) = (x as isize, y as isize);
    (
        0.5 * (phi.clamped(x + 1, y) - phi.clamped(x - 1, y)),
        0.5 * (phi.clamped(x, y + 1) - phi.clamped(x, y - 1)),
    )
}
