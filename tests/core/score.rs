//! Scores against numbers worked out by hand.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use glam::DVec3;
use relievo::file::parts::Parts;
use relievo::score::{compare, compare_flow, compare_known};
use relievo::{Camera, Error, Flow, Grid, Interpretation, RigidMotion};

/// 4×2 pixels, the right half region 1, flow (1, 0), Z = 2 on the left and 1, 3 by rows on the right.
fn truth() -> Interpretation {
    let labels = Grid::from_fn(4, 2, |x, _| u8::from(x >= 2));
    Interpretation {
        camera: Camera::centred(4.0, 4, 2).unwrap(),
        depth: Grid::from_fn(4, 2, |x, y| match (x >= 2, y) {
            (false, _) => 2.0,
            (true, 0) => 1.0,
            (true, _) => 3.0,
        }),
        labels,
        flow: Flow {
            u: Grid::new(4, 2, 1.0),
            v: Grid::new(4, 2, 0.0),
        },
        confidence: Grid::new(4, 2, 1.0),
        occluded: Grid::new(4, 2, 0),
        motions: vec![
            RigidMotion::default(),
            RigidMotion {
                translation: DVec3::new(1.0, 0.0, 0.0),
                rotation: DVec3::new(0.0, 0.01, 0.0),
            },
        ],
    }
}

fn near(a: Option<f64>, b: f64) {
    let a = a.expect("a score");
    assert!((a - b).abs() < 1e-6, "{a} is not {b}");
}

#[test]
fn the_truth_scores_perfectly_whatever_the_scale_of_a_region() {
    let scores = compare(&truth().scaled(&[3.0, 0.25]), &truth()).unwrap();
    near(scores.aee, 0.0);
    near(scores.aae, 0.0);
    assert_eq!(scores.labels_wrong, 0.0);
    assert_eq!(scores.iou, [Some(1.0), Some(1.0)]);
    near(scores.depth_error[0], 0.0);
    near(scores.depth_error[1], 0.0);
    assert_eq!(
        scores.translation_angle[0], None,
        "nothing to compare at rest"
    );
    near(scores.translation_angle[1], 0.0);
    near(scores.rotation_error[1], 0.0);
}

#[test]
fn errors_of_known_size_are_measured_as_such() {
    let mut found = truth();
    // A quarter of the flow off by (0, 1): AEE 1/4; the angle between (1, 1, 1) and (1, 0, 1) has
    // cosine 2/√6, 35.26439°; AAE a quarter of that.
    found.flow.v[(0, 0)] = 1.0;
    found.flow.v[(3, 1)] = 1.0;
    // One of eight labels wrong: region 0 has 3 of 4, region 1 has 4 of 5.
    found.labels[(1, 0)] = 1;
    found.motions[1].translation = DVec3::new(0.0, 5.0, 0.0);
    found.motions[1].rotation = DVec3::new(0.0, 0.01, 0.02);
    // Constant depth in region 1, whose Z is 1, 1, 3, 3: a = 2, errors |2−1|/1 twice, |2−3|/3 twice.
    for x in 2..4 {
        for y in 0..2 {
            found.depth[(x, y)] = 7.0;
        }
    }
    let scores = compare(&found, &truth()).unwrap();
    near(scores.aee, 0.25);
    near(scores.aae, 35.264_389_682 / 4.0);
    assert_eq!(scores.labels_wrong, 0.125);
    assert_eq!(scores.iou, [Some(0.75), Some(0.8)]);
    near(scores.depth_error[1], 2.0 / 3.0);
    near(scores.flat_depth_error[1], 2.0 / 3.0);
    near(scores.translation_angle[1], 90.0);
    near(scores.rotation_error[1], 0.02);
}

#[test]
fn what_cannot_be_known_is_left_out() {
    let mut truth = truth();
    let mut found = truth.clone();
    truth.flow.u[(0, 0)] = f32::NAN;
    found.flow.u[(0, 0)] = 99.0;
    found.depth[(2, 0)] = 50.0;
    truth.occluded[(2, 0)] = 1;
    for y in 0..2 {
        truth.confidence[(0, y)] = 0.0;
        truth.confidence[(1, y)] = 0.0;
    }
    let scores = compare(&found, &truth).unwrap();
    near(scores.aee, 0.0);
    near(scores.depth_error[1], 0.0);
    assert_eq!(scores.depth_error[0], None);
    assert_eq!(scores.flat_depth_error[0], None);
}

