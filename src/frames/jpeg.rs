//! Where a JPEG ends, and what lies behind it.
//!
//! A JPEG is a list of segments, `FF marker length …`, with coded data after those that start a scan, from its start of image
//! (FF D8) to its end of image (FF D9).

/// Whether the bytes are a JPEG without an end. The decoder would fill what is missing with grey and say
/// nothing, and a solver would take the grey for a scene.
pub(super) fn breaks_off(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0xff, 0xd8]) && end(&bytes[2..]).is_none()
}

/// The next JPEG in the bytes behind the end of the first; at most some zeros may lie between.
pub(super) fn behind(bytes: &[u8]) -> Option<&[u8]> {
    let rest = end(bytes.strip_prefix(&[0xff, 0xd8])?)?;
    let padding = rest.iter().position(|&b| b != 0)?;
    let next = &rest[padding..];
    next.starts_with(&[0xff, 0xd8]).then_some(next)
}

/// What lies behind the end of image, from behind the start of image on; `None` when there is no end.
fn end(mut rest: &[u8]) -> Option<&[u8]> {
    loop {
        let start = rest.windows(2).position(|pair| {
            // In coded data zero is stuffing and D0–D7 restart them; FF may be repeated anywhere.
            pair[0] == 0xff && !matches!(pair[1], 0x00 | 0xd0..=0xd7 | 0xff)
        })?;
        let marker = rest[start + 1];
        rest = &rest[start + 2..];
        match marker {
            0xd9 => return Some(rest),
            // The only other one without a length.
            0x01 => {}
            _ => {
                let length = u16::from_be_bytes(*rest.first_chunk()?);
                rest = rest.get(usize::from(length.max(2))..)?;
            }
        }
    }
}
