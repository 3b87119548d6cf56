//! Maps of errors and of the residual: what they show is what scores count.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use relievo::file::parts::Parts;
use relievo::view::{self, Form, PALETTES, Palette, ViewParams};
use relievo::{Error, FramePair, Interpretation, scene, score};

fn hex([r, g, b, _]: [u8; 4]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The truth of a sequence, and the same made wrong in known ways.
fn blocks() -> (scene::Sequence, Interpretation) {
    let blocks = scene::render("blocks", 64, 48).unwrap();
    let mut found = blocks.truth.clone();
    found.labels.row_mut(0).fill(1);
    found.flow.u.row_mut(10).iter_mut().for_each(|u| *u += 3.0);
    found.flow.v.row_mut(10).iter_mut().for_each(|v| *v -= 4.0);
    (blocks, found)
}

#[test]
fn well_known_palettes_have_their_colours() {
    let at = |name, t| Palette::named(name).unwrap().at(t);
    // As their authors publish them.
    assert_eq!(at("viridis", 0.0), [68, 1, 84]);
    assert_eq!(at("viridis", 0.5), [33, 145, 140]);
    assert_eq!(at("viridis", 1.0), [253, 231, 37]);
    assert_eq!(at("magma", 0.0), [0, 0, 4]);
    assert_eq!(at("magma", 1.0), [252, 253, 191]);
    let turbo = [0.0, 0.5, 1.0].map(|t| at("turbo", t));
    for (found, known) in turbo
        .iter()
        .zip([[35, 23, 27], [164, 252, 60], [122, 4, 3]])
    {
        // The polynomial is that near to the table.
        let apart = |i: usize| found[i].abs_diff(known[i]);
        assert!((0..3).all(|i| apart(i) <= 24), "{found:?} {known:?}");
    }
    assert_eq!(PALETTES.len(), 6);
}

#[test]
fn errors_of_labels_and_motion_are_where_they_were_made() {
    let (blocks, found) = blocks();
    let truth = Parts::from(&blocks.truth);
    let params = ViewParams::default();
    let (labels, legend) = view::errors("labels", &found, &truth, &params).unwrap();
    assert_eq!(legend.names, ["right", "wrong"]);
    assert_eq!(hex(labels[(5, 0)]), legend.colours[1]);
    assert_eq!(hex(labels[(5, 20)]), legend.colours[0]);

    let held = ViewParams {
        most: Some(5.0),
        ..params
    };
    let (flow, legend) = view::errors("flow", &found, &truth, &held).unwrap();
    assert_eq!((legend.unit, legend.form), ("px", Form::Ramp));
    assert_eq!(legend.marks.last().unwrap().value, 5.0);
    // 3 and 4 are the sides of a triangle whose longest is 5.
    assert_eq!(&hex(flow[(5, 10)]), legend.colours.last().unwrap());
    assert_eq!(hex(flow[(5, 11)]), legend.colours[0]);
}

#[test]
fn the_error_of_depth_knows_no_scale_of_a_region() {
    let (blocks, _) = blocks();
    let truth = Parts::from(&blocks.truth);
    let held = ViewParams {
        most: Some(50.0),
        ..ViewParams::default()
    };
    let mut found = blocks.truth.scaled(&[1.0, 3.0, 0.5]);
    let at = (0..48 * 64)
        .map(|i| (i % 64, i / 64))
        .find(|&at| {
            let t = &blocks.truth;
            t.labels[at] == 1 && t.occluded[at] == 0 && t.confidence[at] > 0.0
        })
        .unwrap();
    found.depth[at] *= 1.5;
    let (picture, legend) = view::errors("depth", &found, &truth, &held).unwrap();
    assert_eq!(legend.unit, "%");
    assert_eq!(&hex(picture[at]), legend.colours.last().unwrap());
    let wrong = |p: &&[u8; 4]| hex(**p) == *legend.colours.last().unwrap();
    assert_eq!(picture.data().iter().filter(wrong).count(), 1);
    // The ground rests, so its depth cannot be told.
    assert_eq!(picture[(0, 0)][0].abs_diff(picture[(0, 0)][1]), 2);
}

#[test]
fn partial_truth_is_compared_as_far_as_it_goes() {
    let (blocks, found) = blocks();
    let mut truth = Parts {
        flow: Some(blocks.truth.flow.clone()),
        ..Parts::default()
    };
    // KITTI tells flow here and there.
    if let Some(flow) = &mut truth.flow {
        for y in 0..48 {
            flow.u.row_mut(y)[y % 3..]
                .iter_mut()
                .step_by(3)
                .for_each(|u| *u = f32::NAN);
        }
    }
    let params = ViewParams::default();
    let scores = score::compare_found(&found, &truth).unwrap();
    assert!(scores.aee.unwrap() > 0.0 && scores.labels_wrong.is_none());
    let (picture, _) = view::errors("flow", &found, &truth, &params).unwrap();
    assert_eq!(picture.width(), 64);
    let refused = view::errors("depth", &found, &truth, &params).unwrap_err();
    assert!(matches!(refused, Error::NothingShared));
    let drawn = truth.filled(64, 48).unwrap();
    for kind in view::KINDS {
        view::draw(kind, &blocks.frames[0], &drawn, &[], &params).unwrap();
        view::legend(kind, &drawn, &view::same_colours(&drawn, &params)).unwrap();
    }
    let size = truth.filled(32, 48).unwrap_err().to_string();
    assert!(size.contains("64×48") && size.contains("32×48"), "{size}");
    // Depth alone: each region that was found has a scale of its own.
    let depth = Parts {
        depth: Some(blocks.truth.depth.clone()),
        ..Parts::default()
    };
    let scaled = blocks.truth.scaled(&[1.0, 7.0]);
    let scores = score::compare_found(&scaled, &depth).unwrap();
    assert!(scores.depth_error.iter().all(|e| e.unwrap() < 1e-6));
    let aligned = view::aligned(&scaled, &depth).unwrap();
    assert!((aligned.depth[(27, 20)] / blocks.truth.depth[(27, 20)] - 1.0).abs() < 1e-5);
}

#[test]
fn the_residual_is_in_grey_levels_and_small_under_the_truth() {
    let (blocks, _) = blocks();
    let [first, second] = blocks.frames.clone();
    let pair = FramePair::new(first, second).unwrap();
    let range = |found: &Interpretation| {
        let (_, legend) = view::residuals(&pair, found, &ViewParams::default()).unwrap();
        assert_eq!(legend.unit, "grey levels");
        legend.marks.last().unwrap().value
    };
    let mut still = blocks.truth.clone();
    still.flow.u.data_mut().fill(0.0);
    still.flow.v.data_mut().fill(0.0);
    assert!(range(&blocks.truth) < 0.8 * range(&still));
}
