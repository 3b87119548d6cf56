//! The bytes are files of a result: the first tells which, the rest is the file, or all files of one result.

use arbitrary::{Result, Unstructured};
use relievo::file::kept::{self, Precision};
use relievo::file::motion::{MotionFile, RegionMotion, Seconds};
use relievo::file::result::{self, ResultFiles};
use relievo::file::{flo, pfm, png};
use relievo::options::MAX_CURVES;
use relievo::view::{self, ViewParams};
use relievo::{Flow, Frame, Grid, Interpretation, score};

/// What is read can be written, and is then read as the same; a result that is read can be scored and drawn.
pub fn files(bytes: &[u8]) {
    let Some((which, rest)) = bytes.split_first() else {
        return;
    };
    match which % 6 {
        0 => read_flow(rest),
        1 => read_depth(rest),
        2 => read_labels(rest),
        3 => read_motion(&String::from_utf8_lossy(rest)),
        5 => read_kept(rest),
        _ => drop(read_result(&mut Unstructured::new(rest))),
    }
}

fn read_flow(bytes: &[u8]) {
    if let Ok(flow) = flo::read(bytes, "flow.flo") {
        let again = flo::read(&flo::write(&flow), "flow.flo").unwrap();
        assert_eq!(bits(&flow.u), bits(&again.u));
        assert_eq!(bits(&flow.v), bits(&again.v));
    }
}

fn read_depth(bytes: &[u8]) {
    if let Ok(depth) = pfm::read(bytes, "depth.pfm") {
        let again = pfm::read(&pfm::write(&depth), "depth.pfm").unwrap();
        assert_eq!(bits(&depth), bits(&again));
    }
}

fn read_labels(bytes: &[u8]) {
    if let Ok(labels) = png::read_labels(bytes, "labels.png") {
        let written = png::write_labels(&labels).unwrap();
        assert_eq!(labels, png::read_labels(&written, "labels.png").unwrap());
    }
}

fn read_motion(text: &str) {
    if let Ok(motion) = MotionFile::read(text) {
        let again = MotionFile::read(&motion.write()).unwrap();
        // Not a number is not equal to itself.
        assert_eq!(format!("{motion:?}"), format!("{again:?}"));
    }
}

fn read_kept(bytes: &[u8]) {
    if let Ok(found) = kept::read(bytes, "it") {
        kept_as_is(&found);
        drawn(&found);
    }
}

fn kept_as_is(found: &Interpretation) {
    let again = kept::read(&kept::write(found, Precision::Exact), "it").unwrap();
    assert_eq!(bits(&found.depth), bits(&again.depth));
    assert_eq!(found.labels, again.labels);
    // Less is kept of it, but something is.
    kept::read(&kept::write(found, Precision::Visible), "it").unwrap();
}

/// Five files that mostly belong together, with any bits for numbers.
fn read_result(u: &mut Unstructured) -> Result<()> {
    let (width, height) = (u.int_in_range(1..=20)?, u.int_in_range(1..=20)?);
    let last = u.int_in_range(0..=8)?;
    let mut grid = |words: &mut dyn FnMut(&mut Unstructured) -> f32| {
        let data = (0..width * height).map(|_| words(u)).collect();
        Grid::from_vec(width, height, data).unwrap()
    };
    let mut any = |u: &mut Unstructured| f32::from_bits(u.arbitrary().unwrap_or(0x3f80_0000));
    let depth = grid(&mut any);
    let flow = Flow {
        u: grid(&mut any),
        v: grid(&mut any),
    };
    let mut label = |u: &mut Unstructured| f32::from(u.int_in_range(0..=last).unwrap_or(0u8));
    let labels = grid(&mut label).map(|l| l as u8);
    let region = |label: u8, u: &mut Unstructured| -> Result<RegionMotion> {
        Ok(RegionMotion {
            label,
            translation: u.arbitrary()?,
            rotation: u.arbitrary()?,
            model: u.arbitrary::<bool>()?.then_some(relievo::MotionModel::Full),
            rigid: None,
        })
    };
    let described = u.int_in_range(0..=9)?;
    let motion = MotionFile {
        regions: (0..described)
            .map(|k| region(k, u))
            .collect::<Result<_>>()?,
        status: "converged".to_owned(),
        iterations: u.arbitrary()?,
        energy: u.arbitrary()?,
        seconds: Seconds::default(),
        depth_scale: None,
    };
    let labels = png::write_labels(&labels).unwrap();
    let files = ResultFiles {
        labels: &labels,
        depth: &pfm::write(&depth),
        flow: &flo::write(&flow),
        motion: &motion.write(),
        occlusion: u.arbitrary::<bool>()?.then_some(&labels),
    };
    let Ok(read) = files.read() else {
        return Ok(());
    };
    assert_eq!(read.regions(), usize::from(described));
    score::compare(&read, &read).unwrap();
    result::write(&read, &motion).unwrap();
    if read.regions() <= MAX_CURVES + 1 {
        kept_as_is(&read);
    }
    drawn(&read);
    Ok(())
}

/// Every picture of it, where it is large enough for a frame.
fn drawn(found: &Interpretation) {
    let (width, height) = (found.labels.width(), found.labels.height());
    let grey = Grid::from_fn(width, height, |x, y| (x * y % 256) as f32);
    if let Ok(frame) = Frame::from_grey(grey) {
        let params = ViewParams::default();
        for kind in view::KINDS {
            view::draw(kind, &frame, found, &[], &params).unwrap();
        }
        view::mesh(&frame, found, &params);
    }
}

fn bits(grid: &Grid<f32>) -> Vec<u32> {
    let plain = |v: &f32| if v.is_nan() { f32::NAN } else { *v }.to_bits();
    grid.data().iter().map(plain).collect()
}
