//! Horn–Schunck optical flow: the baseline that the method is compared with.
//!
//! Minimises ∫ (Ix u + Iy v + It)² + α² (‖∇u‖² + ‖∇v‖²) dx over the whole frame, knowing nothing of
//! depth, rigidity or regions (B. Horn and B. Schunck, "Determining optical flow", 1981).
//!
//! Ix, Iy and It are means of four first differences over the 2×2×2 cube of pixels right of, below
//! and after a pixel, in grey levels per pixel and per frame. One Jacobi sweep is
//!
//! ```text
//! u ← ū − Ix (Ix ū + Iy v̄ + It) / (α² + Ix² + Iy²)
//! v ← v̄ − Iy (Ix ū + Iy v̄ + It) / (α² + Ix² + Iy²)
//! ```
//!
//! where the bar is a mean over the eight neighbours, 1/6 for the sides and 1/12 for the corners,
//! with the frame continued past its border by its nearest pixel. u points right and v down, in pixels
//! per frame. It starts from no motion and stops after the sweeps asked for, whatever the residual.

use crate::camera::{Camera, RigidMotion};
use crate::error::Error;
use crate::frames::FramePair;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};
use crate::options::Detail;
use crate::working::{Upsampling, factor};

/// A smoothness weight for ordinary film, in grey levels per pixel.
pub const ALPHA: f32 = 10.0;
/// Sweeps after which ordinary film hardly changes.
pub const SWEEPS: usize = 300;

/// What Horn–Schunck makes of `pair`, worked on at the size of [`Detail::Normal`]: image motion, and nothing known of
/// anything else.
///
/// ```
/// use relievo::{Frame, FramePair, Grid, horn_schunck};
///
/// let waves = |by: f32| Grid::from_fn(48, 36, |x, y| 128.0 + 50.0 * (0.4 * (x as f32 - by) + 0.3 * y as f32).sin());
/// let [first, second] = [0.0, 0.5].map(|by| Frame::from_grey(waves(by)).unwrap());
/// let found = horn_schunck::interpreted(&FramePair::new(first, second)?)?;
/// // Along the waves nothing shows: it finds the motion across them.
/// let (u, v) = (found.flow.u[(24, 18)], found.flow.v[(24, 18)]);
/// assert!((0.4 * u + 0.3 * v - 0.2).abs() < 0.05);
/// # Ok::<(), relievo::Error>(())
/// ```
///
/// # Errors
/// Those of [`Camera::centred`].
pub fn interpreted(pair: &FramePair) -> Result<Interpretation, Error> {
    let (width, height) = (pair.width(), pair.height());
    let n = factor(width, height, Detail::Normal);
    if n > 1 {
        let small = pair.shrunk(n);
        let found = interpreted(&small)?;
        let colours = [&small, pair].map(|pair| &pair.first().rgb);
        let camera = Camera::centred(width as f64, width, height)?;
        return Ok(Upsampling::new(&found, colours[0], colours[1], n as f32).whole(camera));
    }
    Ok(Interpretation {
        camera: Camera::centred(width as f64, width, height)?,
        labels: Grid::new(width, height, 0),
        depth: Grid::new(width, height, 1.0),
        flow: solve(pair, ALPHA, SWEEPS),
        confidence: Grid::new(width, height, 0.0),
        occluded: Grid::new(width, height, 0),
        motions: vec![RigidMotion::default()],
    })
}

/// The flow of `pair` after `sweeps` sweeps (see [`SWEEPS`]) with smoothness weight
/// `alpha` > 0 in grey levels per pixel (see [`ALPHA`]). With `alpha` = 0 pixels
/// without contrast take their neighbours' mean.
pub fn solve(pair: &FramePair, alpha: f32, sweeps: usize) -> Flow {
    let (width, height) = (pair.width(), pair.height());
    let slopes = slopes(&pair.first().grey, &pair.second().grey);
    let still = Grid::new(width, height, 0.0_f32);
    let mut flow = Flow {
        u: still.clone(),
        v: still.clone(),
    };
    let mut next = flow.clone();
    for _ in 0..sweeps {
        sweep(&flow, &slopes, alpha * alpha, &mut next);
        std::mem::swap(&mut flow, &mut next);
    }
    flow
}

/// (Ix, Iy, It) at every pixel.
fn slopes(first: &Grid<f32>, second: &Grid<f32>) -> Grid<[f32; 3]> {
    Grid::from_fn(first.width(), first.height(), |x, y| {
        let (x, y) = (x as isize, y as isize);
        let corners = |g: &Grid<f32>| {
            [
                g.clamped(x, y),
                g.clamped(x + 1, y),
                g.clamped(x, y + 1),
                g.clamped(x + 1, y + 1),
            ]
        };
        let (a, b) = (corners(first), corners(second));
        let ix = a[1] - a[0] + a[3] - a[2] + b[1] - b[0] + b[3] - b[2];
        let iy = a[2] - a[0] + a[3] - a[1] + b[2] - b[0] + b[3] - b[1];
        let it = (0..4).map(|i| b[i] - a[i]).sum::<f32>();
        [ix / 4.0, iy / 4.0, it / 4.0]
    })
}

fn sweep(from: &Flow, slopes: &Grid<[f32; 3]>, alpha2: f32, to: &mut Flow) {
    let (width, height) = (slopes.width(), slopes.height());
    for y in 0..height {
        let (above, below) = (y.saturating_sub(1), (y + 1).min(height - 1));
        let u = [from.u.row(above), from.u.row(y), from.u.row(below)];
        let v = [from.v.row(above), from.v.row(y), from.v.row(below)];
        let slope = slopes.row(y);
        let (to_u, to_v) = (to.u.row_mut(y), to.v.row_mut(y));
        for x in 0..width {
            let (left, right) = (x.saturating_sub(1), (x + 1).min(width - 1));
            let mean = |r: &[&[f32]; 3]| {
                (r[0][x] + r[2][x] + r[1][left] + r[1][right]) / 6.0
                    + (r[0][left] + r[0][right] + r[2][left] + r[2][right]) / 12.0
            };
            let (mean_u, mean_v) = (mean(&u), mean(&v));
            let [ix, iy, it] = slope[x];
            let weight = alpha2 + ix * ix + iy * iy;
            let pull = if weight > 0.0 {
                (ix * mean_u + iy * mean_v + it) / weight
            } else {
                0.0
            };
            to_u[x] = mean_u - ix * pull;
            to_v[x] = mean_v - iy * pull;
        }
    }
}
