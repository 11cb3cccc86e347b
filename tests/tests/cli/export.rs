// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall export`: every format holds what `simulate` computes, and what is refused leaves nothing behind.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use glam::Vec3;
use tempfile::TempDir;

use crate::common_cli::{assert_interrupted, assert_refused, file, folder, windfall};

/// A scene in which leaves hang, fall, lie and wait, and whose pictures are made in no time.
const SCENE: &str = r#"(
    wind: (speed: Beaufort(5)),
    species: [(name: "plate, \"thin\"", shape: Plate, size_m: 0.06)],
    sources: [(shape: Sphere(center_m: (0.0, 0.4, 0.0), radius_m: 0.3), count: 30,
               release: Rate(per_s: 8.0, from_s: -3.0), recycle_after_s: 0.6)],
    tree_kinds: [(name: "mine", form: Preset(Weed), foliage: (species: Some("plate, \"thin\"")))],
    trees: [(kind: "mine", at_m: (2.0, -1.0), leaves: 10)],
)"#;
pub(super) const LEAVES: usize = 40;

pub(super) fn scene() -> TempDir {
    let there = folder();
    file(&there, "scene.ron", SCENE);
    there
}

pub(super) fn export(there: &TempDir, frames: &str, out: &str, more: &[&str]) {
    let options = ["export", "scene.ron", "--backend", "cpu", "--frames", frames, "--out", out];
    let printed = windfall(there, &[&options, more].concat()).text();
    assert!(printed.trim().ends_with(out), "the path of what was written: {printed}");
}

/// Rows of a table as columns by name; no field of these tables but the species' holds a comma.
pub(super) fn table(path: &Path) -> Vec<HashMap<String, String>> {
    let text = fs::read_to_string(path).expect("a table").replace("\"plate, \"\"thin\"\"\"", "plate");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields.len(), names.len(), "{line}");
        names.iter().zip(fields).map(|(name, field)| ((*name).to_owned(), field.to_owned())).collect()
    };
    lines.map(row).collect()
}

/// The numbers in the columns of a row.
pub(super) fn numbers<const N: usize>(row: &HashMap<String, String>, names: [&str; N]) -> [f32; N] {
    names.map(|name| row[name].parse().expect("a number"))
}

pub(super) const PLACE: [&str; 3] = ["x_m", "y_m", "z_m"];
pub(super) const SPEED: [&str; 3] = ["vx_m_s", "vy_m_s", "vz_m_s"];
pub(super) const TURN: [&str; 4] = ["qx", "qy", "qz", "qw"];

/// The rows that the table has for a frame, slot by slot.
pub(super) fn frame(there: &TempDir, number: u32) -> Vec<HashMap<String, String>> {
    let range = format!("{number}..{number}");
    export(there, &range, "frame.csv", &["--fps", "30"]);
    table(&there.path().join("frame.csv"))
}

#[test]
fn tables_hold_what_simulate_computes() {
    let there = scene();
    let tracks = ["--steps", "60", "--track-every", "2", "--tracks", "t.csv"];
    windfall(&there, &[&["simulate", "scene.ron", "--backend", "cpu"], &tracks[..]].concat()).text();
    let simulated = table(&there.path().join("t.csv"));
    export(&there, "0..30", "a.csv", &["--fps", "30"]);
    let exported = table(&there.path().join("a.csv"));
    assert_eq!(exported.len(), 31 * LEAVES, "a row for every leaf and frame");
    let mut seen = HashMap::new();
    for (row, wanted) in exported.iter().zip(&simulated) {
        *seen.entry(wanted["state"].clone()).or_insert(0) += 1;
        let step: u32 = row["step"].parse().expect("a number");
        assert_eq!(step, 2 * row["frame"].parse::<u32>().expect("a number"), "two steps a frame");
        let is_attached = wanted["state"] == "attached";
        for (name, value) in wanted {
            // A leaf on its twig has the velocity of its blade, one not turned yet the identity as its turn.
            let is_zero = TURN.contains(&name.as_str()) && TURN.iter().all(|part| wanted[*part] == "0");
            if !(is_zero || is_attached && SPEED.contains(&name.as_str())) {
                assert_eq!(&row[name], value, "{name} of {row:?}");
            }
        }
        if wanted["state"] == "dormant" {
            assert_eq!(row["size_m"], "", "nowhere and of no size");
        } else {
            assert!((0.01..0.2).contains(&numbers(row, ["size_m"])[0]), "{row:?}");
        }
    }
    let states = ["attached", "falling", "resting", "dormant"];
    assert!(states.iter().all(|state| seen.contains_key(*state)), "every state is compared: {seen:?}");
    export(&there, "30..30", "b.csv", &["--fps", "30"]);
    assert_eq!(table(&there.path().join("b.csv")), exported[30 * LEAVES..], "a later start changes nothing");
}

