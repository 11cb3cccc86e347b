// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall simulate` in use: report, checkpoints, tracks.

use std::fs;
use std::io::Read as _;
use std::process::Stdio;

use crate::common_cli::{command, contents, file, folder, windfall};
use serde_json::Value;
use windfall_core::{Scene, World};
use windfall_tests::strategies::wooded_scene;

/// Keys of the report, in their order. They stay.
const KEYS: [&str; 19] = [
    "scene",
    "backend",
    "adapter",
    "contract",
    "seed",
    "steps",
    "time_s",
    "leaves",
    "trees",
    "litter",
    "burning",
    "snow",
    "particles",
    "mean_position_m",
    "mean_velocity_m_s",
    "state_hash",
    "leaf_steps_per_s",
    "cpu_s",
    "bytes_per_leaf",
];
const BACKENDS: [&str; 2] = ["cpu", "wgpu"];

fn simulate(arguments: &[&str]) -> Value {
    let all: Vec<_> = ["simulate", "--json"].iter().chain(arguments).copied().collect();
    windfall(&folder(), &all).json()
}

#[test]
fn the_report_has_its_keys_and_they_add_up() {
    for backend in BACKENDS {
        let report = simulate(&["--steps", "90", "--leaves", "700", "--backend", backend]);
        let object = report.as_object().expect("an object");
        assert_eq!(object.len(), KEYS.len(), "no more keys than known: {report}");
        for key in KEYS {
            assert!(object.contains_key(key), "{key} is missing in {report}");
        }
        assert_eq!(report["scene"], "autumn-park", "the default scene");
        assert_eq!(report["backend"], backend, "as asked for");
        assert_eq!(report["seed"], 20, "of the scene");
        assert_eq!(report["steps"], 90, "as asked for");
        let time_s = report["time_s"].as_f64().expect("a number");
        assert!((time_s - 1.5).abs() < 1e-6, "{time_s} simulated seconds");
        let leaves = |key: &str| report["leaves"][key].as_u64().expect("a whole number");
        assert_eq!(leaves("total"), leaves("attached") + leaves("falling") + leaves("resting"), "{report}");
        assert_eq!(leaves("total") + leaves("dormant"), 700, "every leaf is something: {report}");
        assert!(leaves("falling") > 0 && leaves("resting") > 0, "a park in autumn: {report}");
        for key in ["mean_position_m", "mean_velocity_m_s"] {
            let vector = report[key].as_array().expect("a vector");
            assert!(vector.len() == 3 && vector.iter().all(Value::is_f64), "{key}: {report}");
        }
        let down = report["mean_velocity_m_s"][1].as_f64().expect("a number");
        assert!((-2.0..0.0).contains(&down), "leaves fall: {down} m/s");
        let hash = report["state_hash"].as_str().expect("text");
        assert!(hash.len() == 16 && u64::from_str_radix(hash, 16).is_ok(), "{hash}");
        assert!(report["leaf_steps_per_s"].as_f64().expect("a number") > 0.0, "{report}");
        assert!(report["cpu_s"].as_f64().expect("a number") > 0.0, "{report}");
        assert_eq!(report["bytes_per_leaf"], 88, "five columns of 16 bytes and one of 8");
    }
}

#[test]
fn backends_and_threads_agree_to_the_bit() {
    let reports: Vec<_> = [&["--threads", "1"], &["--threads", "3"], &["--backend", "wgpu"]]
        .iter()
        .map(|backend| {
            let arguments = ["storm", "--steps", "100", "--leaves", "5000", "--seed", "9"];
            simulate(&[&arguments[..], &backend[..]].concat())
        })
        .collect();
    assert_eq!(reports[0]["adapter"], "1 thread", "as asked for");
    assert_eq!(reports[0]["state_hash"], reports[1]["state_hash"], "one thread and three");
    assert_eq!(reports[0]["mean_position_m"], reports[1]["mean_position_m"], "one thread and three");
    if reports[2]["contract"] == "exact" {
        assert_eq!(reports[0]["state_hash"], reports[2]["state_hash"], "both backends");
    }
    let other = simulate(&["storm", "--steps", "100", "--leaves", "5000", "--seed", "10", "--threads", "1"]);
    assert_ne!(reports[0]["state_hash"], other["state_hash"], "another seed");
}

