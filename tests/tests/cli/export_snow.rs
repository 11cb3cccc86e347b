// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow that lies in exports: the mesh of every format has the depth that `simulate` reports.

use std::fs;

use tempfile::TempDir;

use crate::common_cli::{file, folder, windfall};
use crate::export::{export, sample, scene};
use crate::export_gltf::{floats, glb};

/// Snow on a square of 4 m x 4 m on level ground, of which none lies at first.
const SCENE: &str = r#"(
    dt_s: 0.05,
    species: [(name: "plate", shape: Plate, size_m: 0.06)],
    sources: [(shape: Sphere(center_m: (0.0, 1.0, 0.0), radius_m: 0.3), count: 3)],
    weather: Some((size_m: (4.0, 4.0), snow_mm_h: [(0.0, 20.0)], air_c: [(0.0, -2.0)])),
    particles: [
        (name: "flakes", count: 2000, release: Snowfall, from: Box(center_m: (0.0, 5.0, 0.0), half_extent_m: (2.0, 0.5, 2.0)),
         life_s: Some(Constant(8.0)), size_m: Constant(0.003), density_kg_m3: 100.0, air: Settling(m_s: Normal(1.0, 0.12)), meets: Die,
         dies: Some(Through(center_m: (0.0, 4.0, 0.0), half_extent_m: (2.0, 5.0, 2.0)))),
    ],
)"#;

/// Area of a cell in square metres.
const CELL_M2: f32 = 1.0 / 64.0;

fn snowy() -> TempDir {
    let there = folder();
    file(&there, "scene.ron", SCENE);
    there
}

/// A corner of snow.
#[derive(Clone, Copy, Debug)]
struct Corner {
    place_m: [f32; 3],
    depth_m: f32,
    alpha: u8,
}

/// Corners and triangles of the snow of a frame in a folder of PLY files.
fn mesh(there: &TempDir, number: u32) -> (Vec<Corner>, Vec<[usize; 3]>) {
    let bytes = fs::read(there.path().join(format!("meshes/snow_{number:06}.ply"))).expect("a mesh");
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|part| part == end).expect("a header") + end.len();
    let header = String::from_utf8_lossy(&bytes[..start]);
    let count = |element: &str| -> usize {
        let line = header.lines().find_map(|line| line.strip_prefix(element)).expect("an element");
        line.trim().parse().expect("a number")
    };
    let floats: Vec<&str> = header.lines().filter_map(|line| line.strip_prefix("property float ")).collect();
    assert_eq!(floats, ["x", "y", "z", "nx", "ny", "nz", "depth"], "{header}");
    // Seven floats and a colour; a length and three numbers.
    let (corner_bytes, face_bytes) = (32, 13);
    let (corners, faces) = bytes[start..].split_at(corner_bytes * count("element vertex"));
    assert_eq!(faces.len(), face_bytes * count("element face"), "as long as the header says");
    let word = |bytes: &[u8], at: usize| [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
    let corner = |bytes: &[u8]| Corner {
        place_m: [0, 4, 8].map(|at| f32::from_le_bytes(word(bytes, at))),
        depth_m: f32::from_le_bytes(word(bytes, 24)),
        alpha: bytes[31],
    };
    let face = |bytes: &[u8]| [1, 5, 9].map(|at| u32::from_le_bytes(word(bytes, at)) as usize);
    (corners.chunks(corner_bytes).map(corner).collect(), faces.chunks(face_bytes).map(face).collect())
}

#[test]
fn meshes_have_the_volume_of_the_snow_that_has_fallen() {
    let there = snowy();
    export(&there, "0..40", "meshes", &["--fps", "10"]);
    let (corners, triangles) = mesh(&there, 0);
    assert_eq!((corners.len(), triangles.len()), (0, 0), "none at first");
    let mut before = 0;
    for number in [2, 10, 40] {
        let (corners, triangles) = mesh(&there, number);
        println!("frame {number}: {} corners", corners.len());
        assert!(before < corners.len(), "frame {number}: {} corners after {before}", corners.len());
        before = corners.len();
        // Over each half of a cell the mean of three corners would do if the diagonals were without a side; that of all four is exact.
        let cells = triangles.chunks(2).map(|pair| [pair[0][0], pair[0][1], pair[0][2], pair[1][2]]);
        let depths_m = cells.map(|cell| cell.map(|at| corners[at].depth_m).iter().sum::<f32>() / 4.0);
        let volume_m3 = f64::from(depths_m.sum::<f32>() * CELL_M2);
        let steps = (2 * number).to_string();
        let run = ["simulate", "scene.ron", "--backend", "cpu", "--json", "--steps", &steps];
        let report = windfall(&there, &run).json();
        let mean_m = report["snow"]["mean_depth_m"].as_f64().expect("a number");
        assert!((volume_m3 / (16.0 * mean_m) - 1.0).abs() < 1e-4, "frame {number}: {volume_m3} m3: {report}");
        for Corner { place_m, depth_m, alpha } in &corners {
            assert!((place_m[1] - depth_m).abs() < 1e-6, "on level ground: {place_m:?}, {depth_m}");
            assert!(*depth_m > 0.003 || *alpha == 0, "thin snow hides nothing: {depth_m}, {alpha}");
        }
    }
    assert!(before > 900, "{before} corners of 33 x 33");
}

