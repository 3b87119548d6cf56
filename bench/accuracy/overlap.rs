//! Labels of two segmentations of one picture, compared where neither knows the other's numbers.

use relievo::Grid;

/// Pixels of each label of one segmentation that have each label of another.
pub struct Overlap {
    /// By found label, then by true one.
    common: Vec<Vec<usize>>,
}

impl Overlap {
    /// Counts them.
    pub fn of(found: &Grid<u8>, truth: &Grid<u8>) -> Self {
        let labels = |grid: &Grid<u8>| grid.data().iter().max().map_or(0, |l| usize::from(*l) + 1);
        let mut common = vec![vec![0; labels(truth)]; labels(found)];
        for (a, b) in found.data().iter().zip(truth.data()) {
            common[usize::from(*a)][usize::from(*b)] += 1;
        }
        Self { common }
    }

    /// Share of pixels whose label is wrong when every true label is called by another found one, so
    /// that as many as possible are right. Label 0 is the background in both.
    pub fn wrong(&self) -> f64 {
        let all: usize = self.common.iter().flatten().sum();
        let background = self.common.first().and_then(|row| row.first());
        let mut free = vec![true; self.common.first().map_or(0, Vec::len)];
        let right = background.copied().unwrap_or(0) + self.right(1, &mut free);
        (all - right) as f64 / all.max(1) as f64
    }

    /// The most pixels that found labels from `k` on can have right with the true labels still free.
    fn right(&self, k: usize, free: &mut [bool]) -> usize {
        let Some(row) = self.common.get(k) else {
            return 0;
        };
        let mut most = self.right(k + 1, free);
        for label in 1..row.len() {
            if free[label] {
                free[label] = false;
                most = most.max(row[label] + self.right(k + 1, free));
                free[label] = true;
            }
        }
        most
    }
}

/// Intersection over union of two sets of pixels; 0 when both are empty.
pub fn iou(a: impl Iterator<Item = bool>, b: impl Iterator<Item = bool>) -> f64 {
    let (mut both, mut either) = (0usize, 0usize);
    for (a, b) in a.zip(b) {
        both += usize::from(a && b);
        either += usize::from(a || b);
    }
    both as f64 / either.max(1) as f64
}
