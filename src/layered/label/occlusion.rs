//! What the second frame hides.
//!
//! A pixel of the background that goes where a region in front goes too cannot be seen there: its residual says nothing.
//! It is charged what it costs to match by chance, unless it fits better. Without this the strip that a thing covers as it
//! moves fits nobody, and falls to whoever fits by chance. Curves are in front of the background.

use super::super::estimate::State;
use super::super::scale::Scale;
use super::data_cost::for_each_row;
use crate::grid::Grid;

/// Places of the second frame that regions share before one is said to hide the other.
const MEETING: usize = 10;

/// Which regions are seen at each place of the second frame, a bit for each.
pub(in crate::layered) struct Occlusion(Grid<u8>);

impl Occlusion {
    /// Where the pixels of all regions but the background go.
    pub fn of<'a>(
        scale: &Scale,
        level: usize,
        states: impl Iterator<Item = &'a State>,
        labels: &Grid<u8>,
    ) -> Self {
        let mut seen = Grid::new(scale.width, scale.height, 0u8);
        let (width, height) = (scale.width as f32, scale.height as f32);
        for (k, state) in states.enumerate().skip(1) {
            for_each_target(scale, level, state, |x, y, to_x, to_y| {
                if usize::from(labels[(x, y)]) != k {
                    return;
                }
                // All four pixels around: what spreads leaves no gaps.
                let (left, top) = (to_x.floor(), to_y.floor());
                for (px, py) in [
                    (left, top),
                    (left + 1.0, top),
                    (left, top + 1.0),
                    (left + 1.0, top + 1.0),
                ] {
                    if px >= 0.0 && py >= 0.0 && px < width && py < height {
                        seen[(px as usize, py as usize)] |= 1 << k;
                    }
                }
            });
        }
        Self(seen)
    }

    /// The regions in front that are seen at a place of the second frame.
    pub fn at(&self, x: f32, y: f32) -> u8 {
        let (x, y) = (x.round(), y.round());
        let (width, height) = (self.0.width() as f32, self.0.height() as f32);
        if x >= 0.0 && y >= 0.0 && x < width && y < height {
            self.0[(x as usize, y as usize)]
        } else {
            0
        }
    }

    /// Charges hidden pixels of the background at most what chance would; which regions hide some of it.
    pub fn excuse(
        &self,
        scale: &Scale,
        level: usize,
        background: &State,
        chance: &Grid<f32>,
        costs: &mut Grid<f32>,
    ) -> [bool; 8] {
        let mut hidden = [0; 8];
        for_each_target(scale, level, background, |x, y, to_x, to_y| {
            let seen = self.at(to_x, to_y);
            if seen == 0 {
                return;
            }
            let (cost, chance) = (&mut costs[(x, y)], chance[(x, y)]);
            if *cost > chance {
                *cost = chance;
                for (k, hidden) in hidden.iter_mut().enumerate() {
                    *hidden += usize::from(seen >> k & 1);
                }
            }
        });
        hidden.map(|count| count >= MEETING)
    }
}

/// Calls with every pixel that a surface reaches and the place that it goes to.
fn for_each_target(
    scale: &Scale,
    level: usize,
    state: &State,
    mut each: impl FnMut(usize, usize, f32, f32),
) {
    let view = state.view(&scale.camera);
    for_each_row(scale, level, &state.surface, |y, columns, rho| {
        for (x, rho) in columns.zip(rho) {
            let [to_x, to_y] = view.target(x, y, *rho);
            each(x, y, to_x, to_y);
        }
    });
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::camera::Camera;
    use crate::frames::{Frame, FramePair};
    use crate::layered::estimate::Surface;
    use crate::layered::scale::pyramid;
    use crate::options::Options;
    use crate::window::Window;

    /// A square of columns 20–40 and rows 15–30 that goes five pixels to the right over what is still.
    fn made() -> (Scale, [State; 2], Grid<u8>) {
        let frame = |at: usize| {
            let inside =
                |x: usize, y: usize| (20 + at..40 + at).contains(&x) && (15..30).contains(&y);
            let value = |x: usize, y: usize| {
                let (px, py) = if inside(x, y) {
                    (x + 300 - at, y + 90)
                } else {
                    (x, y)
                };
                120.0 + 50.0 * (0.4 * px as f32).sin() * (0.3 * py as f32 + 0.02 * px as f32).cos()
            };
            Frame::from_grey(Grid::from_fn(64, 48, value)).unwrap()
        };
        let pair = FramePair::new(frame(0), frame(5)).unwrap();
        let camera = Camera::centred(64.0, 64, 48).unwrap();
        let plain = Options {
            smoothing: 0.0,
            lighting: false,
            ..Options::default()
        };
        let scale = pyramid(&pair, camera, &plain).swap_remove(0);
        let still = State::still(Surface::flat(8, &Window::whole(64, 48)));
        let moving = State {
            translation: DVec3::new(5.0 / 64.0, 0.0, 0.0),
            ..still.clone()
        };
        let labels = Grid::from_fn(64, 48, |x, y| {
            u8::from((20..40).contains(&x) && (15..30).contains(&y))
        });
        (scale, [still, moving], labels)
    }

    #[test]
    fn what_a_square_goes_over_is_hidden_and_what_it_leaves_is_not() {
        let (scale, [still, moving], labels) = made();
        let occlusion = Occlusion::of(&scale, 0, [&still, &moving].into_iter(), &labels);
        for y in 16..29 {
            for x in 40..44 {
                assert_eq!(occlusion.at(x as f32, y as f32), 2, "({x}, {y})");
            }
            for x in (0..24).chain(47..64) {
                assert_eq!(occlusion.at(x as f32, y as f32), 0, "({x}, {y})");
            }
        }
        assert_eq!(occlusion.at(-3.0, 20.0), 0);
        assert_eq!(occlusion.at(1e9, f32::NAN), 0);
    }

    #[test]
    fn hidden_pixels_are_charged_chance_at_most() {
        let (scale, [still, moving], labels) = made();
        let occlusion = Occlusion::of(&scale, 0, [&still, &moving].into_iter(), &labels);
        let chance = Grid::new(64, 48, 3.0);
        let mut costs = Grid::from_fn(64, 48, |_, y| if y == 20 { 1.0 } else { 9.0 });
        let hides = occlusion.excuse(&scale, 0, &still, &chance, &mut costs);
        assert_eq!(hides[..2], [false, true]);
        assert_eq!(costs[(42, 18)], 3.0);
        // What fits better than chance keeps its cost, and so does what is seen.
        assert_eq!(costs[(42, 20)], 1.0);
        assert_eq!(costs[(50, 18)], 9.0);
        assert_eq!(costs[(10, 18)], 9.0);
    }
}
