//! sRGB's curve, between what a screen is told and the light that it gives (IEC 61966-2-1); both 0–1.

/// Linear light of an sRGB value.
pub fn decode(shown: f64) -> f64 {
    if shown <= 0.040_45 {
        shown / 12.92
    } else {
        ((shown + 0.055) / 1.055).powf(2.4)
    }
}

/// The sRGB value of a linear light, which is clipped to 0–1.
pub fn encode(linear: f64) -> f64 {
    let c = linear.clamp(0.0, 1.0);
    if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    }
}
