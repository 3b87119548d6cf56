//! Which focal length is found, from the true one and from guesses that are far off.

use relievo::FramePair;
use relievo::init::focal_length;

use crate::Failure;
use crate::cases::Case;
use crate::table::{head, number, row};
use crate::threads::try_in_order;

/// Guesses, over the truth.
const GUESSES: [f64; 3] = [1.0, 0.35, 4.0];

/// Looks for f in `cases` and prints what is found, over the truth, with its range.
pub fn print(cases: &[Case]) -> Result<(), Failure> {
    let titles = GUESSES.map(|guess| format!("f found from {guess} of it"));
    head(&["sequence", &titles[0], &titles[1], &titles[2]]);
    try_in_order(
        cases,
        |case| {
            let sequence = case.render()?;
            let [first, second] = sequence.frames;
            let pair = FramePair::new(first, second)?;
            let camera = sequence.truth.camera;
            Ok(GUESSES.map(|guess| {
                let mut guessed = camera;
                guessed.focal *= guess;
                focal_length(&pair, &guessed)
                    .map(|f| [f.focal, f.least, f.greatest].map(|f| f / camera.focal))
            }))
        },
        |case, found| {
            let cell = |found: &Option<[f64; 3]>| match found {
                None => "kept".to_owned(),
                Some(f) => {
                    let [f, least, greatest] = f.map(|f| number(Some(f), 2));
                    format!("{f} ({least} to {greatest})")
                }
            };
            let mut cells = vec![format!("`{}`", case.name())];
            cells.extend(found.iter().map(cell));
            row(&cells);
        },
    )
}
