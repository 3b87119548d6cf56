//! Kinds of files that cameras and programs write, made here byte by byte.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::io::Cursor;

use image::codecs::gif::GifEncoder;
use image::{Delay, DynamicImage, ImageFormat};
use relievo::frames::{Film, Kind, LensSource};
use relievo::{Error, Frame};

const W: usize = 40;
const H: usize = 30;

fn encode(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn colour(x: usize, y: usize, shift: usize) -> [u8; 3] {
    let x = x + shift;
    [(5 * x) as u8, (7 * y) as u8, (2 * x + 3 * y) as u8]
}

fn rgb(width: usize, height: usize, shift: usize) -> DynamicImage {
    let pixel = |x: u32, y: u32| image::Rgb(colour(x as usize, y as usize, shift));
    image::RgbImage::from_fn(width as u32, height as u32, pixel).into()
}

fn pixels() -> impl Iterator<Item = (usize, usize)> {
    (0..W * H).map(|i| (i % W, i / W))
}

/// A TIFF file of one strip: entries of (tag, values of 16 bits).
fn tiff(width: usize, height: usize, tags: &[(u16, &[u16])], strip: &[u8]) -> Vec<u8> {
    let long = strip.len() as u32;
    let mut entries: Vec<(u16, Vec<u16>)> = vec![
        (256, vec![width as u16]),
        (257, vec![height as u16]),
        (278, vec![height as u16]),
    ];
    entries.extend(tags.iter().map(|(tag, values)| (*tag, values.to_vec())));
    entries.push((273, vec![8]));
    entries.push((279, vec![long as u16, (long >> 16) as u16]));
    entries.sort();
    let ifd = 8 + strip.len() + strip.len() % 2;
    let mut bytes = b"II*\0".to_vec();
    bytes.extend((ifd as u32).to_le_bytes());
    bytes.extend(strip);
    bytes.resize(ifd, 0);
    bytes.extend((entries.len() as u16).to_le_bytes());
    let mut behind = Vec::new();
    let from = ifd + 2 + 12 * entries.len() + 4;
    for (tag, values) in &entries {
        bytes.extend(tag.to_le_bytes());
        let data: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        // The length of the strip is one number of 32 bits.
        let (kind, count) = if *tag == 279 {
            (4u16, 1)
        } else {
            (3, values.len())
        };
        bytes.extend(kind.to_le_bytes());
        bytes.extend((count as u32).to_le_bytes());
        if data.len() <= 4 {
            let mut four = data;
            four.resize(4, 0);
            bytes.extend(four);
        } else {
            bytes.extend(((from + behind.len()) as u32).to_le_bytes());
            behind.extend(data);
        }
    }
    bytes.extend([0; 4]);
    bytes.extend(behind);
    bytes
}

fn crc(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for &byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 {
                (crc >> 1) ^ 0xedb8_8320
            } else {
                crc >> 1
            };
        }
    }
    !crc
}

fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [kind.as_slice(), data].concat();
    let length = (data.len() as u32).to_be_bytes();
    [&length[..], &body, &crc(&body).to_be_bytes()].concat()
}

/// Rows with their filter type 0 before them, as zlib stores what it does not compress.
fn stored(rows: &[Vec<u8>]) -> Vec<u8> {
    let raw: Vec<u8> = rows
        .iter()
        .flat_map(|row| [&[0], row.as_slice()].concat())
        .collect();
    let (mut a, mut b) = (1u32, 0u32);
    for &byte in &raw {
        a = (a + u32::from(byte)) % 65_521;
        b = (b + a) % 65_521;
    }
    let length = raw.len() as u16;
    let mut out = vec![0x78, 0x01, 0x01];
    out.extend(length.to_le_bytes());
    out.extend((!length).to_le_bytes());
    out.extend(&raw);
    out.extend(((b << 16) | a).to_be_bytes());
    out
}

