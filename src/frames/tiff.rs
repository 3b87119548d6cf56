//! TIFF: every picture in the file, as the samples that frames are made of.
//!
//! Grey of 1 to 16 bits, palettes, RGB, CMYK, YCbCr and JPEG inside, chunky or in planes; floating point counts from 0 to 1.
//! The decoder refuses palettes, so they are given to it as grey: its samples are then the numbers of their colours.

use std::borrow::Cow;
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

use super::samples::{Raw, Samples, UPRIGHT};
use super::unpack::unreadable;
use crate::error::Error;
use crate::file::png::MOST_BYTES;

/// Whether the bytes begin as a TIFF file does, of 32 or of 64 bits.
pub(super) fn is_tiff(bytes: &[u8]) -> bool {
    [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"]
        .iter()
        .any(|start| bytes.starts_with(*start))
}

/// The pictures of a TIFF file, one after the other.
pub(super) struct Pages<'a> {
    decoder: Decoder<Cursor<Cow<'a, [u8]>>>,
}

/// Why a picture cannot be read.
pub(super) enum Refused {
    /// It needs more memory than a picture may.
    TooLarge,
    /// In words.
    Because(String),
}

impl From<TiffError> for Refused {
    fn from(error: TiffError) -> Self {
        match error {
            TiffError::LimitsExceeded | TiffError::IntSizeError => Self::TooLarge,
            TiffError::UnsupportedError(_) => Self::Because(
                "it is a TIFF file that holds its picture in a way that is seldom used; save it as an ordinary one of 8 or 16 bits".to_owned(),
            ),
            _ => Self::Because("the file is damaged or cut short".to_owned()),
        }
    }
}

impl<'a> Pages<'a> {
    /// Opens a file at its first picture.
    pub fn open(bytes: &'a [u8]) -> Result<Self, Refused> {
        let mut limits = Limits::default();
        limits.decoding_buffer_size = MOST_BYTES;
        limits.intermediate_buffer_size = MOST_BYTES;
        let decoder = Decoder::new(Cursor::new(as_grey(bytes)))?.with_limits(limits);
        Ok(Self { decoder })
    }

    /// Width and height of the picture at hand.
    pub fn size(&mut self) -> Result<(u32, u32), Refused> {
        Ok(self.decoder.dimensions()?)
    }

    /// Whether there is another picture.
    pub fn more(&self) -> bool {
        self.decoder.more_images()
    }

    /// Goes to the next picture.
    pub fn next(&mut self) -> Result<(), Refused> {
        Ok(self.decoder.next_image()?)
    }

    /// The picture at hand.
    pub fn read(&mut self) -> Result<Raw, Refused> {
        let (width, height) = self.decoder.dimensions()?;
        let size = (width as usize, height as usize);
        let colour = self.decoder.colortype()?;
        let orientation = self.decoder.find_tag_unsigned::<u8>(Tag::Orientation)?;
        let table = self.decoder.find_tag_unsigned_vec::<u16>(Tag::ColorMap)?;
        let mut result = DecodingResult::U8(Vec::new());
        let layout = self.decoder.read_image_to_buffer(&mut result)?;
        let planes = layout.planes.max(1);
        let (channels, samples) = match (colour, result) {
            (ColorType::Gray(bits @ (1 | 2 | 4 | 8)), DecodingResult::U8(data))
                if table.is_some() =>
            {
                let table = table.unwrap_or_default();
                let count = table.len() / 3;
                let colour = |i: u8| {
                    let at = |c: usize| table.get(c * count + usize::from(i)).copied();
                    [0, 1, 2].map(|c| (at(c).unwrap_or(0) / 257) as u8)
                };
                let indices = unpacked(&data, size, 1, bits).into_iter();
                (3, Samples::Bytes(indices.flat_map(colour).collect()))
            }
            (ColorType::Gray(bits @ (1 | 2 | 4)), DecodingResult::U8(data)) => {
                let step = 255 / ((1u16 << bits) - 1) as u8;
                let mut all = unpacked(&data, size, 1, bits);
                all.iter_mut().for_each(|v| *v *= step);
                (1, Samples::Bytes(all))
            }
            (ColorType::YCbCr(8), DecodingResult::U8(mut data)) => {
                for p in data.chunks_exact_mut(3) {
                    p.copy_from_slice(&rgb_of_ycbcr([p[0], p[1], p[2]]));
                }
                (3, Samples::Bytes(data))
            }
            (ColorType::CMYK(8), DecodingResult::U8(data)) => {
                let ink = |a: u8, k: u8| ((255 - u16::from(a)) * (255 - u16::from(k)) / 255) as u8;
                let all = data
                    .chunks_exact(4)
                    .flat_map(|p| [0, 1, 2].map(|c| ink(p[c], p[3])));
                (3, Samples::Bytes(all.collect()))
            }
            (colour, DecodingResult::U8(data)) if colour.bit_depth() == 8 => {
                (channels(colour)?, Samples::Bytes(data))
            }
            (colour, DecodingResult::U16(data)) if colour.bit_depth() == 16 => {
                (channels(colour)?, Samples::Words(data))
            }
            (colour, DecodingResult::F32(data)) => (channels(colour)?, Samples::Floats(data)),
            _ => return Err(Refused::unusual()),
        };
        let samples = if planes > 1 {
            samples.interleaved(planes)
        } else {
            samples
        };
        let orientation = orientation.unwrap_or(UPRIGHT);
        Ok(Raw {
            size,
            channels,
            samples,
            orientation,
            lens: None,
        })
    }
}

