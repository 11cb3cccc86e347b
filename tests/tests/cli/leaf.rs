// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall leaf make` in use, and scenes with leaves of their own.

use std::fs;
use std::path::PathBuf;

use crate::common_cli::{assert_refused, command, contents, file, folder, windfall};
use image::{GrayImage, Luma, Rgb, RgbImage};
use tempfile::TempDir;

/// The files of a folder with their bytes, by name.
fn files(folder: &TempDir, name: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let at = folder.path().join(name);
    let relative = |(path, bytes): (PathBuf, Vec<u8>)| {
        (path.strip_prefix(&at).expect("below the folder").to_owned(), bytes)
    };
    contents(&at).into_iter().map(relative).collect()
}

#[test]
fn leaves_are_made_from_a_name() {
    let folder = folder();
    let arguments =
        ["leaf", "make", "birch", "--count", "2", "--size", "128", "--season", "0.2,0.7", "--json"];
    let report =
        windfall(&folder, &[&arguments[..], &["--out", "birches", "--stages", "steps", "--mesh"]].concat())
            .json();
    let leaves = report["leaves"].as_array().expect("a list");
    assert_eq!(leaves.len(), 4, "two for each season");
    for (index, leaf) in leaves.iter().enumerate() {
        assert_eq!(leaf["name"], format!("birch-{:03}", index + 1), "names in order");
        for key in ["area_m2", "mass_kg", "mean_chord_m", "side_m"] {
            assert!(leaf[key].as_f64().is_some_and(|value| value > 0.0), "{key} of {leaf}");
        }
    }
    let names: Vec<String> =
        files(&folder, "birches").iter().map(|(path, _)| path.display().to_string()).collect();
    assert_eq!(names.len(), 4 * 6 + 1, "five pictures and a mesh a leaf, and the manifest: {names:?}");
    assert!(
        names.contains(&"leaves.ron".into()) && names.contains(&"birch-004.normal.png".into()),
        "{names:?}"
    );
    let steps: Vec<String> =
        files(&folder, "steps/birch-001").iter().map(|(path, _)| path.display().to_string()).collect();
    for step in
        ["contour", "veins", "distance", "regions", "superpixels", "level-1", "level-5", "smoothed", "detail"]
    {
        assert!(steps.contains(&format!("{step}.png")), "{step} is missing in {steps:?}");
    }
    let leaf = image::open(folder.path().join("birches/birch-001.png")).expect("a picture").into_rgba8();
    assert_eq!(leaf.dimensions(), (128, 128), "the size asked for");
    let alpha = |row: u32| (0..128).filter(|x| leaf.get_pixel(*x, row)[3] > 127).count();
    assert!((1..16).contains(&alpha(118)) && alpha(60) > 20, "the petiole is down");
}

#[test]
fn equal_seeds_give_equal_bytes_on_any_number_of_threads() {
    let folder = folder();
    for (out, threads) in [("one", "1"), ("three", "3")] {
        let arguments = ["leaf", "make", "oak", "--count", "3", "--size", "64", "--seed", "5", "--out", out];
        let status =
            command(&folder, &arguments).env("RAYON_NUM_THREADS", threads).output().expect("it starts");
        assert!(status.status.success(), "{}", String::from_utf8_lossy(&status.stderr));
    }
    assert_eq!(files(&folder, "one"), files(&folder, "three"), "the same files");
    windfall(
        &folder,
        &["leaf", "make", "oak", "--count", "3", "--size", "64", "--seed", "6", "--out", "other"],
    )
    .text();
    assert_ne!(files(&folder, "one"), files(&folder, "other"), "another seed, other leaves");
}

/// A picture of a plain green leaf on white paper: an ellipse with a pale midrib.
fn photo(folder: &TempDir, name: &str) -> String {
    let inside = |x: u32, y: u32| {
        let (dx, dy) = ((x as f32 - 80.0) / 45.0, (y as f32 - 110.0) / 85.0);
        dx * dx + dy * dy < 1.0
    };
    let picture = RgbImage::from_fn(160, 220, |x, y| match inside(x, y) {
        true if x.abs_diff(80) < 2 => Rgb([150, 180, 90]),
        true => Rgb([70 + u8::try_from((x * 7 + y * 13) % 11).unwrap_or(0), 120, 50]),
        false => Rgb([255; 3]),
    });
    let path = folder.path().join(name);
    picture.save(&path).expect("writable");
    let mask = GrayImage::from_fn(160, 220, |x, y| Luma([if inside(x, y) { 255 } else { 0 }]));
    mask.save(path.with_extension("mask.png")).expect("writable");
    path.to_str().expect("plain").to_owned()
}

