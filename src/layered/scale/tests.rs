use super::*;

fn wavy(width: usize, height: usize) -> Grid<f32> {
    Grid::from_fn(width, height, |x, y| {
        128.0 + 50.0 * (0.4 * x as f32 + 0.2 * y as f32).sin() + 30.0 * (0.5 * y as f32).cos()
    })
}

fn scale(picture: &Grid<f32>) -> Scale {
    let camera = Camera::centred(50.0, picture.width(), picture.height()).unwrap();
    let frames = || [picture.clone(), picture.clone()];
    Scale::new(frames(), frames(), camera)
}

#[test]
fn the_spline_has_the_pixels_values() {
    let picture = wavy(37, 29);
    let scale = scale(&picture);
    for y in 0..29 {
        for x in 0..37 {
            let [value, ..] = scale.read(x as f32, y as f32);
            assert!((value - picture[(x, y)]).abs() < 2e-3, "{x} {y}");
        }
    }
}

#[test]
fn the_gradient_is_the_values_own() {
    let scale = scale(&wavy(40, 32));
    let step = 0.01;
    for (x, y) in [(7.3, 9.8), (20.5, 15.25), (-0.4, 3.0), (39.4, 31.4)] {
        let [_, gx, gy] = scale.read(x, y);
        let across = scale.brightness(x + step, y) - scale.brightness(x - step, y);
        let down = scale.brightness(x, y + step) - scale.brightness(x, y - step);
        assert!((gx - across / (2.0 * step)).abs() < 0.05, "{x} {y}");
        assert!((gy - down / (2.0 * step)).abs() < 0.05, "{x} {y}");
    }
}

#[test]
fn between_pixels_it_is_near_the_wave_itself() {
    let scale = scale(&wavy(64, 64));
    for i in 0..200 {
        let (x, y) = (8.0 + 0.231 * i as f32, 10.0 + 0.207 * i as f32);
        let truth = 128.0 + 50.0 * (0.4 * x + 0.2 * y).sin() + 30.0 * (0.5 * y).cos();
        assert!((scale.brightness(x, y) - truth).abs() < 0.05);
    }
}
