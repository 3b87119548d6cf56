//! The bytes are a file that is opened as a frame.

use relievo::frames::{MAX_SIDE, MIN_SIDE};
use relievo::{Frame, FramePair};

/// A frame that is read has a side within the limits and grey levels from 0 to 255; any other file gets a sentence.
pub fn frames(bytes: &[u8]) {
    let frame = match Frame::decode(bytes, "frame") {
        Ok(frame) => frame,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    for side in [frame.width(), frame.height()] {
        assert!((MIN_SIDE..=MAX_SIDE).contains(&side), "a side of {side}");
    }
    assert_eq!(frame.rgb.len(), frame.width() * frame.height());
    let grey = frame.grey.data();
    assert!(grey.iter().all(|g| (-1e-3..=255.001).contains(g)));
    assert!(FramePair::new(frame.clone(), frame).is_err());
}