fn png_header(bits: u8, kind: u8) -> Vec<u8> {
    let mut data = (W as u32).to_be_bytes().to_vec();
    data.extend((H as u32).to_be_bytes());
    data.extend([bits, kind, 0, 0, 0]);
    chunk(b"IHDR", &data)
}

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

#[test]
fn tiff_with_a_palette_of_any_depth_has_its_colours() {
    let table = |i: usize| [(37 * i) as u8, (11 * i + 5) as u8, (250 - 13 * i) as u8];
    for bits in [1u16, 2, 4, 8] {
        let count = 1usize << bits;
        let index = |x: usize, y: usize| (x + 3 * y) % count.min(19);
        let channel = |c: usize| (0..count).map(move |i| 257 * u16::from(table(i % 19)[c]));
        let map: Vec<u16> = [0, 1, 2].into_iter().flat_map(channel).collect();
        let per = 8 / usize::from(bits);
        let row = |y: usize| {
            let byte = |b: usize| {
                let of = |k: usize| {
                    let x = b * per + k;
                    let value = if x < W { index(x, y) } else { 0 };
                    (value << (8 - usize::from(bits) * (k + 1))) as u8
                };
                (0..per).map(of).fold(0, |a, b| a | b)
            };
            (0..W.div_ceil(per)).map(byte).collect::<Vec<u8>>()
        };
        let strip: Vec<u8> = (0..H).flat_map(row).collect();
        let tags: [(u16, &[u16]); 5] = [
            (258, &[bits]),
            (259, &[1]),
            (262, &[3]),
            (277, &[1]),
            (320, &map),
        ];
        let frame = Frame::decode(&tiff(W, H, &tags, &strip), "palette.tif").unwrap();
        for (x, y) in pixels() {
            assert_eq!(frame.rgb[(x, y)], table(index(x, y)), "{bits} bits");
        }
    }
}

#[test]
fn tiff_of_few_bits_is_grey() {
    for bits in [1u16, 2, 4] {
        let most = (1usize << bits) - 1;
        let per = 8 / usize::from(bits);
        let value = |x: usize, y: usize| (x * y + x) % (most + 1);
        let row = |y: usize| {
            let byte = |b: usize| {
                let of =
                    |k: usize| (value(b * per + k, y) << (8 - usize::from(bits) * (k + 1))) as u8;
                (0..per).map(of).fold(0, |a, b| a | b)
            };
            (0..W / per).map(byte).collect::<Vec<u8>>()
        };
        let strip: Vec<u8> = (0..H).flat_map(row).collect();
        let tags: [(u16, &[u16]); 4] = [(258, &[bits]), (259, &[1]), (262, &[1]), (277, &[1])];
        let frame = Frame::decode(&tiff(W, H, &tags, &strip), "grey.tif").unwrap();
        for (x, y) in pixels() {
            let expected = (value(x, y) * 255 / most) as u8;
            assert_eq!(frame.rgb[(x, y)], [expected; 3], "{bits} bits at {x}, {y}");
        }
    }
}

#[test]
fn tiff_with_jpeg_inside_looks_like_the_jpeg() {
    let jpeg = encode(&rgb(W, H, 0), ImageFormat::Jpeg);
    let plain = Frame::decode(&jpeg, "plain.jpg").unwrap();
    for sampling in [[1u16, 1], [2, 2]] {
        let tags: [(u16, &[u16]); 5] = [
            (258, &[8, 8, 8]),
            (259, &[7]),
            (262, &[6]),
            (277, &[3]),
            (530, &sampling),
        ];
        let inside = Frame::decode(&tiff(W, H, &tags, &jpeg), "inside.tif").unwrap();
        for at in pixels() {
            for (a, b) in inside.rgb[at].iter().zip(plain.rgb[at]) {
                assert!(a.abs_diff(b) <= 3, "{at:?}: {a} for {b}");
            }
        }
    }
}

