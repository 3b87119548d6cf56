//! sRGB bytes, and OKLCH, in which equal steps look equal (OKLab by B. Ottosson, 2020). Linear light is 0–1.

use crate::srgb;

/// Linear light of an sRGB byte.
pub fn decode(byte: u8) -> f32 {
    srgb::decode(f64::from(byte) / 255.0) as f32
}

/// The sRGB byte nearest to a linear light, which is clipped to 0–1.
pub fn encode(linear: f32) -> u8 {
    (255.0 * srgb::encode(f64::from(linear))).round() as u8
}

/// Relative luminance of linear light (Rec. 709 weights), 0–1.
pub fn luminance(linear: [f32; 3]) -> f32 {
    0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
}

/// Linear light of a lightness 0–1, chroma and hue in degrees; outside 0–1 where no screen shows it.
fn oklch(lightness: f32, chroma: f32, hue: f32) -> [f32; 3] {
    let (sin, cos) = hue.to_radians().sin_cos();
    let (a, b) = (chroma * cos, chroma * sin);
    let l = (lightness + 0.396_337_78 * a + 0.215_803_76 * b).powi(3);
    let m = (lightness - 0.105_561_346 * a - 0.063_854_17 * b).powi(3);
    let s = (lightness - 0.089_484_18 * a - 1.291_485_5 * b).powi(3);
    [
        4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s,
        -1.268_438 * l + 2.609_757_4 * m - 0.341_319_4 * s,
        -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
    ]
}

/// The sRGB colour of a lightness, hue and chroma, the chroma lowered until a screen can show it.
pub(super) fn from_oklch(lightness: f32, chroma: f32, hue: f32) -> [u8; 3] {
    let shown = |c: f32| {
        let rgb = oklch(lightness, c, hue);
        rgb.iter().all(|v| (-1e-4..=1.0001).contains(v))
    };
    let mut chroma = chroma;
    if !shown(chroma) {
        let mut low = 0.0;
        for _ in 0..12 {
            let middle = (low + chroma) / 2.0;
            if shown(middle) {
                low = middle;
            } else {
                chroma = middle;
            }
        }
        chroma = low;
    }
    oklch(lightness, chroma, hue).map(encode)
}