#[test]
fn both_backends_report_the_same_trees() {
    let there = folder();
    let mut scene = wooded_scene(7, 300, 14.0, 1.0 / 60.0);
    scene.trees.truncate(3);
    scene.regrow_after_s = Some(1.0);
    file(&there, "wood.ron", scene.to_ron());
    let run = |arguments: &[&str]| {
        let all = [&["simulate", "wood.ron", "--json"], arguments].concat();
        windfall(&there, &all).json()
    };
    let reports: Vec<_> = [&["--threads", "1"], &["--threads", "3"], &["--backend", "wgpu"]]
        .iter()
        .map(|backend| run(&[&["--steps", "600"], &backend[..]].concat()))
        .collect();
    let trees = &reports[0]["trees"];
    assert_eq!(trees["count"], 3, "{trees}");
    assert!(trees["segments"].as_u64().is_some_and(|count| count > 300), "{trees}");
    let angle = trees["max_joint_angle_rad"].as_f64().expect("a number");
    assert!((0.001..2.0).contains(&angle), "joints bend: {trees}");
    let speed = trees["tip_speed_max_m_s"].as_f64().expect("a number");
    assert!((0.05..30.0).contains(&speed), "twigs move: {trees}");
    let shed = trees["leaves_shed"].as_u64().expect("a whole number");
    assert_eq!(&reports[1]["trees"], trees, "one thread and three");
    if reports[2]["contract"] == "exact" {
        assert_eq!(&reports[2]["trees"], trees, "both backends");
    }

    // Leaves that come back and come off again count again: parts of a run add up, states do not.
    let start = run(&["--steps", "0"]);
    let gone = |report: &Value| report["leaves"]["attached"].as_u64().expect("a whole number");
    assert!(shed > gone(&start) - gone(&reports[0]), "{shed} shed, some grew back: {}", reports[0]);
    let first = run(&["--steps", "250", "--checkpoint", "wood.ckpt", "--backend", "wgpu"]);
    let rest = ["simulate", "--json", "--resume", "wood.ckpt", "--steps", "350"];
    let rest = windfall(&there, &rest).json();
    let part = |report: &Value| report["trees"]["leaves_shed"].as_u64().expect("a whole number");
    if first["contract"] == "exact" {
        assert_eq!(part(&first) + part(&rest), shed, "two parts of one run");
    }
    let text = windfall(&there, &["simulate", "wood.ron", "--steps", "60"]).text();
    assert!(text.contains("trees") && text.contains("leaves shed"), "the text has them as well: {text}");
}

#[test]
fn a_scene_without_trees_reports_none() {
    for backend in BACKENDS {
        let report = simulate(&["six-motions", "--steps", "90", "--backend", backend]);
        let none = serde_json::json!({
            "count": 0, "segments": 0, "max_joint_angle_rad": 0.0, "tip_speed_max_m_s": 0.0, "leaves_shed": 0
        });
        assert_eq!(report["trees"], none, "{report}");
    }
}

#[test]
fn a_resumed_run_equals_an_unbroken_one() {
    let there = folder();
    let whole = ["simulate", "--json", "--leaves", "900", "--steps", "70", "--threads", "2"];
    let whole = windfall(&there, &whole).json();
    for first in BACKENDS {
        for second in BACKENDS {
            let part = ["simulate", "--json", "--leaves", "900", "--steps", "30", "--backend", first];
            let part = windfall(&there, &[&part[..], &["--checkpoint", "leaves.ckpt"]].concat()).json();
            assert_eq!(part["steps"], 30, "the first part");
            let rest = ["simulate", "--json", "--resume", "leaves.ckpt", "--steps", "40"];
            let rest = windfall(&there, &[&rest[..], &["--backend", second]].concat()).json();
            assert_eq!(rest["steps"], 40, "of this run");
            assert_eq!(rest["time_s"], whole["time_s"], "{first}, {second}: the same moment");
            assert_eq!(rest["seed"], whole["seed"], "{first}, {second}: the same scene");
            assert_eq!(rest["scene"], "Autumn park", "as the checkpoint calls it");
            if part["contract"] == "exact" && rest["contract"] == "exact" {
                assert_eq!(rest["state_hash"], whole["state_hash"], "{first}, {second}: the same bits");
            }
        }
    }
    assert_eq!(contents(there.path()).len(), 1, "nothing but the checkpoint is left");
}

#[test]
fn no_steps_show_the_beginning() {
    let there = folder();
    let arguments = ["simulate", "storm", "--leaves", "50", "--steps", "0", "--threads", "1"];
    let arguments = [&arguments[..], &["--json", "--checkpoint", "start.ckpt"]].concat();
    let report = windfall(&there, &arguments).json();
    assert_eq!((&report["steps"], &report["time_s"]), (&0.into(), &0.0.into()), "{report}");
    assert_eq!(report["leaf_steps_per_s"], 0.0, "nothing was stepped");
    let bytes = fs::read(there.path().join("start.ckpt")).expect("a checkpoint");
    let world = World::from_checkpoint(&bytes, "start.ckpt").expect("a usable one");
    assert_eq!(report["state_hash"], format!("{:016x}", world.state_hash()), "of the saved state");
}

#[test]
fn the_whole_scene_is_the_default() {
    let report = simulate(&["--steps", "1", "--threads", "1"]);
    assert_eq!(report["leaves"]["total"], 94_767, "{report}");
    let report = simulate(&["six-motions", "--steps", "1", "--backend", "wgpu"]);
    assert_eq!(report["leaves"]["total"], 6, "{report}");
}

