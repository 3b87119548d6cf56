//! Frames and truth of every case as files, for other programs to be measured on.
//!
//! A folder for each case, with the names that `relievo scene` gives: `relievo score` reads them too.

use std::error::Error;
use std::fs;
use std::path::Path;

use relievo::file::motion::{MotionFile, RegionMotion};
use relievo::file::{flo, pfm, png};
use relievo::scene::Sequence;
use serde_json::json;

/// Writes `sequence` into a folder of its name inside `folder`, which is made if there is none.
pub fn write(sequence: &Sequence, folder: &Path) -> Result<(), Box<dyn Error + Send + Sync>> {
    let Sequence { frames, truth, .. } = sequence;
    let about = json!({
        "name": sequence.name,
        "title": sequence.title,
        "lesson": sequence.lesson,
        "width": truth.labels.width(),
        "height": truth.labels.height(),
        "camera": truth.camera,
        "curves": sequence.curves,
    });
    let motion = MotionFile {
        regions: RegionMotion::list(&truth.motions, &truth.models()),
        status: "truth".to_owned(),
        ..MotionFile::default()
    };
    let files = [
        ("frame0.png", png::write_rgb(&frames[0].rgb)?),
        ("frame1.png", png::write_rgb(&frames[1].rgb)?),
        ("flow.flo", flo::write(&truth.flow)),
        ("labels.png", png::write_labels(&truth.labels)?),
        ("occlusion.png", png::write_labels(&truth.occluded)?),
        ("depth.pfm", pfm::write(&truth.depth)),
        ("motion.json", motion.write().into_bytes()),
        (
            "scene.json",
            format!("{}\n", serde_json::to_string_pretty(&about)?).into_bytes(),
        ),
    ];
    let folder = folder.join(&sequence.name);
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for (name, bytes) in files {
        let path = folder.join(name);
        fs::write(&path, bytes).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(())
}
