//! Small components: a curve bounds one thing, and what lies apart from it is most often a shadow that moves along.
//!
//! A 4-connected component of a curve's region with less than [`SMALL`] of the pixels of its largest one goes to the
//! background.

use crate::grid::Grid;

/// Share of the largest component below which another is given up.
const SMALL: f64 = 0.2;

/// Gives small components of all regions but the background to the background.
pub(in crate::layered) fn drop_small_components(labels: &mut Grid<u8>) {
    let (width, height) = (labels.width(), labels.height());
    let mut seen = Grid::new(width, height, false);
    let mut components: Vec<(u8, Vec<(usize, usize)>)> = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let label = labels[(x, y)];
            if label == 0 || seen[(x, y)] {
                continue;
            }
            seen[(x, y)] = true;
            let mut pixels = vec![(x, y)];
            let mut next = 0;
            while let Some(&(x, y)) = pixels.get(next) {
                next += 1;
                let around = [
                    (x.wrapping_sub(1), y),
                    (x + 1, y),
                    (x, y.wrapping_sub(1)),
                    (x, y + 1),
                ];
                for at in around {
                    let inside = at.0 < width && at.1 < height;
                    if inside && labels[at] == label && !seen[at] {
                        seen[at] = true;
                        pixels.push(at);
                    }
                }
            }
            components.push((label, pixels));
        }
    }
    let largest = |label: u8| {
        let own = components.iter().filter(|(l, _)| *l == label);
        own.map(|(_, pixels)| pixels.len()).max().unwrap_or(0) as f64
    };
    let small = |(label, pixels): &&(u8, Vec<_>)| (pixels.len() as f64) < SMALL * largest(*label);
    for &at in components.iter().filter(small).flat_map(|(_, p)| p) {
        labels[at] = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_small_beside_the_largest_goes() {
        let mut labels = Grid::new(40, 30, 0u8);
        let mut fill = |left: usize, top: usize, side: usize, label: u8| {
            for y in top..top + side {
                for x in left..left + side {
                    labels[(x, y)] = label;
                }
            }
        };
        fill(2, 2, 10, 1);
        fill(20, 2, 4, 1);
        fill(20, 12, 6, 1);
        fill(30, 20, 3, 2);
        drop_small_components(&mut labels);
        assert_eq!(labels[(5, 5)], 1);
        assert_eq!(labels[(21, 3)], 0);
        assert_eq!(labels[(22, 14)], 1);
        assert_eq!(labels[(31, 21)], 2);
    }
}
