// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Round trips of written files, and measurements of trees that others have rigged.

mod refused;

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::Vec3;
use serde_json::{Value, json};

use super::*;
use crate::tree::testing::tree;
use crate::tree::{BarkDetail, Skeleton, bark_mesh};

fn glb(skeleton: &Skeleton) -> Vec<u8> {
    to_glb(skeleton, &bark_mesh(skeleton, BarkDetail::Full), &GltfLook::default())
}

/// The document of a small tree with its buffer in it.
fn document() -> Value {
    let skeleton = tree(1, 2);
    let text = to_gltf(&skeleton, &bark_mesh(&skeleton, BarkDetail::Far), &GltfLook::default());
    serde_json::from_str(&text).expect("JSON")
}

fn read_document(document: &Value) -> Result<RiggedTree, GltfError> {
    read_bytes(document.to_string().as_bytes(), Path::new("a.gltf"))
}

/// Changes the bytes of the buffer view that an accessor is in.
fn edit(document: &mut Value, accessor: &Value, change: impl FnOnce(&mut [u8])) {
    let number = |value: &Value| usize::try_from(value.as_u64().expect("a number")).expect("small");
    let view = &document["bufferViews"][number(&document["accessors"][number(accessor)]["bufferView"])];
    let (from, length) = (number(&view["byteOffset"]), number(&view["byteLength"]));
    let uri = document["buffers"][0]["uri"].as_str().expect("a data URI").to_owned();
    let (head, data) = uri.split_once(',').expect("a comma");
    let mut bytes = STANDARD.decode(data).expect("base64");
    change(&mut bytes[from..from + length]);
    document["buffers"][0]["uri"] = format!("{head},{}", STANDARD.encode(bytes)).into();
}

fn refusal(document: &Value) -> String {
    let error = read_document(document).expect_err("not a tree").to_string();
    assert!(error.starts_with("a.gltf: ") && !error.contains('\n'), "one line with the file: {error}");
    error
}

fn assert_same(read: &Skeleton, written: &Skeleton) {
    assert_eq!(read.segments.len(), written.segments.len(), "segments");
    for (index, (a, b)) in read.segments.iter().zip(&written.segments).enumerate() {
        assert_eq!((a.parent, a.order), (b.parent, b.order), "segment {index}");
        assert!(a.start_m.distance(b.start_m) < 1e-5, "segment {index}: {} for {}", a.start_m, b.start_m);
        assert!(a.end_m.distance(b.end_m) < 1e-5, "segment {index}: {} for {}", a.end_m, b.end_m);
        let radii = |s: &crate::tree::Segment| (s.start_radius_m.to_bits(), s.end_radius_m.to_bits());
        assert_eq!(radii(a), radii(b), "segment {index}");
    }
    assert_eq!(read.attachments.len(), written.attachments.len(), "attachments");
    for (a, b) in read.attachments.iter().zip(&written.attachments) {
        assert_eq!((a.segment, a.kind), (b.segment, b.kind), "attachment");
        assert!(a.at_m.distance(b.at_m) < 1e-5, "{} for {}", a.at_m, b.at_m);
        assert!(a.direction.distance(b.direction) < 1e-5, "{} for {}", a.direction, b.direction);
        assert!(a.normal.distance(b.normal) < 1e-5, "{} for {}", a.normal, b.normal);
    }
}

#[test]
fn what_is_written_is_read_again() {
    for seed in 0..4 {
        let skeleton = tree(seed, 3);
        let mesh = bark_mesh(&skeleton, BarkDetail::Full);
        let look = GltfLook { has_wind_colors: seed == 1, ..GltfLook::default() };
        let binary = read_bytes(&to_glb(&skeleton, &mesh, &look), Path::new("a.glb")).expect("a tree");
        let text = to_gltf(&skeleton, &mesh, &look);
        let text = read_bytes(text.as_bytes(), Path::new("a.gltf")).expect("a tree");
        assert!(binary == text, "both forms hold the same");
        assert_same(&binary.skeleton, &skeleton);
        assert!(binary.mesh.indices == mesh.indices, "triangles");
        assert!(binary.mesh.texcoords == mesh.texcoords, "texture");
        for vertex in 0..mesh.joints.len() {
            for (joint, weight) in mesh.joints[vertex].into_iter().zip(mesh.weights[vertex]) {
                let parts = binary.mesh.joints[vertex].into_iter().zip(binary.mesh.weights[vertex]);
                let read: f32 = parts.filter(|(other, _)| *other == joint).map(|(_, weight)| weight).sum();
                assert!(weight == 0.0 || (read - weight).abs() < 1e-6, "share {weight} of {joint}: {read}");
            }
        }
        for (a, b) in binary.mesh.positions_m.iter().zip(&mesh.positions_m) {
            assert!(Vec3::from_array(*a).distance(Vec3::from_array(*b)) < 1e-5, "{a:?} for {b:?}");
        }
    }
}

