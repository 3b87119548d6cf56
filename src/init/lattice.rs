//! Which match lies at which place of the 4-px lattice.

use glam::DVec2;

use super::block_search::SPACING;
use super::matches::Match;
use crate::grid::Grid;

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
    pub fn around(&self, matched: &Match, reach: isize) -> impl Iterator<Item = usize> {
        self.within(place(matched), reach)
            .filter_map(|(other, _)| self.at(other))
    }

    /// The places within `reach` of one, itself left out, and how far they are, squared.
    pub fn within(
        &self,
        (i, j): (usize, usize),
        reach: isize,
    ) -> impl Iterator<Item = ((usize, usize), isize)> + use<> {
        let [across, down] = self.size().map(|n| n as isize);
        let offsets = (-reach..=reach).flat_map(move |b| (-reach..=reach).map(move |a| (a, b)));
        offsets.filter_map(move |(a, b)| {
            let (x, y) = (i as isize + a, j as isize + b);
            let on = (a, b) != (0, 0) && x >= 0 && y >= 0 && x < across && y < down;
            on.then_some(((x as usize, y as usize), a * a + b * b))
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
