//! Which pixels have no counterpart in the second frame.
//!
//! A pixel is covered when a pixel of another region lands on its target and explains it, while its own
//! residual says that what it shows is not there; or when it leaves the frame. Two frames do not tell the
//! depth between regions, so that who is in front is read off this too: whoever covers.

use crate::grid::Grid;

/// χ² above which a pixel does not show what its region says it should.
const REFUTED: f32 = 6.0;

/// 1 where a pixel's point is not seen in the second frame. `target[i]` is where pixel i goes, in pixels,
/// `chi2[i]` its squared residual in units of its variance, both by the region that owns it.
pub fn occluded(labels: &Grid<u8>, target: &[[f32; 2]], chi2: &[f32]) -> Grid<u8> {
    let (width, height) = (labels.width(), labels.height());
    let place = |[x, y]: [f32; 2]| -> Option<usize> {
        let (x, y) = (x.round(), y.round());
        let within = x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32;
        within.then(|| y as usize * width + x as usize)
    };
    // The regions that land on each pixel of the second frame and are confirmed there, as bits.
    let mut confirmed = vec![0u8; width * height];
    for (i, &to) in target.iter().enumerate() {
        if let Some(j) = place(to)
            && chi2[i] < REFUTED
        {
            confirmed[j] |= 1 << labels.data()[i].min(7);
        }
    }
    let mut hidden = Grid::new(width, height, 0u8);
    for (i, hidden) in hidden.data_mut().iter_mut().enumerate() {
        *hidden = match place(target[i]) {
            None => 1,
            Some(j) => {
                let others = confirmed[j] & !(1 << labels.data()[i].min(7));
                u8::from(others != 0 && chi2[i] >= REFUTED)
            }
        };
    }
    hidden
}
