//! The bytes are what is set: options, view settings and curves as JSON, a camera, and curves with any numbers.

use arbitrary::{Result, Unstructured};
use relievo::view::ViewParams;
use relievo::{Camera, Options, Shape};

/// What is taken is valid, and is then taken again as JSON; the level set of a curve that is taken has numbers only.
pub fn settings(bytes: &[u8]) {
    let Some((which, rest)) = bytes.split_first() else {
        return;
    };
    let text = String::from_utf8_lossy(rest);
    match which % 5 {
        0 => {
            if let Ok(options) = Options::from_json(&text) {
                options.validate().unwrap();
                let written = serde_json::to_string(&options).unwrap();
                assert_eq!(options, Options::from_json(&written).unwrap());
            }
        }
        1 => {
            if let Ok(params) = ViewParams::from_json(&text) {
                let written = serde_json::to_string(&params).unwrap();
                assert_eq!(params, ViewParams::from_json(&written).unwrap());
            }
        }
        2 => {
            if let Ok(shapes) = serde_json::from_str::<Vec<Shape>>(&text) {
                shapes.iter().for_each(laid);
            }
        }
        3 => drop(camera(&mut Unstructured::new(rest))),
        _ => drop(curve(&mut Unstructured::new(rest)).map(|shape| laid(&shape))),
    }
}

fn camera(u: &mut Unstructured) -> Result<()> {
    if let Ok(camera) = Camera::new(u.arbitrary()?, u.arbitrary()?, u.arbitrary()?) {
        assert!(camera.ray(0.0, 0.0).is_finite());
    }
    Ok(())
}

/// A circle or a polygon. A coordinate is one in a frame, one near it, or any bits.
pub fn curve(u: &mut Unstructured) -> Result<Shape> {
    let number = |u: &mut Unstructured| {
        Ok(match u.int_in_range(0..=3)? {
            0 => f64::from(u.arbitrary::<u8>()? % 40),
            1 => f64::from(u.arbitrary::<i16>()?) / 64.0,
            2 => f64::from(u.arbitrary::<i8>()?).exp2(),
            _ => u.arbitrary()?,
        })
    };
    if u.arbitrary()? {
        let (x, y, r) = (number(u)?, number(u)?, number(u)?);
        return Ok(Shape::Circle { x, y, r });
    }
    let corners = u.int_in_range(0..=12)?;
    let corner = |_| Ok([number(u)?, number(u)?]);
    Ok(Shape::Polygon {
        points: (0..corners).map(corner).collect::<Result<_>>()?,
    })
}

fn laid(shape: &Shape) {
    if let Ok(phi) = shape.level_set(24, 18, 0) {
        assert!(phi.data().iter().all(|p| !p.is_nan()), "{shape:?}");
        assert!(phi.data().iter().any(|p| *p > 0.0), "{shape:?}");
    }
}
