//! Who is in front, and what is hidden: pixels without a counterpart in the second frame.
//!
//! Where region j lands in the second frame and is confirmed there, a pixel of a region behind it that
//! goes to the same place cannot be seen: its residual says nothing, and it is charged a constant instead
//! ([`HIDDEN`], in variances). Without this the strip that a thing covers as it moves fits nobody, and falls
//! to whoever fits by chance.
//!
//! Curves are in front of the background. Of two curves whose pixels go to the same place, that one is in
//! front whose pixels are confirmed there: Σ (χ²_k − χ²_j) over the places where both land.

use crate::grid::Grid;

/// χ² above which a pixel does not show what its region says it should.
const REFUTED: f32 = 3.0;
/// χ² at which evidence of one pixel saturates.
const SATURATION: f32 = 16.0;
/// Places that two regions must share for one to be said to hide the other.
const MEETING: usize = 10;
/// What a hidden pixel is charged, in variances of the residual.
pub const HIDDEN: f32 = 3.0;

/// Where a region says its pixels go, and how far the second frame confirms it.
pub struct Landing {
    /// Place in the second frame that each pixel goes to; not a number where it goes nowhere.
    pub target: Grid<[f32; 2]>,
    /// Squared residual in units of its variance, smoothed as far as noise asks for.
    pub chi2: Grid<f32>,
}

/// What covers the second frame.
pub struct Cover {
    width: usize,
    height: usize,
    /// Least χ² of what each region lands on each pixel with; infinite where it does not land.
    landed: Vec<Vec<f32>>,
    /// Whether region j is in front of region k, at `j * regions + k`.
    front: Vec<bool>,
}

impl Cover {
    /// What the regions cover that own the pixels as `labels` say.
    pub fn of(labels: &Grid<u8>, landings: &[Landing]) -> Self {
        let (width, height) = (labels.width(), labels.height());
        let regions = landings.len();
        let mut cover = Self {
            width,
            height,
            landed: vec![vec![f32::INFINITY; width * height]; regions],
            front: vec![false; regions * regions],
        };
        for (i, &k) in labels.data().iter().enumerate() {
            let landing = &landings[usize::from(k)];
            let chi2 = landing.chi2.data()[i];
            // All pixels that it touches: what spreads leaves no gaps.
            for (x, y) in cover.around(landing.target.data()[i]) {
                let least = &mut cover.landed[usize::from(k)][y * width + x];
                *least = least.min(chi2);
            }
        }
        for j in 0..regions {
            for k in 0..j {
                let evidence: f32 = cover.landed[j]
                    .iter()
                    .zip(&cover.landed[k])
                    .filter(|(a, b)| a.is_finite() && b.is_finite())
                    .map(|(a, b)| b.min(SATURATION) - a.min(SATURATION))
                    .sum();
                let first = k == 0 || evidence >= 0.0;
                cover.front[j * regions + k] = first;
                cover.front[k * regions + j] = !first;
            }
        }
        cover
    }

    /// For each region those behind it that go to some of the places that it goes to.
    pub fn behind(&self) -> Vec<Vec<usize>> {
        let regions = self.landed.len();
        let meets = |j: usize, k: usize| {
            let pairs = self.landed[j].iter().zip(&self.landed[k]);
            pairs
                .filter(|(a, b)| a.is_finite() && b.is_finite())
                .count()
                >= MEETING
        };
        (0..regions)
            .map(|j| {
                let behind = (0..regions).filter(|&k| k != j && self.is_in_front(j, k));
                behind.filter(|&k| meets(j, k)).collect()
            })
            .collect()
    }

    /// Whether region `j` is in front of region `k`.
    pub fn is_in_front(&self, j: usize, k: usize) -> bool {
        self.front[j * self.landed.len() + k]
    }

    /// Whether a pixel of region `k` that goes `to` would be hidden there.
    pub fn hides(&self, k: usize, to: [f32; 2]) -> bool {
        let (x, y) = (to[0].round(), to[1].round());
        let within = x >= 0.0 && y >= 0.0 && x < self.width as f32 && y < self.height as f32;
        within && {
            let at = y as usize * self.width + x as usize;
            let confirmed = |j: usize| self.landed[j][at] < REFUTED;
            (0..self.landed.len()).any(|j| self.is_in_front(j, k) && confirmed(j))
        }
    }

    fn around(&self, [x, y]: [f32; 2]) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (width, height) = (self.width as f32, self.height as f32);
        let (x0, y0) = (x.floor(), y.floor());
        [
            (x0, y0),
            (x0 + 1.0, y0),
            (x0, y0 + 1.0),
            (x0 + 1.0, y0 + 1.0),
        ]
        .into_iter()
        .filter(move |&(px, py)| {
            px >= 0.0
                && py >= 0.0
                && px < width
                && py < height
                && (px - x).abs() < 0.75
                && (py - y).abs() < 0.75
        })
        .map(|(px, py)| (px as usize, py as usize))
    }
}
