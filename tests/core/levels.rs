//! Frames that use few levels of brightness.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::io::Cursor;

use image::{DynamicImage, ImageBuffer, ImageFormat, Rgb};
use relievo::frames::Note;
use relievo::{Frame, FramePair, scene};

const W: usize = 64;
const H: usize = 48;

/// The two frames of a sequence with every sample changed, as files of 16 bits.
fn deep(change: impl Fn(u8) -> u16) -> [Frame; 2] {
    let made = scene::render("blocks", W, H).unwrap();
    made.frames.map(|frame| {
        let pixel = |x: u32, y: u32| Rgb(frame.rgb[(x as usize, y as usize)].map(&change));
        let picture = ImageBuffer::<Rgb<u16>, Vec<u16>>::from_fn(W as u32, H as u32, pixel);
        let mut bytes = Cursor::new(Vec::new());
        DynamicImage::from(picture)
            .write_to(&mut bytes, ImageFormat::Png)
            .unwrap();
        Frame::decode(bytes.get_ref(), "deep.png").unwrap()
    })
}

fn pair([first, second]: [Frame; 2]) -> FramePair {
    FramePair::new(first, second).unwrap()
}

#[test]
fn a_file_that_is_filled_is_left_alone() {
    let pair = pair(deep(|v| 257 * u16::from(v)));
    let original = scene::render("blocks", W, H).unwrap().frames;
    assert_eq!(pair.notes(), []);
    assert_eq!(pair.first().rgb, original[0].rgb);
    assert_eq!(pair.second().rgb, original[1].rgb);
}

#[test]
fn bits_are_stretched_to_the_same_frames_however_many_there_are() {
    // 10, 12 and 14 bits in a file of 16 whose first bits are empty.
    let pairs = [4u16, 16, 60].map(|gain| pair(deep(|v| gain * u16::from(v))));
    for pair in &pairs {
        assert!(
            matches!(pair.notes(), [Note::Stretched { share }] if *share < 0.25),
            "{:?}",
            pair.notes()
        );
        for (frame, other) in [
            (pair.first(), pairs[1].first()),
            (pair.second(), pairs[1].second()),
        ] {
            for (a, b) in frame.grey.data().iter().zip(other.grey.data()) {
                assert!((a - b).abs() < 0.6, "{a} {b}");
            }
        }
        let mean = |frame: &Frame| {
            let sum: f64 = frame.rgb.data().iter().map(|c| f64::from(c[1])).sum();
            sum / frame.rgb.len() as f64
        };
        assert!(mean(pair.first()) > 60.0, "shown dark");
        // 12 bits are not shown as the 16 levels of a screen that they are in.
        let mut greens: Vec<u8> = pair.first().rgb.data().iter().map(|c| c[1]).collect();
        greens.sort_unstable();
        greens.dedup();
        assert!(greens.len() > 60, "{} shades", greens.len());
    }
}

#[test]
fn both_frames_are_stretched_alike() {
    let dark = deep(|v| 16 * u16::from(v));
    let [first, second] = dark.clone();
    let pair = FramePair::new(first, second).unwrap();
    let gain = |given: &Frame, shown: &Frame| {
        let (i, j) = (7 * W + 9, 30 * W + 40);
        let (g, s) = (given.grey.data(), shown.grey.data());
        assert!((g[i] - g[j]).abs() > 0.1);
        (s[i] - s[j]) / (g[i] - g[j])
    };
    let gains = [gain(&dark[0], pair.first()), gain(&dark[1], pair.second())];
    assert!((gains[0] - gains[1]).abs() < 1e-2 * gains[0], "{gains:?}");
    // Alone each is stretched as well, so that it can be looked at.
    assert!(gain(&dark[0], &dark[0].stretched()) > 5.0);
    // The next pair of a film is made of what was given.
    let next = pair.following(dark[0].clone()).unwrap();
    assert_eq!(next.first(), pair.second());
}

#[test]
fn frames_of_few_levels_are_said_to_be_faint() {
    let made = scene::render("blocks", W, H).unwrap();
    let [first, second] = made.frames.map(|frame| {
        let bytes = frame.rgb.map(|c| {
            let [r, g, b] = c.map(|v| 3 + v / 15);
            [r, g, b, 255]
        });
        Frame::from_rgba8(W, H, bytes.data().as_flattened()).unwrap()
    });
    let pair = FramePair::new(first, second).unwrap();
    let [Note::Faint { levels }] = pair.notes() else {
        panic!("{:?}", pair.notes());
    };
    assert!((8..=17).contains(levels), "{levels}");
    assert!(pair.notes()[0].to_string().contains("little contrast"));
}
