//! Frames in, pictures out.

use wasm_bindgen::Clamped;
use wasm_bindgen::prelude::wasm_bindgen;

use super::Word;
use crate::error::Error;
use crate::grid::Grid;
use crate::view;

/// One frame, decoded.
#[wasm_bindgen]
pub struct Frame(pub(super) crate::Frame);

#[wasm_bindgen]
impl Frame {
    /// Reads the bytes of an image file; `name` is what errors call it.
    pub fn decode(bytes: &[u8], name: &Word) -> Result<Frame, Error> {
        Ok(Self(crate::Frame::decode(
            bytes,
            &name.text("name of the file")?,
        )?))
    }

    /// A frame of four bytes a pixel, as canvas gives them.
    #[wasm_bindgen(js_name = fromRgba)]
    pub fn from_rgba(width: usize, height: usize, bytes: &[u8]) -> Result<Frame, Error> {
        Ok(Self(crate::Frame::from_rgba8(width, height, bytes)?))
    }

    /// Columns.
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> usize {
        self.0.width()
    }

    /// Rows.
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> usize {
        self.0.height()
    }

    /// Four bytes a pixel in row order, opaque.
    pub fn rgba(&self) -> Clamped<Vec<u8>> {
        opaque(&self.0.rgb)
    }
}

/// Something to look at.
#[wasm_bindgen]
pub struct Picture(pub(super) view::Picture);

#[wasm_bindgen]
impl Picture {
    /// Columns.
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> usize {
        self.0.width()
    }

    /// Rows.
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> usize {
        self.0.height()
    }

    /// Four bytes a pixel in row order.
    pub fn rgba(&self) -> Clamped<Vec<u8>> {
        Clamped(self.0.data().as_flattened().to_vec())
    }
}

fn opaque(rgb: &Grid<[u8; 3]>) -> Clamped<Vec<u8>> {
    let opaque = rgb.map(|[r, g, b]| [r, g, b, 255]);
    Clamped(opaque.data().as_flattened().to_vec())
}
