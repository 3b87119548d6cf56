//! Animated PNG.
//!
//! Each frame is a part of the picture, laid over what was there or put in its place; before the next one, what was
//! there is left, cleared, or brought back (PNG Specification, third edition, 11.3.6). A first picture that does not
//! belong to the animation is passed over. Frames are of 8 bits.

use std::io::Cursor;

use ::png::{BlendOp, DisposeOp, FrameControl, Transformations};

use super::film::{Contents, Kind, Take};
use super::frame::check_size;
use super::samples::{Raw, Samples, UPRIGHT};
use super::unpack::refused;
use crate::error::Error;
use crate::file::png::{self, MOST_BYTES, Refused};
use crate::grid::Grid;

/// Hands on the frames of an animation; `None` where the file holds a still picture.
pub(super) fn each_frame(bytes: &[u8], name: &str, take: Take) -> Result<Option<Contents>, Error> {
    let refuse = |e| refused(name, e);
    let mut file = open(bytes).map_err(refuse)?;
    let (width, height) = file.info().size();
    check_size(name, width as usize, height as usize)?;
    let Some(animation) = file.info().animation_control().copied() else {
        return Ok(None);
    };
    let mut contents = Contents {
        kind: Kind::Animation,
        cut: false,
    };
    let size = file.output_buffer_size().filter(|size| *size <= MOST_BYTES);
    let mut part = vec![0; size.ok_or_else(|| refuse(Refused::TooLarge))?];
    if file.info().frame_control().is_none() {
        file.next_frame(&mut part).map_err(|e| refuse(e.into()))?;
    }
    let mut shown = Grid::new(width as usize, height as usize, [0u8; 4]);
    for count in 0..animation.num_frames {
        let control = match next(&mut file, &mut part) {
            Ok(control) => control,
            // What came before the damage is worth having.
            Err(_) if count > 1 => {
                contents.cut = true;
                break;
            }
            Err(e) => return Err(refuse(e)),
        };
        let before = (control.dispose_op == DisposeOp::Previous).then(|| shown.clone());
        lay(&mut shown, &file, &control, &part);
        let per = if control.delay_den == 0 {
            100
        } else {
            control.delay_den
        };
        let room = take(raw(&shown), f64::from(control.delay_num) / f64::from(per));
        if !room {
            break;
        }
        match before {
            Some(before) => shown = before,
            None if control.dispose_op == DisposeOp::Background => {
                each_row(&mut shown, &control, |_, row| row.fill([0; 4]));
            }
            None => {}
        }
    }
    Ok(Some(contents))
}

type Reader<'a> = ::png::Reader<Cursor<&'a [u8]>>;

fn open(bytes: &[u8]) -> Result<Reader<'_>, Refused> {
    let eight_bits = Transformations::ALPHA | Transformations::STRIP_16;
    png::reader(bytes, Transformations::EXPAND | eight_bits)
}

/// Unpacks the next frame into `part`; where it goes.
fn next(file: &mut Reader, part: &mut [u8]) -> Result<FrameControl, Refused> {
    file.next_frame(part)?;
    let control = file.info().frame_control().copied();
    control.ok_or_else(|| Refused::Damaged("a frame has no place".to_owned()))
}

/// Puts a frame into the picture, or over it.
fn lay(shown: &mut Grid<[u8; 4]>, file: &Reader, control: &FrameControl, part: &[u8]) {
    let info = file.info();
    // The parts of an interlaced frame lie in rows of the whole picture's length.
    let columns = if info.interlaced {
        info.width
    } else {
        control.width
    } as usize;
    let channels = file.output_color_type().0.samples();
    let over = control.blend_op == BlendOp::Over;
    each_row(shown, control, |y, row| {
        let from = &part[y * columns * channels..];
        for (to, from) in row.iter_mut().zip(from.chunks_exact(channels)) {
            let from = match *from {
                [g, a] => [g, g, g, a],
                [r, g, b, a] => [r, g, b, a],
                _ => [0; 4],
            };
            *to = if over { laid_over(from, *to) } else { from };
        }
    });
}

/// The rows of the part of the picture that a frame takes.
fn each_row(
    shown: &mut Grid<[u8; 4]>,
    control: &FrameControl,
    mut each: impl FnMut(usize, &mut [[u8; 4]]),
) {
    let (left, top) = (control.x_offset as usize, control.y_offset as usize);
    let right = (left + control.width as usize).min(shown.width());
    let below = (top + control.height as usize).min(shown.height());
    for y in top..below {
        each(y - top, &mut shown.row_mut(y)[left.min(right)..right]);
    }
}

/// a = a₁ + a₂ (1 − a₁), c = (c₁ a₁ + c₂ a₂ (1 − a₁)) / a.
fn laid_over(above: [u8; 4], below: [u8; 4]) -> [u8; 4] {
    let [one, two] = [above[3], below[3]].map(|a| f32::from(a) / 255.0);
    let share = two * (1.0 - one);
    let alpha = one + share;
    if alpha == 0.0 {
        return [0; 4];
    }
    let mixed = |c: usize| {
        let sum = f32::from(above[c]) * one + f32::from(below[c]) * share;
        (sum / alpha).round() as u8
    };
    [mixed(0), mixed(1), mixed(2), (255.0 * alpha).round() as u8]
}

fn raw(shown: &Grid<[u8; 4]>) -> Raw {
    Raw {
        size: (shown.width(), shown.height()),
        channels: 4,
        samples: Samples::Bytes(shown.data().as_flattened().to_vec()),
        orientation: UPRIGHT,
        lens: None,
    }
}
