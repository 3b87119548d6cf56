//! Pictures of an interpretation, for the eye. Nothing here is read back by the solver.
//!
//! Every view is a function of the frame, the interpretation and [`ViewParams`]; [`draw`] finds it by
//! name. Pictures are opaque sRGB of the frame's size, or a whole multiple of it where
//! [`ViewParams::magnify`] or a pair side by side asks for it.

mod anaglyph;
mod arrangement;
mod arrows;
mod behind;
mod colour;
mod compare;
mod depth;
mod flow;
mod foreshortening;
mod layers;
mod leaps;
mod legend;
mod mask;
mod measured;
mod mesh;
mod palette;
mod params;
mod raster;
mod relief;
mod segmentation;
mod span;
mod steady;
mod stereo;
mod stroke;

pub use anaglyph::{GLASSES, Glasses, METHODS, anaglyph, dubois};
pub use arrows::arrows;
pub use colour::{decode, encode, luminance};
pub use compare::{aligned, same_colours};
pub use depth::depth;
pub use flow::{flow, wheel};
pub use legend::{Form, Hold, Legend, Mark, legend};
pub use mask::{confidence, occlusion};
pub use measured::{ERRORS, errors, residuals};
pub use mesh::{Mesh, mesh};
pub use palette::{LABEL_COLOURS, PALETTES, Palette};
pub use params::{Choice, ViewParams};
pub use relief::relief;
pub use segmentation::{labels, segmentation};
pub use stereo::{LAYOUTS, Rig, parallax, second_eye, stereo};

use serde::Serialize;

use crate::curves::Contour;
use crate::error::Error;
use crate::frames::Frame;
use crate::grid::Grid;
use crate::interpretation::Interpretation;

/// An opaque picture, sRGB with alpha 255.
pub type Picture = Grid<[u8; 4]>;

/// A view as people choose it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(
    all(target_arch = "wasm32", feature = "javascript"),
    derive(tsify::Tsify)
)]
pub struct View {
    /// What [`draw`] calls it.
    pub kind: &'static str,
    /// What people call it.
    pub title: &'static str,
    /// What it shows.
    pub meaning: &'static str,
}

const CATALOGUE: [View; 12] = [
    View {
        kind: "frame",
        title: "First frame",
        meaning: "The frame that is interpreted.",
    },
    View {
        kind: "second",
        title: "Second frame",
        meaning: "The frame that follows.",
    },
    View {
        kind: "segmentation",
        title: "Curves",
        meaning: "The curves on the frame, each region lightly tinted.",
    },
    View {
        kind: "labels",
        title: "Labels",
        meaning: "One flat colour for each region, grey for the background.",
    },
    View {
        kind: "depth",
        title: "Depth",
        meaning: "Near is bright, far is dark. Hatched: depth cannot be determined from these two frames.",
    },
    View {
        kind: "relief",
        title: "Relief",
        meaning: "The surface as a plaster cast under a lamp, cut along the curves.",
    },
    View {
        kind: "flow",
        title: "Motion",
        meaning: "The motion of each pixel: hue is the direction, strength of colour the length.",
    },
    View {
        kind: "arrows",
        title: "Arrows",
        meaning: "The motion of each pixel as arrows, drawn longer than it is.",
    },
    View {
        kind: "anaglyph",
        title: "Anaglyph",
        meaning: "Both eyes' pictures in one, for coloured glasses.",
    },
    View {
        kind: "stereo",
        title: "Stereo pair",
        meaning: "The left and the right eye's pictures side by side.",
    },
    View {
        kind: "confidence",
        title: "Confidence",
        meaning: "How well depth is determined at each pixel: not at all at the beginning of the palette, fully at its end.",
    },
    View {
        kind: "occlusion",
        title: "Occlusion",
        meaning: "Pixels that are hidden in the second frame, in colour over the dimmed frame.",
    },
];

