// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shards of a scene, worked on apart and put together: what they write is what one run writes.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::common_cli::{assert_refused, file, folder, windfall};

/// Runs the program, which must end well, and returns what it says.
fn run(there: &TempDir, arguments: &[&str]) -> String {
    windfall(there, arguments).text()
}

/// The object in a file.
fn report(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).expect("written")).expect("an object")
}

/// Runs `words` for every one of three shards, with these words besides for the second.
fn in_three(there: &TempDir, words: &[&str], second: &[&str]) {
    for number in 1..=3 {
        let shard = format!("{number}/3");
        let own = if number == 2 { second } else { &[] };
        run(there, &[words, &["--shard", &shard], own].concat());
    }
}

#[test]
fn shards_of_a_simulation_are_put_together() {
    let there = folder();
    let at = |name: &str| there.path().join(name);
    let words = ["simulate", "forest", "--leaves", "3000", "--steps", "40", "--backend", "cpu"];
    let tracked = [&words[..], &["--track-every", "20", "--track-leaves", "2500"]].concat();
    run(&there, &[&tracked[..], &["--report", "one.json", "--tracks", "one.csv"]].concat());
    fs::create_dir(at("parts")).expect("writable");
    let parts =
        ["--report", "parts/fall.json", "--tracks", "parts/fall.csv", "--checkpoint", "parts/fall.state"];
    in_three(&there, &[&tracked[..], &parts].concat(), &["--threads", "1"]);
    let said = run(&there, &["merge", "parts", "--json"]);
    let (one, whole) = (report(&at("one.json")), report(&at("parts/fall.json")));
    assert_eq!(serde_json::from_str::<Value>(&said).expect("an object"), whole, "printed and written");
    for key in ["state_hash", "leaves", "trees", "seed", "steps", "time_s", "particles", "run", "scene"] {
        assert_eq!(one[key], whole[key], "{key}");
    }
    assert!(whole["trees"]["segments"].as_u64() > Some(1000), "trees are among them: {whole}");
    for (key, axis) in [("mean_position_m", 0), ("mean_velocity_m_s", 1)] {
        let of = |report: &Value| report[key][axis].as_f64().expect("a number");
        assert!((of(&one) - of(&whole)).abs() < 1e-6, "{key}");
    }
    let text = |name: &str| fs::read(at(name)).expect("written");
    assert!(text("one.csv") == text("parts/fall.csv"), "tables of tracks are equal to the byte");
    assert!(!at("parts/fall.state").exists(), "states stay apart");
    // A shard is gone on with from its own state.
    let state = "parts/fall.shard-2-of-3.state";
    let longer = run(&there, &["simulate", "--resume", state, "--steps", "20", "--json"]);
    let unbroken =
        run(&there, &["simulate", "forest", "--leaves", "3000", "--steps", "60", "--shard", "2/3", "--json"]);
    let hash = |text: &str| serde_json::from_str::<Value>(text).expect("an object")["state_hash"].clone();
    assert_eq!(hash(&longer), hash(&unbroken), "resumed");

    run(&there, &[&words[..], &["--seed", "5", "--shard", "3/3", "--report", "parts/fall.json"]].concat());
    assert_refused(
        &there,
        &["merge", "parts"],
        &["fall.shard-3-of-3.json: is of another run", "other scene"],
    );
    fs::remove_file(at("parts/fall.shard-3-of-3.json")).expect("it is there");
    assert_refused(&there, &["merge", "parts"], &["fall.shard-3-of-3.json: is missing"]);
    assert_eq!(report(&at("parts/fall.json")), whole, "what is there stays");
}

