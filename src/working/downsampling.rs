//! What was found, at a smaller size.
//!
//! A pixel of the smaller frame takes the label that most of the pixels have which lie in it, the least of those that as many
//! have, so an outline stays one pixel sharp. Inverse depth, flow and confidence are the means over the pixels of that label,
//! as far as they are numbers; it is hidden where half of them are or more.

use crate::camera::Camera;
use crate::grid::Grid;
use crate::interpretation::{Flow, Interpretation};

/// `found` at `width × height` pixels, each of which is `ratio` ≥ 1 of it wide and high, as `camera` sees them. What fills no
/// pixel on the right and below is left out. Flow is in pixels of the smaller frame.
pub(crate) fn downsampled(
    found: &Interpretation,
    (width, height): (usize, usize),
    ratio: f32,
    camera: Camera,
) -> Interpretation {
    let within = |at: usize, side: usize| {
        // Pixels whose centres lie within.
        let end = |at: usize| ((at as f32 * ratio - 0.5).ceil().max(0.0) as usize).min(side);
        let from = end(at).min(side - 1);
        from..end(at + 1).max(from + 1)
    };
    let columns: Vec<_> = (0..width)
        .map(|x| within(x, found.labels.width()))
        .collect();
    let planes = [
        &found.depth,
        &found.flow.u,
        &found.flow.v,
        &found.confidence,
    ];
    let mut labels = Grid::new(width, height, 0u8);
    let mut occluded = Grid::new(width, height, 0u8);
    let mut out = [(); 4].map(|()| Grid::new(width, height, 0.0f32));
    let mut counts = [0u32; 1 << u8::BITS];
    for y in 0..height {
        let rows = within(y, found.labels.height());
        for (x, columns) in columns.iter().enumerate() {
            let label = most(found, columns.clone(), rows.clone(), &mut counts);
            labels[(x, y)] = label;
            let mut hidden = [0u32; 2];
            let (mut sums, mut numbers) = ([0.0f32; 4], [0.0f32; 4]);
            for y in rows.clone() {
                for x in columns.clone() {
                    if found.labels[(x, y)] != label {
                        continue;
                    }
                    hidden[usize::from(found.occluded[(x, y)] != 0)] += 1;
                    for (i, plane) in planes.iter().enumerate() {
                        let value = plane[(x, y)];
                        let value = if i == 0 { value.recip() } else { value };
                        if value.is_finite() {
                            sums[i] += value;
                            numbers[i] += 1.0;
                        }
                    }
                }
            }
            occluded[(x, y)] = u8::from(hidden[1] >= hidden[0]);
            for (i, out) in out.iter_mut().enumerate() {
                let mean = sums[i] / numbers[i];
                out[(x, y)] = match i {
                    0 => mean.recip(),
                    1 | 2 => mean / ratio,
                    _ => mean,
                };
            }
        }
    }
    let [depth, u, v, confidence] = out;
    Interpretation {
        camera,
        labels,
        depth,
        flow: Flow { u, v },
        confidence,
        occluded,
        motions: found.motions.clone(),
    }
}

/// The label that most of these pixels have. `counts` are all 0 before and after.
fn most(
    found: &Interpretation,
    columns: std::ops::Range<usize>,
    rows: std::ops::Range<usize>,
    counts: &mut [u32; 1 << u8::BITS],
) -> u8 {
    let own = |y: usize| &found.labels.row(y)[columns.clone()];
    let first = own(rows.start)[0];
    if rows.clone().all(|y| own(y).iter().all(|l| *l == first)) {
        return first;
    }
    for y in rows.clone() {
        for &label in own(y) {
            counts[usize::from(label)] += 1;
        }
    }
    let mut best = first;
    for y in rows.clone() {
        for &label in own(y) {
            let (here, before) = (counts[usize::from(label)], counts[usize::from(best)]);
            if here > before || (here == before && label < best) {
                best = label;
            }
        }
    }
    for y in rows {
        for &label in own(y) {
            counts[usize::from(label)] = 0;
        }
    }
    best
}
