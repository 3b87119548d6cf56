//! The least partition: all curves at once to where (7), with ξ as it is, is least.
//!
//! ```text
//! min  Σk ∫ uk ξk dx + λ Σ_{k≥1} ∫ ‖∇uk‖ dx        uk ≥ 0, Σk uk = 1
//! u    ← P( u + τ ( div p − ξ ) )                   P: the nearest point of the simplex
//! pk   ← Q( pk + τ ∇( 2 u − u_before )k )           Q: ‖pk‖ ≤ λ, and p0 = 0
//! ```
//!
//! (17) walks: a lobe that a curve has grown, wide and with little in it to hold it there, takes hundreds of
//! steps to draw in. Here it goes at once; growing is held to a reach, since what a region would leap to often
//! has its motion but is not part of it, like a shadow. Relaxed to shares uk between 0 and 1 the functional is
//! convex (Zach et al. 2008; Lellmann and Schnörr 2011), and primal-dual steps (Chambolle and Pock 2011,
//! τ² ‖∇‖² ≤ 1 with ‖∇‖² ≤ 8) lead to its minimum from anywhere. ξ in grey levels², λ in grey levels²·px. Stops
//! when no pixel's greatest share has changed hands in [`PATIENCE`] steps, or after [`MOST_STEPS`].

use super::evolution::labels;
use super::redistance::redistance;
use crate::grid::Grid;

/// τ of shares and duals in units of λ, τ² ‖∇‖² ≤ 1.
const STEP: f32 = 0.35;
/// Steps between looks at who owns what.
const PATIENCE: usize = 25;
/// Most steps.
const MOST_STEPS: usize = 400;
/// What a pixel beyond reach costs, in units of λ: more than any neighbours could make up for.
const OUT_OF_REACH: f32 = 1e12;

/// The level sets of labels 1… of the least partition, signed distances in pixels, φ > 0 inside. It is looked
/// for from `phi`, beyond whose curves regions grow by at most `reach` pixels. `xi[0]` is the background's
/// residual.
pub fn least_partition(
    phi: &[Grid<f32>],
    xi: &[Grid<f32>],
    lambda: f64,
    reach: f32,
) -> Vec<Grid<f32>> {
    let (width, height, regions) = (xi[0].width(), xi[0].height(), xi.len());
    let mut owners = labels(phi, width, height);
    let mut shares = vec![Grid::new(width, height, 0.0f32); regions];
    for (i, &k) in owners.data().iter().enumerate() {
        shares[usize::from(k)].data_mut()[i] = 1.0;
    }
    let scale = (lambda as f32).max(1e-6).recip();
    let mut costs: Vec<Grid<f32>> = xi.iter().map(|xi| xi.map(|xi| scale * xi)).collect();
    for (cost, phi) in costs[1..].iter_mut().zip(phi) {
        for (cost, &phi) in cost.data_mut().iter_mut().zip(phi.data()) {
            if phi < -reach {
                *cost = OUT_OF_REACH;
            }
        }
    }
    // Elsewhere everything is the background's, and stays so.
    let open: Vec<usize> = (0..width * height)
        .filter(|&i| phi.iter().any(|phi| phi.data()[i] >= -reach))
        .collect();
    let edges = with_neighbours_before(&open, width);
    let mut ahead = shares.clone();
    let mut duals = vec![Grid::new(width, height, [0.0f32; 2]); regions - 1];
    let mut here = vec![0.0f32; regions];
    for step in 1..=MOST_STEPS {
        for (dual, share) in duals.iter_mut().zip(&ahead[1..]) {
            climb(dual, share, &edges);
        }
        for &i in &open {
            here[0] = shares[0].data()[i] - STEP * costs[0].data()[i];
            for k in 1..regions {
                let pull = divergence(&duals[k - 1], i) - costs[k].data()[i];
                here[k] = shares[k].data()[i] + STEP * pull;
            }
            to_simplex(&mut here);
            for k in 0..regions {
                let share = &mut shares[k].data_mut()[i];
                ahead[k].data_mut()[i] = 2.0 * here[k] - *share;
                *share = here[k];
            }
        }
        if step % PATIENCE == 0 {
            let now = greatest(&shares);
            if now.data() == owners.data() {
                break;
            }
            owners = now;
        }
    }
    (1..regions).map(|k| boundary(&shares, k)).collect()
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

/// A dual step with λ = 1 at pixels `at`: up the gradient of `share`, forward differences, none across the
/// frame's border.
fn climb(dual: &mut Grid<[f32; 2]>, share: &Grid<f32>, at: &[usize]) {
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
        let length = px.hypot(*py).max(1.0);
        *px /= length;
        *py /= length;
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

/// Whose share is the greatest.
fn greatest(shares: &[Grid<f32>]) -> Grid<u8> {
    let (width, height) = (shares[0].width(), shares[0].height());
    Grid::from_fn(width, height, |x, y| {
        let mut best = 0;
        for k in 1..shares.len() {
            if shares[k][(x, y)] > shares[best][(x, y)] {
                best = k;
            }
        }
        best as u8
    })
}

/// The level set of region `k`: where its share equals the greatest other.
fn boundary(shares: &[Grid<f32>], k: usize) -> Grid<f32> {
    let mut phi = shares[k].clone();
    for (i, p) in phi.data_mut().iter_mut().enumerate() {
        let others = shares.iter().enumerate().filter(|(j, _)| *j != k);
        let rival = others.fold(0.0f32, |most, (_, s)| most.max(s.data()[i]));
        *p -= rival;
    }
    redistance(&mut phi);
    phi
}