#[test]
fn point_clouds_have_the_numbers_of_the_table() {
    let there = scene();
    export(&there, "19..20", "new/clouds", &["--fps", "30"]);
    let path = there.path().join("new/clouds/frame_000020.ply");
    assert!(there.path().join("new/clouds/frame_000019.ply").is_file(), "both frames are there");
    let bytes = fs::read(path).expect("a file");
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|part| part == end).expect("a header") + end.len();
    let header = String::from_utf8_lossy(&bytes[..start]);
    assert!(header.starts_with("ply\nformat binary_little_endian 1.0\n"), "{header}");
    let names: Vec<&str> = header.lines().filter_map(|line| line.strip_prefix("property float ")).collect();
    let wanted: Vec<_> = frame(&there, 20).into_iter().filter(|row| row["state"] != "dormant").collect();
    assert!(header.contains(&format!("element vertex {}\n", wanted.len())), "{header}");
    let width = 4 * names.len() + 6;
    assert_eq!(bytes.len() - start, width * wanted.len(), "as long as the header says");
    for (vertex, row) in bytes[start..].chunks(width).zip(&wanted) {
        let word = |at: usize| [vertex[at], vertex[at + 1], vertex[at + 2], vertex[at + 3]];
        let value = |name: &str| {
            let at = names.iter().position(|known| *known == name).expect("a property");
            f32::from_le_bytes(word(4 * at))
        };
        assert_eq!(["x", "y", "z"].map(value), numbers(row, PLACE), "{row:?}");
        assert_eq!(["vx", "vy", "vz"].map(value), numbers(row, SPEED), "{row:?}");
        assert_eq!(["qx", "qy", "qz", "qw"].map(value), numbers(row, TURN), "{row:?}");
        assert_eq!([value("size")], numbers(row, ["size_m"]), "{row:?}");
        let normal = glam::Quat::from_array(numbers(row, TURN)) * Vec3::Y;
        assert!(normal.distance(["nx", "ny", "nz"].map(value).into()) < 1e-6, "{row:?}");
        assert_eq!(u32::from_le_bytes(word(4 * names.len())).to_string(), row["id"], "{row:?}");
        let state = ["dormant", "attached", "falling", "resting"][usize::from(vertex[width - 2])];
        assert_eq!((state, vertex[width - 1]), (row["state"].as_str(), 0), "{row:?}");
    }
}

/// The sample of an attribute at a frame, as rows of numbers; one that stays is that of a frame before.
pub(super) fn sample(layer: &str, declaration: &str, frame: u32) -> Vec<f32> {
    let samples = layer.split_once(&format!("{declaration}.timeSamples = {{\n")).expect("samples").1;
    let samples = samples.split_once("\n}").expect("an end").0;
    let mut parsed = samples.lines().filter_map(|line| line.split_once(": "));
    let is_before = |number: &str| number.parse::<u32>().expect("a frame") <= frame;
    let (_, text) = parsed.rfind(|(number, _)| is_before(number)).expect("a sample before");
    let parts = text.split(|c: char| "[](), ".contains(c)).filter(|part| !part.is_empty());
    parts.map(|part| part.parse().expect("a number")).collect()
}

