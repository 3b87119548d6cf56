//! The pictures of a file that is no PNG and holds more than one: animations, pairs of views, pages.
//!
//! Frames of an animation are whole pictures, as long as each is shown beside it. An MPO file is one JPEG after
//! another; of those that follow the first, views are those of its size, and neither thumbnails nor gain maps are.

use image::codecs::gif::GifDecoder;
use image::codecs::webp::WebPDecoder;
use image::{AnimationDecoder, DynamicImage, ImageDecoder, ImageFormat};
use std::io::Cursor;

use super::film::{Contents, Kind, Take};
use super::frame::check_size;
use super::jpeg;
use super::others::unpack;
use super::others::{format_of, limits, raw, refused};
use super::tiff::{self, Pages};
use crate::error::Error;

/// Hands the pictures of a file to `take`, in its order.
///
/// # Errors
/// Those of [`super::Frame::decode`].
pub(crate) fn each_picture(bytes: &[u8], name: &str, take: Take) -> Result<Contents, Error> {
    if tiff::is_tiff(bytes) {
        return pages(bytes, name, take);
    }
    let refuse = |e| refused(name, e);
    let cursor = || Cursor::new(bytes);
    match format_of(bytes) {
        Some(ImageFormat::Gif) => {
            let mut decoder = GifDecoder::new(cursor()).map_err(refuse)?;
            checked(&mut decoder, name)?;
            animation(decoder, name, take)
        }
        Some(ImageFormat::WebP) => {
            let mut decoder = WebPDecoder::new(cursor()).map_err(refuse)?;
            checked(&mut decoder, name)?;
            if decoder.has_animation() {
                return animation(decoder, name, take);
            }
            still(bytes, name, take)
        }
        Some(ImageFormat::Jpeg) => views(bytes, name, take),
        _ => still(bytes, name, take),
    }
}

fn still(bytes: &[u8], name: &str, take: Take) -> Result<Contents, Error> {
    take(unpack(bytes, name)?, 0.0);
    Ok(whole(Kind::Still))
}

fn whole(kind: Kind) -> Contents {
    Contents { kind, cut: false }
}

fn animation<'a>(
    decoder: impl AnimationDecoder<'a>,
    name: &str,
    take: Take,
) -> Result<Contents, Error> {
    for (count, shown) in decoder.into_frames().enumerate() {
        let shown = match shown {
            Ok(shown) => shown,
            // What came before the damage is worth having.
            Err(_) if count > 1 => {
                return Ok(Contents {
                    kind: Kind::Animation,
                    cut: true,
                });
            }
            Err(e) => return Err(refused(name, e)),
        };
        let (milliseconds, per) = shown.delay().numer_denom_ms();
        let picture = raw(DynamicImage::ImageRgba8(shown.into_buffer()));
        let seconds = f64::from(milliseconds) / f64::from(per.max(1)) / 1000.0;
        if !take(picture, seconds) {
            break;
        }
    }
    Ok(whole(Kind::Animation))
}

/// Checks the size of an animation and bounds its memory.
fn checked(decoder: &mut impl ImageDecoder, name: &str) -> Result<(), Error> {
    let (width, height) = decoder.dimensions();
    check_size(name, width as usize, height as usize)?;
    decoder.set_limits(limits()).map_err(|e| refused(name, e))
}

fn views(bytes: &[u8], name: &str, take: Take) -> Result<Contents, Error> {
    let mut room = take(unpack(bytes, name)?, 0.0);
    for view in jpeg::views(bytes).into_iter().skip(1) {
        if !room {
            break;
        }
        // What is no frame, such as a small thumbnail, is passed over.
        room = unpack(view, name).map_or(true, |picture| take(picture, 0.0));
    }
    Ok(whole(Kind::Views))
}

fn pages(bytes: &[u8], name: &str, take: Take) -> Result<Contents, Error> {
    let refuse = |e: tiff::Refused| e.error(name);
    let mut pages = Pages::open(bytes).map_err(refuse)?;
    let mut first = true;
    loop {
        let page = pages.size().map(|(width, height)| {
            let size = check_size(name, width as usize, height as usize);
            size.map(|()| pages.read())
        });
        match page.map_err(refuse).and_then(|page| page?.map_err(refuse)) {
            Ok(page) => {
                first = false;
                if !take(page, 0.0) {
                    break;
                }
            }
            Err(e) if first => return Err(e),
            // Thumbnails and what else lies behind.
            Err(_) => {}
        }
        if !pages.more() || pages.next().is_err() {
            break;
        }
    }
    Ok(whole(Kind::Pages))
}
