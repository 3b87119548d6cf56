//! The least partition: all curves at once to where (7), with ξ as it is, is least.
//!
//! ```text
//! min  Σk ∫ uk ξk dx + Σ_{k≥1} ∫ λ ‖∇uk‖ dx          uk ≥ 0, Σk uk = 1
//! u    ← P( u + τ ( div p − ξ ) )                   P: the nearest point of the simplex
//! pk   ← Q( pk + τ ∇( 2 u − u_before )k )           Q: ‖pk‖ ≤ λ, and p0 = 0
//! ```
//!
//! (17) walks: a lobe that a curve has grown, wide and with little in it to hold it there, takes hundreds of
//! steps to draw in. Here it goes at once; growing is held to a reach, since what a region would leap to often
//! has its motion but is not part of it, like a shadow. Relaxed to shares uk between 0 and 1 the functional is
//! convex (Zach et al. 2008; Lellmann and Schnörr 2011), and primal-dual steps (Chambolle and Pock 2011,
//! τ² ‖∇‖² ≤ 1 with ‖∇‖² ≤ 8) lead to its minimum from anywhere. ξ in grey levels², λ in grey levels²·px;
//! both are divided by λ's mean. Stops when shares move by less than [`STILL`] pixels in a step, all in all, or
//! after [`MOST_STEPS`].

use super::labels::labels;
use super::redistance::redistance;
use crate::grid::Grid;
use crate::window::Window;

/// τ of shares and duals, τ² ‖∇‖² ≤ 1.
const STEP: f32 = 0.35;
/// Change of shares in a step, summed over the frame, that counts as standing still.
const STILL: f32 = 0.1;
/// Most steps.
const MOST_STEPS: usize = 400;
/// What a pixel beyond reach costs, in units of λ's mean: more than any neighbours could make up for.
const OUT_OF_REACH: f32 = 1e12;

/// The level sets of labels 1… of the least partition, signed distances in pixels, φ > 0 inside. It is looked
/// for from `phi`, beyond whose curves regions grow by at most `reach` pixels. `xi[0]` is the background's
/// residual, `lambda` what a pixel of curve costs at every place.
pub fn least_partition(
    phi: &[Grid<f32>],
    xi: &[Grid<f32>],
    lambda: &Grid<f32>,
    reach: f32,
) -> Vec<Grid<f32>> {
    let (width, height) = (xi[0].width(), xi[0].height());
    let within_reach = |i: usize| phi.iter().any(|phi| phi.data()[i] >= -reach);
    // Elsewhere everything is the background's, and stays so.
    let Some(window) = Window::around(width, height, 1, within_reach) else {
        return phi.to_vec();
    };
    let crop = |grids: &[Grid<f32>]| -> Vec<_> { grids.iter().map(|g| window.crop(g)).collect() };
    let shares = relaxed(&crop(phi), crop(xi), window.crop(lambda), reach);
    (1..shares.len())
        .map(|k| {
            let mut phi = Grid::new(width, height, -1.0);
            window.paste(&lead(&shares, k), &mut phi);
            redistance(&mut phi);
            phi
        })
        .collect()
}

