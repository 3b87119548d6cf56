//! The focal length in pixels that a photo's EXIF data tell.
//!
//! ```text
//! f = F₃₅ / 36 mm · side                       F₃₅ the equivalent on 35 mm film, whose frame is 36 mm wide
//! f = F · R · side / side₀                     F the focal length in mm, R pixels of the sensor per mm
//! ```
//!
//! side is the longer side of the frame, side₀ that of the photo when it was taken: a photo that was made smaller since has
//! a smaller f. A photo that was cropped since has not, and its data do not say so.

use exif::{Exif, In, Reader, Tag, Value};
use serde::Serialize;

/// Width of a frame of 35 mm film, mm.
const FILM: f64 = 36.0;
/// Focal lengths that lenses have, in shares of the longer side.
const PLAUSIBLE: std::ops::RangeInclusive<f64> = 0.1..=100.0;
/// TIFF files of more bytes are not searched.
#[cfg(feature = "decoders")]
const MOST_TIFF: usize = 64_000_000;

/// What a photo says of its lens.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct Lens {
    /// f in pixels of the frame.
    pub focal: f64,
    /// Where it comes from.
    pub source: LensSource,
    /// The focal length that is written there, mm.
    pub millimetres: f64,
}

/// Which of a photo's data tell f.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
#[serde(rename_all = "lowercase")]
pub enum LensSource {
    /// The equivalent on 35 mm film.
    Film,
    /// The focal length and the sensor's resolution.
    Sensor,
}

impl std::fmt::Display for Lens {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mm = self.millimetres;
        match self.source {
            LensSource::Film => write!(f, "EXIF: {mm} mm on 35 mm film"),
            LensSource::Sensor => write!(f, "EXIF: {mm} mm and the sensor's resolution"),
        }
    }
}

impl Lens {
    /// Of an EXIF block and the size of the frame.
    pub(super) fn of_exif(block: &[u8], width: usize, height: usize) -> Option<Self> {
        let data = Reader::new().read_raw(block.to_vec()).ok()?;
        let side = width.max(height) as f64;
        let found = of_film(&data, side).or_else(|| of_sensor(&data, side));
        found.filter(|lens| PLAUSIBLE.contains(&(lens.focal / side)))
    }

    /// Of a TIFF file, which is an EXIF block itself.
    #[cfg(feature = "decoders")]
    pub(super) fn of_tiff(bytes: &[u8], width: usize, height: usize) -> Option<Self> {
        let small = bytes.len() <= MOST_TIFF;
        small.then(|| Self::of_exif(bytes, width, height))?
    }

    /// The same lens on the frame shrunk `n` times.
    pub(super) fn shrunk(self, n: usize) -> Self {
        Self {
            focal: self.focal / n as f64,
            ..self
        }
    }
}

fn of_film(data: &Exif, side: f64) -> Option<Lens> {
    let millimetres = number(data, Tag::FocalLengthIn35mmFilm)?;
    Some(Lens {
        focal: millimetres / FILM * side,
        source: LensSource::Film,
        millimetres,
    })
}

fn of_sensor(data: &Exif, side: f64) -> Option<Lens> {
    let millimetres = number(data, Tag::FocalLength)?;
    let resolution = number(data, Tag::FocalPlaneXResolution)?;
    let unit = match number(data, Tag::FocalPlaneResolutionUnit).unwrap_or(2.0) as u32 {
        2 => 25.4,
        3 => 10.0,
        4 => 1.0,
        _ => return None,
    };
    let sides = [Tag::PixelXDimension, Tag::PixelYDimension];
    let taken = sides
        .into_iter()
        .filter_map(|tag| number(data, tag))
        .fold(0.0, f64::max);
    let shrunk = if taken > 0.0 { side / taken } else { 1.0 };
    Some(Lens {
        focal: millimetres * resolution / unit * shrunk,
        source: LensSource::Sensor,
        millimetres,
    })
}

/// A number above 0.
fn number(data: &Exif, tag: Tag) -> Option<f64> {
    let value = match &data.get_field(tag, In::PRIMARY)?.value {
        Value::Rational(all) => all.first()?.to_f64(),
        other => f64::from(other.get_uint(0)?),
    };
    (value.is_finite() && value > 0.0).then_some(value)
}

/// What makes a picture with these EXIF data stand upright, 1–8 as EXIF counts.
pub(super) fn orientation(block: &[u8]) -> u8 {
    let data = Reader::new().read_raw(block.to_vec()).ok();
    let found = data.and_then(|data| {
        data.get_field(Tag::Orientation, In::PRIMARY)?
            .value
            .get_uint(0)
    });
    found.and_then(|n| u8::try_from(n).ok()).unwrap_or(1)
}
