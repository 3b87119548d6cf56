//! Which body each curve is drawn on.
//!
//! A person's curve says which thing, a body that patches show says where it ends. Curves are assigned to
//! bodies, each to another, so that they have least far to go (the assignment problem):
//!
//! ```text
//! Σ_k d(k, b(k)) least        d(k, b) = mean over the pixels x of body b of max(0, −φ_k(x)), in pixels
//! ```
//!
//! φ_k being signed distance, above 0 inside. A curve that lies half on its neighbour's body is still its
//! own's if the neighbour's curve is nearer. Only what a curve touches is offered to it: its body shares
//! [`TOUCHES`] of the smaller of both. Unless every curve gets a body there is no assignment.

use crate::grid::Grid;

/// Share of the smaller of a curve and a body that they have in common at least.
const TOUCHES: f64 = 0.05;

/// The body that each of `curves` is on, both given by level sets of one size; `None` unless each can have
/// one of its own.
pub fn assignment(curves: &[Grid<f32>], bodies: &[Grid<f32>]) -> Option<Vec<usize>> {
    let ways: Vec<Vec<Option<f64>>> = curves
        .iter()
        .map(|curve| bodies.iter().map(|body| way(curve, body)).collect())
        .collect();
    let mut best = None;
    complete(&ways, &mut Vec::new(), 0.0, &mut best);
    best.map(|(_, which)| which)
}

/// How far `curve` has to go to `body`, in pixels; `None` where they hardly touch.
fn way(curve: &Grid<f32>, body: &Grid<f32>) -> Option<f64> {
    let (mut enclosed, mut size, mut common, mut far) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
    for (&phi, &inside) in curve.data().iter().zip(body.data()) {
        enclosed += f64::from(phi > 0.0);
        if inside > 0.0 {
            size += 1.0;
            common += f64::from(phi > 0.0);
            far += f64::from((-phi).max(0.0));
        }
    }
    let touches = common > TOUCHES * enclosed.min(size);
    touches.then(|| far / size)
}

/// Tries all ways to complete `chosen`, the bodies of the first curves, which have `far` to go.
fn complete(
    ways: &[Vec<Option<f64>>],
    chosen: &mut Vec<usize>,
    far: f64,
    best: &mut Option<(f64, Vec<usize>)>,
) {
    if best.as_ref().is_some_and(|(least, _)| far >= *least) {
        return;
    }
    let Some(next) = ways.get(chosen.len()) else {
        *best = Some((far, chosen.clone()));
        return;
    };
    for (body, way) in next.iter().enumerate() {
        if let Some(way) = way
            && !chosen.contains(&body)
        {
            chosen.push(body);
            complete(ways, chosen, far + way, best);
            chosen.pop();
        }
    }
}
