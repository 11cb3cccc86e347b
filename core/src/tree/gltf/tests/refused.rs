// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Refusal of files that are no trees; nothing in a file makes the reader panic.

use std::path::Path;

use proptest::prelude::*;
use serde_json::{Value, json};

use super::super::*;
use super::{document, edit, glb, read_document, refusal};
use crate::tree::skeleton::MAX_SEGMENTS;
use crate::tree::testing::tree;
use crate::tree::{BarkDetail, bark_mesh};

#[test]
fn what_is_no_tree_is_refused_with_the_reason() {
    let whole = glb(&tree(1, 2));
    for bytes in [&b""[..], b"glTF", b"{}", b"no glTF", &whole[..whole.len() / 2], &[0xff; 64]] {
        let error = read_bytes(bytes, Path::new("a.glb")).expect_err("no glTF").to_string();
        assert!(error.contains("a.glb: not a usable glTF 2.0 file: ") && !error.contains('\n'), "{error}");
    }
    let valid = document();
    let refused = |change: &dyn Fn(&mut Value)| {
        let mut document = valid.clone();
        change(&mut document);
        refusal(&document)
    };
    let has = |error: String, parts: &[&str]| {
        for part in parts {
            assert!(error.contains(part), "{part:?} is missing in {error}");
        }
    };
    let last = valid["nodes"].as_array().expect("nodes").len() - 1;
    has(
        refused(&|d| {
            for node in 0..2 {
                d["nodes"][node].as_object_mut().expect("a node").remove("skin");
            }
            d.as_object_mut().expect("a document").remove("skins");
        }),
        &["has no skin"],
    );
    has(refused(&|d| d["nodes"][0] = json!({})), &["skins[0] moves no triangles"]);
    has(refused(&|d| d["nodes"][last]["children"] = json!([last])), &["nodes", "child of"]);
    has(
        refused(&|d| {
            d["nodes"][last - 1] = json!({ "children": [last] });
            d["nodes"][last] = json!({ "children": [last - 1] });
            d["nodes"].as_array_mut().expect("nodes").iter_mut().take(last - 1).for_each(|node| {
                node.as_object_mut().expect("a node").remove("children");
            });
        }),
        &["below itself", "without cycles"],
    );
    has(refused(&|d| d["skins"][0]["joints"][1] = json!(2)), &["(segment.0)", "twice"]);
    has(refused(&|d| d["nodes"][3]["translation"] = json!([0, 1e39, 0])), &["nodes[3]", "finite"]);
    has(refused(&|d| d["nodes"][3]["extras"]["length_m"] = json!(0.0)), &["extras.length_m is 0", "above 0"]);
    has(
        refused(&|d| {
            d["nodes"][2].as_object_mut().expect("a node").remove("extras");
            d["nodes"][3]["translation"] = json!([0, 0, 0]);
        }),
        &["nodes[2] (segment.0)", "0 m long", "0.0001 m and more"],
    );
    has(
        refused(
            &|d| d["accessors"][0]["sparse"] = json!({ "count": 1, "indices": { "bufferView": 0, "componentType": 5123 }, "values": { "bufferView": 0 } }),
        ),
        &["sparse"],
    );
    has(
        refused(&|d| d["accessors"][0]["count"] = json!(1_000_000)),
        &["POSITION", "1000000 elements do not fit"],
    );
    has(refused(&|d| d["accessors"][0]["count"] = json!(u32::MAX)), &["4294967295 elements; allowed"]);
    has(refused(&|d| d["accessors"][0]["byteOffset"] = json!(u64::MAX)), &["do not fit"]);
    has(
        refused(&|d| d["bufferViews"][0]["byteLength"] = json!(1u64 << 40)),
        &["its view takes", "the buffer has"],
    );
    has(refused(&|d| d["bufferViews"][0]["byteOffset"] = json!(u64::MAX)), &["its view takes"]);
    has(refused(&|d| d["accessors"][0]["type"] = json!("VEC2")), &["Vec2", "needed: 3 numbers"]);
    has(refused(&|d| d["accessors"][1]["count"] = json!(3)), &["NORMAL", "has 3 elements for"]);
    has(
        refused(&|d| {
            let nodes = d["nodes"].as_array_mut().expect("nodes");
            let first = nodes.len();
            nodes.extend((0..=MAX_SEGMENTS).map(|_| json!({})));
            d["skins"][0]["joints"] = (first..=first + MAX_SEGMENTS).collect::<Vec<_>>().into();
        }),
        &["65537 joints; allowed are up to 65536"],
    );
    let bark = &valid["meshes"][0]["primitives"][0];
    for (attribute, bad) in [("POSITION", f32::NAN), ("WEIGHTS_0", f32::INFINITY), ("NORMAL", f32::NAN)] {
        let error = refused(&|d| {
            edit(d, &bark["attributes"][attribute], |bytes| bytes[..4].copy_from_slice(&bad.to_le_bytes()));
        });
        has(error, &[attribute, "element 0", "finite numbers"]);
    }
    has(
        refused(&|d| edit(d, &bark["attributes"]["WEIGHTS_0"], |bytes| bytes.fill(0))),
        &["WEIGHTS_0", "all zero"],
    );
    has(
        refused(&|d| edit(d, &bark["attributes"]["JOINTS_0"], |bytes| bytes[..2].fill(0xff))),
        &["JOINTS_0", "names joint 65535"],
    );
    has(refused(&|d| edit(d, &bark["indices"], |bytes| bytes[..4].fill(0xff))), &["indices", "4294967295"]);
    has(
        refused(&|d| {
            let matrices = d["skins"][0]["inverseBindMatrices"].clone();
            edit(d, &matrices, |bytes| bytes[..4].copy_from_slice(&f32::NAN.to_le_bytes()));
        }),
        &["inverse bind matrices", "finite"],
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn broken_files_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..24),
        cut in prop::option::of(any::<prop::sample::Index>()),
        is_binary: bool,
        in_head: bool,
    ) {
        let skeleton = tree(1, 1);
        let mesh = bark_mesh(&skeleton, BarkDetail::Far);
        let mut bytes = if is_binary {
            to_glb(&skeleton, &mesh, &GltfLook::default())
        } else {
            to_gltf(&skeleton, &mesh, &GltfLook::default()).into_bytes()
        };
        // The structure is at the beginning of the binary form, and all over the other.
        let reach = if in_head { bytes.len().min(4000) } else { bytes.len() };
        for (index, value) in edits {
            bytes[index.index(reach)] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok(read) = read_bytes(&bytes, Path::new("a.gltf")) {
            prop_assert_eq!(read.skeleton.validate(), Ok(()));
        }
    }

    #[test]
    fn changed_numbers_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0usize..8), 1..4),
    ) {
        // Keeps the JSON whole, so that what lies behind the parser is reached.
        let skeleton = tree(1, 1);
        let text = to_gltf(&skeleton, &bark_mesh(&skeleton, BarkDetail::Far), &GltfLook::default());
        let mut document: Value = serde_json::from_str(&text).expect("JSON");
        let values = ["0", "-1", "1e39", "4294967295", "18446744073709551615", "3.5", "7", "5126"];
        for (index, value) in edits {
            let mut numbers = Vec::new();
            collect_numbers(&mut document, &mut numbers);
            let count = numbers.len();
            *numbers[index.index(count)] = serde_json::from_str(values[value]).expect("a number");
        }
        if let Ok(read) = read_document(&document) {
            prop_assert_eq!(read.skeleton.validate(), Ok(()));
        }
    }
}

fn collect_numbers<'a>(value: &'a mut Value, numbers: &mut Vec<&'a mut Value>) {
    match value {
        Value::Number(_) => numbers.push(value),
        Value::Array(list) => list.iter_mut().for_each(|item| collect_numbers(item, numbers)),
        Value::Object(map) => map.values_mut().for_each(|item| collect_numbers(item, numbers)),
        _ => {}
    }
}
