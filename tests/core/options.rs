//! The list of options, their defaults, and their way through JSON.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use std::collections::BTreeSet;

use relievo::options::{Control, Options, Preset, catalogue};
use relievo::{Error, Frame, FramePair, Grid, Solver};
use serde_json::{Map, Value, json};

fn fields(options: &Options) -> Map<String, Value> {
    match serde_json::to_value(options) {
        Ok(Value::Object(map)) => map,
        other => panic!("{other:?}"),
    }
}

fn word(preset: Preset) -> Value {
    serde_json::to_value(preset).unwrap()
}

fn read(json: &Value) -> Result<Options, Error> {
    Options::from_json(&json.to_string())
}

#[test]
fn every_setting_is_described_once_and_nothing_else_is() {
    for &preset in Preset::ALL {
        let mut settings: BTreeSet<String> = fields(&Options::preset(preset))
            .into_iter()
            .map(|f| f.0)
            .collect();
        assert!(settings.remove("preset"));
        let described: Vec<String> = catalogue().iter().map(|d| d.key.to_owned()).collect();
        let set: BTreeSet<String> = described.iter().cloned().collect();
        assert_eq!(set.len(), described.len(), "a key is described twice");
        assert_eq!(set, settings);
    }
}

#[test]
fn descriptions_are_complete() {
    for d in catalogue() {
        assert!(!d.label.is_empty() && !d.term.is_empty(), "{}", d.key);
        assert!(d.meaning.ends_with('.'), "{}", d.key);
        assert!(d.key.chars().all(|c| c.is_ascii_lowercase() || c == '_'));
        match d.control {
            Control::Number { min, max, .. } | Control::Integer { min, max } => {
                assert!(min.is_finite() && max.is_finite() && min < max, "{}", d.key);
            }
            Control::Choice { choices } => {
                let words: BTreeSet<_> = choices.iter().map(|c| c.value).collect();
                assert!(!words.is_empty() && words.len() == choices.len());
                assert!(choices.iter().all(|c| !c.label.is_empty()));
            }
            Control::Toggle => {}
        }
    }
}

#[test]
fn defaults_are_valid_and_the_first_preset_is_the_default() {
    for &preset in Preset::ALL {
        let options = Options::preset(preset);
        assert_eq!(options.validate(), Ok(()));
        assert_eq!(options.preset, preset);
        assert!(!preset.label().is_empty());
        assert_eq!(read(&json!({ "preset": word(preset) })), Ok(options));
    }
    assert_eq!(Preset::ALL[0], Preset::default());
    assert_eq!(word(Preset::default()), "best");
    assert_eq!(Options::default(), Options::preset(Preset::default()));
    assert_eq!(read(&json!({})), Ok(Options::default()));
}

/// Another value that the option may have than `now`.
fn other(control: Control, now: &Value) -> Option<Value> {
    match control {
        Control::Number { min, max, .. } => {
            let middle = min + 0.25 * (max - min);
            Some(json!(if now.as_f64() == Some(middle) {
                max
            } else {
                middle
            }))
        }
        Control::Integer { min, max } => {
            let value = if now.as_f64() == Some(max) { min } else { max };
            Some(json!(value as u64))
        }
        Control::Choice { choices } => {
            let other = choices.iter().find(|c| now.as_str() != Some(c.value))?;
            Some(json!(other.value))
        }
        Control::Toggle => Some(json!(!now.as_bool()?)),
    }
}

#[test]
fn settings_return_from_json_as_they_were() {
    for &preset in Preset::ALL {
        let defaults = Options::preset(preset);
        assert_eq!(
            read(&Value::Object(fields(&defaults))),
            Ok(defaults.clone())
        );
        for d in catalogue() {
            let Some(value) = other(d.control, &fields(&defaults)[d.key]) else {
                continue;
            };
            let given = json!({ "preset": word(preset), d.key: value });
            let options = read(&given).expect(d.key);
            assert_ne!(options, defaults, "{} did nothing", d.key);
            assert_eq!(fields(&options)[d.key], value, "{}", d.key);
            // And nothing else changed.
            let mut rest = fields(&options);
            rest.insert(d.key.to_owned(), fields(&defaults)[d.key].clone());
            assert_eq!(rest, fields(&defaults), "{} changed more", d.key);
            assert_eq!(read(&Value::Object(fields(&options))), Ok(options));
        }
    }
}

#[test]
fn only_what_can_be_chosen_from_the_data_may_be_null() {
    let mut automatic = BTreeSet::new();
    for d in catalogue() {
        let result = read(&json!({ d.key: null }));
        if matches!(
            d.control,
            Control::Number {
                automatic: true,
                ..
            }
        ) {
            automatic.insert(d.key);
            assert!(fields(&result.expect(d.key))[d.key].is_null());
        } else {
            let error = result.expect_err(d.key).to_string();
            assert!(error.contains("null") && error.contains(d.key), "{error}");
        }
    }
    assert!(automatic.contains("mu") && automatic.contains("lambda"));
}

