//! PNG: pictures for people, labels with one byte a pixel (0 = background, k = k-th curve), and frames.

use png::{
    BitDepth, ColorType, Compression, Decoder, DecodingError, Filter, Limits, Transformations,
};
use std::io::Cursor;

use super::{bounded, unreadable};
use crate::error::Error;
use crate::grid::Grid;

/// With what such a file begins.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Bytes that a decoder may take for one picture: 16-bit RGB with alpha of the largest frame.
pub(crate) const MOST_BYTES: usize = 800_000_000;
const FORMAT: &str = "8-bit grey PNG";

/// The bytes of a picture with alpha, sRGB.
///
/// # Errors
/// [`Error::File`] for a picture without pixels.
pub fn write_rgba(picture: &Grid<[u8; 4]>) -> Result<Vec<u8>, Error> {
    encode(picture, picture.data().as_flattened(), ColorType::Rgba)
}

/// The bytes of an sRGB picture.
///
/// # Errors
/// [`Error::File`] for a picture without pixels.
pub fn write_rgb(picture: &Grid<[u8; 3]>) -> Result<Vec<u8>, Error> {
    encode(picture, picture.data().as_flattened(), ColorType::Rgb)
}

/// The bytes of labels, one grey byte a pixel.
///
/// # Errors
/// [`Error::File`] for labels without pixels.
pub fn write_labels(labels: &Grid<u8>) -> Result<Vec<u8>, Error> {
    encode(labels, labels.data(), ColorType::Grayscale)
}

/// The bytes of a grey picture of 16 bits a pixel.
///
/// # Errors
/// [`Error::File`] for a picture without pixels.
pub fn write_grey16(values: &Grid<u16>) -> Result<Vec<u8>, Error> {
    let bytes: Vec<u8> = (values.data().iter())
        .flat_map(|value| value.to_be_bytes())
        .collect();
    encode_as(
        size_of(values),
        &bytes,
        ColorType::Grayscale,
        BitDepth::Sixteen,
    )
}

/// Reads labels. `name` is what error messages call the file.
///
/// # Errors
/// [`Error::File`] unless it is a PNG of 8-bit grey, of sides up to the largest frame's.
pub fn read_labels(bytes: &[u8], name: &str) -> Result<Grid<u8>, Error> {
    let file = Unread::open(bytes).map_err(|e| wrong(name, FORMAT, e))?;
    let (width, height) = bounded(name, FORMAT, file.width.into(), file.height.into())?;
    let picture = file.read().map_err(|e| wrong(name, FORMAT, e))?;
    match picture.samples {
        Samples::Bytes(labels) if picture.channels == 1 => Grid::from_vec(width, height, labels),
        _ => Err(unreadable(
            name,
            FORMAT,
            format!("its pixels are {}, not one grey byte each", picture.kind()),
        )),
    }
}

/// Samples in row order, channel by channel within a pixel.
pub(crate) enum Samples {
    Bytes(Vec<u8>),
    Words(Vec<u16>),
}

/// An unpacked picture.
pub(crate) struct Pixels {
    /// 1 for grey, 2 for grey and alpha, 3 for RGB, 4 for RGB and alpha.
    pub channels: usize,
    pub samples: Samples,
}

/// A file whose beginning is read.
pub(crate) struct Unread<'a> {
    pub width: u32,
    pub height: u32,
    reader: png::Reader<Cursor<&'a [u8]>>,
}

/// Why a file is not read.
pub(crate) enum Refused {
    TooLarge,
    PaletteCutShort,
    Damaged(String),
}

impl From<DecodingError> for Refused {
    fn from(error: DecodingError) -> Self {
        match error {
            DecodingError::LimitsExceeded => Self::TooLarge,
            other => Self::Damaged(other.to_string()),
        }
    }
}