impl Refused {
    /// For the file called `name`.
    pub fn error(self, name: &str) -> Error {
        match self {
            Self::TooLarge => Error::TooLarge {
                name: name.to_owned(),
            },
            Self::Because(reason) => unreadable(name, reason),
        }
    }

    fn unusual() -> Self {
        Self::Because(
            "its pixels are of a kind that is seldom used; save it as grey or RGB of 8 or 16 bits"
                .to_owned(),
        )
    }
}

fn channels(colour: ColorType) -> Result<usize, Refused> {
    match colour {
        ColorType::Gray(_) => Ok(1),
        ColorType::GrayA(_) => Ok(2),
        ColorType::RGB(_) => Ok(3),
        ColorType::RGBA(_) => Ok(4),
        _ => Err(Refused::unusual()),
    }
}

/// Samples of fewer than 8 bits, one a byte; each row begins with a byte of its own.
fn unpacked(data: &[u8], (width, height): (usize, usize), channels: usize, bits: u8) -> Vec<u8> {
    if bits == 8 {
        return data.to_vec();
    }
    let (bits, count) = (usize::from(bits), width * channels);
    let stride = (count * bits).div_ceil(8);
    let mask = (1u16 << bits) as u8 - 1;
    let mut out = Vec::with_capacity(count * height);
    for row in data.chunks(stride).take(height) {
        for i in 0..count {
            let at = i * bits;
            let byte = row.get(at / 8).copied().unwrap_or(0);
            out.push((byte >> (8 - bits - at % 8)) & mask);
        }
    }
    out
}

/// sRGB of YCbCr as JPEG has it (Rec. 601, full range).
fn rgb_of_ycbcr([y, cb, cr]: [u8; 3]) -> [u8; 3] {
    let (y, cb, cr) = (f32::from(y), f32::from(cb) - 128.0, f32::from(cr) - 128.0);
    [
        y + 1.402 * cr,
        y - 0.344_14 * cb - 0.714_14 * cr,
        y + 1.772 * cb,
    ]
    .map(|c| c.round().clamp(0.0, 255.0) as u8)
}

/// The file with *palette* turned into *grey* in every directory of an ordinary TIFF file (of 32 bits) that says so.
fn as_grey(bytes: &[u8]) -> Cow<'_, [u8]> {
    const PHOTOMETRIC: u16 = 262;
    let little = bytes.starts_with(b"II");
    let short = |at: usize| -> Option<u16> {
        let two = *bytes.get(at..)?.first_chunk()?;
        Some(if little {
            u16::from_le_bytes(two)
        } else {
            u16::from_be_bytes(two)
        })
    };
    let long = |at: usize| -> Option<usize> {
        let four = *bytes.get(at..)?.first_chunk()?;
        let value = if little {
            u32::from_le_bytes(four)
        } else {
            u32::from_be_bytes(four)
        };
        usize::try_from(value).ok()
    };
    let mut found = Cow::Borrowed(bytes);
    let mut next = long(4).filter(|_| short(2) == Some(42));
    // A chain that bites its own tail ends as well.
    for _ in 0..1000 {
        let Some((folder, count)) = next
            .filter(|&at| at > 0 && at < bytes.len())
            .and_then(|at| Some((at, short(at)?)))
        else {
            break;
        };
        let entries = (0..usize::from(count)).map(|i| folder + 2 + 12 * i);
        for entry in entries.filter(|&entry| short(entry) == Some(PHOTOMETRIC)) {
            if short(entry + 8) == Some(3) {
                found.to_mut()[entry + 8 + usize::from(!little)] = 1;
            }
        }
        next = long(folder + 2 + 12 * usize::from(count));
    }
    found
}