#[test]
fn a_stage_has_the_numbers_of_the_table() {
    let there = scene();
    export(&there, "0..20", "shot.usda", &["--fps", "30"]);
    let read = |name: &str| fs::read_to_string(there.path().join(name)).expect("a layer");
    let root = read("shot.usda");
    for line in ["endTimeCode = 20", "timeCodesPerSecond = 30", "metersPerUnit = 1", "upAxis = \"Y\""] {
        assert!(root.contains(line), "{line} is missing in {root}");
    }
    let stage = read("shot_layers/stage.usda");
    for layer in [&root, &stage] {
        for asset in layer.split('@').skip(1).step_by(2).filter(|asset| !asset.is_empty()) {
            let folder =
                if layer == &root { there.path().to_owned() } else { there.path().join("shot_layers") };
            assert!(folder.join(asset).is_file(), "{asset} is there");
        }
    }
    let layer = read("shot_layers/frames_00000.usda");
    for number in [0, 20] {
        let rows = frame(&there, number);
        let dormant: Vec<f32> = rows
            .iter()
            .filter(|row| row["state"] == "dormant")
            .flat_map(|row| numbers(row, ["id"]))
            .collect();
        assert_eq!(sample(&layer, "int64[] invisibleIds", number), dormant, "frame {number}");
        let of = |declaration, width: usize| {
            let all = sample(&layer, declaration, number);
            assert_eq!(all.len(), width * LEAVES, "{declaration} of every leaf");
            all.chunks(width).map(<[f32]>::to_vec).collect::<Vec<_>>()
        };
        let (places, speeds) = (of("point3f[] positions", 3), of("vector3f[] velocities", 3));
        let (turns, halves) = (of("quatf[] orientationsf", 4), of("quath[] orientations", 4));
        let (scales, ids) = (of("float3[] scales", 3), of("int64[] ids", 1));
        for (slot, row) in rows.iter().enumerate() {
            assert_eq!(ids[slot], numbers(row, ["id"]), "{row:?}");
            if row["state"] == "dormant" {
                assert_eq!(scales[slot], [0.0; 3], "of no size: {row:?}");
                continue;
            }
            assert_eq!(places[slot], numbers(row, PLACE), "{row:?}");
            assert_eq!(speeds[slot], numbers(row, SPEED), "{row:?}");
            let [x, y, z, w] = numbers(row, TURN);
            assert_eq!(turns[slot], [w, x, y, z], "{row:?}");
            let apart = halves[slot].iter().zip(&turns[slot]).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(apart < 1e-4, "{row:?}: {:?}", halves[slot]);
            let [size_m] = numbers(row, ["size_m"]);
            assert!((scales[slot][1] * 0.06 / size_m - 1.0).abs() < 1e-5, "{row:?}: {:?}", scales[slot]);
        }
    }
    // Again over what is there, with fewer frames.
    export(&there, "3..4", "shot.usda", &[]);
    assert!(read("shot.usda").contains("endTimeCode = 4"), "the new one");
    assert!(!read("shot_layers/frames_00000.usda").contains("\n20: "), "its layers too");
    let names =
        fs::read_dir(there.path()).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    let left: Vec<_> = names.filter(|name| name.to_string_lossy().starts_with('.')).collect();
    assert_eq!(left, Vec::<std::ffi::OsString>::new(), "nothing of the old one is left");
}

/// A scene with a box, a ball that goes two metres along x in a second, and a walker.
const SOLIDS: &str = r#"(
    species: [(name: "plate", shape: Plate, size_m: 0.06)],
    sources: [(shape: Sphere(center_m: (0.0, 1.0, 0.0), radius_m: 0.3), count: 3)],
    ground: (litter: Some((size_m: (4.0, 4.0), leaf_area_index: 0.0))),
    objects: [
        (shape: Box(size_m: (1.0, 0.5, 0.4)), at_m: (1.5, 0.25, 2.0), color: (0.5, 0.25, 0.125)),
        (shape: Sphere(radius_m: 0.25), at_m: (0.0, 0.5, -1.0), motion: Path([
            (time_s: 0.0, moved_m: (0.0, 0.0, 0.0)), (time_s: 1.0, moved_m: (2.0, 0.0, 0.0))])),
    ],
    walkers: [()],
)"#;

