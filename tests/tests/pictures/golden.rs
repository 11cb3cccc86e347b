// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of scenes against those in `tests/golden`, by a perceptual metric, and broken shaders, which it must notice.
//!
//! The metric is SSIMULACRA 2 (Cloudinary 2022): 100 is the same picture, 90 cannot be distinguished side by side, 70 is what a
//! photograph loses as a good JPEG. `scripts/bless` draws the pictures anew. A failure leaves a sheet (golden, now, what differs) in
//! `target/tmp/golden`.

use std::path::{Path, PathBuf};

use glam::Vec3;
use image::{Rgba, RgbaImage, imageops};
use ssimulacra2::{ColorPrimaries, Rgb, TransferCharacteristic, compute_frame_ssimulacra2};
use windfall::backend::{BackendArguments, BackendKind};
use windfall::cancel::Cancel;
use windfall::drawing::Drawing;
use windfall::scenes::atlas_of;
use windfall::studio::Studio;
use windfall_core::scene::{Exposure, Focus, ToneMap};
use windfall_core::{Scene, World};
use windfall_render::{Quality, with_shader_edit};
use windfall_texgen::Atlas;

/// Size of the pictures: small, but nothing of a scene is lost.
pub(crate) const SIZE: (u32, u32) = (256, 144);
/// The rasteriser they are drawn on: Mesa's, in software. Others break leaves and grass into other pixels: Chromium's SwiftShader
/// scores 43 in the park and 87 out of focus, which is worse than most of the breaks below.
pub(crate) const RASTERISER: &str = "llvmpipe";
/// Lowest score of a picture that is as it was. The same rasteriser draws the same picture, which is 100; the faintest of the
/// breaks below scores 71.
const LEAST_SCORE: f64 = 90.0;

/// A picture: its name, its preset and what is changed in it, the steps before it, and the effort spent on it.
struct Case {
    name: &'static str,
    preset: &'static str,
    change: fn(&mut Scene),
    steps: u64,
    quality: Quality,
}

#[rustfmt::skip]
const CASES: [Case; 11] = [
    Case { name: "park", preset: "autumn-park", change: |_| {}, steps: 0, quality: Quality::Full },
    Case { name: "park-draft", preset: "autumn-park", change: |_| {}, steps: 0, quality: Quality::Draft },
    Case { name: "park-plain", preset: "autumn-park", change: |_| {}, steps: 0, quality: Quality::Plain },
    Case { name: "dusk", preset: "autumn-park", change: dusk, steps: 30, quality: Quality::Full },
    Case { name: "storm", preset: "storm", change: |_| {}, steps: 120, quality: Quality::Full },
    Case { name: "motions", preset: "six-motions", change: |_| {}, steps: 90, quality: Quality::Full },
    Case { name: "focus", preset: "six-motions", change: focus, steps: 20, quality: Quality::Full },
    Case { name: "bonfire", preset: "bonfire", change: |_| {}, steps: 60, quality: Quality::Full },
    Case { name: "balls", preset: "particle-lab", change: balls, steps: 60, quality: Quality::Full },
    Case { name: "slime", preset: "slime", change: |_| {}, steps: 90, quality: Quality::Full },
    Case { name: "ribbons", preset: "ember-whirl", change: |_| {}, steps: 60, quality: Quality::Full },
];

/// The sun low behind the trees, as Reinhard would develop it.
fn dusk(scene: &mut Scene) {
    scene.view.sun.elevation_deg = 5.0;
    scene.view.sun.azimuth_deg = -95.0;
    scene.view.lens.tone_map = ToneMap::Reinhard { white: 4.0 };
    scene.view.lens.glare.strength = 0.08;
}

/// Sharp at the leaves and nowhere else, with exposure and gamma set by hand.
fn focus(scene: &mut Scene) {
    let camera = &mut scene.view.camera;
    camera.eye_m = camera.target_m + 0.35 * (camera.eye_m - camera.target_m);
    let distance_m = camera.eye_m.distance(camera.target_m);
    scene.view.lens.focus = Some(Focus { distance_m, f_number: 0.5 });
    scene.view.lens.exposure = Exposure::Manual { ev100: 14.0 };
    scene.view.lens.tone_map = ToneMap::Linear { gamma: 2.2 };
}

