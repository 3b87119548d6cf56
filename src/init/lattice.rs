//! Which match lies at which place of the 4-px lattice.

use glam::DVec2;

use super::block_search::SPACING;
use super::matches::Match;
use crate::grid::Grid;
use crate::window::places;

/// Places of a frame, four pixels apart, and the matches there.
pub struct Lattice {
    index: Grid<Option<u32>>,
}

impl Lattice {
    /// Of matches on a frame of `size`.
    pub fn new<'a>(matches: impl IntoIterator<Item = &'a Match>, size: [usize; 2]) -> Self {
        let [across, down] = size.map(|side| side.div_ceil(SPACING));
        let mut index = Grid::new(across, down, None);
        for (k, matched) in (0..).zip(matches) {
            index[place(matched)] = Some(k);
        }
        Self { index }
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.index.width(), self.index.height()]
    }

    /// How many places there are.
    pub fn places(&self) -> usize {
        self.index.len()
    }

    /// The match at a place.
    pub fn at(&self, place: (usize, usize)) -> Option<usize> {
        self.index[place].map(|k| k as usize)
    }

    /// The matches within `reach` places of one, itself left out.
    pub fn around(&self, matched: &Match, reach: usize) -> impl Iterator<Item = usize> {
        self.within(place(matched), reach)
            .filter_map(|(other, _)| self.at(other))
    }

    /// The places within `reach` of one, itself left out, and how far they are, squared.
    pub fn within(
        &self,
        (i, j): (usize, usize),
        reach: usize,
    ) -> impl Iterator<Item = ((usize, usize), usize)> + use<> {
        let [across, down] = self.size();
        let range = |at: usize, side: usize| at.saturating_sub(reach)..(at + reach + 1).min(side);
        places(range(i, across), range(j, down)).filter_map(move |(x, y)| {
            let apart = x.abs_diff(i).pow(2) + y.abs_diff(j).pow(2);
            (apart > 0).then_some(((x, y), apart))
        })
    }
}

/// The place of a match.
pub fn place(matched: &Match) -> (usize, usize) {
    let [x, y] = matched.at;
    (x as usize / SPACING, y as usize / SPACING)
}

/// The middle of a frame of so many places, in pixels.
pub fn centre(size: [usize; 2]) -> DVec2 {
    let [x, y] = size.map(|n| (n * SPACING) as f64 / 2.0);
    DVec2::new(x, y)
}