#[test]
fn tracks_are_a_row_for_each_leaf_and_sampled_step() {
    for backend in BACKENDS {
        let there = folder();
        let arguments =
            ["simulate", "six-motions", "--steps", "10", "--tracks", "t.csv", "--backend", backend];
        let arguments = [&arguments[..], &["--track-every", "4", "--track-leaves", "5", "--json"]].concat();
        let report = windfall(&there, &arguments).json();
        let text = fs::read_to_string(there.path().join("t.csv")).expect("tracks");
        let mut lines = text.lines();
        assert_eq!(
            lines.next(),
            Some("step,time_s,leaf,id,state,primitive,species,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,qx,qy,qz,qw"),
            "the header"
        );
        let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
        let steps: Vec<_> = rows.iter().map(|row| row[0]).collect();
        let expected: Vec<_> = ["0", "4", "8"].iter().flat_map(|step| [*step; 5]).collect();
        assert_eq!(steps, expected, "five leaves at every fourth step");
        let codes = ["SD", "PT", "TC", "PF", "TH"];
        for (index, row) in rows.iter().enumerate() {
            assert_eq!(row.len(), 17, "{row:?}");
            assert_eq!(row[2], (index % 5).to_string(), "slot of {row:?}");
            assert_eq!((row[4], row[5]), ("falling", codes[index % 5]), "{row:?}");
            let numbers: Vec<f64> = row[7..].iter().map(|text| text.parse().expect("a number")).collect();
            let length: f64 = numbers[6..].iter().map(|q| q * q).sum();
            assert!((length - 1.0).abs() < 1e-3, "a unit quaternion: {row:?}");
        }
        assert_eq!(report["steps"], 10, "sampling changes nothing");
        assert_eq!(contents(there.path()).len(), 1, "nothing but the tracks is left");
    }
}

#[test]
fn tracks_hold_the_velocities_of_leaves() {
    let there = folder();
    let arguments = ["simulate", "six-motions", "--steps", "60", "--tracks", "t.csv", "--threads", "1"];
    windfall(&there, &arguments).text();
    let text = fs::read_to_string(there.path().join("t.csv")).expect("tracks");
    // The fourth leaf of six flutters: where it goes is what its velocity says, by the trapezoidal rule.
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(4)
        .step_by(6)
        .map(|line| line.split(',').skip(7).take(6).map(|text| text.parse().expect("a number")).collect())
        .collect();
    assert_eq!(rows.len(), 61, "both ends");
    for axis in 0..3 {
        let moved = rows[60][axis] - rows[0][axis];
        let pairs = rows.windows(2).map(|pair| (pair[0][3 + axis] + pair[1][3 + axis]) / 120.0);
        let integrated: f64 = pairs.sum();
        assert!((moved - integrated).abs() < 0.02, "axis {axis}: moved {moved} m, integrated {integrated} m");
    }
}

#[test]
fn a_scene_may_name_its_own_motion_tables() {
    let there = folder();
    let listed = windfall(&there, &["motions", "six-motions", "--out", "tables"]).text();
    let mut scene = Scene::preset("six-motions").expect("a preset");
    assert_eq!(listed.lines().count(), scene.species.len(), "a file for each species: {listed}");
    for species in &mut scene.species {
        species.tables = Some(format!("tables/{}.motions", species.name));
    }
    file(&there, "own.ron", scene.to_ron());
    let run =
        |scene| windfall(&there, &["simulate", scene, "--steps", "200", "--json", "--threads", "1"]).json();
    assert_eq!(
        run("own.ron")["state_hash"],
        run("six-motions")["state_hash"],
        "the same tables, the same bits"
    );

    // Tables read are tables written.
    windfall(&there, &["motions", "own.ron", "--out", "again"]).text();
    let files = |name: &str| contents(&there.path().join(name)).into_iter().map(|(_, bytes)| bytes);
    assert!(files("tables").eq(files("again")), "the same files");
}

#[test]
fn without_json_it_speaks_to_people() {
    let text = windfall(&folder(), &["simulate", "--steps", "3", "--leaves", "9", "--threads", "1"]).text();
    for part in ["autumn-park", "cpu", "state hash", "mean position", "falling", "leaf-steps/s"] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
}

#[test]
fn help_and_version_are_no_errors() {
    let there = folder();
    for arguments in [&["--help"][..], &["--version"], &["simulate", "--help"], &["bench", "-h"]] {
        let outcome = windfall(&there, arguments);
        assert_eq!(outcome.stderr, "", "{arguments:?}");
        assert!(!outcome.text().is_empty(), "{arguments:?}");
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let there = folder();
    for arguments in
        [&["--help"][..], &["info"], &["simulate", "--steps", "1", "--leaves", "9", "--threads", "1"]]
    {
        let mut command = command(&there, arguments);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the program starts");
        drop(child.stdout.take());
        let mut stderr = String::new();
        child.stderr.take().expect("a pipe").read_to_string(&mut stderr).expect("UTF-8");
        let status = child.wait().expect("it ends");
        assert_eq!((status.code(), stderr.as_str()), (Some(0), ""), "{arguments:?}");
    }
}