impl<'a> Unread<'a> {
    pub fn open(bytes: &'a [u8]) -> Result<Self, Refused> {
        // Palettes and fewer bits than eight become bytes, a transparent colour becomes alpha.
        let reader = reader(bytes, Transformations::EXPAND)?;
        let (width, height) = reader.info().size();
        Ok(Self {
            width,
            height,
            reader,
        })
    }

    /// Its EXIF data.
    pub fn exif(&self) -> Option<Vec<u8>> {
        (self.reader.info().exif_metadata.as_ref()).map(|block| block.to_vec())
    }

    pub fn read(mut self) -> Result<Pixels, Refused> {
        let size = self.reader.output_buffer_size();
        let size = size.filter(|size| *size <= MOST_BYTES);
        let mut bytes = vec![0; size.ok_or(Refused::TooLarge)?];
        self.reader.next_frame(&mut bytes)?;
        let (colour, depth) = self.reader.output_color_type();
        let samples = if depth == BitDepth::Sixteen {
            let pairs = bytes.as_chunks::<2>().0.iter();
            Samples::Words(pairs.map(|pair| u16::from_be_bytes(*pair)).collect())
        } else {
            Samples::Bytes(bytes)
        };
        Ok(Pixels {
            channels: colour.samples(),
            samples,
        })
    }
}

impl Pixels {
    fn kind(&self) -> String {
        let channels = match self.channels {
            1 => "grey",
            2 => "grey with alpha",
            3 => "RGB",
            _ => "RGB with alpha",
        };
        let bits = match self.samples {
            Samples::Bytes(_) => 8,
            Samples::Words(_) => 16,
        };
        format!("{bits}-bit {channels}")
    }
}

/// What a reader of results says of such a file.
pub(super) fn wrong(name: &str, format: &'static str, refused: Refused) -> Error {
    let reason = match refused {
        Refused::TooLarge => "it is too large".to_owned(),
        Refused::PaletteCutShort => "its palette is cut short".to_owned(),
        Refused::Damaged(reason) => reason,
    };
    unreadable(name, format, reason)
}

/// Whether the bytes are such a file.
pub(crate) fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(SIGNATURE)
}

/// A reader at the first picture's data, which keeps within [`MOST_BYTES`].
pub(crate) fn reader(
    bytes: &[u8],
    transformations: Transformations,
) -> Result<png::Reader<Cursor<&[u8]>>, Refused> {
    if palette_breaks_off(bytes) {
        return Err(Refused::PaletteCutShort);
    }
    let limits = Limits { bytes: MOST_BYTES };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_transformations(transformations);
    Ok(decoder.read_info()?)
}

/// Whether the bytes are a PNG whose palette ends within a colour. The decoder would panic.
pub(crate) fn palette_breaks_off(bytes: &[u8]) -> bool {
    let mut rest = bytes.strip_prefix(SIGNATURE).unwrap_or_default();
    // Chunks: the length of the data, four letters, the data, a checksum.
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let length = u32::from_be_bytes(*length) as usize;
        if after.starts_with(b"PLTE") && !length.is_multiple_of(3) {
            return true;
        }
        rest = after.get(length.saturating_add(8)..).unwrap_or_default();
    }
    false
}

fn encode<T: Copy>(grid: &Grid<T>, bytes: &[u8], colour: ColorType) -> Result<Vec<u8>, Error> {
    encode_as(size_of(grid), bytes, colour, BitDepth::Eight)
}

fn size_of<T: Copy>(grid: &Grid<T>) -> (u32, u32) {
    (grid.width() as u32, grid.height() as u32)
}

fn encode_as(
    (width, height): (u32, u32),
    bytes: &[u8],
    colour: ColorType,
    depth: BitDepth,
) -> Result<Vec<u8>, Error> {
    let wrong = |e: png::EncodingError| unreadable("the picture", "PNG", e.to_string());
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let mut writer = encoder.write_header().map_err(wrong)?;
    writer.write_image_data(bytes).map_err(wrong)?;
    drop(writer);
    Ok(out)
}