#[test]
fn a_stage_and_a_gltf_file_have_the_same_mesh() {
    let there = snowy();
    export(&there, "38..40", "meshes", &["--fps", "10"]);
    export(&there, "38..40", "shot.usda", &["--fps", "10"]);
    let read = |name: &str| fs::read_to_string(there.path().join(name)).expect("a layer");
    let (stage, layer) = (read("shot_layers/stage.usda"), read("shot_layers/frames_00000.usda"));
    assert!(stage.contains("def Mesh \"Snow\""), "a prim");
    assert!(stage.contains("def Material \"snow\"") && stage.contains("\"displayOpacity\""), "its material");
    let own = layer.split_once("over \"Snow\"").expect("samples").1;
    for number in [38, 40] {
        let (corners, triangles) = mesh(&there, number);
        let indices = sample(own, "int[] faceVertexIndices", number);
        let wanted: Vec<f32> = triangles.iter().flatten().map(|corner| *corner as f32).collect();
        assert_eq!(indices, wanted, "frame {number}: the same faces");
        assert_eq!(sample(own, "int[] faceVertexCounts", number), vec![3.0; triangles.len()], "triangles");
        let places_m = sample(own, "point3f[] points", number);
        let depths_m = sample(own, "float[] primvars:windfall:snow_depth", number);
        let opacities = sample(own, "float[] primvars:displayOpacity", number);
        let lengths = [places_m.len() / 3, depths_m.len(), opacities.len()];
        assert_eq!(lengths, [corners.len(); 3], "frame {number}: as many corners");
        for (at, corner) in corners.iter().enumerate() {
            let off_m =
                (0..3).map(|axis| (places_m[3 * at + axis] - corner.place_m[axis]).abs()).fold(0.0, f32::max);
            assert!(off_m <= 5.1e-5, "frame {number}: {off_m} m beside {corner:?}");
            assert!(
                (depths_m[at] - corner.depth_m).abs() <= 5.1e-5,
                "frame {number}: {} m, {corner:?}",
                depths_m[at]
            );
            assert!(
                (opacities[at] - f32::from(corner.alpha) / 255.0).abs() < 0.01,
                "frame {number}: {corner:?}"
            );
        }
    }
    // One frame, and several, in which snow stays as in the first.
    for (range, out) in [("38..38", "one.glb"), ("38..40", "clip.glb")] {
        let run = ["export", "scene.ron", "--backend", "cpu", "--fps", "10", "--frames", range, "--out", out];
        let outcome = windfall(&there, &run);
        assert_eq!(outcome.stderr.contains("snow stays"), out == "clip.glb", "{}", outcome.stderr);
        assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
        let (document, buffer) = glb(&there.path().join(out));
        let meshes = document["meshes"].as_array().expect("meshes");
        let snow = meshes.iter().find(|mesh| mesh["name"] == "Snow").expect("snow");
        let attributes = &snow["primitives"][0]["attributes"];
        let (corners, _) = mesh(&there, 38);
        let places_m: Vec<f32> = corners.iter().flat_map(|corner| corner.place_m).collect();
        assert_eq!(floats(&document, &buffer, &attributes["POSITION"]), places_m, "{out}: places");
        let depths_m: Vec<f32> = corners.iter().map(|corner| corner.depth_m).collect();
        assert_eq!(floats(&document, &buffer, &attributes["_SNOW_DEPTH"]), depths_m, "{out}: depths");
        let material = snow["primitives"][0]["material"].as_u64().and_then(|at| usize::try_from(at).ok());
        let material = &document["materials"][material.expect("a material")];
        assert_eq!((&material["name"], &material["alphaMode"]), (&"snow".into(), &"BLEND".into()), "{out}");
    }
}

#[test]
fn a_scene_without_weather_has_no_snow() {
    let there = scene();
    export(&there, "0..1", "shot.usda", &[]);
    export(&there, "0..1", "clouds", &[]);
    export(&there, "0..0", "one.glb", &[]);
    for name in ["stage.usda", "manifest.usda", "frames_00000.usda"] {
        let text = fs::read_to_string(there.path().join("shot_layers").join(name)).expect("a layer");
        assert!(!text.to_lowercase().contains("snow"), "{name}: a prim of nothing");
    }
    assert!(!there.path().join("clouds/snow_000000.ply").exists(), "a mesh of nothing");
    let (document, _) = glb(&there.path().join("one.glb"));
    assert!(!document.to_string().to_lowercase().contains("snow"), "a node of nothing");
}
