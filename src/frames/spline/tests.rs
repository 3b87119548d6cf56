use super::*;

fn wavy(width: usize, height: usize) -> Grid<f32> {
    Grid::from_fn(width, height, |x, y| wave(x as f32, y as f32))
}

fn wave(x: f32, y: f32) -> f32 {
    128.0 + 50.0 * (0.4 * x + 0.2 * y).sin() + 30.0 * (0.5 * y).cos()
}

#[test]
fn it_has_the_pixels_values() {
    let picture = wavy(37, 29);
    let spline = Spline::through(&picture);
    for y in 0..29 {
        for x in 0..37 {
            let value = picture[(x, y)];
            let [read, ..] = spline.with_gradient(x as f32, y as f32);
            for own in [read, spline.at(x as f32, y as f32), spline.pixel(x, y)] {
                assert!((own - value).abs() < 2e-3, "{x} {y}");
            }
        }
    }
}

#[test]
fn its_gradient_is_its_own() {
    let spline = Spline::through(&wavy(40, 32));
    let step = 0.01;
    for (x, y) in [(7.3, 9.8), (20.5, 15.25), (-0.4, 3.0), (39.4, 31.4)] {
        let [value, gx, gy] = spline.with_gradient(x, y);
        assert!((value - spline.at(x, y)).abs() < 1e-3);
        let across = spline.at(x + step, y) - spline.at(x - step, y);
        let down = spline.at(x, y + step) - spline.at(x, y - step);
        assert!((gx - across / (2.0 * step)).abs() < 0.05, "{x} {y}");
        assert!((gy - down / (2.0 * step)).abs() < 0.05, "{x} {y}");
    }
}

#[test]
fn four_at_once_are_what_each_is_by_itself() {
    let spline = Spline::through(&wavy(40, 32));
    let x = [7.3, 20.5, -0.4, 39.4];
    let y = [9.8, 15.25, 3.0, 31.4];
    let values = spline.at_four(x, y);
    let [again, across, down] = spline.four_with_gradient(x, y);
    for n in 0..4 {
        let [value, gx, gy] = spline.with_gradient(x[n], y[n]);
        for (four, one) in [(values, value), (again, value), (across, gx), (down, gy)] {
            assert!((four[n] - one).abs() < 1e-3);
        }
    }
    // What leads far out, or nowhere, is read somewhere.
    let lost = [f32::INFINITY, -1e30, f32::NAN, 1e9];
    assert!(spline.at_four(lost, lost).iter().all(|v| v.is_finite()));
}

#[test]
fn between_pixels_it_is_near_the_wave_itself() {
    let spline = Spline::through(&wavy(64, 64));
    for i in 0..200 {
        let (x, y) = (8.0 + 0.231 * i as f32, 10.0 + 0.207 * i as f32);
        assert!((spline.at(x, y) - wave(x, y)).abs() < 0.05);
    }
}

#[test]
fn quadratic_pictures_are_exact() {
    let (w, h) = (24, 18);
    let value = |x: f32, y: f32| {
        let (x, y) = (x - 9.0, y - 8.0);
        x * x - x * y + 0.5 * y * y
    };
    let bowl = Grid::from_fn(w, h, |x, y| value(x as f32, y as f32));
    for (x, y) in [(3.0f32, 4.0f32), (3.25, 4.75), (10.5, 9.1), (20.9, 15.9)] {
        // It is mirrored at the border, which is felt some pixels from there.
        let border = x.min(y).min((w - 1) as f32 - x).min((h - 1) as f32 - y);
        let felt = 40.0 * POLE.abs().powf(border) + 2e-3;
        assert!((Spline::through(&bowl).at(x, y) - value(x, y)).abs() < felt);
    }
}

#[test]
fn it_follows_fine_texture() {
    let wave = |x: f32, y: f32| 50.0 * (0.9 * x + 0.4).sin() * (1.1 * y).cos();
    let picture = Grid::from_fn(60, 50, |x, y| wave(x as f32, y as f32));
    let spline = Spline::through(&picture);
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