#[test]
fn png_of_four_greys_is_read() {
    let value = |x: usize, y: usize| (x + y) % 4;
    let row = |y: usize| {
        let byte = |b: usize| (0..4).fold(0, |a, k| a << 2 | value(4 * b + k, y) as u8);
        (0..W / 4).map(byte).collect::<Vec<u8>>()
    };
    let rows: Vec<_> = (0..H).map(row).collect();
    let bytes = [
        PNG,
        &png_header(2, 0),
        &chunk(b"IDAT", &stored(&rows)),
        &chunk(b"IEND", &[]),
    ];
    let frame = Frame::decode(&bytes.concat(), "four.png").unwrap();
    for (x, y) in pixels() {
        assert_eq!(frame.rgb[(x, y)], [85 * value(x, y) as u8; 3]);
    }
}

#[test]
fn what_is_refused_is_called_by_its_name_and_no_decoder_is_quoted() {
    let named = [
        (b"\0\0\0\x1cftypheic\0\0\0\0heic".to_vec(), "HEIC"),
        (b"\0\0\0\x1cftypavif\0\0\0\0avif".to_vec(), "AVIF"),
        (b"\xff\x0a\xfa\x1f\x41".to_vec(), "JPEG XL"),
        (b"\0\0\0\x20ftypisom\0\0\0\0".to_vec(), "MP4"),
        (b"\x1a\x45\xdf\xa3\x9f".to_vec(), "WebM"),
    ];
    for (bytes, kind) in named {
        let sentence = refusal(&bytes);
        assert!(sentence.contains(kind), "{sentence}");
    }
    let lab: [(u16, &[u16]); 4] = [(258, &[8, 8, 8]), (259, &[1]), (262, &[8]), (277, &[3])];
    let old: [(u16, &[u16]); 4] = [(258, &[8, 8, 8]), (259, &[6]), (262, &[6]), (277, &[3])];
    for tags in [lab, old] {
        let sentence = refusal(&tiff(W, H, &tags, &[0; 3 * W * H]));
        for word in ["Unknown", "Unsupported", "Error", "("] {
            // One bracket around the reason is the sentence's own.
            let most = usize::from(word == "(");
            assert!(sentence.matches(word).count() <= most, "{sentence}");
        }
        assert!(sentence.contains("8 or 16 bits"), "{sentence}");
    }
}

fn refusal(bytes: &[u8]) -> String {
    match Frame::decode(bytes, "strange") {
        Err(error @ Error::Decode { .. }) => error.to_string(),
        other => panic!("{:?}", other.map(|f| (f.width(), f.height()))),
    }
}

/// A JPEG with an EXIF block of entries (tag, type, count, value) in its Exif folder.
fn with_exif(jpeg: &[u8], entries: &[(u16, u16, u32, [u8; 4])], behind: &[u8]) -> Vec<u8> {
    let mut block = b"II*\0\x08\0\0\0\x01\0\x69\x87\x04\0\x01\0\0\0\x1a\0\0\0\0\0\0\0".to_vec();
    block.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        block.extend(tag.to_le_bytes());
        block.extend(kind.to_le_bytes());
        block.extend(count.to_le_bytes());
        block.extend(value);
    }
    block.extend([0; 4]);
    block.extend(behind);
    let mut out = jpeg[..2].to_vec();
    out.extend([0xff, 0xe1]);
    out.extend((block.len() as u16 + 8).to_be_bytes());
    out.extend(b"Exif\0\0");
    out.extend(block);
    out.extend(&jpeg[2..]);
    out
}

