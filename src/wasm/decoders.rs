//! The module that opens files: pictures of them, unpacked, whose rows the solver's module asks for one by one, so
//! that no picture is held twice on its way.

use js_sys::Function;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::frames::{
    Contents, Kind, LensSource, Raw, Sample, Samples, check_length, others, pictures, views,
};

/// A picture of a file, upright.
#[wasm_bindgen]
pub struct Unpacked {
    raw: Raw,
    /// Seconds for which it is shown; 0 where the file does not say.
    #[wasm_bindgen(readonly)]
    pub seconds: f64,
}

#[wasm_bindgen]
impl Unpacked {
    /// Columns.
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> usize {
        self.raw.upright_size().0
    }

    /// Rows.
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> usize {
        self.raw.upright_size().1
    }

    /// 1 for grey, 2 for grey and alpha, 3 for RGB, 4 for RGB and alpha.
    #[wasm_bindgen(getter)]
    pub fn channels(&self) -> usize {
        self.raw.channels
    }

    /// Bytes of a sample: 1 of 0–255, 2 of 0–65535, 4 of a number 0–1.
    #[wasm_bindgen(getter)]
    pub fn depth(&self) -> usize {
        match self.raw.samples {
            Samples::Bytes(_) => 1,
            Samples::Words(_) => 2,
            Samples::Floats(_) => 4,
        }
    }

    /// What the file says of the lens: f in pixels, in millimetres, and whether it is that on 35 mm film (1) or goes with
    /// the sensor's resolution (0).
    pub fn lens(&self) -> Option<Vec<f64>> {
        self.raw.lens.map(|lens| {
            let film = f64::from(u8::from(lens.source == LensSource::Film));
            vec![lens.focal, lens.millimetres, film]
        })
    }

    /// The samples of row `y`, each with its lowest byte first.
    pub fn row(&self, y: usize) -> Vec<u8> {
        match &self.raw.samples {
            Samples::Bytes(data) => self.upright(data, y),
            Samples::Words(data) => bytes_of(&self.upright(data, y), u16::to_le_bytes),
            Samples::Floats(data) => bytes_of(&self.upright(data, y), f32::to_le_bytes),
        }
    }
}

impl Unpacked {
    fn upright<S: Sample>(&self, data: &[S], y: usize) -> Vec<S> {
        let mut row = vec![S::default(); self.width() * self.raw.channels];
        self.raw.row(data, y, &mut row);
        row
    }
}

fn bytes_of<S: Copy, const N: usize>(row: &[S], bytes: fn(S) -> [u8; N]) -> Vec<u8> {
    row.iter().flat_map(|&sample| bytes(sample)).collect()
}

/// What a file holds, besides its pictures.
#[wasm_bindgen]
pub struct Opened(Contents);

#[wasm_bindgen]
impl Opened {
    /// `still`, `animation`, `views` or `pages`.
    #[wasm_bindgen(getter)]
    pub fn kind(&self) -> String {
        self.0.kind.word().to_owned()
    }

    /// Whether it holds more than can be read.
    #[wasm_bindgen(getter)]
    pub fn cut(&self) -> bool {
        self.0.cut
    }
}

/// Hands the pictures of a file, or the first of them unless `all`, to `take`, which says whether it has room for more.
/// `name` is what errors call the file.
#[wasm_bindgen]
pub fn unpack(bytes: &[u8], name: &str, all: bool, take: &Function) -> Result<Opened, JsValue> {
    check_length(bytes, name)?;
    let mut thrown = None;
    let mut hand = |raw: Raw, seconds: f64| {
        let room = take.call1(&JsValue::NULL, &Unpacked { raw, seconds }.into());
        room.map_or_else(
            |error| {
                thrown = Some(error);
                false
            },
            |room| room.is_truthy(),
        )
    };
    let contents = if all {
        pictures::each_picture(bytes, name, &mut hand)?
    } else {
        hand(others::unpack(bytes, name)?, 0.0);
        Contents {
            kind: Kind::Still,
            cut: false,
        }
    };
    thrown.map_or(Ok(Opened(contents)), Err)
}

/// Where the views of a JPEG or MPO file begin and end in its bytes: from, to, from, to, …
#[wasm_bindgen(js_name = viewsOf)]
pub fn views_of(bytes: &[u8]) -> Vec<u32> {
    let start = bytes.as_ptr().addr();
    let place = |view: &[u8]| {
        let from = view.as_ptr().addr() - start;
        [from as u32, (from + view.len()) as u32]
    };
    views(bytes).into_iter().flat_map(place).collect()
}
