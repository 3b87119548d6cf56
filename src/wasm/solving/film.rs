//! Files that hold several pictures.

use js_sys::Uint8Array;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

use super::opening::open;
use super::{Frame, Word};
use crate::frames;

/// The pictures of a file, all of one size.
#[wasm_bindgen]
pub struct Film(frames::Film);

/// Reads all pictures of an image file: of an animated GIF, PNG or WebP, of an MPO file, or the pages of a TIFF file;
/// else the one that `Frame.decode` reads. `name` is what errors call it.
#[wasm_bindgen(js_name = decodeAll)]
pub fn decode_all(bytes: &Uint8Array, name: &Word) -> Result<Film, JsValue> {
    let name = name.text("name of the file")?;
    let mut film = frames::Film::new();
    let contents = open(bytes, &name, true, &mut |frame, seconds| {
        film.add(frame, seconds)
    })?;
    Ok(Film(film.finished(contents, &name)?))
}

#[wasm_bindgen]
impl Film {
    /// How many pictures there are, at least 1.
    #[wasm_bindgen(getter)]
    pub fn count(&self) -> usize {
        self.0.moments.len()
    }

    /// What they are to each other.
    #[wasm_bindgen(
        getter,
        unchecked_return_type = "\"still\" | \"animation\" | \"views\" | \"pages\""
    )]
    pub fn kind(&self) -> String {
        self.0.kind.word().to_owned()
    }

    /// Whether the file holds more than fit.
    #[wasm_bindgen(getter)]
    pub fn cut(&self) -> bool {
        self.0.cut
    }

    /// Picture `index`, from 0; the last where there is none.
    pub fn frame(&self, index: usize) -> Frame {
        Frame(self.moment(index).frame.clone())
    }

    /// Seconds for which picture `index` is shown; 0 where the file does not say.
    pub fn seconds(&self, index: usize) -> f64 {
        self.moment(index).seconds
    }
}

impl Film {
    fn moment(&self, index: usize) -> &frames::Moment {
        &self.0.moments[index.min(self.0.moments.len() - 1)]
    }
}
