// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles in tracks and exports: every format holds the living ones, with the same numbers.

use std::collections::HashMap;
use std::fs;

use glam::Vec3;
use tempfile::TempDir;

use crate::common_cli::{assert_refused, file, folder, windfall};
use crate::export::{PLACE, SPEED, export, numbers, sample, table};

/// Sparks that bounce and die, shells in vacuum that nothing meets, and a burst after the end.
const SCENE: &str = r#"(
    species: [(name: "plate", shape: Plate, size_m: 0.06)],
    sources: [(shape: Sphere(center_m: (0.0, 1.0, 0.0), radius_m: 0.3), count: 3)],
    particles: [
        (name: "hot sparks", count: 90, from: Disc(center_m: (0.0, 0.3, 0.0), radius_m: 0.2),
         direction: Cone(axis: (0.0, 1.0, 0.0), half_angle_deg: 40.0), speed_m_s: Uniform(1.0, 0.5),
         release: Rate(per_s: 80.0, from_s: 0.1), life_s: Some(Uniform(0.8, 0.15)), size_m: Uniform(0.01, 0.004),
         air: Linear(time_s: Constant(0.5)), meets: Bounce(restitution: 0.1, friction: Coulomb(0.5))),
        (name: "shells", count: 8, from: Line(from_m: (-1.0, 5.0, 0.0), to_m: (1.0, 5.0, 0.0)),
         release: Burst(at_s: 0.0), life_s: None, speed_m_s: Constant(3.0), size_m: Constant(0.125), air: Vacuum, meets: Nothing,
         history: Some((samples: 5, every_steps: 4)), look: (ribbon: Some((width: 0.5, alone: false)))),
        (name: "late", count: 4, release: Burst(at_s: 60.0)),
    ],
)"#;

/// Frames that are exported, at 30 a second: every other step.
const FRAMES: &str = "0..30";

type Row = HashMap<String, String>;

fn scene() -> TempDir {
    let there = folder();
    file(&there, "scene.ron", SCENE);
    there
}

/// The exported table of particles, frame by frame.
fn frames(there: &TempDir) -> Vec<Vec<Row>> {
    export(there, FRAMES, "a.csv", &["--fps", "30"]);
    let mut frames = vec![Vec::new(); 31];
    for row in table(&there.path().join("a_particles.csv")) {
        frames[row["frame"].parse::<usize>().expect("a number")].push(row);
    }
    frames
}

/// The rows of a population.
fn of<'a>(rows: &'a [Row], population: &str) -> Vec<&'a Row> {
    rows.iter().filter(|row| row["population"] == population).collect()
}

#[test]
fn tables_hold_the_living_particles() {
    let there = scene();
    let frames = frames(&there);
    let run = ["simulate", "scene.ron", "--backend", "cpu", "--json", "--steps", "60"];
    let report = windfall(&there, &run).json();
    for (number, name) in ["hot sparks", "shells", "late"].into_iter().enumerate() {
        let alive = report["particles"][number]["alive"].as_u64().expect("a whole number");
        assert_eq!(of(&frames[30], name).len() as u64, alive, "{name} that live: {report}");
    }
    assert!(
        of(&frames[2], "hot sparks").is_empty() && of(&frames[30], "hot sparks").len() > 30,
        "born by then"
    );
    let states = frames.iter().flatten().map(|row| row["state"].as_str());
    let resting = states.inspect(|state| assert!(["flying", "resting"].contains(state), "{state}"));
    assert!(resting.filter(|state| *state == "resting").count() > 0, "some come to rest");
    for row in frames.iter().flatten() {
        let [size_m, age_s] = numbers(row, ["size_m", "age_s"]);
        let sizes = if row["population"] == "shells" { 0.125..=0.125 } else { 0.0059..=0.0141 };
        assert!(sizes.contains(&size_m), "{row:?}");
        assert!((0.0..1.01).contains(&age_s), "{row:?}");
    }
    // A shell is where a body thrown into nothing is.
    let start = of(&frames[1], "shells");
    for (shell, first) in of(&frames[30], "shells").into_iter().zip(start) {
        assert_eq!((&shell["id"], &shell["particle"]), (&first["id"], &first["particle"]), "the same slot");
        let [age_s] = numbers(shell, ["age_s"]);
        assert!((age_s - 1.0).abs() < 1e-6, "born in the first step: {shell:?}");
        let time_s = age_s - numbers(first, ["age_s"])[0];
        let [place, velocity] = [PLACE, SPEED].map(|names| Vec3::from(numbers(first, names)));
        let fallen = place + velocity * time_s - Vec3::Y * (0.5 * 9.806_65 * time_s * time_s);
        assert!(fallen.distance(numbers(shell, PLACE).into()) < 1e-3, "{shell:?}");
    }
}

