#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| relievo_fuzz::files(bytes));
