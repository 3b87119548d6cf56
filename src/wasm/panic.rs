//! Panics, for JavaScript.
//!
//! A panic ends in a trap that JavaScript sees as a `RuntimeError` without a reason. The reason is
//! kept here, where it can still be read afterwards; nothing else of the module may be used then.

use std::panic::PanicHookInfo;
use std::sync::Mutex;

use wasm_bindgen::prelude::wasm_bindgen;

static MESSAGE: Mutex<String> = Mutex::new(String::new());

/// Runs when the module is loaded.
#[wasm_bindgen(start)]
fn watch() {
    std::panic::set_hook(Box::new(|info| {
        if let Ok(mut message) = MESSAGE.lock() {
            *message = describe(info);
        }
        console_error_panic_hook::hook(info);
    }));
}

fn describe(info: &PanicHookInfo) -> String {
    let text = info.payload_as_str().unwrap_or("unknown reason");
    match info.location() {
        Some(place) => format!(
            "internal error at {}:{}: {text}",
            place.file(),
            place.line()
        ),
        None => format!("internal error: {text}"),
    }
}

/// What the last panic said and where it was; empty when there was none.
#[wasm_bindgen(js_name = panicMessage)]
pub fn panic_message() -> String {
    MESSAGE.lock().map(|m| m.clone()).unwrap_or_default()
}

/// Panics with `text`, which no input can make the core do: for tests of what happens then.
#[wasm_bindgen(js_name = panicForTest)]
pub fn panic_for_test(text: &str) {
    panic!("{text}");
}