#[test]
fn tracks_of_a_population_are_those_of_the_export() {
    let there = scene();
    let frames = frames(&there);
    let track = |steps: &str, more: &[&str]| {
        let run = ["simulate", "scene.ron", "--backend", "cpu", "--steps", steps, "--tracks", "t.csv"];
        windfall(&there, &[&run[..], &["--population", "hot sparks"], more].concat()).text();
        fs::read_to_string(there.path().join("t.csv")).expect("tracks")
    };
    let text = track("60", &["--track-every", "2"]);
    let header = "step,time_s,population,particle,id,state,age_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,size_m";
    assert_eq!(text.lines().next(), Some(header), "the header");
    let tracked = table(&there.path().join("t.csv"));
    let exported: Vec<&Row> = frames.iter().flat_map(|rows| of(rows, "hot sparks")).collect();
    assert_eq!(tracked.len(), exported.len(), "a row for each living one and step");
    for (row, wanted) in tracked.iter().zip(exported) {
        assert!(row.iter().all(|(name, value)| &wanted[name] == value), "{row:?} is not {wanted:?}");
    }
    track("150", &["--track-leaves", "5"]);
    let slots = table(&there.path().join("t.csv"));
    assert!(slots.iter().all(|row| numbers(row, ["particle"])[0] < 5.0) && slots.len() > 100, "five slots");
    let ids: std::collections::BTreeSet<&str> = slots.iter().map(|row| row["id"].as_str()).collect();
    assert!(ids.len() > 5, "slots are used again: {ids:?}");

    for (scene, essentials) in [
        ("scene.ron", &["--population is 'fog'", "allowed: 'hot sparks', 'shells', 'late'"][..]),
        ("storm", &["--population is 'fog'", "no particles"]),
    ] {
        let run = ["simulate", scene, "--backend", "cpu", "--steps", "1", "--tracks", "fog.csv"];
        assert_refused(&there, &[&run[..], &["--population", "fog"]].concat(), essentials);
    }
}

#[test]
fn point_clouds_have_the_numbers_of_the_table() {
    let there = scene();
    let frames = frames(&there);
    export(&there, FRAMES, "clouds", &["--fps", "30"]);
    for number in [0, 30] {
        let path = there.path().join(format!("clouds/particles_{number:06}.ply"));
        assert!(path.with_file_name(format!("frame_{number:06}.ply")).is_file(), "beside the leaves");
        let bytes = fs::read(path).expect("a file");
        let end = b"end_header\n";
        let start = bytes.windows(end.len()).position(|part| part == end).expect("a header") + end.len();
        let header = String::from_utf8_lossy(&bytes[..start]);
        assert!(header.starts_with("ply\nformat binary_little_endian 1.0\n"), "{header}");
        assert!(header.contains("comment population 1 shells\n"), "{header}");
        let names: Vec<&str> =
            header.lines().filter_map(|line| line.strip_prefix("property float ")).collect();
        assert_eq!(names, ["x", "y", "z", "vx", "vy", "vz", "size", "age"], "{header}");
        let rows = &frames[number];
        assert!(header.contains(&format!("element vertex {}\n", rows.len())), "{header}");
        let width = 4 * names.len() + 6;
        assert_eq!(bytes.len() - start, width * rows.len(), "as long as the header says");
        for (vertex, row) in bytes[start..].chunks(width).zip(rows) {
            let word = |at: usize| [vertex[at], vertex[at + 1], vertex[at + 2], vertex[at + 3]];
            let floats: Vec<f32> = (0..names.len()).map(|at| f32::from_le_bytes(word(4 * at))).collect();
            assert_eq!(floats[..3], numbers(row, PLACE), "{row:?}");
            assert_eq!(floats[3..6], numbers(row, SPEED), "{row:?}");
            assert_eq!(floats[6..], numbers(row, ["size_m", "age_s"]), "{row:?}");
            assert_eq!(u32::from_le_bytes(word(4 * names.len())).to_string(), row["id"], "{row:?}");
            let state = ["", "flying", "resting"][usize::from(vertex[width - 2])];
            let population = ["hot sparks", "shells", "late"][usize::from(vertex[width - 1])];
            assert_eq!((state, population), (row["state"].as_str(), row["population"].as_str()), "{row:?}");
        }
    }
}

