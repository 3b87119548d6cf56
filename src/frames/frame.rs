//! One frame, and the pair of frames that everything starts from.
//!
//! Brightness is the luma of the frame as encoded (Rec. 709 weights on sRGB values), in grey levels
//! 0–255 with 16-bit input keeping its fraction. It is not linearised: encoded values have noise of
//! nearly equal size at all brightnesses, which is what least squares assumes.
//!
//! A frame holds 3 bytes a pixel of colour and 4 of brightness, the latter of [`MOST_WORKED`] pixels at most:
//! 84 MB at 12 megapixels, 350 MB at 100. Copies share them.

use std::sync::Arc;

use super::absent::{absent, continued};
use super::lens::Lens;
use super::levels::Levels;
use super::note::Note;
use super::shrink::{shrunk, shrunk_colours, shrunk_mask};
use crate::error::Error;
use crate::grid::Grid;

/// Shortest side of a frame, in pixels.
pub const MIN_SIDE: usize = 16;
/// Longest side of a frame, in pixels.
pub const MAX_SIDE: usize = 30_000;
/// Most pixels of a frame.
pub const MAX_PIXELS: usize = 100_000_000;
/// Most pixels that are worked on: the solver holds 250 bytes for each with four regions, and WebAssembly has 4 GiB.
pub const MOST_WORKED: usize = 16_000_000;

/// A picture, for the solver and for the eye.
///
/// ```
/// use relievo::file::png;
/// use relievo::{Frame, Grid};
///
/// let orange = png::write_rgb(&Grid::new(32, 24, [255, 128, 0]))?;
/// let frame = Frame::decode(&orange, "orange.png")?;
/// assert_eq!((frame.width(), frame.height()), (32, 24));
/// assert!((frame.grey[(5, 5)] - 145.8).abs() < 0.1); // 0.2126 R + 0.7152 G + 0.0722 B
///
/// let error = Frame::decode(b"no picture", "notes.txt").unwrap_err();
/// assert!(error.to_string().starts_with("notes.txt cannot be read as an image"));
/// # Ok::<(), relievo::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Brightness in grey levels, 0–255, not rounded: of the frame's size, or where that has more than
    /// [`MOST_WORKED`] pixels, shrunk by the least whole number that leaves no more.
    pub grey: Arc<Grid<f32>>,
    /// Colours to show, sRGB, opaque.
    pub rgb: Arc<Grid<[u8; 3]>>,
    /// 1 where the file says that there is no picture (alpha 0), 0 elsewhere; `None` where there is one everywhere.
    pub unknown: Option<Arc<Grid<u8>>>,
    /// What its file says of the lens.
    pub lens: Option<Lens>,
    /// Colours of 16 bits, where the file has them and most of their range is empty.
    pub(super) deep: Option<Arc<Grid<[u16; 3]>>>,
    /// Grey levels in a step of the file's numbers; 0 where brightness was computed.
    pub(super) step: f32,
}

/// Writes row `y`: colours, and whether there is a picture.
type Fill<'a> = &'a mut dyn FnMut(usize, &mut [[f32; 3]], &mut [bool]);

impl Frame {
    /// A frame of 8-bit sRGB values with alpha, four bytes a pixel in row order. Transparent parts are shown on mid
    /// grey, and are unknown where alpha is 0.
    ///
    /// # Errors
    /// [`Error::Size`] and [`Error::Pixels`] outside the limits, [`Error::Length`] unless there are
    /// `4 · width · height` bytes.
    pub fn from_rgba8(width: usize, height: usize, bytes: &[u8]) -> Result<Self, Error> {
        check_size("the frame", width, height)?;
        if bytes.len() != 4 * width * height {
            return Err(Error::Length {
                what: "an RGBA frame",
                width,
                height,
                expected: 4 * width * height,
                found: bytes.len(),
            });
        }
        let row = |y: usize| &bytes[4 * width * y..4 * width * (y + 1)];
        Ok(Self::from_rows(width, height, &mut |y, out, known| {
            for ((out, known), p) in out.iter_mut().zip(known).zip(row(y).chunks_exact(4)) {
                *out = over_grey([p[0], p[1], p[2], p[3]].map(f32::from));
                *known = p[3] > 0;
            }
        }))
    }

    /// A frame of brightness alone, in grey levels 0–255.
    ///
    /// # Errors
    /// [`Error::Size`] and [`Error::Pixels`] outside the limits.
    pub fn from_grey(grey: Grid<f32>) -> Result<Self, Error> {
        check_size("the frame", grey.width(), grey.height())?;
        let rgb = Arc::new(grey.map(|g| [g.round().clamp(0.0, 255.0) as u8; 3]));
        let n = least_factor(grey.len());
        Ok(Self {
            grey: Arc::new(if n > 1 { shrunk(&grey, n) } else { grey }),
            rgb,
            unknown: None,
            lens: None,
            deep: None,
            step: 0.0,
        })
    }