#[test]
fn leaves_are_made_after_photos() {
    let folder = folder();
    let photo = photo(&folder, "a.png");
    let text = windfall(
        &folder,
        &["leaf", "make", "--photo", &photo, "--count", "2", "--size", "128", "--out", "made"],
    )
    .text();
    assert_eq!(text.lines().count(), 2, "a path for each leaf: {text}");
    let made = image::open(folder.path().join("made/leaf-001.png")).expect("a picture").into_rgba8();
    let middle = made.get_pixel(64, 64).0;
    assert!(
        middle[1] > middle[0] && middle[1] > middle[2] && middle[3] == 255,
        "green like the photo: {middle:?}"
    );
}

#[test]
fn photos_can_be_carried_to_another_season() {
    let folder = folder();
    let photo = photo(&folder, "a.png");
    let arguments = ["leaf", "make", "birch", "--photo", &photo, "--count", "1", "--size", "64"];
    windfall(&folder, &[&arguments[..], &["--season", "0.0,0.6", "--out", "turned"]].concat()).text();
    let middle = |name: &str| {
        let path = folder.path().join("turned").join(name);
        image::open(path).expect("a picture").into_rgba8().get_pixel(32, 36).0
    };
    let (green, yellow) = (middle("birch-001.png"), middle("birch-002.png"));
    assert!(green[1] > green[0], "green: {green:?}");
    let warmth = |[r, g, ..]: [u8; 4]| f32::from(r) / f32::from(g);
    assert!(yellow[0] > green[0] + 40, "brighter: {yellow:?}, was {green:?}");
    assert!(warmth(yellow) > 1.3 * warmth(green), "yellower: {yellow:?}, was {green:?}");
}

#[test]
fn leaves_of_one_kind_are_like_each_other_and_unlike_another() {
    let folder = folder();
    let make = |kind, count, season, seed, out| {
        let arguments = ["leaf", "make", kind, "--count", count, "--size", "256", "--season", season];
        windfall(&folder, &[&arguments[..], &["--seed", seed, "--out", out]].concat()).text();
    };
    make("hornbeam", "4", "0.5", "1", "these");
    make("hornbeam", "4", "0.5", "2", "those");
    make("oak", "2", "0.1", "3", "oaks");
    let compare = |generated, photos| {
        let arguments = ["leaf", "compare", "--generated", generated, "--photos", photos];
        windfall(&folder, &[&arguments[..], &["--json", "--sheet", "sheet.png"]].concat()).json()
    };
    let (same, other) = (compare("those", "these"), compare("oaks", "these"));
    assert_eq!(same["leaves"].as_array().map(Vec::len), Some(4), "{same}");
    assert_eq!(other["verdict"], "fail", "green oaks are no yellow hornbeams: {other}");
    let keys = same["median"].as_object().expect("numbers").keys();
    assert_eq!(keys.len(), 12, "twelve numbers");
    for key in keys.filter(|key| ["delta_e_2000", "one_minus_iou"].contains(&key.as_str())) {
        let of = |report: &serde_json::Value| report["median"][key].as_f64().expect("a number");
        assert!(of(&same) < 0.5 * of(&other), "{key}: {} and {}", of(&same), of(&other));
    }
    let sheet = image::open(folder.path().join("sheet.png")).expect("a picture");
    assert!(sheet.width() > 500 && sheet.height() > 200, "photos above leaves");
    let alone = windfall(&folder, &["leaf", "compare", "--generated", "those", "--photos", "these"]).text();
    let last = alone.trim_end().lines().last();
    assert!(matches!(last, Some("PASS" | "FAIL")), "a verdict comes last: {alone}");
    assert_refused(&folder, &["leaf", "compare", "--generated", "none", "--photos", "these"], &["none"]);
}