#[test]
fn a_rig_without_extras_is_measured() {
    let skeleton = tree(2, 2);
    let mesh = bark_mesh(&skeleton, BarkDetail::Full);
    let mut document: Value =
        serde_json::from_str(&to_gltf(&skeleton, &mesh, &GltfLook::default())).expect("JSON");
    for node in document["nodes"].as_array_mut().expect("nodes") {
        node.as_object_mut().expect("a node").remove("extras");
    }
    let read = read_document(&document).expect("a tree").skeleton;
    assert_eq!(read.segments.len(), skeleton.segments.len(), "segments");
    let mut near = 0;
    for (index, (a, b)) in read.segments.iter().zip(&skeleton.segments).enumerate() {
        assert_eq!(a.parent, b.parent, "segment {index}");
        assert!(a.start_m.distance(b.start_m) < 1e-5, "segment {index}: {} for {}", a.start_m, b.start_m);
        let length = a.length_m() / b.length_m();
        // At tips the blunt end of the bark is taken for wood.
        assert!((0.8..1.2).contains(&length), "segment {index}: {length} of its length");
        for (a, b) in [(a.start_radius_m, b.start_radius_m), (a.end_radius_m, b.end_radius_m)] {
            near += usize::from((0.75..1.33).contains(&(a / b)));
        }
    }
    assert!(near * 10 > skeleton.segments.len() * 2 * 8, "{near} of {} radii", skeleton.segments.len() * 2);
}

#[test]
fn scaled_and_turned_armatures_stand_as_they_are_shown() {
    let mut document = document();
    let plain = read_document(&document).expect("a tree").skeleton;
    // As exporters do it: centimetres and z up below a node that makes up for it.
    let nodes = document["nodes"].as_array_mut().expect("nodes");
    let root = nodes.len();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    nodes.push(json!({
        "children": [2], "scale": [0.01, 0.01, 0.01], "rotation": [half, 0.0, 0.0, half], "translation": [3, 4, 5],
    }));
    document["scenes"][0]["nodes"] = json!([0, 1, root]);
    for node in document["nodes"].as_array_mut().expect("nodes") {
        node.as_object_mut().expect("a node").remove("extras");
    }
    let read = read_document(&document).expect("a tree").skeleton;
    for (a, b) in read.segments.iter().zip(&plain.segments) {
        let turned = Vec3::new(b.start_m.x, -b.start_m.z, b.start_m.y) * 0.01;
        assert!(a.start_m.distance(turned) < 1e-6, "{} for {turned}", a.start_m);
    }
}

#[test]
fn unweighted_tips_mark_ends_and_further_roots_are_stems() {
    let mut document = document();
    let segments = read_document(&document).expect("a tree").skeleton.segments.len();
    let nodes = document["nodes"].as_array_mut().expect("nodes");
    let leaf = (2..nodes.len()).find(|&node| nodes[node].get("children").is_none()).expect("a tip");
    let mark = nodes.len();
    nodes.push(json!({ "translation": [0.0, 0.5, 0.0] }));
    nodes[leaf].as_object_mut().expect("a node").remove("extras");
    nodes[leaf]["children"] = json!([mark]);
    nodes.push(json!({ "translation": [1.0, 0.0, 0.0], "extras": { "length_m": 0.3 } }));
    let skin = &mut document["skins"][0];
    skin.as_object_mut().expect("a skin").remove("inverseBindMatrices");
    skin["joints"].as_array_mut().expect("joints").extend([json!(mark), json!(mark + 1)]);
    let read = read_document(&document).expect("a tree").skeleton.segments;
    assert_eq!(read.len(), segments + 1, "the stem, and not the mark");
    assert!((read[leaf - 2].length_m() - 0.5).abs() < 1e-5, "{} m", read[leaf - 2].length_m());
    assert_eq!(read[segments].parent, Some(0), "the stem grows from the foot");
}

