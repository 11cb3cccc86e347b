// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall litter`, and scenes with living litter, in use.

use serde_json::Value;

use crate::common_cli::{assert_refused, file, folder, windfall};

/// A small bed in a fresh breeze, and leaves that fall on it.
const SCENE: &str = "(
    species: [(name: \"leaf\", size_m: 0.06)],
    sources: [(shape: Box(center_m: (0.0, 2.0, 0.0), half_extent_m: (1.0, 1.0, 1.0)), count: 200,
        release: Rate(per_s: 60.0, from_s: -2.0), recycle_after_s: 5.0)],
    wind: (speed: MetresPerSecond(6.0), gusts: (strength: 0.5)),
    ground: (litter: Some((size_m: (8.0, 6.0), leaf_area_index: 0.2))),
)";

#[test]
fn a_tunnel_finds_who_moves_in_which_wind() {
    let there = folder();
    let arguments = ["litter", "--leaves", "300", "--seconds", "20", "--ground", "pavement,lawn"];
    let more = ["--u10", "1..8/3", "--out", "onset.png", "--json"];
    let json = windfall(&there, &[&arguments[..], &more].concat()).json();
    let points = json["points"].as_array().expect("points");
    assert_eq!(points.len(), 6, "three winds on two grounds");
    let number = |point: &Value, key: &str| point[key].as_f64().expect("a number");
    for ground in points.chunks(3) {
        let moved: Vec<f64> = ground.iter().map(|point| number(point, "moved_share")).collect();
        assert!(moved[0] == 0.0 && moved.is_sorted(), "{moved:?}");
    }
    let [paved, lawn] = [&points[2], &points[5]];
    assert!(
        paved["ground"] == "pavement" && lawn["ground"] == "lawn" && paved["species"] == "beech",
        "{json}"
    );
    assert!(number(paved, "moved_share") > 0.9, "a fresh breeze sweeps the pavement: {paved}");
    assert!(number(paved, "mean_speed_m_s") > 1.9 * number(lawn, "mean_speed_m_s"), "{paved} {lawn}");
    assert!(number(paved, "hops_per_leaf") > 0.5 && number(paved, "mean_hop_m") > 0.1, "{paved}");
    assert!((0.001..1.0).contains(&number(paved, "airborne_share")), "{paved}");
    let picture = std::fs::read(there.path().join("onset.png")).expect("a picture");
    let picture = image::load_from_memory(&picture).expect("a PNG").to_rgb8();
    assert_eq!(picture.dimensions(), (1600, 1000), "its size");
    let text = windfall(&there, &["litter", "--leaves", "20", "--seconds", "1", "--u10", "3"]).text();
    assert!(text.contains("moved %") && text.contains("beech") && text.lines().count() == 2, "{text}");
}

#[test]
fn reports_count_what_lies() {
    let there = folder();
    file(&there, "bed.ron", SCENE);
    let arguments = ["simulate", "bed.ron", "--steps", "300", "--backend", "cpu"];
    let json = windfall(&there, &[&arguments[..], &["--json"]].concat()).json();
    let litter = &json["litter"];
    let number = |key: &str| litter[key].as_f64().expect("a number");
    assert!(number("lying") > 50.0 && number("woken") > 20.0 && number("awake") > 0.0, "{litter}");
    assert!(
        number("lying") + number("awake") <= json["leaves"]["total"].as_f64().expect("a number"),
        "{json}"
    );
    let packed = number("mass_kg") / number("volume_m3");
    assert!((packed - 12.2).abs() < 0.2, "the bulk density that the scene states: {packed} kg/m³");
    assert!(number("deepest_m") > 0.0 && number("deepest_m") < 0.05, "{litter}");
    let text = windfall(&there, &arguments).text();
    assert!(text.contains("lying") && text.contains("woken"), "{text}");
    let none = windfall(&there, &["simulate", "storm", "--leaves", "50", "--steps", "2", "--json"]).json();
    assert!(none["litter"].is_null(), "{none}");
}

#[test]
fn litter_goes_on_from_a_checkpoint_with_the_same_bits() {
    let there = folder();
    file(&there, "bed.ron", SCENE);
    let run = |arguments: &[&str]| {
        let all = [&["simulate"], arguments, &["--backend", "cpu", "--json"]].concat();
        windfall(&there, &all).json()["state_hash"].clone()
    };
    let whole = run(&["bed.ron", "--steps", "260"]);
    run(&["bed.ron", "--steps", "130", "--checkpoint", "half.ckpt"]);
    assert_eq!(run(&["--resume", "half.ckpt", "--steps", "130"]), whole, "in the middle of a gust");
}

#[test]
fn living_litter_does_not_repeat_and_still_litter_does() {
    let there = folder();
    file(&there, "bed.ron", SCENE);
    let clip = ["--loop", "2", "--fps", "5", "--size", "64x36", "--out", "x.gif"];
    let refused = [&["render", "bed.ron"], &clip[..]].concat();
    assert_refused(&there, &refused, &["bed.ron: ground.litter.still is false", "in a loop"]);
    file(&there, "still.ron", SCENE.replace("leaf_area_index: 0.2", "leaf_area_index: 0.2, still: true"));
    let outcome = windfall(&there, &[&["render", "still.ron"], &clip[..]].concat());
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
}

/// Leaves of a scene that burn are counted and weighed, on both backends alike; those of others are not.
#[test]
fn burning_leaves_are_in_the_report() {
    let there = folder();
    let arguments = ["simulate", "burning-leaves", "--steps", "300"];
    let both = ["cpu", "wgpu"].map(|backend| {
        windfall(&there, &[&arguments[..], &["--json", "--backend", backend]].concat()).json()
    });
    let burning = &both[0]["burning"];
    assert_eq!(burning, &both[1]["burning"], "the same leaves burn");
    let number = |key: &str| burning[key].as_f64().expect("a number");
    assert!(number("burning") > 10.0 && number("power_kw") > 1.0, "{burning}");
    let heat_mj = number("gone_kg") * 16.0;
    assert!((number("heat_mj") / heat_mj - 1.0).abs() < 0.05, "16 to 16.5 MJ/kg: {burning}");
    let text = windfall(&there, &arguments).text();
    assert!(text.contains("burnt") && text.contains("kg of ash"), "{text}");
    let none = windfall(&there, &["simulate", "heap", "--leaves", "50", "--steps", "2", "--json"]).json();
    assert!(none["burning"].is_null(), "{none}");
}