pub(super) fn solid_scene() -> TempDir {
    let there = folder();
    file(&there, "scene.ron", SOLIDS);
    there
}

#[test]
fn a_stage_has_objects_where_they_are() {
    let there = solid_scene();
    export(&there, "0..30", "shot.usda", &["--fps", "30"]);
    let read = |name: &str| fs::read_to_string(there.path().join(name)).expect("a layer");
    let (stage, layer) = (read("shot_layers/stage.usda"), read("shot_layers/frames_00000.usda"));
    assert!(stage.contains("(1.5, 0.25, 2, 1))"), "the box stands where it is");
    assert!(stage.contains("inputs:diffuseColor = (0.5, 0.25, 0.125)"), "in its colour");
    assert_eq!(stage.matches("def Mesh \"Walker_0_").count(), 10, "a mesh for every limb");
    assert!(!layer.contains("over \"Object_0\""), "what stands has no samples");
    let ball = layer.split_once("over \"Object_1\"").expect("samples of the ball").1;
    for (number, x_m) in [(0, 0.0), (15, 1.0), (30, 2.0)] {
        let matrix = sample(ball, "matrix4d xformOp:transform", number);
        assert!((matrix[12] - x_m).abs() < 1e-5, "frame {number}: {matrix:?}");
        assert_eq!(matrix[13..], [0.5, -1.0, 1.0], "frame {number}");
    }
    let limb = layer.split_once("over \"Walker_0_8\"").expect("samples of the trunk").1;
    let at = |number| sample(limb, "matrix4d xformOp:transform", number)[12];
    assert!((at(30) - at(0) - 1.4).abs() < 1e-4, "the walker goes {} m in a second", at(30) - at(0));
}

/// In latitudes and longitudes as OpenEXR lays them out: the middle column lies towards +z, x grows to the left.
#[test]
fn the_sky_of_a_stage_is_a_picture_that_is_brightest_around_the_sun() {
    let there = folder();
    let plate = "species: [(name: \"plate\", shape: Plate)]";
    file(&there, "low.ron", format!("({plate}, view: (sun: (elevation_deg: 25.0, azimuth_deg: 70.0)))"));
    let run =
        ["export", "low.ron", "--backend", "cpu", "--leaves", "2", "--frames", "0..1", "--out", "low.usda"];
    windfall(&there, &run).text();
    let stage = fs::read_to_string(there.path().join("low_layers/stage.usda")).expect("a stage");
    assert!(stage.contains("inputs:texture:file = @./textures/sky.hdr@"), "{stage}");
    let (_, sun) = stage.split_once("def DistantLight \"Sun\"").expect("a sun");
    let (_, matrix) = sun.split_once("xformOp:transform = ").expect("its attitude");
    let (matrix, _) = matrix.split_once('\n').expect("a line");
    let numbers: Vec<f32> = matrix
        .split(|c: char| !matches!(c, '0'..='9' | '.' | '-' | 'e'))
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().expect("a number"))
        .collect();
    // The third row: light shines the other way.
    let to_sun = Vec3::from_slice(&numbers[8..11]);
    let sky = image::open(there.path().join("low_layers/textures/sky.hdr")).expect("a picture").to_rgb32f();
    let (width, height) = (sky.width() as f32, sky.height() as f32);
    let light = |pixel: &image::Rgb<f32>| pixel.0.iter().sum::<f32>();
    let (x, y, _) = sky.enumerate_pixels().max_by(|a, b| light(a.2).total_cmp(&light(b.2))).expect("pixels");
    let longitude = std::f32::consts::PI * (1.0 - 2.0 * (x as f32 + 0.5) / width);
    let latitude = std::f32::consts::PI * (0.5 - (y as f32 + 0.5) / height);
    let [(east, north), (up, level)] = [longitude, latitude].map(libm::sincosf);
    let brightest = Vec3::new(level * east, up, level * north);
    assert!(to_sun.dot(brightest) > 0.98, "{brightest} is not towards the sun, {to_sun}");
}

