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

/// [`encode`] for whole pictures: the same bytes, looked up.
pub(super) struct Encoder {
    /// The least light that each byte stands for.
    least: Vec<f32>,
    /// The byte of each of equal steps of light, at the step's start.
    near: Vec<u8>,
}

/// Steps of light in [`Encoder`]: in the darkest, the curve's straight part, less than one byte each.
const STEPS: usize = 4096;

impl Encoder {
    pub fn new() -> Self {
        // Positive floats are in the order of their bits.
        let least = |byte: u8| {
            let (mut below, mut above) = (0, 1.0f32.to_bits());
            while above - below > 1 {
                let middle = below + (above - below) / 2;
                if encode(f32::from_bits(middle)) < byte {
                    below = middle;
                } else {
                    above = middle;
                }
            }
            f32::from_bits(above)
        };
        let mut bytes = vec![0.0];
        bytes.extend((1..=u8::MAX).map(least));
        Self {
            least: bytes,
            near: (0..=STEPS)
                .map(|i| encode(i as f32 / STEPS as f32))
                .collect(),
        }
    }

    pub fn encode(&self, linear: f32) -> u8 {
        // What is not a number becomes 0, as in a conversion.
        let linear = if linear > 0.0 { linear.min(1.0) } else { 0.0 };
        let mut byte = self.near[(linear * STEPS as f32) as usize];
        while byte < u8::MAX && linear >= self.least[usize::from(byte) + 1] {
            byte += 1;
        }
        byte
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looked_up_bytes_are_those_of_the_curve() {
        let encoder = Encoder::new();
        let fine = (0..200_000).map(|i| i as f32 / 190_000.0 - 0.02);
        let ends = encoder
            .least
            .iter()
            .flat_map(|&l| [l.next_down(), l, l.next_up()]);
        for light in fine.chain(ends).chain([f32::NAN, f32::INFINITY, -0.0]) {
            assert_eq!(encoder.encode(light), encode(light), "{light}");
        }
    }
}