/// Particles from nearby, so that they are more than dots.
fn balls(scene: &mut Scene) {
    let camera = &mut scene.view.camera;
    (camera.eye_m, camera.target_m) = (Vec3::new(-0.85, 1.7, 4.0), Vec3::new(-0.85, 1.7, 0.0));
    camera.vertical_fov_deg = 15.0;
}

/// A case that is ready to be drawn several times.
struct Prepared {
    case: &'static Case,
    world: World,
    atlas: Atlas,
}

impl Case {
    fn prepare(&'static self) -> Prepared {
        let mut scene = Scene::preset(self.preset).expect("a preset");
        (self.change)(&mut scene);
        let world = World::build(&scene).expect("a preset can be built");
        let atlas = atlas_of(&scene, &|_, _| ()).expect("leaves can be made");
        Prepared { case: self, world, atlas }
    }

    fn golden(&self) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(format!("{}.png", self.name))
    }
}

impl Prepared {
    fn draw(&self) -> RgbaImage {
        let (backend, adapter) = (Some(BackendKind::Cpu), Some(RASTERISER.into()));
        let arguments = BackendArguments { backend, adapter, ..BackendArguments::default() };
        let drawing = Drawing::without_window(&arguments)
            .expect("Mesa's software Vulkan: install mesa-vulkan-drivers; scripts/test does");
        let drawing = Drawing { quality: self.case.quality, ..drawing };
        let mut studio = Studio::with_leaves(&self.world, &self.atlas, drawing, SIZE, &Cancel::default())
            .expect("a preset can be drawn");
        studio.advance(self.case.steps).expect("the cpu simulates");
        studio.draw(f64::INFINITY).expect("a picture")
    }
}

/// SSIMULACRA 2 of two pictures of one size.
fn score(a: &RgbaImage, b: &RgbaImage) -> f64 {
    let linear = |picture: &RgbaImage| {
        let channel = |byte: u8| f32::from(byte) / 255.0;
        let pixels = picture.pixels().map(|pixel| [0, 1, 2].map(|index| channel(pixel.0[index]))).collect();
        let (width, height) = (SIZE.0 as usize, SIZE.1 as usize);
        Rgb::new(pixels, width, height, TransferCharacteristic::SRGB, ColorPrimaries::BT709)
            .expect("a picture")
    };
    compute_frame_ssimulacra2(linear(a), linear(b)).expect("pictures of one size")
}

