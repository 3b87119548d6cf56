//! Frames in, pictures out.

use js_sys::{Uint8Array, Uint8ClampedArray};
use serde::Serialize;
use tsify::Tsify;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{Clamped, JsValue};
use web_sys::ImageData;

use super::opening::open;
use super::{Word, write};
use crate::error::Error;
use crate::file::png;
use crate::frames::Lens;
use crate::grid::Grid;
use crate::view;

/// What a photo says of its lens.
#[derive(Serialize, Tsify)]
struct LensEntry {
    #[serde(flatten)]
    #[tsify(type = "Lens")]
    lens: Lens,
    /// Where f comes from, in words.
    text: String,
}

/// One frame, decoded.
#[wasm_bindgen]
pub struct Frame(pub(super) crate::Frame);

#[wasm_bindgen]
impl Frame {
    /// Reads the bytes of an image file; `name` is what errors call it. In browsers files that are no PNG need
    /// `loadDecoders()` before.
    pub fn decode(bytes: &Uint8Array, name: &Word) -> Result<Frame, JsValue> {
        let mut first = None;
        open(
            bytes,
            &name.text("name of the file")?,
            false,
            &mut |frame, _| {
                first = Some(Self(frame));
                false
            },
        )?;
        first.ok_or_else(|| js_sys::Error::new("the file gave no picture").into())
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

    /// What the photo's EXIF data say of its lens: a `Lens` with a `text` that says where f comes from, as JSON, or null.
    pub fn lens(&self) -> String {
        write(&self.0.lens.map(|lens| LensEntry {
            lens,
            text: lens.to_string(),
        }))
    }

    /// Whether even and odd rows seem to show different moments.
    #[wasm_bindgen(getter)]
    pub fn interlaced(&self) -> bool {
        self.0.interlaced()
    }

    /// The two moments of an interlaced frame, even rows first, half as wide and high: f is half as long.
    pub fn fields(&self) -> Result<Vec<Frame>, Error> {
        Ok(self.0.fields()?.map(Self).into())
    }

    /// The frame by itself with its levels of brightness stretched where it uses few, for the eye; a solver stretches
    /// both of its frames alike.
    pub fn stretched(&self) -> Frame {
        Self(self.0.stretched())
    }

    /// 1 where the file has no picture (alpha 0), 0 elsewhere, in row order; undefined where it has one everywhere.
    pub fn unknown(&self) -> Option<Vec<u8>> {
        self.0.unknown.as_ref().map(|mask| mask.data().to_vec())
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

    /// The bytes of a PNG file.
    #[wasm_bindgen(unchecked_return_type = "Uint8Array<ArrayBuffer>")]
    pub fn png(&self) -> Result<Uint8Array, Error> {
        Ok(Uint8Array::from(png::write_rgba(&self.0)?.as_slice()))
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
