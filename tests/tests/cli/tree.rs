// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall tree` in use: trees as glTF files, and trees in numbers.

use std::fs;

use crate::common_cli::{assert_refused, file, folder, windfall};
use serde_json::Value;
use tempfile::TempDir;
use windfall_core::tree::{AttachmentKind, gltf};

/// Kinds of trees that need no file.
const KINDS: [&str; 6] = ["maple", "birch", "oak", "bush", "weed", "berry-bush"];

fn info(folder: &TempDir, arguments: &[&str]) -> Value {
    windfall(folder, &[&["tree", "info"], arguments, &["--json"]].concat()).json()
}

#[test]
fn every_kind_is_exported_and_read_again() {
    let folder = folder();
    for kind in KINDS {
        let path = format!("{kind}.glb");
        let report = windfall(&folder, &["tree", "export", kind, "--out", &path, "--json"]).json();
        assert_eq!(report["file"], path.as_str(), "{report}");
        let bytes = fs::metadata(folder.path().join(&path)).expect("a file").len();
        assert_eq!(report["bytes"], bytes, "{report}");
        let read = gltf::read(&folder.path().join(&path)).expect("a tree");
        let grown = info(&folder, &[kind]);
        let again = info(&folder, &[&path]);
        assert_eq!(again["segments"], read.skeleton.segments.len(), "{again}");
        for key in ["segments", "depth", "orders", "leaves", "fruit", "bark"] {
            assert_eq!(grown[key], again[key], "{kind}: {key}");
        }
        for key in ["height_m", "crown_m"] {
            let value = |report: &Value| report[key].as_f64().expect("a number");
            assert!((value(&grown) - value(&again)).abs() < 1e-4, "{kind}: {key} of {grown} and {again}");
        }
        assert_eq!(report["joints"], grown["segments"], "{report}");
        let fruit = read.skeleton.attachments.iter().filter(|a| a.kind == AttachmentKind::Fruit).count();
        assert_eq!(fruit > 0, kind == "berry-bush", "{kind} bears {fruit} fruit");
    }
}

#[test]
fn details_ages_heights_and_numbers_change_the_tree() {
    let folder = folder();
    let export = |rest: &[&str]| {
        let arguments = [&["tree", "export", "maple", "--json", "--out", "maple.glb"], rest].concat();
        windfall(&folder, &arguments).json()["triangles"].as_u64().expect("a number")
    };
    let [full, middle, far] = ["full", "middle", "far"].map(|detail| export(&["--detail", detail]));
    assert!(full > 2 * middle && middle > 2 * far && far > 100, "{full}, {middle}, {far}");
    let height =
        |rest: &[&str]| info(&folder, &[&["maple"], rest].concat())["height_m"].as_f64().expect("a number");
    assert!((height(&["--height", "10"]) - 10.0).abs() < 1e-3, "full-grown as high as asked");
    assert!(height(&["--age", "0.2"]) < 0.7 * height(&[]), "a young tree is lower");
    let trunk = info(&folder, &["maple"])["diameter_m"].as_f64().expect("a trunk");
    assert!((0.2..1.0).contains(&trunk), "{trunk} m thick at breast height");
    assert_eq!(info(&folder, &["weed"])["diameter_m"], Value::Null, "a herb is lower than that");
    let bytes = |rest: &[&str]| {
        windfall(&folder, &[&["tree", "export", "birch", "--out", "birch.glb"], rest].concat()).text();
        fs::read(folder.path().join("birch.glb")).expect("a file")
    };
    let first = bytes(&[]);
    assert!(first == bytes(&[]), "the same bytes again");
    assert!(first != bytes(&["--number", "3"]) && first != bytes(&["--seed", "3"]), "another tree");
    assert_eq!(info(&folder, &["oak", "--leaves", "50"])["leaves"], 50, "as many leaves as asked for");
}

#[test]
fn trees_of_scenes_are_exported_as_text_too() {
    let folder = folder();
    let scene = "(trees: [(kind: \"weed\"), (kind: \"birch\", height_m: 9, heading_deg: 30)])";
    file(&folder, "grove.ron", scene.as_bytes());
    let text =
        windfall(&folder, &["tree", "export", "grove.ron#1", "--out", "b.gltf", "--wind-colors"]).text();
    assert_eq!(text, "b.gltf\n", "it says where the file is");
    let text = fs::read_to_string(folder.path().join("b.gltf")).expect("text");
    let document: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(document["asset"]["generator"], "Windfall", "{}", document["asset"]);
    let attributes = &document["meshes"][0]["primitives"][0]["attributes"];
    assert_eq!(attributes["COLOR_0"], attributes["_WINDWEIGHT"], "{attributes}");
    assert_eq!(document["scenes"][0]["name"], "grove.ron#1", "the tree's name");
    let height = info(&folder, &["grove.ron#1"])["height_m"].as_f64().expect("a number");
    assert!((height - 9.0).abs() < 1e-3, "{height} m high");
    let printed = windfall(&folder, &["tree", "info", "grove.ron#0"]).text();
    for name in ["height", "trunk", "segments", "leaves", "bark full"] {
        assert!(printed.lines().any(|line| line.starts_with(name)), "{name} is missing in\n{printed}");
    }
}

