//! Where a solver stands, as bytes: to be looked at again when it has gone on, and to go on from.
//!
//! `RLS1`, the preset (a byte), width and height of the frames as they are worked on, the number of curves, the passes made
//! (`history.rs`) and the seconds spent; then what the approach keeps. Under `best` every bit comes back, so that the next
//! pass is the one that would have followed; under `paper` depth and curves are rounded (`paper/packed.rs`).

use super::history::History;
use super::{Seconds, Solver, Status};
use crate::error::Error;
use crate::file::packed::{Packer, Unpacker};
use crate::options::{MAX_CURVES, Preset};

const MAGIC: &[u8; 4] = b"RLS1";
/// What errors call the bytes.
const NAME: [&str; 2] = ["the kept pass", "solver state"];
/// Passes at most.
const MOST_PASSES: usize = 1 << 20;
const PRESETS: [Preset; 2] = [Preset::Paper, Preset::Best];
const STATUSES: [Status; 4] = [
    Status::Running,
    Status::Converged,
    Status::Exhausted,
    Status::Diverged,
];

impl Solver {
    /// Where it stands, as bytes for [`Solver::set_state`]: a few kilobytes under `best`, less once compressed. Meant for the
    /// end of a pass.
    pub fn state(&self) -> Vec<u8> {
        let mut to = Packer(MAGIC.to_vec());
        to.one_of(&PRESETS, &self.options.preset);
        to.whole(self.working.pair.width());
        to.whole(self.working.pair.height());
        to.whole(self.shapes.len());
        to.one_of(&STATUSES, &self.status);
        self.history.write(&mut to);
        let seconds = self.seconds;
        to.floats([seconds.motion, seconds.depth, seconds.curves]);
        self.approach.pack(&mut to);
        to.0
    }

    /// Goes to where a solver of the same frames, camera and number of curves stood; options and drawn curves stay its own,
    /// and it goes on under these once [`Solver::set_options`] is called.
    ///
    /// # Errors
    /// [`Error::File`] for bytes that are no such state, or are one under another preset, at another size or of other
    /// curves; then nothing is changed.
    pub fn set_state(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let mut from = Unpacker::new(bytes, NAME[0], NAME[1]);
        if from.take(4)? != MAGIC {
            return Err(from.wrong("it does not begin like one"));
        }
        if from.one_of(&PRESETS)? != self.options.preset {
            return Err(from.wrong("it is of another preset"));
        }
        let [width, height] = [from.whole(usize::MAX)?, from.whole(usize::MAX)?];
        let size = [self.working.pair.width(), self.working.pair.height()];
        if [width, height] != size {
            return Err(from.wrong(&format!(
                "it is of frames of {width}×{height} pixels, these are worked on at {}×{}",
                size[0], size[1]
            )));
        }
        if from.whole(MAX_CURVES)? != self.shapes.len() {
            return Err(from.wrong("it has another number of curves"));
        }
        let status = from.one_of(&STATUSES)?;
        let history = History::read(&mut from)?;
        let [motion, depth, curves] = from.floats()?;
        self.approach.unpack(&mut from)?;
        (self.status, self.history) = (status, history);
        self.seconds = Seconds {
            motion,
            depth,
            curves,
        };
        Ok(())
    }
}

impl History {
    fn write(&self, to: &mut Packer) {
        to.list(&self.energies, |to, &energy| to.float(energy));
        to.list(&self.breaks, |to, &after| to.whole(after));
        to.whole(self.drawn);
        to.whole(self.still);
    }

    fn read(from: &mut Unpacker) -> Result<Self, Error> {
        let energies = from.list(MOST_PASSES, |from| from.float())?;
        let count = energies.len();
        Ok(Self {
            breaks: from.list(2 * MOST_PASSES, |from| from.whole(count))?,
            drawn: from.whole(count)?,
            still: from.whole(MOST_PASSES)?,
            last: None,
            energies,
        })
    }
}
