// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles that are drawn as blobs: one picture on both backends, and a mesh that looks like it.

use std::fs;

use glam::{Vec2, Vec3};
use image::RgbaImage;
use tempfile::TempDir;

use crate::common_cli::{file, folder, windfall};
use crate::export::export;

/// Balls that hang in the air high above the ground, some together and some alone, and what is drawn of them.
fn scene(look: &str) -> TempDir {
    let there = folder();
    let scene = format!(
        r#"(
    sources: [(shape: Sphere(center_m: (0.0, 1.0, 0.0), radius_m: 0.3), count: 3)],
    particles: [
        (name: "slime", count: 12, from: Box(center_m: (0.0, 60.0, 0.0), half_extent_m: (1.3, 0.7, 0.5)),
         release: Burst(at_s: 0.0), life_s: None, speed_m_s: Constant(0.0), size_m: Uniform(0.2, 0.05), gravity: 0.0, air: Vacuum,
         meets: Nothing, look: (kind: {look}, color: [(0.0, (0.5, 0.02, 0.0))])),
    ],
    view: (camera: (eye_m: (0.0, 60.0, 5.0), target_m: (0.0, 60.0, 0.0), vertical_fov_deg: 40.0),
           sky: Physical((cloud_cover: 0.0)),
           lens: (exposure: Manual(ev100: 14.5), glare: (strength: 0.0))),
)"#
    );
    file(&there, "scene.ron", &scene);
    there
}

const BLOBS: &str = "Blobs(radius_m: 0.7, threshold: 0.4)";
/// Radius of the surface of a ball alone, over that of its field: the root of one minus the cube root of the threshold.
const LONE_RADIUS: f32 = 0.513_06;
const SIZE: (u32, u32) = (640, 360);
const EYE_M: Vec3 = Vec3::new(0.0, 60.0, 5.0);

/// Pixels of what is as large as it is far away, in the scene's camera.
fn focal_px() -> f32 {
    0.5 * SIZE.1 as f32 / 20f32.to_radians().tan()
}

fn picture(there: &TempDir, backend: &str) -> RgbaImage {
    let run =
        ["render", "scene.ron", "--backend", backend, "--frames", "3", "--size", "640x360", "--out", "a.png"];
    windfall(there, &run).text();
    image::open(there.path().join("a.png")).expect("a picture").to_rgba8()
}

/// Corners and triangles of a mesh in a PLY file.
fn mesh(bytes: &[u8]) -> (Vec<Vec3>, Vec<[usize; 3]>) {
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|part| part == end).expect("a header") + end.len();
    let header = String::from_utf8_lossy(&bytes[..start]);
    let count = |element: &str| -> usize {
        let line = header.lines().find_map(|line| line.strip_prefix(element)).expect("an element");
        line.trim().parse().expect("a number")
    };
    // Six floats, a colour and a population; a length and three numbers.
    let (corner_bytes, face_bytes) = (28, 13);
    let (corners, faces) = bytes[start..].split_at(corner_bytes * count("element vertex"));
    assert_eq!(faces.len(), face_bytes * count("element face"), "as long as the header says");
    let word = |bytes: &[u8], at: usize| [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
    let place = |bytes: &[u8]| Vec3::from_array([0, 4, 8].map(|at| f32::from_le_bytes(word(bytes, at))));
    let face = |bytes: &[u8]| [1, 5, 9].map(|at| u32::from_le_bytes(word(bytes, at)) as usize);
    (corners.chunks(corner_bytes).map(place).collect(), faces.chunks(face_bytes).map(face).collect())
}

/// Pixels whose middle a mesh covers, as the camera of the scene sees it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a small picture")]
fn silhouette((corners, triangles): &(Vec<Vec3>, Vec<[usize; 3]>)) -> Vec<bool> {
    let (width, height) = (SIZE.0 as usize, SIZE.1 as usize);
    let size_px = Vec2::new(SIZE.0 as f32, SIZE.1 as f32);
    let focal_px = focal_px();
    // It looks along -z.
    let see = |corner: &Vec3| {
        let place = Vec2::new(corner.x, EYE_M.y - corner.y) * (focal_px / (EYE_M.z - corner.z));
        0.5 * size_px + place
    };
    let seen: Vec<Vec2> = corners.iter().map(see).collect();
    let mut covered = vec![false; width * height];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| seen[corner]);
        let (low, high) = (a.min(b).min(c).floor().max(Vec2::ZERO), a.max(b).max(c).ceil().min(size_px));
        for y in low.y as usize..high.y as usize {
            for x in low.x as usize..high.x as usize {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(at - from));
                if sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0) {
                    covered[y * width + x] = true;
                }
            }
        }
    }
    covered
}

