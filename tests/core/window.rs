//! Rectangles of a frame.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::{Grid, Window};

const W: usize = 40;
const H: usize = 30;

/// The window with `margin` around the pixels from `from` to `to`, both included.
fn around(from: (usize, usize), to: (usize, usize), margin: usize) -> Window {
    let inside = |i: usize| {
        let (x, y) = (i % W, i / W);
        // Its two ends alone: what lies between follows.
        (x, y) == from || (x, y) == to
    };
    Window::around(W, H, margin, inside).unwrap()
}

#[test]
fn a_window_reaches_as_far_as_its_margin_and_no_further_than_the_frame() {
    let window = |left, top, width, height| Window {
        left,
        top,
        width,
        height,
    };
    assert_eq!(around((12, 9), (20, 15), 0), window(12, 9, 9, 7));
    assert_eq!(around((12, 15), (20, 9), 3), window(9, 6, 15, 13));
    assert_eq!(around((2, 1), (5, 4), 4), window(0, 0, 10, 9));
    assert_eq!(around((36, 27), (39, 29), 2), window(34, 25, 6, 5));
    assert_eq!(around((7, 7), (7, 7), 0), window(7, 7, 1, 1));
    assert_eq!(around((7, 7), (8, 8), 500), Window::whole(W, H));
}

#[test]
fn without_pixels_there_is_no_window() {
    assert_eq!(Window::around(W, H, 5, |_| false), None);
}

#[test]
fn what_is_cut_out_and_put_back_is_as_it_was() {
    let frame = Grid::from_fn(W, H, |x, y| (1000 * y + x) as u32);
    for window in [
        around((12, 9), (20, 15), 2),
        around((0, 0), (3, 29), 2),
        around((39, 29), (39, 29), 0),
        Window::whole(W, H),
    ] {
        let part = window.crop(&frame);
        assert_eq!((part.width(), part.height()), (window.width, window.height));
        for (i, value) in part.data().iter().enumerate() {
            assert_eq!(*value, frame[window.place(i)]);
        }
        let mut same = frame.clone();
        window.paste(&part, &mut same);
        assert_eq!(same, frame);
        // Pasting changes the window and nothing else.
        let mut marked = frame.clone();
        window.paste(&part.map(|_| u32::MAX), &mut marked);
        for y in 0..H {
            for x in 0..W {
                let within = x >= window.left
                    && x < window.left + window.width
                    && y >= window.top
                    && y < window.top + window.height;
                let expected = if within { u32::MAX } else { frame[(x, y)] };
                assert_eq!(marked[(x, y)], expected, "({x}, {y})");
            }
        }
    }
}