/// Writes two pictures beside each other, and four times their difference.
fn write_sheet(name: &str, old: &RgbaImage, new: &RgbaImage) -> PathBuf {
    let mut sheet = RgbaImage::new(3 * SIZE.0, SIZE.1);
    imageops::replace(&mut sheet, old, 0, 0);
    imageops::replace(&mut sheet, new, SIZE.0.into(), 0);
    for (x, y, pixel) in new.enumerate_pixels() {
        let before = old.get_pixel(x, y).0;
        let apart = |index: usize| pixel.0[index].abs_diff(before[index]).saturating_mul(4);
        sheet.put_pixel(2 * SIZE.0 + x, y, Rgba([apart(0), apart(1), apart(2), 255]));
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden");
    std::fs::create_dir_all(&folder).expect("the target folder is writable");
    let path = folder.join(format!("{name}.png"));
    sheet.save(&path).expect("the target folder is writable");
    path
}

fn golden(case: &Case) -> Option<RgbaImage> {
    image::open(case.golden()).ok().map(|picture| picture.to_rgba8())
}

#[test]
fn pictures_are_as_they_were() {
    let is_blessing = std::env::var_os("WINDFALL_BLESS").is_some();
    let mut failures = Vec::new();
    for case in &CASES {
        let new = case.prepare().draw();
        let old = golden(case).filter(|old| old.dimensions() == SIZE);
        let found = old.as_ref().map(|old| score(old, &new));
        println!("{}: {found:?}", case.name);
        if is_blessing {
            let sheet = write_sheet(case.name, old.as_ref().unwrap_or(&new), &new);
            println!("  {}", sheet.display());
            std::fs::create_dir_all(case.golden().parent().expect("a folder"))
                .expect("tests/golden is writable");
            new.save(case.golden()).expect("tests/golden is writable");
        } else if found.is_none_or(|found| found < LEAST_SCORE) {
            let sheet = write_sheet(case.name, old.as_ref().unwrap_or(&new), &new);
            failures.push(format!("{} scores {found:?}: look at {}", case.name, sheet.display()));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}; if they are meant to be so, run scripts/bless");
}

/// A break: its name, its case, and its edit.
#[rustfmt::skip]
const BREAKS: [(&str, &str, &str, &str); 22] = [
    ("shoots are too thin to be seen", "park", "radius_m / share,", "0.001 * radius_m,"),
    ("leaves of a branchlet hang in one place", "park", "offset += leaf.place * sight.diameter;", ""),
    ("sunlight is blue", "park", "frame.sun_color *", "frame.sun_color.bgr *"),
    ("samples lie in other quarters", "park-draft", "2 * quarter.y + quarter.x", "3 - 2 * quarter.y - quarter.x"),
    ("shadows are of no map", "park-plain", "coarser > FIRST_MAP", "coarser > CASCADES"),
    ("leaves face the other way", "storm", "let facing = dot(normal, light);", "let facing = dot(-normal, light);"),
    ("leaves are whole squares", "storm", "let mask = covered(alpha, in.random);", "let mask = 15u;"),
    ("far trees are whole squares", "motions", "let mask = covered(clamp((surface.a - 0.5) / rim + 0.5, 0.0, 1.0), random);", "let mask = 15u;"),
    ("no ambient light", "storm", "return Ambient(max(even + odd, vec3(0.0)),", "return Ambient(vec3(0.0),"),
    ("the picture is a third of a stop too bright", "storm", "lens.key * exp2(", "1.26 * lens.key * exp2("),
    ("the filmic curve has too much contrast", "storm", "const STOPS: f32 = 16.5f;", "const STOPS: f32 = 14.0f;"),
    ("Reinhard without white", "dusk", "(1.0 + bright / (white * white))", "1.0"),
    ("haze has no shafts of light", "dusk", "sunlit += share * sun_at(at);", "sunlit += share;"),
    ("grass is of one height", "park", "out.height = mix(out.height, 0.55, ", "out.height = mix(0.6, 0.55, "),
    ("glare four times too strong", "dusk", "color += lens.glare_strength *", "color += 4.0 * lens.glare_strength *"),
    ("fires light nothing", "bonfire", "sum += fire.intensity * (facing / squared);", "sum += vec3(0.0);"),
    ("flames are four times too bright", "bonfire", "(row.opacity * share *", "(4.0 * row.opacity * share *"),
    ("smoke does not thin out", "bonfire", "thick *= mix(1.0, 1.6 * billows", "thick = mix(1.0, 1.6 * billows"),
    ("balls have no lit side", "balls", "let round = smoothstep(1.5, 4.0, radius_px)", "let round = 0.0 * radius_px"),
    ("far balls lie before near ones", "balls", "(0x7fffffffu - bitcast<u32>(max(depth_m, 0.0)))", "bitcast<u32>(max(depth_m, 0.0))"),
    ("slime is dry", "slime", "return mix(below, mirrored, fresnel) + glint;", "return below;"),
    ("ribbons do not fade", "ribbons", "particle.row.opacity * left * half_m", "particle.row.opacity * half_m"),
];

#[test]
fn broken_shaders_are_noticed() {
    let mut unnoticed = Vec::new();
    for case in &CASES {
        let breaks = || BREAKS.iter().filter(|(_, broken, ..)| *broken == case.name);
        if breaks().next().is_none() {
            continue;
        }
        let prepared = case.prepare();
        let whole = prepared.draw();
        for (name, _, from, to) in breaks() {
            let broken = with_shader_edit(from, to, || prepared.draw());
            let found = score(&whole, &broken);
            println!("{name}: {found}");
            if found >= LEAST_SCORE {
                unnoticed.push((name, found));
            }
        }
        assert!(whole == prepared.draw(), "whole shaders draw {} again", case.name);
    }
    assert!(BREAKS.iter().all(|(_, broken, ..)| CASES.iter().any(|case| case.name == *broken)));
    assert!(unnoticed.is_empty(), "no worse than {LEAST_SCORE}: {unnoticed:?}");
}
