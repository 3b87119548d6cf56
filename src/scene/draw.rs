//! What decides a scene drawn at random.

/// A draw: what [`variant`](super::variant()), [`passing`](super::passing()) and [`mild`](super::mild()) render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw<'a> {
    /// "blocks" has two bodies, "carousel" three, "crowd" four.
    pub base: &'a str,
    /// Decides shapes, places, textures, lamp and motions.
    pub seed: u64,
    /// Standard deviation of the Gaussian noise in both frames, the same in all channels: 0–50 grey levels.
    pub noise_sigma: f32,
    /// The largest image motion, 0.1–16 pixels at a width of 320, larger in proportion in larger frames.
    pub displacement: f64,
    /// Columns and rows.
    pub size: [usize; 2],
}
