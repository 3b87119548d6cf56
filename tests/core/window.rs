//! Rectangles of a frame.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::Window;

const W: usize = 40;
const H: usize = 30;

#[test]
fn a_window_has_every_pixel_that_is_inside_and_no_more() {
    let around = |from: (usize, usize), to: (usize, usize)| {
        // Its two ends alone: what lies between follows.
        let inside = |i: usize| [from, to].contains(&(i % W, i / W));
        Window::around(W, H, inside).unwrap()
    };
    let window = |left, top, width, height| Window {
        left,
        top,
        width,
        height,
    };
    assert_eq!(around((12, 9), (20, 15)), window(12, 9, 9, 7));
    assert_eq!(around((12, 15), (20, 9)), window(12, 9, 9, 7));
    assert_eq!(around((7, 7), (7, 7)), window(7, 7, 1, 1));
    assert_eq!(around((0, 0), (W - 1, H - 1)), Window::whole(W, H));
}

#[test]
fn without_pixels_there_is_no_window() {
    assert_eq!(Window::around(W, H, |_| false), None);
}
