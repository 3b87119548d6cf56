//! Small components: a curve bounds one thing, and what lies apart from it is most often a shadow that moves along.
//!
//! A 4-connected component of a curve's region with less than [`SMALL`] of the pixels of its largest one goes to the
//! background.

use crate::connected::parts;
use crate::grid::Grid;

/// Share of the largest component below which another is given up.
const SMALL: f64 = 0.2;

/// Gives small components of all regions but the background to the background.
pub(in crate::layered) fn drop_small_components(labels: &mut Grid<u8>) {
    let (width, data) = (labels.width(), labels.data());
    let components = parts(
        data.len(),
        |i| data[i] != 0,
        |i| {
            let across = [
                (i % width > 0).then(|| i - 1),
                (i % width + 1 < width).then(|| i + 1),
            ];
            let down = [
                i.checked_sub(width),
                Some(i + width).filter(|&o| o < data.len()),
            ];
            let around = across.into_iter().chain(down).flatten();
            around.filter(move |&other| data[other] == data[i])
        },
    );
    let label = |component: &[usize]| data[component[0]];
    let largest = |of: u8| {
        let own = components.iter().filter(|c| label(c) == of);
        own.map(Vec::len).max().unwrap_or(0) as f64
    };
    let small = |c: &&Vec<usize>| (c.len() as f64) < SMALL * largest(label(c));
    let given_up: Vec<usize> = components.iter().filter(small).flatten().copied().collect();
    for i in given_up {
        labels.data_mut()[i] = 0;
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