#[test]
fn a_photo_tells_its_focal_length_by_35_mm_film() {
    let jpeg = encode(&rgb(W, H, 0), ImageFormat::Jpeg);
    let short = |v: u16| [v as u8, (v >> 8) as u8, 0, 0];
    let photo = with_exif(&jpeg, &[(0xa405, 3, 1, short(27))], &[]);
    let lens = Frame::decode(&photo, "photo.jpg").unwrap().lens.unwrap();
    assert!((lens.focal - 27.0 / 36.0 * W as f64).abs() < 1e-9);
    assert_eq!(lens.source, LensSource::Film);
    assert_eq!(lens.to_string(), "EXIF: 27 mm on 35 mm film");
    // 0 says that it is not known.
    for bytes in [
        jpeg.clone(),
        with_exif(&jpeg, &[(0xa405, 3, 1, short(0))], &[]),
    ] {
        assert_eq!(Frame::decode(&bytes, "photo.jpg").unwrap().lens, None);
    }
    // The longer side counts, however the camera was held.
    let upright = encode(&rgb(H, W, 0), ImageFormat::Jpeg);
    let upright = with_exif(&upright, &[(0xa405, 3, 1, short(27))], &[]);
    let again = Frame::decode(&upright, "photo.jpg").unwrap().lens.unwrap();
    assert!((again.focal - lens.focal).abs() < 1e-9);
}

#[test]
fn a_photo_tells_its_focal_length_by_its_sensor_and_scaled_if_it_was() {
    let jpeg = encode(&rgb(W, H, 0), ImageFormat::Jpeg);
    // 4.2 mm, 7000 pixels a centimetre, taken 4000 pixels wide.
    let at = |offset: u32| (26 + 2 + 4 * 12 + 4 + offset).to_le_bytes();
    let entries = [
        (0x920a, 5, 1, at(0)),
        (0xa002, 4, 1, 4000u32.to_le_bytes()),
        (0xa20e, 5, 1, at(8)),
        (0xa210, 3, 1, [3, 0, 0, 0]),
    ];
    let behind: Vec<u8> = [42u32, 10, 7000, 1]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let lens = Frame::decode(&with_exif(&jpeg, &entries, &behind), "photo.jpg")
        .unwrap()
        .lens;
    let lens = lens.unwrap();
    assert_eq!(lens.source, LensSource::Sensor);
    let expected = 4.2 * 700.0 * W as f64 / 4000.0;
    assert!((lens.focal - expected).abs() < 1e-6, "{lens:?}");
}

/// Three pictures of an animation, each for so many milliseconds.
const TIMES: [u32; 3] = [80, 120, 40];

#[test]
fn animations_become_lists_of_frames_with_their_times() {
    let mut gif = Vec::new();
    {
        let mut encoder = GifEncoder::new(&mut gif);
        for (shift, time) in TIMES.into_iter().enumerate() {
            let picture = rgb(W, H, 3 * shift).to_rgba8();
            let delay = Delay::from_numer_denom_ms(time, 1);
            encoder
                .encode_frame(image::Frame::from_parts(picture, 0, 0, delay))
                .unwrap();
        }
    }
    for (kind, bytes, exact) in [
        ("gif", gif, false),
        ("png", apng(), true),
        ("webp", webp(), true),
    ] {
        let film = Film::decode(&bytes, kind).unwrap();
        assert_eq!(
            (film.kind, film.moments.len(), film.cut),
            (Kind::Animation, 3, false),
            "{kind}"
        );
        for (shift, moment) in film.moments.iter().enumerate() {
            assert!(
                (moment.seconds - f64::from(TIMES[shift]) / 1000.0).abs() < 1e-6,
                "{kind}"
            );
            for (x, y) in pixels() {
                let found = moment.frame.rgb[(x, y)];
                for (a, b) in found.iter().zip(colour(x, y, 3 * shift)) {
                    // A GIF has 256 colours.
                    assert!(
                        a.abs_diff(b) <= if exact { 0 } else { 40 },
                        "{kind} {shift}: {a} for {b}"
                    );
                }
            }
        }
        let first = Frame::decode(&bytes, kind).unwrap();
        assert_eq!(first.rgb, film.moments[0].frame.rgb, "{kind}");
    }
}

