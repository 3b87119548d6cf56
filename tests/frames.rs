//! Reading frames, smoothing them, and differentiating them.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::io::Cursor;

use image::{DynamicImage, ImageFormat};
use relievo::frames::{Derivatives, MAX_SIDE, MIN_SIDE, Spline, blur, gradient};
use relievo::{Error, Frame, FramePair, Grid};

const W: usize = 24;
const H: usize = 18;

fn encode(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
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

#[test]
fn smoothing_keeps_constants_and_sums() {
    let flat = Grid::new(W, H, 77.0f32);
    let mut peak = Grid::new(41, 37, 0.0f32);
    peak[(20, 18)] = 100.0;
    for sigma in [0.3, 1.0, 2.5] {
        let smooth = blur(&flat, sigma);
        assert!(smooth.data().iter().all(|g| (g - 77.0).abs() < 1e-3));
        let spread = blur(&peak, sigma);
        let total: f32 = spread.data().iter().sum();
        assert!((total - 100.0).abs() < 1e-2, "{total} at σ = {sigma}");
        // As wide in both directions as asked for, but for what lies beyond 3σ.
        for along in [|x: usize, _: usize| x as f32 - 20.0, |_, y| y as f32 - 18.0] {
            let moment = Grid::from_fn(41, 37, |x, y| along(x, y).powi(2) * spread[(x, y)]);
            let deviation = (moment.data().iter().sum::<f32>() / 100.0).sqrt();
            // Sampled at whole pixels, one narrower than a pixel comes out narrower still.
            let ratio = f64::from(deviation) / sigma;
            let narrow = sigma < 0.5 && ratio < 1.0;
            assert!(
                narrow || (ratio - 1.0).abs() < 0.03,
                "σ {deviation} for {sigma}"
            );
        }
    }
    assert_eq!(blur(&peak, 0.0), peak);
}

#[test]
fn smoothing_twice_is_smoothing_once_by_more() {
    let picture = Grid::from_fn(W, H, |x, y| ((x * 7919 + y * 104_729) % 200) as f32);
    let twice = blur(&blur(&picture, 1.2), 1.6);
    let once = blur(&picture, 2.0);
    for (x, y) in pixels() {
        if x > 8 && y > 8 && x + 8 < W && y + 8 < H {
            assert!((twice[(x, y)] - once[(x, y)]).abs() < 1.0);
        }
    }
}

#[test]
fn derivatives_of_polynomials_are_exact() {
    let p = |x: f64, y: f64| 3.0 + 2.0 * x - y + 0.25 * x * y - 0.1 * x.powi(3) + 0.02 * y.powi(4);
    let px = |x: f64, y: f64| 2.0 + 0.25 * y - 0.3 * x * x;
    let py = |x: f64, y: f64| -1.0 + 0.25 * x + 0.08 * y.powi(3);
    // Small coordinates, so that single precision is fine enough.
    let real = |x: usize, y: usize| (x as f64 - 8.0, y as f64 - 6.0);
    let picture = Grid::from_fn(17, 13, |x, y| {
        let (x, y) = real(x, y);
        p(x, y) as f32
    });
    let (ix, iy) = gradient(&picture);
    for y in 2..11 {
        for x in 2..15 {
            let at = (x, y);
            let (rx, ry) = real(x, y);
            assert!((f64::from(ix[at]) - px(rx, ry)).abs() < 1e-4);
            assert!((f64::from(iy[at]) - py(rx, ry)).abs() < 1e-4);
        }
    }
}

#[test]
fn derivatives_belong_to_the_moment_between_the_frames() {
    // I = x² − 3xy + t (2x + y) + 5t: at t = 1/2, Ix = 2x − 3y + 1, Iy = −3x + 1/2, It = 2x + y + 5.
    let frame = |t: f32| {
        Grid::from_fn(W, H, |x, y| {
            let (x, y) = (x as f32, y as f32);
            x * x - 3.0 * x * y + t * (2.0 * x + y) + 5.0 * t
        })
    };
    let found = Derivatives::between(&frame(0.0), &frame(1.0));
    for (x, y) in pixels() {
        let (rx, ry) = (x as f32, y as f32);
        assert!((found.it[(x, y)] - (2.0 * rx + ry + 5.0)).abs() < 1e-3);
        if x >= 2 && y >= 2 && x + 2 < W && y + 2 < H {
            assert!((found.ix[(x, y)] - (2.0 * rx - 3.0 * ry + 1.0)).abs() < 1e-3);
            assert!((found.iy[(x, y)] - (0.5 - 3.0 * rx)).abs() < 1e-3);
        }
    }
}

#[test]
fn between_pixels_linear_and_quadratic_pictures_are_exact() {
    let plane = Grid::from_fn(W, H, |x, y| 2.0 * x as f32 - 0.5 * y as f32 + 1.0);
    let bowl = Grid::from_fn(W, H, |x, y| {
        let (x, y) = (x as f32 - 9.0, y as f32 - 8.0);
        x * x - x * y + 0.5 * y * y
    });
    for (x, y) in [(3.0f32, 4.0f32), (3.25, 4.75), (10.5, 9.1), (20.9, 15.9)] {
        assert!((plane.bilinear(x, y) - (2.0 * x - 0.5 * y + 1.0)).abs() < 1e-4);
        let (dx, dy) = (x - 9.0, y - 8.0);
        // The spline is mirrored at the border, which is felt some pixels from there.
        let border = x.min(y).min((W - 1) as f32 - x).min((H - 1) as f32 - y);
        let felt = 40.0 * (3f32.sqrt() - 2.0).abs().powf(border) + 1e-3;
        let exact = dx * dx - dx * dy + 0.5 * dy * dy;
        assert!((Spline::through(&bowl).at(x, y) - exact).abs() < felt);
    }
    // Beyond the border, the border.
    let spline = Spline::through(&plane);
    for (x, y, border) in [(-7.5, -3.0, (0, 0)), (99.0, 99.5, (W - 1, H - 1))] {
        assert_eq!(plane.bilinear(x, y), plane[border]);
        assert!((spline.at(x, y) - plane[border]).abs() < 1e-4);
    }
}

#[test]
fn the_spline_goes_through_every_pixel_and_follows_fine_texture_between_them() {
    let wave = |x: f32, y: f32| 50.0 * (0.9 * x + 0.4).sin() * (1.1 * y).cos();
    let (width, height) = (60, 50);
    let picture = Grid::from_fn(width, height, |x, y| wave(x as f32, y as f32));
    let spline = Spline::through(&picture);
    for (x, y) in [
        (0, 0),
        (1, 7),
        (30, 20),
        (width - 1, 3),
        (width - 1, height - 1),
    ] {
        assert!((spline.at(x as f32, y as f32) - picture[(x, y)]).abs() < 1e-3);
    }
    // Six and seven pixels to a wave, halfway between pixels.
    for (x, y) in [(20.5, 20.5), (31.5, 15.25), (40.3, 30.5)] {
        let [off, linear] =
            [spline.at(x, y), picture.bilinear(x, y)].map(|v| (v - wave(x, y)).abs());
        assert!(
            off < 0.5 && off < 0.1 * linear,
            "{off} off, bilinear {linear}"
        );
    }
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
    for (w, h) in [(over, 20), (20, over), (20_000, 20_000)] {
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
