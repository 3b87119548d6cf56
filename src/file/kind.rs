//! What a file of a result or of a truth is, by its first bytes: names of files lie, and frames are PNGs as well.
//!
//! A `.flo` begins with `PIEH`, a PFM with `Pf`, motion.json with a brace. A PNG of three 16-bit numbers is KITTI's flow if
//! the third is 0 or 1 everywhere; one of 8-bit grey is labels if no number is above 15, which as a frame would be black.
//! A PNG of 16-bit grey may as well be a frame: then its name decides.

use super::{kitti, png};

/// Greatest number in a picture that is taken for labels.
const MOST_LABEL: u8 = 15;
/// Where the header of a PNG has the bits of a sample and the kind of colour.
const BITS: usize = 24;
const COLOUR: usize = 25;

/// The name by which [`Parts::read`](super::parts::Parts::read) takes a file; `None` where it is something else. Of a file
/// that is `said` to be of a result or a truth only the format is asked.
pub fn kind_of(name: &str, bytes: &[u8], said: bool) -> Option<&'static str> {
    let name = name.to_ascii_lowercase();
    let inverse = name.contains("disp");
    if bytes.starts_with(b"PIEH") {
        return Some("flow.flo");
    }
    if bytes.starts_with(b"Pf") || bytes.starts_with(b"PF") {
        let pfm = bytes.get(2).is_some_and(u8::is_ascii_whitespace);
        return pfm.then_some(if inverse {
            "disparity.pfm"
        } else {
            "depth.pfm"
        });
    }
    if bytes.trim_ascii_start().starts_with(b"{") {
        return Some("motion.json");
    }
    if !bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        return None;
    }
    match (bytes.get(BITS)?, bytes.get(COLOUR)?) {
        (16, 2) => (said || kitti::is_flow(bytes)).then_some("flow.png"),
        (16, 0) if inverse => Some("disparity.png"),
        (16, 0) => (said || name.contains("depth")).then_some("depth.png"),
        (8, 0) if name.ends_with("occlusion.png") => Some("occlusion.png"),
        (8, 0) => (said || are_labels(bytes)).then_some("labels.png"),
        _ => None,
    }
}

fn are_labels(bytes: &[u8]) -> bool {
    let labels = png::read_labels(bytes, "");
    labels.is_ok_and(|labels| labels.data().iter().all(|&k| k <= MOST_LABEL))
}
