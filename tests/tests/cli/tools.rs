// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall info`, `bench`, `motions`, `man` and `completions` in use.

use std::fs;

use crate::common_cli::{contents, folder, windfall, windfall_without_adapter};
use serde_json::Value;
use windfall_core::Scene;
use windfall_core::motion::MotionTables;
use windfall_core::scene::STANDARD_GRAVITY_M_S2;

#[test]
fn info_lists_adapters_and_the_default() {
    let outcome = windfall(&folder(), &["info"]);
    assert_eq!(outcome.stderr, "", "no noise");
    let text = outcome.text();
    for part in ["processor", "default", "bytes per leaf     88", "adapter  ", "contract", "largest binding"]
    {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
    assert!(
        text.contains("backend cpu: ") || text.contains("backend wgpu: "),
        "what is chosen and why:\n{text}"
    );
}

#[test]
fn info_works_without_adapters() {
    let outcome = windfall_without_adapter(&folder(), &["info"]);
    assert_eq!(outcome.stderr, "", "no noise");
    let text = outcome.text();
    for part in ["adapters           0", "backend cpu: no graphics adapter", "mesa-vulkan-drivers"] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
}

#[test]
fn without_adapters_the_processor_simulates_and_says_so() {
    let arguments = ["simulate", "--steps", "2", "--leaves", "20", "--json"];
    let outcome = windfall_without_adapter(&folder(), &arguments);
    assert!(outcome.stderr.starts_with("backend cpu: no graphics adapter"), "{}", outcome.stderr);
    assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    assert_eq!(outcome.json()["backend"], "cpu", "nothing else is there");
}

#[test]
fn bench_times_the_passes_of_a_frame() {
    for (preset, is_sorted) in [("particle-lab", true), ("six-motions", false)] {
        let arguments = ["bench", preset, "--draw", "--leaves", "10", "--size", "64x36", "--json"];
        let outcome = windfall(&folder(), &arguments);
        let row = outcome.json();
        let passes = row["passes"].as_array().expect("passes");
        let milliseconds = |name| passes.iter().find(|row| row["pass"] == name).map(|row| row["ms"].as_f64());
        for part in ["leaves", "grass", "ground", "far trees", "sky"] {
            assert!(milliseconds(part).flatten().is_some_and(|ms| ms > 0.0), "{preset}, {part}: {row}");
        }
        assert_eq!(milliseconds("scene"), None, "parts stand for the whole: {row}");
        assert_eq!(milliseconds("particle order").is_some(), is_sorted, "{preset}: {row}");
    }
}

#[test]
fn bench_measures_every_approach_and_the_memory() {
    let arguments = ["bench", "storm", "--leaves", "100", "--steps", "3", "--json"];
    let outcome = windfall(&folder(), &arguments);
    assert_eq!(outcome.stderr, "", "no noise");
    let text = outcome.text();
    let mut rows: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let floor = rows.remove(0);
    let bandwidth = floor["update_bandwidth_bytes_per_s"].as_f64().expect("a number");
    let bound = floor["floor_leaf_steps_per_s"].as_f64().expect("a number");
    assert!(bandwidth > 1e8, "memory is faster than a disk: {floor}");
    assert!((bound * 104.0 / bandwidth - 1.0).abs() < 1e-9, "the floor is bandwidth over bytes: {floor}");
    let which: Vec<_> = rows
        .iter()
        .map(|row| (row["backend"].as_str().expect("text"), row["leaves"].as_u64().expect("a number")))
        .collect();
    assert_eq!(
        which,
        ["trajectory", "structs", "cpu", "cpu-fused", "wgpu"].map(|approach| (approach, 100)),
        "all of them"
    );
    for row in &rows {
        let mut keys: Vec<_> = row.as_object().expect("an object").keys().map(String::as_str).collect();
        keys.sort_unstable();
        let expected = [
            "adapter",
            "backend",
            "bytes_per_leaf",
            "bytes_per_leaf_step",
            "cpu_utilisation",
            "floor_share",
            "frames_per_s",
            "leaf_steps_per_cpu_s",
            "leaf_steps_per_s",
            "leaf_steps_per_s_max",
            "leaf_steps_per_s_min",
            "leaves",
            "scene",
            "steps",
            "steps_per_s",
            "turbulence_m_s",
        ];
        assert_eq!(keys, expected, "{row}");
        assert_eq!((&row["scene"], &row["steps"]), (&"storm".into(), &3.into()), "{row}");
        assert_eq!(row["bytes_per_leaf_step"], 104, "six records of 16 bytes and one of 8");
        assert!(row["turbulence_m_s"].as_f64().expect("a number") > 1.0, "a storm: {row}");
        let rate = |key: &str| row[key].as_f64().expect("a number");
        let (low, high) = (rate("leaf_steps_per_s_min"), rate("leaf_steps_per_s_max"));
        assert!(0.0 < low && (low..=high).contains(&rate("leaf_steps_per_s")), "the median: {row}");
        assert!(rate("leaf_steps_per_cpu_s") > 0.0, "{row}");
        assert!((rate("floor_share") * bound / rate("leaf_steps_per_s") - 1.0).abs() < 1e-9, "{row}");
        assert!(rate("frames_per_s") > 0.0, "drawn, too: {row}");
        let bytes = match row["backend"].as_str() {
            Some("trajectory") => 1201 * 32,
            // Records of 16 bytes fill a struct up.
            Some("structs") => 96,
            _ => 88,
        };
        assert_eq!(row["bytes_per_leaf"], bytes, "{row}");
    }
}

#[test]
fn bench_measures_particles_beside_leaves() {
    let arguments = ["bench", "six-motions", "--leaves", "60", "--steps", "3", "--particles"];
    let text = windfall(&folder(), &[&arguments[..], &["--json"]].concat()).text();
    let rows: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let bandwidth = rows[0]["update_bandwidth_bytes_per_s"].as_f64().expect("a number");
    let sparks: Vec<_> = rows.iter().filter(|row| row.get("particles").is_some()).collect();
    let which: Vec<_> = sparks.iter().map(|row| (&row["backend"], &row["particles"])).collect();
    let names = ["cpu", "cpu-fused", "wgpu"].map(Value::from);
    let count = Value::from(60);
    assert_eq!(which, names.each_ref().map(|name| (name, &count)), "every backend");
    assert_eq!(rows.len(), 1 + 5 + 3, "leaves are measured as ever");
    for row in sparks {
        assert_eq!((&row["scene"], &row["steps"]), (&"six-motions".into(), &3.into()), "{row}");
        assert_eq!(row["bytes_per_particle_step"], 80, "two records read and written, one read");
        let number = |key: &str| row[key].as_f64().expect("a number");
        let rate = number("particle_steps_per_s");
        let (low, high) = (number("particle_steps_per_s_min"), number("particle_steps_per_s_max"));
        assert!(0.0 < low && (low..=high).contains(&rate), "the median: {row}");
        assert!((number("ms_per_step") * rate / (1e3 * number("particles")) - 1.0).abs() < 1e-9, "{row}");
        assert!((number("floor_share") * bandwidth / (80.0 * rate) - 1.0).abs() < 1e-9, "{row}");
    }
    let text = windfall(&folder(), &[&arguments[..], &["--backend", "cpu"]].concat()).text();
    assert_eq!(text.lines().filter(|line| line.contains("60 sparks: ")).count(), 2, "for people: {text}");
}

#[test]
fn bench_prints_a_table_and_chooses_its_steps() {
    let outcome = windfall(&folder(), &["bench", "--leaves", "10", "--backend", "cpu"]);
    let text = outcome.text();
    let last: Vec<_> = text.lines().last().expect("a row").split_whitespace().collect();
    assert_eq!(&last[..2], ["cpu-fused", "10"], "{text}");
    assert!(text.contains("scene: million, turbulence of 0."), "turbulence is stated: {text}");
    assert!(last[2].parse::<f64>().expect("steps per second") > 1000.0, "ten leaves take no time: {text}");
    assert!(text.contains("GB/s changed in place"), "the memory's speed: {text}");
}

#[test]
fn bench_without_adapters_measures_the_processor() {
    let arguments = ["bench", "--leaves", "10", "--steps", "1", "--json"];
    let outcome = windfall_without_adapter(&folder(), &arguments);
    assert!(outcome.stderr.contains("no usable adapter"), "{}", outcome.stderr);
    let last: Value = serde_json::from_str(outcome.text().lines().last().expect("a row")).expect("JSON");
    assert_eq!(
        (&last["backend"], &last["frames_per_s"]),
        (&"cpu-fused".into(), &Value::Null),
        "nothing drawn"
    );
}

#[test]
fn motions_are_the_tables_of_the_scene() {
    let there = folder();
    let text = windfall(&there, &["motions", "--out", "deep/down"]).text();
    let scene = Scene::preset("autumn-park").expect("a preset");
    let seed = [20, 0];
    assert_eq!(text.lines().count(), scene.species.len(), "{text}");
    for species in &scene.species {
        let path = there.path().join("deep/down").join(format!("{}.motions", species.name));
        let text = fs::read_to_string(&path).expect("a file for each species");
        let tables = MotionTables::from_text(&text, "written").expect("a readable one");
        assert_eq!(tables, MotionTables::generate(species, seed, STANDARD_GRAVITY_M_S2), "{}", species.name);
    }
    assert_eq!(contents(there.path()).len(), scene.species.len() + 2, "nothing else is left");
}

#[test]
fn every_command_has_a_page_of_the_manual() {
    let there = folder();
    let text = windfall(&there, &["man", "--out", "pages"]).text();
    assert_eq!(text.lines().count(), contents(&there.path().join("pages")).len(), "all are listed: {text}");
    let page = |command: &str| {
        let path = there.path().join("pages").join(format!("{command}.1"));
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{command}: {error}"))
    };
    let help = windfall(&there, &["--help"]).text();
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names: Vec<_> = commands.map_while(|line| line.split_whitespace().next()).collect();
    assert!(names.len() > 10, "{help}");
    for name in names {
        assert!(
            page("windfall").contains(&format!("windfall\\-{name}(1)")),
            "{name} is named on the first page"
        );
        let page = page(&format!("windfall-{name}"));
        assert!(page.contains(&format!(".TH windfall-{name} 1")), "{name}: {page}");
    }
    // Of an option that this command alone has, with its description.
    let page = page("windfall-leaf-make");
    assert!(page.contains("\\-\\-season") && page.contains("Season"), "{page}");
}

#[test]
fn completions_name_commands_and_options() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = windfall(&folder(), &["completions", shell]).text();
        for word in ["simulate", "shedding", "checkpoint"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}
