// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall drift` in use.

use serde_json::Value;

use crate::common_cli::{assert_refused, folder, windfall};

#[test]
fn a_fence_keeps_snow_as_the_storm_blows() {
    let there = folder();
    let arguments = ["drift", "--height", "0.3", "--u10", "25", "--hours", "4", "--reports", "2"];
    let json = windfall(&there, &[&arguments[..], &["--out", "drift.png", "--json"]].concat()).json();
    let drifts = json["drifts"].as_array().expect("drifts");
    let numbers = |key: &str| -> Vec<f64> {
        drifts.iter().map(|drift| drift[key].as_f64().expect("a number")).collect()
    };
    assert_eq!(numbers("hours"), [2.0, 4.0], "{json}");
    let [sections, deepest] = [numbers("section"), numbers("deepest")];
    assert!(
        sections[1] > 6.0 && deepest.iter().all(|depth| (0.7..1.25).contains(depth)),
        "{sections:?} {deepest:?}"
    );
    assert!(numbers("length")[1] > 8.0, "{:?}", numbers("length"));
    let profile = drifts[1]["profile"].as_array().map(Vec::len);
    assert_eq!(profile, Some(180), "150 heights in pairs of cells");
    let picture = std::fs::read(there.path().join("drift.png")).expect("a picture");
    let picture = image::load_from_memory(&picture).expect("a PNG").to_rgb8();
    assert_eq!(picture.dimensions(), (1600, 760), "its size");
    let calm = windfall(&there, &["drift", "--height", "0.3", "--u10", "7", "--hours", "1", "--json"]).json();
    let section = |json: &Value| json["drifts"][0]["section_before"].as_f64().expect("a number");
    assert!(section(&calm) < 0.05 && section(&json) > 0.5, "nothing drifts in a breeze: {}", section(&calm));
}

#[test]
fn fences_out_of_range_are_refused() {
    let there = folder();
    for (option, value, allowed) in [
        ("--height", "0.2", "0.3 to 3"),
        ("--open", "1", "0 to 0.9"),
        ("--u10", "4", "5 to 40"),
        ("--air", "1", "-30 to 0"),
        ("--hours", "0.5", "1 to 96"),
    ] {
        assert_refused(&there, &["drift", option, value], &[option, allowed]);
    }
}