#[test]
fn what_is_read_from_a_photo_is_drawn_over_it() {
    let folder = folder();
    windfall(&folder, &["leaf", "make", "beech", "--count", "1", "--size", "256", "--out", "beech"]).text();
    let text = windfall(&folder, &["leaf", "veins", "beech/beech-001.png", "--out", "over.png"]).text();
    let number = |name: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(name)).expect("a line for each number");
        line.trim().parse::<f32>().expect("a number")
    };
    assert!(number("main veins") >= 1.0 && number("lateral veins") >= 4.0, "{text}");
    assert!(number("confidence") > 0.6, "root and tip of a whole leaf are found: {text}");
    assert!(image::open(folder.path().join("over.png")).is_ok(), "a picture");
    assert_refused(&folder, &["leaf", "veins", "none.png", "--out", "none2.png"], &["none.png"]);
    assert_refused(&folder, &["leaf", "veins", "beech/beech-001.png", "--out", "over.txt"], &["over.txt"]);
}

#[test]
fn bad_input_is_refused_in_one_line_and_leaves_nothing() {
    let folder = folder();
    let make = |rest: &[&'static str]| [&["leaf", "make", "--out", "made"][..], rest].concat();
    assert_refused(&folder, &make(&[]), &["SPECIES"]);
    assert_refused(&folder, &make(&["fern"]), &["fern", "hornbeam"]);
    assert_refused(
        &folder,
        &make(&["oak", "--season", "1.5"]),
        &["--season", "1.5", "0 (green) to 1 (brown)"],
    );
    assert_refused(&folder, &make(&["oak", "--season", "0.2,x"]), &["--season", "x"]);
    assert_refused(&folder, &make(&["oak", "--count", "0"]), &["--count", "1 to 999"]);
    assert_refused(&folder, &make(&["oak", "--size", "100"]), &["--size", "100", "128"]);
    assert_refused(&folder, &make(&["--photo", "none.png"]), &["none.png"]);
    assert_refused(&folder, &make(&["oak", "--mask", "m.png"]), &["m.png", "--photo"]);
    assert_refused(&folder, &make(&["oak", "--stages", "made"]), &["--stages", "--out"]);
    file(&folder, "text.png", b"no picture");
    assert_refused(&folder, &make(&["--photo", "text.png"]), &["text.png"]);
    let blank = RgbImage::from_pixel(64, 64, Rgb([255; 3]));
    blank.save(folder.path().join("blank.png")).expect("writable");
    assert_refused(&folder, &make(&["--photo", "blank.png"]), &["blank.png"]);
    file(&folder, "occupied", b"a file");
    let occupied = ["leaf", "make", "oak", "--out", "occupied"];
    assert_refused(&folder, &occupied, &["occupied", "not a folder"]);
    let below = ["leaf", "make", "oak", "--out", "occupied/made"];
    assert_refused(&folder, &below, &["occupied"]);
}

#[test]
fn scenes_show_the_leaves_of_a_folder() {
    let folder = folder();
    windfall(&folder, &["leaf", "make", "ginkgo", "--count", "2", "--size", "64", "--out", "fans"]).text();
    file(&folder, "mine.ron", b"(species: [(leaves: \"fans\")])");
    windfall(&folder, &["render", "mine.ron", "--frames", "1", "--size", "64x48", "--out", "mine.png"])
        .text();
    file(&folder, "lost.ron", b"(species: [(leaves: \"nowhere\")])");
    let render = ["render", "lost.ron", "--frames", "1", "--size", "64x48", "--out", "lost.png"];
    assert_refused(&folder, &render, &["nowhere", "leaves.ron", "no such file"]);
    let picture = folder.path().join("fans/ginkgo-002.png");
    let bytes = fs::read(&picture).expect("a picture");
    fs::write(&picture, &bytes[..bytes.len() / 2]).expect("writable");
    let render = ["render", "mine.ron", "--frames", "1", "--size", "64x48", "--out", "half.png"];
    assert_refused(&folder, &render, &["ginkgo-002.png", "no whole PNG"]);
}