#[test]
#[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "pixels of a small picture")]
fn the_picture_of_blobs_is_the_same_on_both_backends_and_that_of_their_mesh() {
    let there = scene(BLOBS);
    let [cpu, wgpu] = ["cpu", "wgpu"].map(|backend| picture(&there, backend));
    assert!(cpu == wgpu, "one picture on both backends");
    let without = picture(&scene("Hidden"), "cpu");
    export(&there, "0..2", "meshes", &[]);
    let bytes = fs::read(there.path().join("meshes/blobs_000002.ply")).expect("a mesh");
    let silhouette = silhouette(&mesh(&bytes));

    // More than what the shade of the balls takes from the haze, and less than the rim of a glint differs from the ground.
    let is_drawn =
        |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| (0..3).any(|c| a.0[c].abs_diff(b.0[c]) > 15);
    let drawn: Vec<bool> = cpu.pixels().zip(without.pixels()).map(is_drawn).collect();
    let count = |mask: &[bool]| mask.iter().filter(|is_in| **is_in).count() as f64;
    let (seen, expected) = (count(&drawn), count(&silhouette));
    println!("{seen} pixels are drawn, {expected} of the mesh");
    assert!(
        expected > 20_000.0 && (seen / expected - 1.0).abs() < 0.01,
        "{seen} pixels, {expected} of the mesh"
    );
    // Outlines are at most half a cell of the mesh apart.
    let half_cell_px = (0.5 * 0.7 * LONE_RADIUS / 7.0 * focal_px() / (EYE_M.z + 0.5)).floor() as i32;
    assert!(half_cell_px >= 1, "the picture is fine enough");
    let (width, height) = (SIZE.0 as i32, SIZE.1 as i32);
    let near = |mask: &[bool], at: usize, wanted: bool| {
        let (x, y) = (at as i32 % width, at as i32 / width);
        let range = |at: i32, most: i32| (at - half_cell_px).max(0)..=(at + half_cell_px).min(most - 1);
        range(y, height).any(|y| range(x, width).any(|x| mask[(y * width + x) as usize] == wanted))
    };
    let strays: Vec<(i32, i32)> = (0..drawn.len())
        .filter(|&at| !near(&silhouette, at, drawn[at]))
        .map(|at| (at as i32 % width, at as i32 / width))
        .collect();
    assert_eq!(strays, [], "pixels farther than {half_cell_px} from the outline of the mesh");
}

#[test]
fn a_stage_has_the_same_mesh() {
    let there = scene(BLOBS);
    export(&there, "0..2", "meshes", &[]);
    export(&there, "0..2", "shot.usda", &[]);
    let (corners, triangles) = mesh(&fs::read(there.path().join("meshes/blobs_000002.ply")).expect("a mesh"));
    let read = |name: &str| fs::read_to_string(there.path().join(name)).expect("a layer");
    let (stage, layer) = (read("shot_layers/stage.usda"), read("shot_layers/frames_00000.usda"));
    assert!(stage.contains("def Mesh \"slime\" (\ndisplayName = \"slime\""), "a prim");
    assert!(stage.contains("uniform token purpose = \"guide\""), "its points are guides");
    let own = layer.split_once("over \"Blobs\"").expect("samples").1;
    let places = crate::export::sample(own, "point3f[] points", 2);
    assert_eq!(places.len(), 3 * corners.len(), "as many corners");
    let off_m =
        places.chunks(3).zip(&corners).map(|(place, corner)| Vec3::from_slice(place).distance(*corner));
    assert!(off_m.fold(0.0, f32::max) < 2e-5, "at the same places");
    let indices = crate::export::sample(own, "int[] faceVertexIndices", 2);
    let wanted: Vec<f32> = triangles.iter().flatten().map(|corner| *corner as f32).collect();
    assert_eq!(indices, wanted, "the same faces");
    assert_eq!(crate::export::sample(own, "vector3f[] velocities", 2).len(), 3 * corners.len(), "velocities");
}
