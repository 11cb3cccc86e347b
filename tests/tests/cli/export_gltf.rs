// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves and trees in glTF files have the numbers of the table.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::export::{LEAVES, PLACE, TURN, export, frame, numbers, scene, solid_scene};

/// The document of a `.glb` file and its buffer.
pub(super) fn glb(path: &Path) -> (Value, Vec<u8>) {
    let bytes = fs::read(path).expect("a file");
    let word = |at: usize| {
        let word = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
        usize::try_from(u32::from_le_bytes(word)).expect("a length")
    };
    assert_eq!((&bytes[..4], word(8)), (&b"glTF"[..], bytes.len()), "a whole file");
    let text = word(12);
    (serde_json::from_slice(&bytes[20..20 + text]).expect("JSON"), bytes[28 + text..].to_vec())
}

/// The floats of an accessor.
pub(super) fn floats(document: &Value, buffer: &[u8], accessor: &Value) -> Vec<f32> {
    let index = |value: &Value| usize::try_from(value.as_u64().expect("an index")).expect("small");
    let accessor = &document["accessors"][index(accessor)];
    assert_eq!(accessor["componentType"], 5126, "floats");
    let view = &document["bufferViews"][index(&accessor["bufferView"])];
    let start = index(&view["byteOffset"]);
    let bytes = buffer[start..start + index(&view["byteLength"])].chunks(4);
    bytes.map(|word| f32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
}

/// Returns true if two quaternions turn the same way.
fn same_turn(a: &[f32], b: [f32; 4]) -> bool {
    let dot: f32 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    (dot.abs() - 1.0).abs() < 1e-5
}

#[test]
fn a_moving_gltf_file_has_the_numbers_of_the_table() {
    let there = scene();
    export(&there, "10..20", "clip.glb", &["--fps", "30"]);
    let (document, buffer) = glb(&there.path().join("clip.glb"));
    let rows = [frame(&there, 10), frame(&there, 20)];
    let animation = &document["animations"][0];
    let track = |node: usize, path: &str| {
        let mut channels = animation["channels"].as_array().expect("channels").iter();
        let channel = channels
            .find(|channel| channel["target"]["node"] == node && channel["target"]["path"] == path)?;
        let sampler =
            &animation["samplers"][channel["sampler"].as_u64().and_then(|at| usize::try_from(at).ok())?];
        Some((floats(&document, &buffer, &sampler["input"]), floats(&document, &buffer, &sampler["output"])))
    };
    let mut compared = 0;
    for (node, name) in document["nodes"].as_array().expect("nodes").iter().enumerate() {
        let Some(slot) = name["name"].as_str().and_then(|name| name.strip_prefix("leaf.")) else { continue };
        let slot: usize = slot.parse().expect("a slot");
        let (times, places) = track(node, "translation").expect("it moves");
        let (_, turns) = track(node, "rotation").expect("it turns");
        assert_eq!((times.len(), times[0], places.len()), (11, 0.0, 33), "eleven frames from nought on");
        assert!((times[10] - 10.0 / 30.0).abs() < 1e-6, "ten frames later: {times:?}");
        for (at, rows) in [(0, &rows[0]), (10, &rows[1])] {
            let row = &rows[slot];
            let size = match track(node, "scale") {
                Some((when, sizes)) => {
                    let now = when.iter().rposition(|time| *time <= times[at] + 1e-6).expect("a size");
                    sizes[3 * now]
                }
                None => numbers_of(&name["scale"])[0],
            };
            if row["state"] == "dormant" {
                assert_eq!(size.to_bits(), 0, "of no size: {row:?}");
                continue;
            }
            assert_eq!(places[3 * at..3 * at + 3], numbers(row, PLACE), "{row:?}");
            assert!(same_turn(&turns[4 * at..4 * at + 4], numbers(row, TURN)), "{row:?}");
            assert!((size * 0.06 / numbers(row, ["size_m"])[0] - 1.0).abs() < 1e-5, "{size}: {row:?}");
            compared += 1;
        }
    }
    assert!(compared > LEAVES, "{compared} leaves compared");
    assert_eq!(document["skins"].as_array().map(Vec::len), Some(1), "a tree that sways");
}

fn numbers_of(values: &Value) -> Vec<f32> {
    serde_json::from_value(values.clone()).expect("numbers")
}

#[test]
fn a_still_gltf_file_has_the_numbers_of_the_table() {
    let there = scene();
    export(&there, "20..20", "still.glb", &["--fps", "30"]);
    let (document, buffer) = glb(&there.path().join("still.glb"));
    let rows = frame(&there, 20);
    let mut found = 0;
    for node in document["nodes"].as_array().expect("nodes") {
        let attributes = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        let Some(ids) = node["extras"]["ids"].as_array() else { continue };
        let [places, turns] =
            ["TRANSLATION", "ROTATION"].map(|name| floats(&document, &buffer, &attributes[name]));
        for (at, id) in ids.iter().enumerate() {
            let id = id.to_string();
            let row = rows.iter().find(|row| row["id"] == id).expect("a leaf of this number");
            assert_eq!(places[3 * at..3 * at + 3], numbers(row, PLACE), "{row:?}");
            assert!(same_turn(&turns[4 * at..4 * at + 4], numbers(row, TURN)), "{row:?}");
            found += 1;
        }
    }
    let present = rows.iter().filter(|row| row["state"] != "dormant").count();
    assert_eq!(found, present, "all leaves that are somewhere");
    assert_eq!(
        document["extensionsRequired"][0], "EXT_mesh_gpu_instancing",
        "without it nothing is in its place"
    );
}

#[test]
fn objects_stand_and_move_in_gltf_files() {
    let there = solid_scene();
    for (frames, out) in [("0..30", "clip.glb"), ("15..15", "still.glb")] {
        export(&there, frames, out, &["--fps", "30"]);
    }
    let [clip, still] = ["clip.glb", "still.glb"].map(|name| glb(&there.path().join(name)));
    let nodes = |document: &Value| document["nodes"].as_array().expect("nodes").clone();
    let find = |document: &Value, name: &str| {
        let found = nodes(document).iter().position(|node| node["name"] == name);
        found.unwrap_or_else(|| panic!("a node {name}"))
    };
    for (document, ball_m) in [(&clip.0, 0.0), (&still.0, 1.0)] {
        let place = |name| numbers_of(&nodes(document)[find(document, name)]["translation"]);
        assert_eq!(place("Object_0"), [1.5, 0.25, 2.0], "the box");
        assert!((place("Object_1")[0] - ball_m).abs() < 1e-5, "the ball: {:?}", place("Object_1"));
        assert!(find(document, "Walker_0_9") > 0, "a node for every limb");
    }
    let (document, buffer) = &clip;
    let animation = &document["animations"][0];
    let places = |name: &str| {
        let node = find(document, name);
        let mut channels = animation["channels"].as_array().expect("channels").iter();
        let channel = channels.find(|channel| {
            channel["target"]["node"] == node && channel["target"]["path"] == "translation"
        })?;
        let sampler = usize::try_from(channel["sampler"].as_u64().expect("a number")).expect("small");
        Some(floats(document, buffer, &animation["samplers"][sampler]["output"]))
    };
    assert_eq!(places("Object_0"), None, "what stands has no channel");
    let ball = places("Object_1").expect("a channel");
    assert_eq!(ball.len(), 93, "a place for every frame");
    assert!((ball[90] - 2.0).abs() < 1e-5, "at the end: {:?}", &ball[90..]);
    let trunk = places("Walker_0_8").expect("a channel");
    assert!((trunk[90] - trunk[0] - 1.4).abs() < 1e-4, "a second of the walk: {}", trunk[90] - trunk[0]);
}