#[test]
fn both_backends_write_the_same_stage() {
    let there = scene();
    for backend in ["cpu", "wgpu"] {
        let out = format!("{backend}.csv");
        let options = ["--backend", backend, "--frames", "0..12", "--out", &out];
        windfall(&there, &[&["export", "scene.ron"], &options[..]].concat()).text();
    }
    let [cpu, wgpu] = ["cpu.csv", "wgpu.csv"].map(|name| table(&there.path().join(name)));
    assert_eq!(cpu.len(), wgpu.len(), "as many rows");
    for (a, b) in cpu.iter().zip(&wgpu) {
        assert_eq!((&a["id"], &a["state"]), (&b["id"], &b["state"]), "the same leaf");
        if a["state"] != "dormant" {
            let apart = Vec3::from(numbers(a, PLACE)).distance(numbers(b, PLACE).into());
            assert!(apart < 1e-3, "{apart} m apart: {a:?} {b:?}");
        }
    }
}

#[test]
fn bad_input_is_refused_in_one_line() {
    let there = scene();
    file(&there, "plain", "a file");
    fs::create_dir(there.path().join("mine_layers")).expect("a folder");
    file(&there, "mine_layers/notes.txt", "not of an export");
    let refuse = |arguments: &[&str], essentials: &[&str]| {
        assert_refused(&there, &[&["export", "scene.ron"], arguments].concat(), essentials);
    };
    for range in ["9..3", "-1..4", "4", "1..x", "0..1000000"] {
        refuse(
            &["--frames", range, "--out", "a.csv"],
            &["--frames", range, "allowed: FIRST..LAST", "999999"],
        );
    }
    refuse(&["--out", "a.csv"], &["--frames"]);
    refuse(&["--frames", "0..1"], &["--out"]);
    refuse(&["--frames", "0..1", "--out", "a.obj"], &["--out", "a.obj", "FILE.usda", "FILE.glb", "FILE.csv"]);
    refuse(
        &["--frames", "0..1", "--out", "a.csv", "--format", "usd"],
        &["--out", "a.csv", "usd", "FILE.usda"],
    );
    refuse(&["--frames", "0..1", "--out", "a.csv", "--format", "fbx"], &["--format", "fbx", "usd", "ply"]);
    for out in ["no/a.csv", "no/a.usda", "no/a.glb"] {
        refuse(&["--frames", "0..1", "--out", out], &[out, "there is no folder"]);
    }
    refuse(&["--frames", "0..1", "--out", "plain/frames"], &["plain/frames", "cannot write"]);
    refuse(&["--frames", "0..1", "--out", "plain"], &["plain", "cannot write"]);
    refuse(&["--frames", "0..1", "--out", "mine.usda"], &["mine_layers", "no layers of an export"]);
    refuse(&["--frames", "0..1", "--out", "/dev/full", "--format", "csv"], &["/dev/full", "FILE.csv"]);
    refuse(&["--frames", "0..1", "--out", "a.csv", "--fps", "0"], &["--fps", "0", "1 to 1000"]);
    refuse(&["--frames", "0..1", "--out", "a.csv", "--backend", "cpu", "--adapter", "x"], &["--adapter"]);
    let many = ["--leaves", "5000", "--backend", "cpu", "--frames", "0..1", "--out", "a.glb"];
    refuse(&many, &["a.glb", "5000 leaves", "4096", "--leaves", "USD"]);
    let long = ["--leaves", "4000", "--backend", "cpu", "--frames", "0..99999", "--out", "a.glb"];
    refuse(&long, &["a.glb", "100000 frames", "allowed as glTF: 1024 MiB"]);
    let huge = ["--leaves", "1e7", "--frames", "0..999999", "--out", "a.csv"];
    refuse(&huge, &["--frames", "0..999999", "10000000 leaves", "GB that are free"]);
}

#[test]
fn an_interrupt_of_what_has_no_parts_leaves_nothing_behind() {
    let options = ["--frames", "0..99999", "--backend", "cpu", "--out", "a.glb"];
    assert_interrupted(&scene(), &[&["export", "scene.ron"], &options[..]].concat());
}