#[test]
fn numbers_outside_their_range_are_refused_with_the_range() {
    for d in catalogue() {
        let (Control::Number { min, max, .. } | Control::Integer { min, max }) = d.control else {
            continue;
        };
        let whole = matches!(d.control, Control::Integer { .. });
        for bound in [min, max] {
            let bound = if whole {
                json!(bound as u64)
            } else {
                json!(bound)
            };
            assert!(
                read(&json!({ d.key: bound })).is_ok(),
                "{} = {bound}",
                d.key
            );
        }
        let mut bad = vec![
            json!(min - 1.0),
            json!(max * 1.01 + 1.0),
            json!(1e300),
            json!(-1e300),
        ];
        bad.extend([json!("7"), json!(true), json!([1]), json!({})]);
        if whole {
            bad.push(json!(min + 0.5));
        }
        for value in bad {
            let (key, value_text) = (d.key.to_owned(), value.to_string());
            let expected = if whole {
                Error::Count {
                    key,
                    value: value_text,
                    min,
                    max,
                }
            } else {
                Error::Option {
                    key,
                    value: value_text,
                    min,
                    max,
                }
            };
            let sentence = expected.to_string();
            assert_eq!(read(&json!({ d.key: value })), Err(expected));
            for part in [d.key.to_owned(), min.to_string(), max.to_string()] {
                assert!(sentence.contains(&part), "{sentence}");
            }
        }
    }
}

#[test]
fn words_that_are_no_choice_are_refused_with_the_choices() {
    for d in catalogue() {
        if let Control::Choice { choices } = d.control {
            for value in [json!("nonsense"), json!(3), json!(false), json!("")] {
                let error = read(&json!({ d.key: value })).expect_err(d.key);
                assert!(matches!(error, Error::Choice { .. }));
                for choice in choices {
                    assert!(error.to_string().contains(choice.value), "{error}");
                }
            }
        }
    }
    for &preset in Preset::ALL {
        let error = read(&json!({ "preset": "printed" })).unwrap_err();
        assert!(matches!(error, Error::Choice { .. }));
        assert!(
            error.to_string().contains(word(preset).as_str().unwrap()),
            "{error}"
        );
    }
}

#[test]
fn keys_that_do_not_exist_are_refused_with_those_that_do() {
    for key in ["Mu", "mu ", "", "smoothness"] {
        let error = read(&json!({ key: 1.0 })).unwrap_err();
        let Error::Choice { value, choices, .. } = &error else {
            panic!("{error}");
        };
        assert_eq!(value, key);
        assert!(
            catalogue().iter().all(|d| choices.contains(d.key)),
            "{error}"
        );
    }
}

#[test]
fn what_is_no_json_object_is_refused() {
    // JSON has no NaN, and whatever JavaScript's becomes is null.
    for text in [
        "",
        "{",
        "[]",
        "7",
        "null",
        "\"best\"",
        "{\"mu\": NaN}",
        "{\"mu\": 1e999}",
        "{\"mu\": Infinity}",
    ] {
        let error = Options::from_json(text).unwrap_err();
        assert!(
            matches!(
                error,
                Error::Json {
                    what: "options",
                    ..
                }
            ),
            "{error}"
        );
        assert!(error.to_string().contains("options"), "{error}");
    }
}

#[test]
fn numbers_that_are_none_are_refused_by_the_solver() {
    let frame = |shift: f32| {
        let wave = |x, y| 99.0 + 50.0 * (0.4 * (x as f32 - shift) + 0.3 * y as f32).sin();
        Frame::from_grey(Grid::from_fn(32, 24, wave)).unwrap()
    };
    let pair = FramePair::new(frame(0.0), frame(0.5)).unwrap();
    let camera = relievo::Camera::centred(32.0, 32, 24).unwrap();
    let start = |options| Solver::new(pair.clone(), camera, &[], options);
    type Change = fn(&mut Options, f64);
    let changes: [(&str, Change); 6] = [
        ("mu", |o, v| o.mu = Some(v)),
        ("lambda", |o, v| o.lambda = Some(v)),
        ("epsilon", |o, v| o.epsilon = v),
        ("smoothing", |o, v| o.smoothing = v),
        ("rotation_ridge", |o, v| o.rotation_ridge = v),
        ("tolerance", |o, v| o.tolerance = v),
    ];
    for (key, change) in changes {
        for value in [f64::NAN, f64::INFINITY, -1.0, 1e12] {
            let mut options = Options::default();
            change(&mut options, value);
            let at_start = start(options.clone()).err();
            assert!(
                matches!(&at_start, Some(Error::Option { key: k, .. }) if k == key),
                "{key} = {value}: {at_start:?}"
            );
            let mut solver = start(Options::default()).unwrap();
            assert_eq!(solver.set_options(options).err(), at_start);
            assert_eq!(*solver.options(), Options::default());
        }
    }
}