/// The names of all views.
pub const KINDS: [&str; 12] = {
    let mut kinds = [""; 12];
    let mut i = 0;
    while i < 12 {
        kinds[i] = CATALOGUE[i].kind;
        i += 1;
    }
    kinds
};

/// All views with their titles and meanings.
pub fn catalogue() -> &'static [View] {
    &CATALOGUE
}

/// Draws the view called `kind` of an interpretation over `frame`, which is the first of the two
/// frames, or the second for the view `second`. `contours` are the curves if they are known finer than
/// the labels are; without any, those of the labels are drawn.
///
/// # Errors
/// [`Error::Choice`] for an unknown view, palette, layout or glasses, [`Error::Option`] for a parameter out of
/// range, [`Error::Length`] when frame and interpretation differ in size.
pub fn draw(
    kind: &str,
    frame: &Frame,
    interpretation: &Interpretation,
    contours: &[Contour],
    params: &ViewParams,
) -> Result<Picture, Error> {
    params.check()?;
    if !frame.rgb.same_size(&interpretation.labels) {
        return Err(Error::Length {
            what: "an interpretation",
            width: frame.width(),
            height: frame.height(),
            expected: frame.rgb.len(),
            found: interpretation.labels.len(),
        });
    }
    let scaled;
    // These take regions' depths from `arrangement.rs`, which knows the factors.
    let arranged = ["relief", "anaglyph", "stereo"].contains(&kind);
    let interpretation = if arranged || params.scales.iter().all(|&s| s == 1.0) {
        interpretation
    } else {
        scaled = interpretation.scaled(&params.scales);
        &scaled
    };
    match kind {
        "frame" | "second" => Ok(opaque(&frame.rgb)),
        "segmentation" => Ok(segmentation(frame, interpretation, contours, params)),
        "labels" => Ok(labels(interpretation)),
        "depth" => depth(interpretation, params),
        "relief" => Ok(relief(frame, interpretation, params)),
        "flow" => Ok(flow(interpretation, params)),
        "arrows" => Ok(arrows(frame, interpretation, params)),
        "anaglyph" => anaglyph(frame, interpretation, params),
        "stereo" => stereo(frame, interpretation, params),
        "confidence" => confidence(interpretation, params),
        "occlusion" => Ok(occlusion(frame, interpretation, params)),
        _ => Err(Error::Choice {
            what: "view".to_owned(),
            value: kind.to_owned(),
            choices: KINDS.join(", "),
        }),
    }
}

fn opaque(rgb: &Grid<[u8; 3]>) -> Picture {
    rgb.map(|[r, g, b]| [r, g, b, 255])
}

/// The frame dimmed to a share of its brightness and half of its colour, so that what is drawn over
/// it stands out; each pixel repeated `magnify` times in both directions.
fn dimmed(frame: &Frame, share: f64, magnify: usize) -> Picture {
    let (width, height) = (frame.width() * magnify, frame.height() * magnify);
    Grid::from_fn(width, height, |x, y| {
        let rgb = frame.rgb[(x / magnify, y / magnify)].map(f32::from);
        let grey = (rgb[0] + rgb[1] + rgb[2]) / 3.0;
        let [r, g, b] = rgb.map(|c| ((0.5 * c + 0.5 * grey) * share as f32) as u8);
        [r, g, b, 255]
    })
}

fn mix(a: [u8; 3], b: [u8; 3], share_of_b: f32) -> [u8; 3] {
    let t = share_of_b.clamp(0.0, 1.0);
    std::array::from_fn(|i| rounded(f32::from(a[i]) * (1.0 - t) + f32::from(b[i]) * t))
}

/// The nearest byte to a value that is none below 0: `round` is a call in WebAssembly.
fn rounded(value: f32) -> u8 {
    let low = value as u8;
    low.saturating_add(u8::from(value - f32::from(low) >= 0.5))
}

/// Whether a pixel lies on a line of the diagonal hatching that means "not known".
fn hatched(x: usize, y: usize) -> bool {
    (x + y) % 8 < 2
}