#[test]
fn shards_of_an_export_are_put_together() {
    let there = folder();
    let text = |name: &str| fs::read(there.path().join(name)).expect("written");
    let words = ["export", "pollen", "--leaves", "900", "--frames", "0..3"];
    run(&there, &[&words[..], &["--out", "one.csv"]].concat());
    fs::create_dir(there.path().join("parts")).expect("writable");
    in_three(&there, &[&words[..], &["--out", "parts/fall.csv"]].concat(), &[]);
    run(&there, &["merge", "parts"]);
    assert!(text("one.csv") == text("parts/fall.csv"), "leaves are equal to the byte");
    assert!(text("one_particles.csv") == text("parts/fall_particles.csv"), "particles are equal to the byte");
    assert!(text("one.csv").len() > 100_000, "rows of leaves");
}

#[test]
fn stages_of_shards_lie_side_by_side() {
    let there = folder();
    let text = |name: &str| fs::read_to_string(there.path().join(name)).expect("written");
    let scene = "(species: [(name: \"maple\")], tree_kinds: [(name: \"t\", form: Preset(Bush))],
        trees: [(kind: \"t\", at_m: (0.0, 0.0), leaves: 40), (kind: \"t\", at_m: (4.0, 0.0), leaves: 40)],
        sources: [(count: 100)])";
    file(&there, "scene.ron", scene);
    in_three(&there, &["export", "scene.ron", "--frames", "0..2", "--out", "fall.usda"], &[]);
    run(&there, &["merge", "."]);
    let root = text("fall.usda");
    let mut slots = 0;
    for number in 1..=3 {
        assert!(root.contains(&format!("@./fall.shard-{number}-of-3.usda@")), "{root}");
        let samples = text(&format!("fall.shard-{number}-of-3_layers/frames_00000.usda"));
        assert!(samples.contains(&format!("over \"Leaves_{number}\"")), "prims of their own");
        let ids = samples.split("int64[] ids.timeSamples = {\n0: [").nth(1).expect("numbers of leaves");
        slots += ids.split(']').next().expect("a list").split(',').filter(|id| !id.is_empty()).count();
    }
    assert_eq!(slots, 180, "every leaf is in one of them");
}

#[test]
fn a_study_is_shared() {
    let there = folder();
    let words =
        ["study", "storm", "--vary", "wind.speed=0..4/5", "--drops", "40", "--over", "1", "--tracks", "0"];
    run(&there, &[&words[..], &["--out", "one"]].concat());
    for share in ["2/2", "1/2"] {
        run(&there, &[&words[..], &["--out", "shared", "--share", share]].concat());
        assert!(!there.path().join("shared/summary.csv").exists(), "a share is not the whole");
    }
    let points = || fs::read_dir(there.path().join("shared")).expect("a folder").flatten();
    assert_eq!(points().filter(|entry| entry.path().is_dir()).count(), 5, "all points");
    run(&there, &[&words[..], &["--out", "shared"]].concat());
    let text = |name: &str| fs::read(there.path().join(name)).expect("written");
    assert_eq!(text("one/summary.csv"), text("shared/summary.csv"), "the same table");
}

#[test]
fn what_cannot_be_divided_is_refused() {
    let there = folder();
    assert_refused(&there, &["simulate", "square", "--shard", "1/2"], &["square: ground.litter", "share"]);
    assert_refused(
        &there,
        &["export", "heap", "--frames", "0..1", "--out", "a.csv", "--shard", "1/2"],
        &["ground.litter"],
    );
    for shard in ["0/2", "3/2", "2", "x/2"] {
        assert_refused(&there, &["simulate", "storm", "--shard", shard], &["--shard", "K/N"]);
    }
    assert_refused(&there, &["simulate", "storm", "--leaves", "5", "--shard", "6/6"], &["at most 5 shards"]);
    assert_refused(
        &there,
        &["export", "storm", "--frames", "0..1", "--out", "a.glb", "--shard", "1/2"],
        &["usd and csv"],
    );
    assert_refused(
        &there,
        &["simulate", "storm", "--report", "a.json", "--tracks", "a.json"],
        &["a.json: named by --tracks and --report"],
    );
    assert_refused(&there, &["merge", "."], &["holds no files of shards"]);
}