#[test]
fn regions_and_motions_may_be_missing() {
    let mut found = truth();
    found.motions.truncate(1);
    found.labels = Grid::new(4, 2, 0);
    found.flow.u = Grid::new(4, 2, f32::NAN);
    let scores = compare(&found, &truth()).unwrap();
    assert_eq!(scores.iou, [Some(0.5), Some(0.0)]);
    assert_eq!(scores.translation_angle[1], None);
    assert_eq!(scores.rotation_error[1], None);
    // Flow that was not found counts as no motion.
    near(scores.aee, 1.0);
    near(scores.aae, 45.0);
}

#[test]
fn a_mask_restricts_the_flow_and_sizes_must_agree() {
    let mut found = truth().flow;
    found.u[(0, 0)] = 3.0;
    let mut mask = Grid::new(4, 2, 0);
    assert_eq!(
        compare_flow(&found, &truth().flow, Some(&mask)).unwrap(),
        None
    );
    mask[(0, 0)] = 1;
    let (aee, _) = compare_flow(&found, &truth().flow, Some(&mask))
        .unwrap()
        .unwrap();
    assert_eq!(aee, 2.0);
    let small = Flow {
        u: Grid::new(2, 2, 0.0),
        v: Grid::new(2, 2, 0.0),
    };
    assert!(compare_flow(&small, &truth().flow, None).is_err());
}

#[test]
fn scores_are_one_flat_json_object() {
    let json = serde_json::to_value(compare(&truth(), &truth()).unwrap()).unwrap();
    for key in [
        "aee",
        "aae",
        "labels_wrong",
        "iou",
        "depth_error",
        "flat_depth_error",
    ] {
        assert!(json.get(key).is_some(), "{key} is missing");
    }
    assert!(json["translation_angle"][0].is_null());
}

#[test]
fn depth_that_was_not_found_counts_as_off_by_all_of_it() {
    let mut found = truth();
    for (x, none) in [(0, f32::NAN), (1, 0.0)] {
        found.depth[(x, 0)] = none;
    }
    let error = compare(&found, &truth()).unwrap().depth_error[0];
    near(error, 0.5);
    found.depth = found.depth.map(|_| f32::INFINITY);
    let error = compare(&found, &truth()).unwrap().depth_error[0];
    near(error, 1.0);
}

#[test]
fn flow_alone_is_scored_where_both_know_it() {
    let flow = |u: f32| Flow {
        u: Grid::from_fn(5, 4, |x, _| if x == 0 { f32::NAN } else { u }),
        v: Grid::new(5, 4, 0.0),
    };
    let [found, known] = [2.5, 2.0].map(|u| Parts {
        flow: Some(flow(u)),
        ..Parts::default()
    });
    let scores = compare_known(&found, &known).unwrap();
    near(scores.aee, 0.5);
    assert_eq!((scores.labels_wrong, scores.iou), (None, vec![None]));
    // Labels of only one of the two are not compared.
    let all = Parts::from(&truth());
    assert_eq!(
        compare_known(
            &found,
            &Parts {
                flow: None,
                ..all.clone()
            }
        ),
        Err(Error::NothingShared)
    );
    let labels = Parts {
        labels: all.labels.clone(),
        ..Parts::default()
    };
    let scores = compare_known(&labels, &all).unwrap();
    assert_eq!((scores.labels_wrong, scores.aee), (Some(0.0), None));
    assert_eq!(scores.iou, [Some(1.0), Some(1.0)]);
    assert_eq!(scores.depth_error, [None, None]);
}

#[test]
fn depth_without_labels_is_one_region() {
    let depth = |factor: f32| Parts {
        depth: Some(Grid::from_fn(6, 5, |x, y| factor * (1.0 + (x + y) as f32))),
        ..Parts::default()
    };
    let scores = compare_known(&depth(3.0), &depth(1.0)).unwrap();
    assert_eq!(scores.depth_error.len(), 1);
    near(scores.depth_error[0], 0.0);
}
