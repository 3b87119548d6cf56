//! PFM, a picture of floats, as used for depth: a line `Pf`, a line with width and height, a line with
//! a scale whose sign tells the byte order (below 0: little-endian), then 32-bit floats in rows from
//! the *bottom* row up. The size of the scale is a unit that readers leave alone, as here.

use super::{bounded, unreadable};
use crate::error::Error;
use crate::grid::Grid;

const FORMAT: &str = "PFM";
/// No header with sides that we accept is longer; bounds the search for its end in garbage.
const LONGEST_HEADER: usize = 256;

/// The bytes of a grey little-endian PFM file.
pub fn write(values: &Grid<f32>) -> Vec<u8> {
    let mut bytes = format!("Pf\n{} {}\n-1.0\n", values.width(), values.height()).into_bytes();
    for y in (0..values.height()).rev() {
        bytes.extend(values.row(y).iter().flat_map(|z| z.to_le_bytes()));
    }
    bytes
}

/// Reads a grey PFM file of either byte order. `name` is what error messages call it.
///
/// # Errors
/// [`Error::File`] for anything else, colour PFM included, and for sides above the largest frame's.
pub fn read(bytes: &[u8], name: &str) -> Result<Grid<f32>, Error> {
    let wrong = |reason: String| unreadable(name, FORMAT, reason);
    let mut at = 0;
    let mut word = || {
        let end = bytes.len().min(LONGEST_HEADER);
        while at < end && bytes[at].is_ascii_whitespace() {
            at += 1;
        }
        let from = at.min(end);
        at = from;
        while at < end && !bytes[at].is_ascii_whitespace() {
            at += 1;
        }
        let text = String::from_utf8_lossy(&bytes[from..at]).into_owned();
        // One white space ends a word; what follows the last is data already.
        at += 1;
        (text, at)
    };
    match word().0.as_str() {
        "Pf" => {}
        "PF" => {
            return Err(wrong(
                "it is in colour; one value a pixel is needed".to_owned(),
            ));
        }
        _ => return Err(wrong("it does not begin with Pf".to_owned())),
    }
    let mut side = || {
        let (text, _) = word();
        let number = text.parse::<i64>();
        number.map_err(|_| wrong(format!("{text:?} is no width or height")))
    };
    let (width, height) = (side()?, side()?);
    let (width, height) = bounded(name, FORMAT, width, height)?;
    let (scale, data_at) = word();
    let little = little_endian(&scale).ok_or_else(|| wrong(format!("{scale:?} is no scale")))?;
    let data = bytes.get(data_at..).unwrap_or_default();
    let expected = 4 * width * height;
    if data.len() != expected {
        return Err(wrong(format!(
            "{width}×{height} pixels need {expected} bytes after the header, but there are {}",
            data.len()
        )));
    }
    let value = |x: usize, y: usize| {
        let at = 4 * ((height - 1 - y) * width + x);
        let b = [data[at], data[at + 1], data[at + 2], data[at + 3]];
        if little {
            f32::from_le_bytes(b)
        } else {
            f32::from_be_bytes(b)
        }
    };
    Ok(Grid::from_fn(width, height, value))
}

/// Whether the lowest byte comes first, by the sign of a decimal number; `None` of a word that is none, or of 0.
fn little_endian(scale: &str) -> Option<bool> {
    let size = scale.strip_prefix(['-', '+']).unwrap_or(scale);
    let (number, exponent) = size.split_once(['e', 'E']).unwrap_or((size, "0"));
    exponent.parse::<i32>().ok()?;
    let (whole, part) = number.split_once('.').unwrap_or((number, ""));
    let digits = || whole.bytes().chain(part.bytes());
    let known = digits().all(|d| d.is_ascii_digit()) && digits().any(|d| d != b'0');
    known.then(|| scale.starts_with('-'))
}

#[cfg(test)]
mod tests {
    use super::little_endian;

    #[test]
    fn the_sign_of_the_scale_tells_the_order_of_bytes() {
        for scale in ["-1", "-1.0", "-0.003922", "-.5", "-2.", "-1e-3", "-1.5E+2"] {
            assert_eq!(little_endian(scale), Some(true), "{scale}");
            assert_eq!(little_endian(&scale[1..]), Some(false), "{scale}");
        }
        for scale in [
            "", "-", ".", "0", "-0.0", "1e", "1e1.5", "--1", "1.2.3", "one", "nan", "inf",
        ] {
            assert_eq!(little_endian(scale), None, "{scale}");
        }
    }
}