/// The shares uk of the minimum.
fn relaxed(
    phi: &[Grid<f32>],
    mut costs: Vec<Grid<f32>>,
    mut lambda: Grid<f32>,
    reach: f32,
) -> Vec<Grid<f32>> {
    let (width, height, regions) = (costs[0].width(), costs[0].height(), costs.len());
    let mut shares = vec![Grid::new(width, height, 0.0f32); regions];
    for (i, &k) in labels(phi, width, height).data().iter().enumerate() {
        shares[usize::from(k)].data_mut()[i] = 1.0;
    }
    let sum: f64 = lambda.data().iter().map(|l| f64::from(*l)).sum();
    let scale = ((sum / lambda.len() as f64) as f32).max(1e-6).recip();
    lambda.data_mut().iter_mut().for_each(|l| *l *= scale);
    for (k, cost) in costs.iter_mut().enumerate() {
        for (i, cost) in cost.data_mut().iter_mut().enumerate() {
            let barred = k > 0 && phi[k - 1].data()[i] < -reach;
            *cost = if barred { OUT_OF_REACH } else { *cost * scale };
        }
    }
    let open: Vec<usize> = (0..width * height)
        .filter(|&i| phi.iter().any(|phi| phi.data()[i] >= -reach))
        .collect();
    let edges = with_neighbours_before(&open, width);
    let mut ahead = shares.clone();
    let mut duals = vec![Grid::new(width, height, [0.0f32; 2]); regions - 1];
    let mut here = vec![0.0f32; regions];
    for _ in 0..MOST_STEPS {
        for (dual, share) in duals.iter_mut().zip(&ahead[1..]) {
            climb(dual, share, &lambda, &edges);
        }
        let mut moved = 0.0;
        for &i in &open {
            here[0] = shares[0].data()[i] - STEP * costs[0].data()[i];
            for k in 1..regions {
                let pull = divergence(&duals[k - 1], i) - costs[k].data()[i];
                here[k] = shares[k].data()[i] + STEP * pull;
            }
            to_simplex(&mut here);
            for k in 0..regions {
                let share = &mut shares[k].data_mut()[i];
                moved += (here[k] - *share).abs();
                ahead[k].data_mut()[i] = 2.0 * here[k] - *share;
                *share = here[k];
            }
        }
        if moved < STILL {
            break;
        }
    }
    shares
}

/// Pixels `open` and those left of and above them, in order, each once.
fn with_neighbours_before(open: &[usize], width: usize) -> Vec<usize> {
    let left = open
        .iter()
        .filter(|i| !i.is_multiple_of(width))
        .map(|i| i - 1);
    let above = open.iter().filter(|&&i| i >= width).map(|i| i - width);
    let mut all: Vec<usize> = open.iter().copied().chain(left).chain(above).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// A dual step at pixels `at`: up the gradient of `share`, forward differences, none across the frame's
/// border, and back to where ‖p‖ ≤ λ.
fn climb(dual: &mut Grid<[f32; 2]>, share: &Grid<f32>, lambda: &Grid<f32>, at: &[usize]) {
    let width = share.width();
    let u = share.data();
    for &i in at {
        let [px, py] = &mut dual.data_mut()[i];
        if i % width + 1 < width {
            *px += STEP * (u[i + 1] - u[i]);
        }
        if i + width < u.len() {
            *py += STEP * (u[i + width] - u[i]);
        }
        let (length, most) = (px.hypot(*py), lambda.data()[i]);
        if length > most {
            *px *= most / length;
            *py *= most / length;
        }
    }
}

/// div p at pixel `i`: backward differences.
fn divergence(dual: &Grid<[f32; 2]>, i: usize) -> f32 {
    let (p, width) = (dual.data(), dual.width());
    let left = if i.is_multiple_of(width) {
        0.0
    } else {
        p[i - 1][0]
    };
    let above = if i >= width { p[i - width][1] } else { 0.0 };
    p[i][0] - left + p[i][1] - above
}

/// The nearest point with parts that are not negative and add up to 1 (Michelot 1986).
fn to_simplex(point: &mut [f32]) {
    let mut excess = (point.iter().sum::<f32>() - 1.0) / point.len() as f32;
    // Each round takes away at least one of the parts that will be 0.
    for _ in 1..point.len() {
        let (mut sum, mut count) = (0.0, 0);
        for &x in point.iter().filter(|x| **x > excess) {
            sum += x;
            count += 1;
        }
        if count > 0 {
            excess = (sum - 1.0) / count as f32;
        }
    }
    for x in point {
        *x = (*x - excess).max(0.0);
    }
}

/// How far the share of region `k` is ahead of the greatest other.
fn lead(shares: &[Grid<f32>], k: usize) -> Grid<f32> {
    let mut lead = shares[k].clone();
    for (i, lead) in lead.data_mut().iter_mut().enumerate() {
        let others = shares.iter().enumerate().filter(|(j, _)| *j != k);
        *lead -= others.fold(0.0f32, |most, (_, s)| most.max(s.data()[i]));
    }
    lead
}
