//! Reading frames, and what is refused as such.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::io::Cursor;

use image::{DynamicImage, ImageFormat};
use relievo::frames::{MAX_PIXELS, MAX_SIDE, MIN_SIDE, MOST_WORKED};
use relievo::{Error, Frame, FramePair, Grid};
use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::{Gray16, RGB8};

const W: usize = 24;
const H: usize = 18;

fn encode(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    if format == ImageFormat::Tiff {
        let mut tiff = TiffEncoder::new(&mut bytes).unwrap();
        let (width, height) = (picture.width(), picture.height());
        match picture {
            DynamicImage::ImageRgb8(p) => tiff.write_image::<RGB8>(width, height, p.as_raw()),
            DynamicImage::ImageLuma16(p) => tiff.write_image::<Gray16>(width, height, p.as_raw()),
            other => panic!("{:?}", other.color()),
        }
        .unwrap();
        return bytes.into_inner();
    }
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn colour(x: u32, y: u32) -> [u8; 3] {
    [(10 * x) as u8, (12 * y) as u8, (3 * x + 5 * y) as u8]
}

fn rgb() -> DynamicImage {
    let pixel = |x, y| image::Rgb(colour(x, y));
    image::RgbImage::from_fn(W as u32, H as u32, pixel).into()
}

fn luma([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn pixels() -> impl Iterator<Item = (usize, usize)> {
    (0..W * H).map(|i| (i % W, i / W))
}

fn textured(shift: f32) -> Frame {
    let wave =
        |x: usize, y: usize| 128.0 + 50.0 * (0.4 * (x as f32 - shift) + 0.3 * y as f32).sin();
    Frame::from_grey(Grid::from_fn(W, H, wave)).unwrap()
}

#[test]
fn colours_of_8_bits_come_back_exactly_from_every_lossless_format() {
    for format in [
        ImageFormat::Png,
        ImageFormat::Bmp,
        ImageFormat::Pnm,
        ImageFormat::Tiff,
        ImageFormat::WebP,
    ] {
        let frame = Frame::decode(&encode(&rgb(), format), "frame").unwrap();
        assert_eq!((frame.width(), frame.height()), (W, H));
        for at in pixels() {
            let expected = colour(at.0 as u32, at.1 as u32);
            assert_eq!(frame.rgb[at], expected, "{format:?}");
            let grey = luma(expected.map(f64::from));
            assert!(
                (f64::from(frame.grey[at]) - grey).abs() < 1e-3,
                "{format:?}"
            );
        }
    }
}

#[test]
fn jpeg_is_read() {
    let grey = |x, y| image::Luma([(5 * x + 4 * y) as u8]);
    let picture = image::GrayImage::from_fn(W as u32, H as u32, grey).into();
    let frame = Frame::decode(&encode(&picture, ImageFormat::Jpeg), "frame").unwrap();
    for at in pixels() {
        let expected = (5 * at.0 + 4 * at.1) as f32;
        assert!((frame.grey[at] - expected).abs() < 12.0);
    }
}

#[test]
fn a_photograph_held_upright_stands_upright() {
    let grey = |x, y| image::Luma([(5 * x + 4 * y) as u8]);
    let picture = image::GrayImage::from_fn(W as u32, H as u32, grey).into();
    let lying = encode(&picture, ImageFormat::Jpeg);
    // Exif: one little-endian entry, orientation 6, the picture's top on the right.
    let mut upright = lying[..2].to_vec();
    upright.extend(b"\xff\xe1\x00\x22Exif\0\0II*\0\x08\0\0\0\x01\0");
    upright.extend(b"\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0");
    upright.extend(&lying[2..]);
    let lying = Frame::decode(&lying, "lying").unwrap();
    let upright = Frame::decode(&upright, "upright").unwrap();
    assert_eq!((upright.width(), upright.height()), (H, W));
    for (x, y) in pixels() {
        assert_eq!(upright.grey[(H - 1 - y, x)], lying.grey[(x, y)]);
    }
}

#[test]
fn sixteen_bits_keep_their_fraction() {
    // Steps of a quarter grey level.
    let value = |x: u32, y: u32| (10_000.0 + 64.25 * f64::from(x + 30 * y)) as u16;
    let pixel = |x, y| image::Luma([value(x, y)]);
    let deep = image::ImageBuffer::<image::Luma<u16>, Vec<u16>>::from_fn(W as u32, H as u32, pixel);
    for format in [ImageFormat::Png, ImageFormat::Tiff] {
        let frame = Frame::decode(&encode(&deep.clone().into(), format), "frame").unwrap();
        for at in pixels() {
            let expected = f64::from(value(at.0 as u32, at.1 as u32)) / 257.0;
            let found = f64::from(frame.grey[at]);
            assert!((found - expected).abs() < 1e-3, "{found} for {expected}");
        }
    }
    let white = image::ImageBuffer::<image::Luma<u16>, Vec<u16>>::from_pixel(
        W as u32,
        H as u32,
        image::Luma([u16::MAX]),
    );
    let frame = Frame::decode(&encode(&white.into(), ImageFormat::Png), "white").unwrap();
    assert!((frame.grey[(3, 3)] - 255.0).abs() < 1e-3);
    assert_eq!(frame.rgb[(3, 3)], [255; 3]);
}

#[test]
fn transparent_parts_are_mid_grey_in_files_and_in_memory() {
    let alpha = |x: u32| [0u8, 255, 51][x as usize % 3];
    let pixel = |x, y| {
        let [r, g, b] = colour(x, y);
        image::Rgba([r, g, b, alpha(x)])
    };
    let picture = image::RgbaImage::from_fn(W as u32, H as u32, pixel);
    let memory = Frame::from_rgba8(W, H, picture.as_raw()).unwrap();
    let file = Frame::decode(&encode(&picture.into(), ImageFormat::Png), "frame").unwrap();
    for at in pixels() {
        let own = colour(at.0 as u32, at.1 as u32).map(f64::from);
        let a = f64::from(alpha(at.0 as u32)) / 255.0;
        let expected = luma(own.map(|c| c * a + 128.0 * (1.0 - a)));
        for frame in [&memory, &file] {
            assert!((f64::from(frame.grey[at]) - expected).abs() < 1e-3);
            if a == 0.0 {
                assert_eq!(frame.rgb[at], [128; 3]);
            }
        }
        assert_eq!(memory.rgb[at], file.rgb[at]);
    }
}

#[test]
fn grey_with_alpha_and_grey_alone_agree_where_opaque() {
    let plain = |x, y| image::Luma([(9 * x + 2 * y) as u8]);
    let with = |x, y| image::LumaA([(9 * x + 2 * y) as u8, 255]);
    let plain = image::GrayImage::from_fn(W as u32, H as u32, plain).into();
    let with = image::GrayAlphaImage::from_fn(W as u32, H as u32, with).into();
    let [a, b] = [plain, with]
        .map(|picture| Frame::decode(&encode(&picture, ImageFormat::Png), "frame").unwrap());
    assert_eq!(a, b);
    assert!((a.grey[(7, 5)] - 73.0).abs() < 1e-3);
}

fn unreadable(bytes: &[u8]) -> String {
    match Frame::decode(bytes, "holiday.png") {
        Err(error @ Error::Decode { .. }) => {
            let sentence = error.to_string();
            assert!(sentence.contains("holiday.png"), "{sentence}");
            assert!(sentence.contains("PNG, JPEG"), "{sentence}");
            sentence
        }
        other => panic!("{:?}", other.map(|f| (f.width(), f.height()))),
    }
}

#[test]
fn what_is_no_image_is_refused_by_name() {
    assert!(unreadable(&[]).contains("empty"));
    unreadable(b"Dear diary, today I went to the mountains.");
    unreadable(&[0; 100]);
    unreadable(b"\x89PNG\r\n\x1a\n");
    unreadable(&[0xff, 0xd8, 0xff, 0xe0]);
    unreadable(b"P5 twenty 20 255\n");
}

#[test]
fn a_truncated_file_is_refused_whatever_its_format() {
    let noise = |x: u32, y: u32| {
        let n = (x * 7919 + y * 104_729 + x * y * 31) % 65_521;
        image::Rgb([(n % 251) as u8, (n % 241) as u8, (n % 239) as u8])
    };
    let picture = image::RgbImage::from_fn(64, 48, noise).into();
    for format in [
        ImageFormat::Png,
        ImageFormat::Jpeg,
        ImageFormat::Bmp,
        ImageFormat::Pnm,
        ImageFormat::Tiff,
        ImageFormat::WebP,
    ] {
        let bytes = encode(&picture, format);
        for share in [2, 25, 50, 80] {
            let kept = &bytes[..bytes.len() * share / 100];
            let result = Frame::decode(kept, "frame");
            assert!(
                matches!(result, Err(Error::Decode { .. })),
                "{share} % of a {format:?} file was read"
            );
        }
    }
}

/// The same file with another size in its header: a PNG's is at bytes 16 to 23, with a checksum after it.
fn png_that_claims(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = encode(&rgb(), ImageFormat::Png);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let mut crc = u32::MAX;
    for &byte in &bytes[12..29] {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 {
                (crc >> 1) ^ 0xedb8_8320
            } else {
                crc >> 1
            };
        }
    }
    bytes[29..33].copy_from_slice(&(!crc).to_be_bytes());
    bytes
}

#[test]
fn sizes_outside_the_limits_are_refused_from_the_header_alone() {
    let over = MAX_SIDE as u32 + 1;
    for (w, h) in [(over, 20), (20, over)] {
        let pnm = format!("P5 {w} {h} 255\n").into_bytes();
        for bytes in [pnm, png_that_claims(w, h)] {
            let expected = Error::Size {
                name: "huge".to_owned(),
                width: w as usize,
                height: h as usize,
            };
            assert_eq!(Frame::decode(&bytes, "huge").err(), Some(expected.clone()));
            let sentence = expected.to_string();
            let limits = [MIN_SIDE.to_string(), MAX_SIDE.to_string()];
            for part in ["huge".to_owned(), format!("{w}×{h}")]
                .iter()
                .chain(&limits)
            {
                assert!(sentence.contains(part), "{sentence}");
            }
        }
    }
    let many = Error::Pixels {
        name: "huge".to_owned(),
        width: 20_000,
        height: 20_000,
    };
    let pnm = b"P5 20000 20000 255\n";
    assert_eq!(Frame::decode(pnm, "huge").err(), Some(many.clone()));
    let most = format!("{} megapixels", MAX_PIXELS / 1_000_000);
    assert!(many.to_string().contains(&most), "{many}");
    // Ten gigabytes, which some machines can address, and sixteen million terabytes.
    for bytes in [
        png_that_claims(100_000, 100_000),
        b"P5 4000000000 4000000000 255\n".to_vec(),
        png_that_claims(2_000_000_000, 2_000_000_000),
    ] {
        let refused = Frame::decode(&bytes, "huge").err();
        let sentence = refused.map_or(String::new(), |e| e.to_string());
        for part in ["huge", &MIN_SIDE.to_string(), &MAX_SIDE.to_string()] {
            assert!(sentence.contains(part), "{sentence}");
        }
    }
    let small: DynamicImage = image::GrayImage::new(15, 40).into();
    assert!(matches!(
        Frame::decode(&encode(&small, ImageFormat::Png), "small"),
        Err(Error::Size {
            width: 15,
            height: 40,
            ..
        })
    ));
}

#[test]
fn nought_by_nought_is_refused() {
    for bytes in [png_that_claims(0, 0), b"P5 0 0 255\n".to_vec()] {
        let result = Frame::decode(&bytes, "nothing");
        assert!(matches!(
            result,
            Err(Error::Decode { .. } | Error::Size { .. })
        ));
    }
    let size = |width, height| Error::Size {
        name: "the frame".to_owned(),
        width,
        height,
    };
    assert_eq!(Frame::from_rgba8(0, 0, &[]).err(), Some(size(0, 0)));
    assert_eq!(
        Frame::from_grey(Grid::new(0, 0, 0.0)).err(),
        Some(size(0, 0))
    );
    assert_eq!(
        Frame::from_grey(Grid::new(16, 15, 0.0)).err(),
        Some(size(16, 15))
    );
    assert!(Frame::from_grey(Grid::new(16, 16, 0.0)).is_ok());
    let absurd = Frame::from_rgba8(usize::MAX, usize::MAX, &[]);
    assert_eq!(absurd.err(), Some(size(usize::MAX, usize::MAX)));
}

#[test]
fn too_few_and_too_many_bytes_are_refused_with_both_numbers() {
    for found in [0, 4 * 16 * 20 - 1, 4 * 16 * 20 + 4] {
        let error = Frame::from_rgba8(16, 20, &vec![9; found]).unwrap_err();
        let sentence = error.to_string();
        assert!(matches!(error, Error::Length { expected: 1280, .. }));
        for part in ["16×20", "1280", &found.to_string()] {
            assert!(sentence.contains(part), "{sentence}");
        }
    }
    let error = Grid::from_vec(3, 2, vec![0u8; 5]).unwrap_err();
    assert!(matches!(
        error,
        Error::Length {
            expected: 6,
            found: 5,
            ..
        }
    ));
}

#[test]
fn frames_of_different_sizes_are_refused_with_both_sizes() {
    let other = Frame::from_grey(Grid::from_fn(20, 30, |x, _| x as f32)).unwrap();
    let error = FramePair::new(textured(0.0), other).unwrap_err();
    assert!(matches!(
        error,
        Error::FramesDiffer {
            first: (W, H),
            second: (20, 30)
        }
    ));
    let sentence = error.to_string();
    assert!(
        sentence.contains("24×18") && sentence.contains("20×30"),
        "{sentence}"
    );
}

#[test]
fn the_same_frame_twice_is_refused() {
    let result = FramePair::new(textured(0.0), textured(0.0));
    assert_eq!(result.err(), Some(Error::FramesIdentical));
    assert!(FramePair::new(textured(0.0), textured(0.1)).is_ok());
}

#[test]
fn a_frame_without_contrast_is_refused_and_named() {
    let flat = |g| Frame::from_grey(Grid::new(W, H, g)).unwrap();
    let which = |first, second| match FramePair::new(first, second) {
        Err(error @ Error::FrameConstant { which }) => {
            assert!(error.to_string().contains(which));
            which
        }
        other => panic!("{:?}", other.err()),
    };
    assert_eq!(which(flat(10.0), textured(0.0)), "the first");
    assert_eq!(which(textured(0.0), flat(10.0)), "the second");
    // Nothing to see comes before nothing moves.
    assert_eq!(which(flat(10.0), flat(10.0)), "the first");
}

#[test]
fn a_large_frame_keeps_its_colours_and_the_brightness_that_is_worked_on() {
    let (width, height) = (5003, 4001);
    let pixels: Vec<u8> = (0..width * height)
        .map(|i| (i % width / 8 + i / width / 4) as u8)
        .collect();
    let mut bytes = format!("P5 {width} {height} 255\n").into_bytes();
    bytes.extend(&pixels);
    let frame = Frame::decode(&bytes, "large").unwrap();
    assert_eq!((frame.width(), frame.height()), (width, height));
    assert_eq!(frame.grey_factor(), 2);
    assert_eq!((frame.grey.width(), frame.grey.height()), (2501, 2000));
    assert!(frame.grey.len() <= MOST_WORKED);
    let small = frame.shrunk(4);
    assert_eq!((small.width(), small.height()), (1250, 1000));
    assert_eq!(small.grey.len(), small.rgb.len());
    for (x, y) in [(0, 0), (7, 900), (1249, 999), (640, 3)] {
        assert_eq!(
            frame.rgb[(4 * x, 4 * y)],
            [pixels[4 * y * width + 4 * x]; 3]
        );
        let own = (0..16).map(|i| f32::from(pixels[(4 * y + i / 4) * width + 4 * x + i % 4]));
        let mean = own.sum::<f32>() / 16.0;
        assert!((small.grey[(x, y)] - mean).abs() < 1e-3);
        assert!((f32::from(small.rgb[(x, y)][1]) - mean).abs() <= 0.5);
    }
}