#[test]
fn scenes_plant_trees_of_files() {
    let folder = folder();
    windfall(&folder, &["tree", "export", "bush", "--out", "bush.glb"]).text();
    let kind = "tree_kinds: [(name: \"mine\", form: File(\"bush.glb\"))]";
    let scene = format!("({kind}, trees: [(kind: \"mine\", height_m: 2, leaves: 40)])");
    file(&folder, "mine.ron", scene.as_bytes());
    let report = info(&folder, &["mine.ron#0"]);
    let height = report["height_m"].as_f64().expect("a number");
    assert!((height - 2.0).abs() < 1e-3 && report["leaves"] == 40, "{report}");
    assert_eq!(report["segments"], info(&folder, &["bush"])["segments"], "all of the wood");
    fs::write(folder.path().join("bush.glb"), b"no glTF").expect("room");
    assert_refused(&folder, &["tree", "info", "mine.ron#0"], &["'mine'", "bush.glb", "not a usable glTF"]);
}

#[test]
fn bad_input_is_refused_in_one_line_and_leaves_nothing() {
    let folder = folder();
    let refuse = |rest: &[&str], essentials: &[&str]| {
        assert_refused(&folder, &[&["tree", "export", "--out", "out.glb"], rest].concat(), essentials);
        assert_refused(&folder, &[&["tree", "info"], rest].concat(), essentials);
    };
    refuse(&[], &["TREE"]);
    refuse(&["palm"], &["'palm'", "maple, birch, oak, bush, weed, berry-bush", "SCENE#INDEX"]);
    refuse(&["autumn-park#999"], &["autumn-park", "'999'"]);
    refuse(&["autumn-park#x"], &["autumn-park", "'x'"]);
    refuse(&["nowhere#0"], &["'nowhere'", "autumn-park"]);
    refuse(&["none.glb"], &["none.glb"]);
    refuse(&["maple", "--age", "2"], &["--age", "'2'", "0.05 to 1"]);
    refuse(&["maple", "--height", "nan"], &["--height", "'nan'", "0.2 to 60 m"]);
    refuse(&["maple", "--number", "-1"], &["-1"]);
    refuse(&["maple", "--leaves", "1e9"], &["--leaves", "0 to 200000"]);
    file(&folder, "text.glb", b"no glTF");
    refuse(&["text.glb"], &["text.glb", "not a usable glTF 2.0 file"]);
    file(&folder, "empty.gltf", b"{\"asset\": {\"version\": \"2.0\"}}");
    refuse(&["empty.gltf"], &["empty.gltf", "has no skin"]);
    refuse(&["empty.gltf", "--age", "1"], &["--age", "empty.gltf"]);
    windfall(&folder, &["tree", "export", "weed", "--out", "weed.glb"]).text();
    let whole = fs::read(folder.path().join("weed.glb")).expect("a file");
    file(&folder, "half.glb", &whole[..whole.len() / 2]);
    refuse(&["half.glb"], &["half.glb", "not a usable glTF 2.0 file"]);
    let export = |rest: &[&str], essentials: &[&str]| {
        assert_refused(&folder, &[&["tree", "export", "maple"], rest].concat(), essentials);
    };
    export(&[], &["--out <FILE>"]);
    export(&["--out", "maple.obj"], &["maple.obj", ".glb or .gltf"]);
    export(&["--out", "missing/maple.glb"], &["missing", "no folder"]);
    export(&["--out", "maple.glb", "--detail", "fine"], &["'fine'", "full, middle, far"]);
    // What lies at the destination stays if the tree cannot be had.
    assert_refused(&folder, &["tree", "export", "half.glb", "--out", "weed.glb"], &["half.glb"]);
}

#[test]
fn shedding_is_plotted() {
    let folder = folder();
    let arguments = ["tree", "shedding", "weed", "--minutes", "1", "--leaves", "200", "--out", "weed.png"];
    let printed = windfall(&folder, &arguments).text();
    assert!(printed.starts_with("weed.png: 5 seasons, "), "{printed}");
    let picture = image::open(folder.path().join("weed.png")).expect("a picture").to_rgb8();
    assert_eq!(picture.dimensions(), (1600, 1000), "size");
    // Curves, ink and the paper between them.
    let count = |is: fn([u8; 3]) -> bool| picture.pixels().filter(|pixel| is(pixel.0)).count();
    let (paper, ink) = (count(|[r, g, b]| r.min(g).min(b) > 225), count(|[r, g, b]| r.max(g).max(b) < 90));
    let color = count(|[r, _, b]| r > 190 && b < 80);
    assert!(paper > 1_200_000 && ink > 4000 && color > 3000, "{paper} paper, {ink} ink, {color} colour");

    let out = ["--out", "other.png"];
    assert_refused(
        &folder,
        &[&["tree", "shedding", "fern"], &out[..]].concat(),
        &["fern", "allowed", "maple"],
    );
    assert_refused(&folder, &["tree", "shedding", "weed", "--out", "a.jpg"], &["a.jpg", ".png"]);
    let minutes = ["tree", "shedding", "weed", "--minutes", "61", "--out", "other.png"];
    assert_refused(&folder, &minutes, &["--minutes", "1 to 60"]);
}
