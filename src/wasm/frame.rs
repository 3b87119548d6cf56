//! Frames in, pictures out.

use js_sys::Uint8ClampedArray;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{Clamped, JsValue};
use web_sys::ImageData;

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
        Clamped(opaque(&self.0.rgb).data().as_flattened().to_vec())
    }

    /// The same for a canvas; browsers only.
    #[wasm_bindgen(js_name = imageData)]
    pub fn image_data(&self) -> Result<ImageData, JsValue> {
        image_data(&opaque(&self.0.rgb))
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

    /// The same for a canvas; browsers only.
    #[wasm_bindgen(js_name = imageData)]
    pub fn image_data(&self) -> Result<ImageData, JsValue> {
        image_data(&self.0)
    }
}

fn opaque(rgb: &Grid<[u8; 3]>) -> view::Picture {
    rgb.map(|[r, g, b]| [r, g, b, 255])
}

/// Copied out of the core's memory, which may grow and so move while the browser draws.
fn image_data(picture: &view::Picture) -> Result<ImageData, JsValue> {
    let (width, height) = (picture.width() as u32, picture.height() as u32);
    let bytes = Uint8ClampedArray::from(picture.data().as_flattened());
    ImageData::new_with_js_u8_clamped_array_and_sh(&bytes, width, height)
}
