//! Where a JPEG ends, what lies behind it, and what its segments say.
//!
//! A JPEG is a list of segments, `FF marker length …`, with coded data after those that start a scan, from its start of image
//! (FF D8) to its end of image (FF D9).

/// The start of image.
const START: [u8; 2] = [0xff, 0xd8];

pub(super) fn is_jpeg(bytes: &[u8]) -> bool {
    bytes.starts_with(&START)
}

/// Whether the bytes are a JPEG without an end. The decoder would fill what is missing with grey and say
/// nothing, and a solver would take the grey for a scene.
pub(super) fn breaks_off(bytes: &[u8]) -> bool {
    (bytes.strip_prefix(&START)).is_some_and(|rest| end(rest).is_none())
}

/// What a gain map says of itself, in the older and the newer way.
const GAIN_MAPS: [&[u8]; 2] = [b"hdrgm:", b"urn:iso:std:iso:ts:21496"];

/// The views that a file holds: its first JPEG, and those behind it that have the same size and are no gain map of a
/// photo with a high dynamic range. At most some zeros lie between two.
pub(crate) fn views(bytes: &[u8]) -> Vec<&[u8]> {
    let mut found = Vec::new();
    let mut next = Some(bytes);
    while let Some(from) = next {
        let behind = from.strip_prefix(&START).and_then(end);
        let one = &from[..from.len() - behind.map_or(0, <[u8]>::len)];
        if found.is_empty() || (size(one) == size(found[0]) && !is_gain_map(one)) {
            found.push(one);
        }
        next = behind.and_then(|rest| {
            let padding = rest.iter().position(|&b| b != 0)?;
            rest.get(padding..).filter(|rest| rest.starts_with(&START))
        });
    }
    found
}

/// Height and width as the frame header has them.
fn size(jpeg: &[u8]) -> Option<[u8; 4]> {
    let is_frame = |marker| matches!(marker, 0xc0..=0xcf) && !matches!(marker, 0xc4 | 0xc8 | 0xcc);
    let (_, header) = segments(jpeg).find(|(marker, _)| is_frame(*marker))?;
    header.get(1..)?.first_chunk().copied()
}

fn is_gain_map(jpeg: &[u8]) -> bool {
    let marked = |data: &[u8]| {
        let says = |mark: &&[u8]| data.windows(mark.len()).any(|part| part == *mark);
        GAIN_MAPS.iter().any(says)
    };
    segments(jpeg).any(|(marker, data)| matches!(marker, 0xe1 | 0xe2) && marked(data))
}

/// The segments before the coded data: marker and contents.
fn segments(jpeg: &[u8]) -> impl Iterator<Item = (u8, &[u8])> {
    let mut rest = jpeg.get(2..).unwrap_or_default();
    std::iter::from_fn(move || {
        let (&[0xff, marker, high, low], data) = rest.split_first_chunk()? else {
            return None;
        };
        let length = usize::from(u16::from_be_bytes([high, low])).checked_sub(2)?;
        let (contents, behind) = data.split_at_checked(length)?;
        rest = behind;
        (marker != 0xda).then_some((marker, contents))
    })
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