    /// A frame of sRGB colours 0–255 that need not be whole numbers; sizes must agree.
    #[cfg(feature = "scenes")]
    pub(crate) fn from_colours(width: usize, height: usize, colours: &[[f32; 3]]) -> Self {
        Self::from_rows(width, height, &mut |y, out, _| {
            out.copy_from_slice(&colours[y * width..(y + 1) * width]);
        })
    }

    /// A frame whose rows `fill(y, colours, known)` writes: sRGB 0–255, not rounded, and whether there is a picture.
    pub(super) fn from_rows(width: usize, height: usize, fill: Fill) -> Self {
        let n = least_factor(width * height);
        let mut rgb = Grid::new(width, height, [0u8; 3]);
        let mut grey = Grid::new(width / n, height / n, 0.0f32);
        let mut unknown: Option<Grid<u8>> = None;
        let mut row = vec![[0.0f32; 3]; width];
        let mut known = vec![true; width];
        let share = 1.0 / (n * n) as f32;
        for y in 0..height {
            fill(y, &mut row, &mut known);
            for (to, c) in rgb.row_mut(y).iter_mut().zip(&row) {
                *to = c.map(|c| c.round().clamp(0.0, 255.0) as u8);
            }
            if y / n < grey.height() {
                let sums = grey.row_mut(y / n).iter_mut();
                if n == 1 {
                    for (sum, &c) in sums.zip(&row) {
                        *sum = luma(c);
                    }
                } else {
                    for (sum, few) in sums.zip(row.chunks_exact(n)) {
                        *sum += share * few.iter().map(|&c| luma(c)).sum::<f32>();
                    }
                }
            }
            if known.contains(&false) {
                let mask = unknown.get_or_insert_with(|| Grid::new(width, height, 0));
                for (m, &known) in mask.row_mut(y).iter_mut().zip(&known) {
                    *m = u8::from(!known);
                }
            }
        }
        Self {
            grey: Arc::new(grey),
            rgb: Arc::new(rgb),
            unknown: unknown.map(Arc::new),
            lens: None,
            deep: None,
            step: 1.0,
        }
    }

    /// The frame with its levels stretched where it uses few, as it is shown by itself.
    pub fn stretched(&self) -> Self {
        let levels = Levels::of(&[self]);
        if levels.narrow() {
            levels.stretch(self)
        } else {
            self.clone()
        }
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.rgb.width()
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.rgb.height()
    }

    /// How many times its brightness is shrunk already.
    pub fn grey_factor(&self) -> usize {
        least_factor(self.rgb.len())
    }

    /// Its brightness shrunk `n` times, a multiple of [`Frame::grey_factor`].
    pub(crate) fn grey_shrunk(&self, n: usize) -> Grid<f32> {
        match n / self.grey_factor() {
            0 | 1 => (*self.grey).clone(),
            rest => shrunk(&self.grey, rest),
        }
    }

    /// The frame shrunk `n` times, a multiple of [`Frame::grey_factor`]; its brightness is never shrunk.
    pub fn shrunk(&self, n: usize) -> Self {
        if n == 1 {
            return self.clone();
        }
        Self {
            grey: Arc::new(self.grey_shrunk(n)),
            rgb: Arc::new(shrunk_colours(&self.rgb, n)),
            unknown: (self.unknown.as_ref()).map(|mask| Arc::new(shrunk_mask(mask, n))),
            lens: self.lens.map(|lens| lens.shrunk(n)),
            deep: None,
            step: self.step,
        }
    }
}

/// Two moments of one film, of the same size and with something to see in them.
///
/// ```
/// use relievo::{Error, Frame, FramePair, Grid};
///
/// let waves = |by: f32| Grid::from_fn(32, 24, |x, y| 128.0 + 50.0 * (0.4 * (x as f32 - by) + 0.3 * y as f32).sin());
/// let [first, second] = [0.0, 0.5].map(|by| Frame::from_grey(waves(by)).unwrap());
/// let pair = FramePair::new(first.clone(), second)?;
/// assert_eq!(pair.width(), 32);
///
/// assert_eq!(FramePair::new(first.clone(), first), Err(Error::FramesIdentical));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FramePair {
    first: Frame,
    second: Frame,
    /// The second as it was given.
    unstretched: Frame,
    /// 1 where brightness shows nothing of the scene.
    absent: Option<Arc<Grid<u8>>>,
    notes: Vec<Note>,
}

