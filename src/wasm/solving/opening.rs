//! Files on their way to frames: PNG is read here, other files by the module that opens them, row by row.

use std::cell::RefCell;

use js_sys::{Float64Array, Uint8Array};
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

use super::kind_of;
use crate::error::Error;
use crate::file::png;
use crate::frames::{
    Contents, Kind, Lens, LensSource, Raw, Sample, check_size, each_picture, frame_of_rows,
};

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = "
/** What opens files that are no PNG; see `useDecoders`. */
export interface Decoders {
  unpack(bytes: Uint8Array, name: string, all: boolean, take: (picture: any) => boolean): any;
}";

#[wasm_bindgen]
extern "C" {
    /// The module that opens files.
    #[derive(Clone)]
    #[wasm_bindgen(typescript_type = "Decoders")]
    pub type Decoders;

    #[wasm_bindgen(method, catch)]
    fn unpack(
        this: &Decoders,
        bytes: &Uint8Array,
        name: &str,
        all: bool,
        take: &mut dyn FnMut(Unpacked) -> bool,
    ) -> Result<Opened, JsValue>;

    type Opened;
    #[wasm_bindgen(method, getter)]
    fn kind(this: &Opened) -> String;
    #[wasm_bindgen(method, getter)]
    fn cut(this: &Opened) -> bool;

    type Unpacked;
    #[wasm_bindgen(method, getter)]
    fn width(this: &Unpacked) -> usize;
    #[wasm_bindgen(method, getter)]
    fn height(this: &Unpacked) -> usize;
    #[wasm_bindgen(method, getter)]
    fn channels(this: &Unpacked) -> usize;
    #[wasm_bindgen(method, getter)]
    fn depth(this: &Unpacked) -> usize;
    #[wasm_bindgen(method, getter)]
    fn seconds(this: &Unpacked) -> f64;
    #[wasm_bindgen(method)]
    fn lens(this: &Unpacked) -> Option<Float64Array>;
    #[wasm_bindgen(method, catch)]
    fn row(this: &Unpacked, y: usize) -> Result<Uint8Array, JsValue>;
    #[wasm_bindgen(method)]
    fn free(this: &Unpacked);
}

thread_local! {
    static DECODERS: RefCell<Option<Decoders>> = const { RefCell::new(None) };
}

/// Says what opens files that are no PNG. The package does it by itself: in Node at once, in browsers in `loadDecoders`.
#[wasm_bindgen(js_name = useDecoders)]
pub fn use_decoders(decoders: Decoders) {
    DECODERS.set(Some(decoders));
}

/// Whether `Frame.decode` of a file needs what `loadDecoders` loads, as all do that are no PNG.
#[wasm_bindgen(js_name = needsDecoders)]
pub fn needs_decoders(bytes: &Uint8Array) -> bool {
    !reads(bytes)
}

/// Hands the frames of a file, or the first of them unless `all`, to `take` with the seconds for which each is shown.
pub(super) fn open(
    bytes: &Uint8Array,
    name: &str,
    all: bool,
    take: &mut dyn FnMut(crate::Frame, f64) -> bool,
) -> Result<Contents, JsValue> {
    let it: &JsValue = bytes.as_ref();
    if !it.is_instance_of::<Uint8Array>() {
        return Err(Error::Json {
            what: "file",
            reason: format!("it must be a Uint8Array, and is {}", kind_of(it)),
        }
        .into());
    }
    if reads(bytes) {
        let bytes = bytes.to_vec();
        if all {
            let take = &mut |raw: Raw, seconds| take(raw.frame(), seconds);
            return Ok(each_picture(&bytes, name, take)?);
        }
        take(crate::Frame::decode(&bytes, name)?, 0.0);
        return Ok(Contents {
            kind: Kind::Still,
            cut: false,
        });
    }
    let unreadable = |reason: &str| Error::Decode {
        name: name.to_owned(),
        reason: reason.to_owned(),
    };
    let decoders = DECODERS.with_borrow(Clone::clone).ok_or_else(|| {
        unreadable("it is no PNG file, and what opens others is not loaded: call loadDecoders() and wait for it")
    })?;
    let mut thrown = None;
    let opened = decoders.unpack(bytes, name, all, &mut |picture| {
        let frame = frame_of(&picture, name);
        let seconds = picture.seconds();
        picture.free();
        match frame {
            Ok(frame) => take(frame, seconds),
            Err(error) => {
                thrown = Some(error);
                false
            }
        }
    });
    if let Some(error) = thrown {
        return Err(error);
    }
    let opened = opened?;
    let kind = Kind::ALL
        .into_iter()
        .find(|kind| kind.word() == opened.kind());
    Ok(Contents {
        kind: kind.unwrap_or(Kind::Still),
        cut: opened.cut(),
    })
}

/// Whether a file is read here.
fn reads(bytes: &Uint8Array) -> bool {
    png::is_png(&bytes.subarray(0, bytes.length().min(8)).to_vec())
}

fn frame_of(picture: &Unpacked, name: &str) -> Result<crate::Frame, JsValue> {
    check_size(name, picture.width(), picture.height())?;
    let mut frame = match picture.depth() {
        1 => of_rows(picture, |[byte]| byte),
        2 => of_rows(picture, u16::from_le_bytes),
        _ => of_rows(picture, f32::from_le_bytes),
    }?;
    frame.lens = picture.lens().map(|lens| Lens {
        focal: lens.get_index(0),
        millimetres: lens.get_index(1),
        source: if lens.get_index(2) > 0.0 {
            LensSource::Film
        } else {
            LensSource::Sensor
        },
    });
    Ok(frame)
}

fn of_rows<S: Sample, const N: usize>(
    picture: &Unpacked,
    sample: fn([u8; N]) -> S,
) -> Result<crate::Frame, JsValue> {
    let size = (picture.width(), picture.height());
    let channels = picture.channels().clamp(1, 4);
    let mut bytes = vec![0u8; N * channels * size.0];
    let mut thrown = None;
    let frame = frame_of_rows(size, channels, &mut |y, row| match picture.row(y) {
        Ok(given) if given.length() as usize == bytes.len() => {
            given.copy_to(&mut bytes);
            for (to, from) in row.iter_mut().zip(bytes.as_chunks::<N>().0) {
                *to = sample(*from);
            }
        }
        Ok(_) => thrown = Some(js_sys::Error::new("a row has another length").into()),
        Err(error) => thrown = Some(error),
    });
    thrown.map_or(Ok(frame), Err)
}
