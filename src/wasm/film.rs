//! Files that hold several pictures.

use wasm_bindgen::prelude::wasm_bindgen;

use super::{Frame, Word};
use crate::error::Error;
use crate::frames::{self, Kind};

/// The pictures of a file, all of one size.
#[wasm_bindgen]
pub struct Film(frames::Film);

/// Reads all pictures of an image file: of an animated GIF, PNG or WebP, of an MPO file, or the pages of a TIFF file;
/// else the one that `Frame.decode` reads. `name` is what errors call it.
#[wasm_bindgen(js_name = decodeAll)]
pub fn decode_all(bytes: &[u8], name: &Word) -> Result<Film, Error> {
    let name = name.text("name of the file")?;
    Ok(Film(frames::Film::decode(bytes, &name)?))
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
        let kind = match self.0.kind {
            Kind::Still => "still",
            Kind::Animation => "animation",
            Kind::Views => "views",
            Kind::Pages => "pages",
        };
        kind.to_owned()
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