impl FramePair {
    /// Pairs two frames. Where they use few levels of brightness, both are stretched alike. Where they show nothing of the
    /// scene, black bars or a logo, brightness is continued from around.
    ///
    /// # Errors
    /// [`Error::FramesDiffer`] in size, [`Error::FrameConstant`] when one has no contrast,
    /// [`Error::FramesIdentical`] when no pixel changes.
    pub fn new(mut first: Frame, mut second: Frame) -> Result<Self, Error> {
        if !first.rgb.same_size(&second.rgb) {
            return Err(Error::FramesDiffer {
                first: (first.width(), first.height()),
                second: (second.width(), second.height()),
            });
        }
        for (frame, which) in [(&first, "the first"), (&second, "the second")] {
            let data = frame.grey.data();
            if data.iter().all(|&g| g == data[0]) {
                return Err(Error::FrameConstant { which });
            }
        }
        if first.grey == second.grey {
            return Err(Error::FramesIdentical);
        }
        let mut notes = Vec::new();
        if first.interlaced() {
            notes.push(Note::Interlaced);
        }
        let levels = Levels::of(&[&first, &second]);
        let unstretched = second.clone();
        if levels.narrow() {
            notes.push(levels.note(first.step.max(second.step)));
            (first, second) = (levels.stretch(&first), levels.stretch(&second));
        }
        let absent = absent(&first, &second);
        if let Some(mask) = &absent {
            let marked = mask.data().iter().filter(|m| **m != 0).count();
            notes.push(Note::Absent {
                share: marked as f64 / mask.len() as f64,
            });
            for frame in [&mut first, &mut second] {
                frame.grey = Arc::new(continued(&frame.grey, mask));
            }
        }
        Ok(Self {
            first,
            second,
            unstretched,
            absent: absent.map(Arc::new),
            notes,
        })
    }

    /// The pair of the second frame and the one that follows it.
    ///
    /// # Errors
    /// Those of [`FramePair::new`].
    pub fn following(&self, next: Frame) -> Result<Self, Error> {
        Self::new(self.unstretched.clone(), next)
    }

    /// What a user should know of the two.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// The frame whose labels, depth and motion are sought.
    pub fn first(&self) -> &Frame {
        &self.first
    }

    /// The frame that follows.
    pub fn second(&self) -> &Frame {
        &self.second
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.first.width()
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.first.height()
    }

    /// Where brightness shows nothing of the scene: 1 at pixels that are transparent, black bars, or a logo that stands
    /// still over a moving picture, of the size of the frames' brightness; `None` where there are none.
    pub fn absent(&self) -> Option<&Grid<u8>> {
        self.absent.as_deref()
    }

    /// Both frames shrunk `n` times, as [`Frame::shrunk`] does it.
    pub fn shrunk(&self, n: usize) -> Self {
        let (first, second) = (self.first.shrunk(n), self.second.shrunk(n));
        let (width, height) = (first.grey.width(), first.grey.height());
        let smaller = |mask: &Arc<Grid<u8>>| {
            let place =
                |at: usize, from: usize, to: usize| ((2 * at + 1) * from / (2 * to)).min(from - 1);
            Arc::new(Grid::from_fn(width, height, |x, y| {
                mask[(
                    place(x, mask.width(), width),
                    place(y, mask.height(), height),
                )]
            }))
        };
        Self {
            absent: self.absent.as_ref().map(smaller),
            first,
            unstretched: second.clone(),
            second,
            notes: self.notes.clone(),
        }
    }
}

/// The least whole number by which so many pixels are shrunk to [`MOST_WORKED`].
pub(crate) fn least_factor(pixels: usize) -> usize {
    (1..).find(|n| pixels / (n * n) <= MOST_WORKED).unwrap_or(1)
}

pub(crate) fn check_size(name: &str, width: usize, height: usize) -> Result<(), Error> {
    let allowed = MIN_SIDE..=MAX_SIDE;
    let name = || name.to_owned();
    if !(allowed.contains(&width) && allowed.contains(&height)) {
        return Err(Error::Size {
            name: name(),
            width,
            height,
        });
    }
    if width * height > MAX_PIXELS {
        return Err(Error::Pixels {
            name: name(),
            width,
            height,
        });
    }
    Ok(())
}

pub(super) fn luma(rgb: [f32; 3]) -> f32 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

pub(super) fn over_grey(rgba: [f32; 4]) -> [f32; 3] {
    let a = rgba[3] / 255.0;
    [rgba[0], rgba[1], rgba[2]].map(|c| c * a + 128.0 * (1.0 - a))
}
