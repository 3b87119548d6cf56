//! Every way in which input can be wrong, as a sentence that says what, with sizes and limits, and
//! what to do about it.

use crate::camera::{FARTHEST_CENTRE, FOCAL_RANGE};
use crate::frames::{MAX_PIXELS, MAX_SIDE, MIN_SIDE};
use crate::options::MAX_CURVES;

const FORMATS: &str = if cfg!(feature = "decoders") {
    "PNG, JPEG, PNM, WebP, BMP, GIF and TIFF are"
} else {
    "PNG alone is"
};

/// What can be wrong with what a user gave.
///
/// ```
/// use relievo::{Camera, Error};
///
/// let error = Camera::centred(0.0, 320, 240).unwrap_err();
/// assert_eq!(error, Error::Focal(0.0));
/// assert_eq!(
///     error.to_string(),
///     "the focal length is 0 pixels; it must be a number from 1 to 1000000, such as the frame's width"
/// );
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// The bytes are no image, or one that is cut short.
    #[error("{name} cannot be read as an image ({reason}); {FORMATS} understood")]
    Decode {
        /// The file, as the user knows it.
        name: String,
        /// What the decoder found.
        reason: String,
    },
    /// A picture too small or too large to work on.
    #[error(
        "{name} is {width}×{height} pixels; both sides must lie between {MIN_SIDE} and {MAX_SIDE}: crop or resize it"
    )]
    Size {
        /// The picture, as the user knows it.
        name: String,
        /// Its width.
        width: usize,
        /// Its height.
        height: usize,
    },
    /// A picture of too many pixels.
    #[error(
        "{name} is {width}×{height} pixels; at most {most} megapixels can be worked on: crop or resize it",
        most = MAX_PIXELS / 1_000_000
    )]
    Pixels {
        /// The picture, as the user knows it.
        name: String,
        /// Its width.
        width: usize,
        /// Its height.
        height: usize,
    },
    /// A picture whose header claims more than this machine can address.
    #[error(
        "{name} claims to be larger than can be unpacked here; both sides must lie between {MIN_SIDE} and {MAX_SIDE} pixels: crop or resize it"
    )]
    TooLarge {
        /// The picture, as the user knows it.
        name: String,
    },
    /// Depth asked for where regions move as planes still.
    #[error(
        "there is no depth yet: regions are modelled as planes until their outlines stop moving; take steps of motion and curves, or whole passes, {most} at most"
    )]
    Planes {
        /// Passes before depth is looked for, at most.
        most: usize,
    },
    /// A flat array that does not fill the picture it is said to be.
    #[error("{what} of {width}×{height} pixels needs {expected} values, but {found} were given")]
    Length {
        /// What the array is.
        what: &'static str,
        /// Stated width.
        width: usize,
        /// Stated height.
        height: usize,
        /// Values needed.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// Two frames of different sizes.
    #[error(
        "the frames differ in size: the first is {}×{}, the second {}×{} pixels; give two frames of one film",
        .first.0, .first.1, .second.0, .second.1
    )]
    FramesDiffer {
        /// Width and height of the first frame.
        first: (usize, usize),
        /// Width and height of the second frame.
        second: (usize, usize),
    },
    /// A result and a truth of different sizes.
    #[error(
        "the result is {}×{}, the ground truth {}×{} pixels; both must be of the same frames",
        .found.0, .found.1, .truth.0, .truth.1
    )]
    TruthDiffers {
        /// Width and height of what was found.
        found: (usize, usize),
        /// Width and height of the truth.
        truth: (usize, usize),
    },
    /// A truth that is not of the frames that are open.
    #[error(
        "the ground truth is {}×{} pixels, the frames are {}×{}; give the ground truth of the first frame at its own size, or open the frames that it belongs to",
        .truth.0, .truth.1, .frames.0, .frames.1
    )]
    TruthSize {
        /// Width and height of the truth.
        truth: (usize, usize),
        /// Width and height of the frames.
        frames: (usize, usize),
    },
    /// A file that is no truth of any kind.
    #[error(
        "{name} is no ground truth that can be read: flow as .flo or KITTI's 16-bit PNG, labels as 8-bit grey PNG, depth as PFM or 16-bit grey PNG, or motion.json"
    )]
    NoTruth {
        /// The file.
        name: String,
    },
    /// Two files of the same kind.
    #[error("{one} and {other} both have the ground truth of {what}; give one of them")]
    TruthTwice {
        /// The one.
        one: String,
        /// The other.
        other: String,
        /// What both have.
        what: &'static str,
    },
    /// Files of one result that are of different sizes.
    #[error(
        "{name} is {}×{}, {than} {}×{} pixels; all files must be those of one result",
        .size.0, .size.1, .expected.0, .expected.1
    )]
    FilesDiffer {
        /// The file that differs.
        name: &'static str,
        /// Its width and height.
        size: (usize, usize),
        /// The file that it differs from.
        than: &'static str,
        /// Width and height of that.
        expected: (usize, usize),
    },
    /// Files none of which can be scored.
    #[error(
        "there is nothing to score: give a folder with labels.png, flow.flo, depth.pfm or motion.json, or one such file"
    )]
    NothingToScore,
    /// Two results that have nothing in common.
    #[error(
        "the two have nothing in common that could be compared; both must have labels, flow, depth or motions"
    )]
    NothingShared,
    /// Motions that are not those of the regions.
    #[error(
        "motion.json describes regions {described:?}, labels.png goes up to {last}; it must describe each from 0 to {last} once"
    )]
    Regions {
        /// The labels in motion.json.
        described: Vec<u8>,
        /// The greatest in labels.png.
        last: u8,
    },
    /// Twice the same frame.
    #[error(
        "the two frames are identical, so nothing moves; give two different moments of the film"
    )]
    FramesIdentical,
    /// A frame without any contrast.
    #[error(
        "{which} frame has the same grey everywhere, so no motion can be seen; give frames with texture"
    )]
    FrameConstant {
        /// "the first" or "the second".
        which: &'static str,
    },
    /// A focal length that no camera has.
    #[error(
        "the focal length is {0} pixels; it must be a number from {least} to {greatest}, such as the frame's width",
        least = FOCAL_RANGE[0], greatest = FOCAL_RANGE[1]
    )]
    Focal(f64),
    /// A principal point that is no point.
    #[error(
        "the principal point is ({0}, {1}); both coordinates must be numbers from -{FARTHEST_CENTRE} to {FARTHEST_CENTRE}, such as the middle of the frame"
    )]
    Centre(f64, f64),
    /// A number too many of curves.
    #[error("{0} curves are drawn, at most {MAX_CURVES} are possible; delete some")]
    TooManyCurves(usize),
    /// A curve that lies wholly outside the frame.
    #[error(
        "curve {curve} lies outside the {width}×{height} frame; move it onto the object it should find"
    )]
    CurveOutside {
        /// Which curve, from 1.
        curve: usize,
        /// Frame width.
        width: usize,
        /// Frame height.
        height: usize,
    },
    /// A curve around no pixel.
    #[error("curve {curve} encloses no pixel; draw it larger")]
    CurveEmpty {
        /// Which curve, from 1.
        curve: usize,
    },
    /// A curve with a coordinate that is no number.
    #[error("curve {curve} has a coordinate or radius that is not a finite number")]
    CurveNotFinite {
        /// Which curve, from 1.
        curve: usize,
    },
    /// A setting outside its range.
    #[error("{key} is {value}; it must be a number from {min} to {max}")]
    Option {
        /// The option's key.
        key: String,
        /// What was given.
        value: String,
        /// Least value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
    /// A setting that is counted, outside its range or between whole numbers.
    #[error("{key} is {value}; it must be a whole number from {min} to {max}")]
    Count {
        /// The option's key.
        key: String,
        /// What was given.
        value: String,
        /// Least value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
    /// A choice that is none of those offered.
    #[error("{value:?} is no {what}; choose one of {choices}")]
    Choice {
        /// What is chosen.
        what: String,
        /// What was given.
        value: String,
        /// What could be.
        choices: String,
    },
    /// A file of numbers (flow, depth, labels) that does not say what its format promises.
    #[error("{name} is not a readable {format} file: {reason}")]
    File {
        /// The file, as the user knows it.
        name: String,
        /// "Middlebury .flo", "PFM", …
        format: &'static str,
        /// What is wrong in it.
        reason: String,
    },
    /// Text that is not the JSON expected.
    #[error("the {what} cannot be read: {reason}")]
    Json {
        /// What it should describe.
        what: &'static str,
        /// What the parser found.
        reason: String,
    },
}

/// Whether `value`, called `key`, lies from `min` to `max`; not-a-number never does.
pub(crate) fn within(key: &str, value: f64, min: f64, max: f64) -> Result<(), Error> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(Error::Option {
        key: key.to_owned(),
        value: value.to_string(),
        min,
        max,
    })
}