fn apng() -> Vec<u8> {
    let rows = |shift: usize| -> Vec<Vec<u8>> {
        let row = |y: usize| (0..W).flat_map(|x| colour(x, y, shift)).collect();
        (0..H).map(row).collect()
    };
    let mut bytes = [
        PNG,
        &png_header(8, 2),
        &chunk(b"acTL", &[0, 0, 0, 3, 0, 0, 0, 0]),
    ]
    .concat();
    let mut number = 0u32;
    for (shift, time) in TIMES.into_iter().enumerate() {
        let mut control = number.to_be_bytes().to_vec();
        number += 1;
        control.extend((W as u32).to_be_bytes());
        control.extend((H as u32).to_be_bytes());
        control.extend([0; 8]);
        control.extend((time as u16).to_be_bytes());
        control.extend(1000u16.to_be_bytes());
        control.extend([0, 0]);
        bytes.extend(chunk(b"fcTL", &control));
        let data = stored(&rows(3 * shift));
        if shift == 0 {
            bytes.extend(chunk(b"IDAT", &data));
        } else {
            bytes.extend(chunk(
                b"fdAT",
                &[&number.to_be_bytes(), data.as_slice()].concat(),
            ));
            number += 1;
        }
    }
    bytes.extend(chunk(b"IEND", &[]));
    bytes
}

fn webp() -> Vec<u8> {
    let riff = |kind: &[u8; 4], data: &[u8]| {
        let mut out = kind.to_vec();
        out.extend((data.len() as u32).to_le_bytes());
        out.extend(data);
        out.resize(out.len() + data.len() % 2, 0);
        out
    };
    let three = |v: usize| [v as u8, (v >> 8) as u8, (v >> 16) as u8];
    let size = [three(W - 1), three(H - 1)].concat();
    let mut body = b"WEBP".to_vec();
    body.extend(riff(b"VP8X", &[&[2, 0, 0, 0], size.as_slice()].concat()));
    body.extend(riff(b"ANIM", &[0; 6]));
    for (shift, time) in TIMES.into_iter().enumerate() {
        let still = encode(&rgb(W, H, 3 * shift), ImageFormat::WebP);
        let mut frame = vec![0; 6];
        frame.extend(&size);
        frame.extend(three(time as usize));
        frame.push(2);
        frame.extend(&still[12..]);
        body.extend(riff(b"ANMF", &frame));
    }
    riff(b"RIFF", &body)
}

#[test]
fn a_file_of_two_jpegs_is_a_pair_of_views() {
    let [left, right] = [0, 5].map(|shift| encode(&rgb(W, H, shift), ImageFormat::Jpeg));
    let thumbnail = encode(&rgb(W / 2, H / 2, 0), ImageFormat::Jpeg);
    let padding = vec![0; 37];
    let film = Film::decode(
        &[&left, &padding, &thumbnail, &right]
            .map(|b| b.as_slice())
            .concat(),
        "a.mpo",
    );
    let film = film.unwrap();
    assert_eq!((film.kind, film.moments.len()), (Kind::Views, 2));
    for (moment, alone) in film.moments.iter().zip([&left, &right]) {
        assert_eq!(moment.frame, Frame::decode(alone, "alone.jpg").unwrap());
    }
    // A photo with a thumbnail or rubbish behind it is a photo.
    for behind in [thumbnail, b"\0\0\xff\xd8rubbish".to_vec()] {
        let film = Film::decode(&[left.clone(), behind].concat(), "a.jpg").unwrap();
        assert_eq!((film.kind, film.moments.len()), (Kind::Still, 1));
    }
}

#[test]
fn what_is_damaged_in_an_animation_costs_no_more_than_the_rest() {
    let bytes = webp();
    let film = Film::decode(&bytes[..bytes.len() - 30], "cut.webp");
    assert!(film.is_err() || film.is_ok_and(|film| film.moments.len() >= 2));
    for bytes in [&b""[..], b"GIF89a", &apng()[..60], &webp()[..40]] {
        assert!(Film::decode(bytes, "short").is_err());
    }
}