#[test]
fn a_stage_has_points_with_the_numbers_of_the_table() {
    let there = scene();
    let frames = frames(&there);
    export(&there, FRAMES, "shot.usda", &["--fps", "30"]);
    let read = |name: &str| fs::read_to_string(there.path().join(name)).expect("a layer");
    let (stage, layer) = (read("shot_layers/stage.usda"), read("shot_layers/frames_00000.usda"));
    assert_eq!(stage.matches("def Points ").count(), 3, "a prim for each population");
    for (prim, name) in [("hot_sparks", "hot sparks"), ("shells", "shells"), ("late", "late")] {
        assert!(stage.contains(&format!("def Points \"{prim}\" (\ndisplayName = \"{name}\"")), "{prim}");
        let own = layer.split_once(&format!("over \"{prim}\"")).expect("samples").1;
        for number in [0, 12, 30] {
            let rows = of(&frames[number as usize], name);
            let column = |names: &[&str]| -> Vec<f32> {
                let fields = rows.iter().flat_map(|row| names.iter().map(|name| row[*name].parse()));
                fields.collect::<Result<_, _>>().expect("numbers")
            };
            let at = |declaration| sample(own, declaration, number);
            assert_eq!(at("point3f[] points"), column(&PLACE), "{name}, frame {number}");
            assert_eq!(at("vector3f[] velocities"), column(&SPEED), "{name}, frame {number}");
            assert_eq!(at("float[] widths"), column(&["size_m"]), "{name}, frame {number}");
            assert_eq!(at("int64[] ids"), column(&["id"]), "{name}, frame {number}");
            assert_eq!(at("float[] primvars:windfall:age"), column(&["age_s"]), "{name}, frame {number}");
            let extent = at("float3[] extent");
            if rows.is_empty() {
                assert!(extent[0] > extent[3], "of nothing: {extent:?}");
            }
            for (place, size) in column(&PLACE).chunks(3).zip(column(&["size_m"])) {
                for axis in 0..3 {
                    let (low, high) = (place[axis] - 0.5 * size, place[axis] + 0.5 * size);
                    assert!(extent[axis] <= low && high <= extent[3 + axis], "{name}, frame {number}");
                }
            }
        }
    }
}

/// The way of a body thrown into nothing is a parabola, back from where it is.
#[test]
fn a_stage_has_curves_of_ways() {
    let there = scene();
    export(&there, FRAMES, "shot.usda", &["--fps", "30"]);
    let read = |name: &str| fs::read_to_string(there.path().join(name)).expect("a layer");
    let (stage, layer) = (read("shot_layers/stage.usda"), read("shot_layers/frames_00000.usda"));
    assert_eq!(stage.matches("def BasisCurves ").count(), 1, "a prim for what keeps samples");
    assert!(stage.contains("def BasisCurves \"shells\" (\ndisplayName = \"shells\""), "{stage}");
    let points = layer
        .split_once("over \"Particles\"")
        .expect("points")
        .1
        .split_once("over \"shells\"")
        .expect("shells")
        .1;
    let ways = layer.split_once("over \"Histories\"").expect("histories").1;
    for (number, backs) in [
        (0, &[][..]),
        (5, &[0.0, 2.0, 6.0][..]),
        (12, &[0.0, 4.0, 8.0, 12.0, 16.0][..]),
        (29, &[0.0, 2.0, 6.0, 10.0, 14.0, 18.0][..]),
    ] {
        let at = |declaration| sample(ways, declaration, number);
        let (places, speeds) =
            (sample(points, "point3f[] points", number), sample(points, "vector3f[] velocities", number));
        let shells = if backs.is_empty() { 0 } else { 8 };
        assert_eq!(at("int[] curveVertexCounts"), vec![backs.len() as f32; shells], "frame {number}");
        assert_eq!(at("int64[] primvars:windfall:id").len(), shells, "frame {number}");
        let (found, widths) = (at("point3f[] points"), at("float[] widths"));
        assert_eq!(
            (found.len(), widths.len()),
            (3 * shells * backs.len(), shells * backs.len()),
            "frame {number}"
        );
        for (shell, way) in found.chunks(3 * backs.len().max(1)).enumerate() {
            let three = |row: &[f32], at: usize| Vec3::new(row[3 * at], row[3 * at + 1], row[3 * at + 2]);
            for (point, back) in backs.iter().enumerate() {
                let time_s = back / 60.0;
                let expected = three(&places, shell)
                    - three(&speeds, shell) * time_s
                    - Vec3::Y * (0.5 * 9.806_65 * time_s * time_s);
                let off_m = three(way, point).distance(expected);
                assert!(off_m < 1e-4, "frame {number}, shell {shell}, {back} steps ago: {off_m} m off");
            }
            let own = &widths[shell * backs.len()..][..backs.len()];
            assert!((own[0] - 0.0625).abs() < 1e-6 && own.is_sorted_by(|a, b| a >= b), "{own:?}");
        }
    }
}

#[test]
fn gltf_leaves_particles_out_and_says_so() {
    let there = scene();
    let run = ["export", "scene.ron", "--backend", "cpu", "--frames", "0..1", "--out", "a.glb"];
    let outcome = windfall(&there, &run);
    assert!(outcome.stderr.contains("particles are left out"), "{}", outcome.stderr);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
}

#[test]
fn a_scene_without_particles_has_no_table_of_them() {
    let there = folder();
    let run = ["export", "six-motions", "--backend", "cpu", "--frames", "0..1", "--out"];
    windfall(&there, &[&run[..], &["a.csv"]].concat()).text();
    windfall(&there, &[&run[..], &["clouds"]].concat()).text();
    assert!(!there.path().join("a_particles.csv").exists(), "a table of nothing");
    assert!(!there.path().join("clouds/particles_000000.ply").exists(), "a cloud of nothing");
}