#[test]
fn buffers_are_found_in_the_file_and_beside_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut document = document();
    let uri = document["buffers"][0]["uri"].as_str().expect("a data URI").to_owned();
    let bytes = STANDARD.decode(uri.split_once(',').expect("a comma").1).expect("base64");
    document["buffers"][0]["uri"] = "my%20tree.bin".into();
    let path = folder.path().join("a.gltf");
    std::fs::write(&path, document.to_string()).expect("room");
    let error = read(&path).expect_err("no buffer").to_string();
    assert!(error.contains("a.gltf: buffers[0]: ") && error.contains("my tree.bin"), "{error}");
    std::fs::write(folder.path().join("my tree.bin"), &bytes[..100]).expect("room");
    let error = read(&path).expect_err("too short").to_string();
    assert!(error.contains("buffers[0]: it has 100 bytes; needed are"), "{error}");
    std::fs::write(folder.path().join("my tree.bin"), &bytes).expect("room");
    assert_eq!(read(&path).expect("a tree").skeleton.segments.len(), tree(1, 2).segments.len(), "read");
    for elsewhere in ["../a.bin", "/etc/hostname", "http://example.org/a.bin", "a%zz.bin", "", "C:/a.bin"] {
        document["buffers"][0]["uri"] = elsewhere.into();
        assert!(refusal(&document).contains("not a file beside it"), "{elsewhere}");
    }
    #[cfg(unix)]
    {
        let outside = tempfile::NamedTempFile::new().expect("a temporary file");
        std::fs::write(outside.path(), &bytes).expect("room");
        std::os::unix::fs::symlink(outside.path(), folder.path().join("link.bin")).expect("room");
        document["buffers"][0]["uri"] = "link.bin".into();
        std::fs::write(&path, document.to_string()).expect("room");
        let error = read(&path).expect_err("a link that leads out").to_string();
        assert!(error.contains("'link.bin' is not a file beside it"), "{error}");
    }
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64,%%".into();
    assert!(refusal(&document).contains("not base64"), "{}", refusal(&document));
    document["buffers"][0].as_object_mut().expect("a buffer").remove("uri");
    assert!(refusal(&document).contains("no binary chunk"), "{}", refusal(&document));
    assert!(read(folder.path()).expect_err("a folder").to_string().contains("a directory"), "a folder");
    let missing = folder.path().join("none.glb");
    assert!(read(&missing).expect_err("missing").to_string().contains("none.glb"), "no file");
}

#[test]
fn wind_weights_grow_towards_the_tips() {
    let skeleton = tree(3, 3);
    let document = {
        let text = to_gltf(&skeleton, &bark_mesh(&skeleton, BarkDetail::Full), &GltfLook::default());
        serde_json::from_str::<Value>(&text).expect("JSON")
    };
    let gltf = gltf::Gltf::from_slice(document.to_string().as_bytes()).expect("glTF");
    let read = read_bytes(document.to_string().as_bytes(), Path::new("a.gltf")).expect("a tree");
    let accessor = usize::try_from(
        document["meshes"][0]["primitives"][0]["attributes"][WIND_WEIGHT].as_u64().expect("an accessor"),
    )
    .expect("small");
    let view = gltf.accessors().nth(accessor).expect("there").view().expect("a view");
    let uri = document["buffers"][0]["uri"].as_str().expect("a data URI");
    let bytes = STANDARD.decode(uri.split_once(',').expect("a comma").1).expect("base64");
    let numbers: Vec<f32> = bytes[view.offset()..view.offset() + view.length()]
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect();
    let weights = numbers.as_chunks::<4>().0;
    assert_eq!(weights.len(), read.mesh.positions_m.len(), "one for each vertex");
    let top = (0..weights.len())
        .max_by(|&a, &b| read.mesh.positions_m[a][1].total_cmp(&read.mesh.positions_m[b][1]))
        .expect("vertices");
    assert!(weights[0][0] < 1e-3 && weights[top][0] > 0.99, "{:?} and {:?}", weights[0], weights[top]);
    for (weight, (joints, place)) in weights.iter().zip(read.mesh.joints.iter().zip(&read.mesh.positions_m)) {
        assert!(weight.iter().all(|x| (0.0..=1.0).contains(x)), "{weight:?} at {place:?}");
        let is_trunk = joints.iter().all(|&joint| skeleton.segments[usize::from(joint)].order == 0);
        assert!(
            !is_trunk || weight[1..3] == [0.0, 0.0],
            "the trunk has no phase and is no branch: {weight:?}"
        );
    }
    let farthest = weights.iter().map(|weight| weight[2]).fold(0.0, f32::max);
    assert!((farthest - 1.0).abs() < 1e-5, "the farthest tip bends most: {farthest}");
    assert!(weights.iter().any(|weight| weight[3] > 0.5), "twigs flutter");
}
