// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of skies: what is read from them, and what is refused.

use std::f32::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

use exr::prelude::{
    Blocks, Compression, Encoding, Image, Layer, LayerAttributes, LineOrder, SpecificChannels, Vec2,
    WritableImage,
};
use glam::Vec3;
use image::codecs::hdr::HdrEncoder;
use image::{ImageBuffer, ImageFormat, Rgb};
use windfall_core::scene::SkyMap;

use super::Daylight;
use super::EnvironmentMap;
use super::MapError;
use super::luminance;
use super::picture_file::Picture;
use super::prefilter::{LEAST_ROUGHNESS, ROUGHNESS, ROUGHNESS_STEP};
use super::prefiltered;
use super::sun_search::take_sun;

/// A sky that differs in every direction: brighter upwards, red towards +x, blue towards +z.
fn gradient(direction: Vec3) -> Vec3 {
    Vec3::new(2.0 + direction.x, 2.0 + direction.y, 2.0 + direction.z) * (1.5 + direction.y)
}

fn picture(width: usize, height: usize, value: impl Fn(usize, usize) -> Vec3) -> Picture {
    let pixels = (0..width * height).map(|index| value(index % width, index / width)).collect();
    Picture { width, height, pixels }
}

/// The direction that a pixel of a cross shows, by the faces as readers of files define them.
fn cross_direction(x: usize, y: usize, edge: usize, is_upright: bool) -> Vec3 {
    let on_face = |at: usize| (at % edge) as f32 * 2.0 / edge as f32 + 1.0 / edge as f32 - 1.0;
    let (u, v) = (on_face(x), on_face(y));
    match (x / edge, y / edge) {
        (1, 0) => Vec3::new(u, 1.0, -v),
        (0, 1) => Vec3::new(-1.0, -v, -u),
        (1, 1) => Vec3::new(u, -v, -1.0),
        (2, 1) => Vec3::new(1.0, -v, u),
        (3, 1) if !is_upright => Vec3::new(-u, -v, 1.0),
        (1, 2) => Vec3::new(u, -1.0, v),
        (1, 3) => Vec3::new(u, v, 1.0),
        _ => Vec3::ZERO,
    }
}

#[test]
fn crosses_and_latitude_and_longitude_agree() {
    let map = EnvironmentMap::from_fn(128, 64, gradient);
    for (columns, rows) in [(3, 4), (4, 3)] {
        let edge = 32;
        let cross = picture(columns * edge, rows * edge, |x, y| {
            let direction = cross_direction(x, y, edge, rows > columns);
            if direction == Vec3::ZERO { Vec3::ZERO } else { gradient(direction.normalize()) }
        });
        let found = EnvironmentMap::of_picture(cross);
        assert_eq!(found.size(), (128, 64), "four faces around");
        for ((direction, expected, _), (_, found, _)) in map.parts().zip(found.parts()) {
            let error = (found / expected - 1.0).abs().max_element();
            assert!(error < 0.03, "{columns}:{rows} towards {direction}: {found}, not {expected}");
        }
    }
}

#[test]
fn samples_are_what_the_map_was_made_from() {
    let map = EnvironmentMap::from_fn(256, 128, gradient);
    for direction in [Vec3::X, -Vec3::X, Vec3::Y, Vec3::Z, -Vec3::Z, Vec3::new(0.3, -0.9, 0.2).normalize()] {
        let error = (map.sample(direction) / gradient(direction) - 1.0).abs().max_element();
        assert!(error < 0.02, "{direction}: {}", map.sample(direction));
    }
    let turned = map.turned(90.0);
    let error = (turned.sample(Vec3::Z) - gradient(Vec3::X)).abs().max_element();
    assert!(error < 0.05, "what was towards +x is towards +z");
}

#[test]
fn rough_mirrors_keep_the_light() {
    let flat = EnvironmentMap::from_fn(64, 32, |_| Vec3::new(0.5, 1.0, 2.0));
    for level in prefiltered(&flat) {
        let off =
            level.parts().map(|(_, found, _)| (found / Vec3::new(0.5, 1.0, 2.0) - 1.0).abs().max_element());
        assert!(off.fold(0.0, f32::max) < 1e-5, "a constant sky stays constant");
    }
    let all = |map: &EnvironmentMap| map.parts().map(|(_, light, angle)| light * angle).sum::<Vec3>();
    // A bright spot on a dim sky: the hardest to keep.
    let spot = Vec3::new(0.6, 0.64, -0.48);
    let sky =
        EnvironmentMap::from_fn(256, 128, |to| Vec3::splat(if to.dot(spot) > 0.97 { 50.0 } else { 1.0 }));
    let levels = prefiltered(&sky);
    for (level, roughness) in (0u8..).zip(ROUGHNESS) {
        let stepped = LEAST_ROUGHNESS + f32::from(level) * ROUGHNESS_STEP;
        assert!((roughness - stepped).abs() < 1.0e-6, "shaders find level {level}: {roughness} at {stepped}");
    }
    assert_eq!(levels.len(), ROUGHNESS.len(), "one level for each roughness");
    for (level, roughness) in levels.iter().zip(ROUGHNESS) {
        let kept = all(level).x / all(&sky).x;
        assert!((kept - 1.0).abs() < 0.05, "{kept} of all light is left at roughness {roughness}");
    }
    let peaks: Vec<f32> = levels.iter().map(|level| level.sample(spot).x).collect();
    assert!(peaks.windows(2).all(|pair| pair[1] < pair[0]), "rougher mirrors blur more: {peaks:?}");
}

#[test]
fn a_sun_is_found_and_taken_out() {
    let toward = Vec3::new(0.5, 0.7, -0.5).normalize();
    let sky = Vec3::new(2.0, 3.0, 5.0);
    let radiance = 20_000.0;
    let map =
        EnvironmentMap::from_fn(
            512,
            256,
            |to| {
                if to.dot(toward) > 0.9995 { Vec3::splat(radiance) } else { sky }
            },
        );
    let (sun, rest) = take_sun(&map);
    assert!(sun.direction.dot(toward) > 0.9999, "{} is not {toward}", sun.direction);
    let angle = 2.0 * PI * (1.0 - 0.9995);
    let expected = angle * radiance;
    assert!((luminance(sun.illuminance) / expected - 1.0).abs() < 0.1, "{} klx", sun.illuminance);
    let left = rest.parts().map(|(_, light, _)| luminance(light)).fold(0.0, f32::max);
    assert!(left < 1.01 * luminance(sky), "{left} is brighter than the sky");
    // Nothing is lost: sun and rest light a surface as the whole map did.
    let whole = luminance(map.irradiance(toward));
    let parts = luminance(sun.illuminance) + luminance(rest.irradiance(toward));
    assert!((parts / whole - 1.0).abs() < 0.01, "{parts} of {whole}");
    let (none, same) = take_sun(&EnvironmentMap::from_fn(128, 64, gradient));
    assert_eq!(none.illuminance, Vec3::ZERO, "an even sky has no sun");
    assert_eq!(same, EnvironmentMap::from_fn(128, 64, gradient), "and stays whole");
}

/// A folder of files that goes away with it.
fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("temporary files can be made")
}

fn load(path: &Path) -> Result<Daylight, MapError> {
    Daylight::of_picture(&SkyMap::new(path.to_str().expect("a UTF-8 path").into()))
}

/// A file of each kind with these pixels.
fn files(at: &Path, width: u32, height: u32, value: impl Fn(u32, u32) -> [f32; 3]) -> [PathBuf; 2] {
    let image = ImageBuffer::from_fn(width, height, |x, y| Rgb(value(x, y)));
    let exr = at.join("sky.exr");
    image.save_with_format(&exr, ImageFormat::OpenExr).expect("a picture can be written");
    let hdr = at.join("sky.hdr");
    let pixels: Vec<Rgb<f32>> = image.pixels().copied().collect();
    let file = fs::File::create(&hdr).expect("a file can be made");
    HdrEncoder::new(file).encode(&pixels, width as usize, height as usize).expect("a picture can be written");
    [hdr, exr]
}

#[test]
fn files_of_both_kinds_light_alike() {
    let at = folder();
    let lights = files(at.path(), 64, 32, |x, y| [1.0 + x as f32 / 64.0, 2.0, 3.0 - y as f32 / 16.0])
        .map(|path| load(&path).expect("a good file"));
    for day in &lights {
        assert_eq!(day.sky.size(), (64, 32), "as large as the file");
    }
    for ((direction, hdr, _), (_, exr, _)) in lights[0].sky.parts().zip(lights[1].sky.parts()) {
        assert!((hdr - exr).abs().max_element() < 0.15, "{hdr} and {exr} towards {direction}");
    }
}

#[test]
fn broken_files_are_refused_by_name() {
    let at = folder();
    let refused = |path: &Path, what: &str| {
        let error = load(path).expect_err(what).to_string();
        let name = path.file_name().and_then(|name| name.to_str()).expect("a name");
        assert!(error.contains(name) && !error.contains('\n'), "{what}: {error}");
        error
    };
    let [hdr, exr] = files(at.path(), 64, 32, |x, y| [1.0 + (x * 37 % 11) as f32, 2.0 + y as f32, 3.0]);
    for good in [&hdr, &exr] {
        let bytes = fs::read(good).expect("it was written");
        for length in [4, 11, 40, bytes.len() / 2, bytes.len() - 1] {
            fs::write(good, &bytes[..length]).expect("it can be written");
            assert!(refused(good, "cut off").contains("cut off"), "at {length} of {}", bytes.len());
        }
    }
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 2e9] {
        let [_, exr] =
            files(at.path(), 64, 32, |x, y| if (x, y) == (5, 7) { [1.0, value, 1.0] } else { [1.0; 3] });
        let error = refused(&exr, "not light");
        assert!(error.contains("column 5, row 7") && error.contains("0 to 1e9"), "{error}");
    }
    let [hdr, exr] = files(at.path(), 64, 32, |_, _| [0.0; 3]);
    assert!(refused(&hdr, "black").contains("black") && refused(&exr, "black").contains("black"), "no light");
    for (width, height) in [(48, 32), (32, 32), (32, 64)] {
        for path in files(at.path(), width, height, |_, _| [1.0; 3]) {
            let error = refused(&path, "no map");
            assert!(error.contains("2:1") && error.contains("3:4"), "{error}");
        }
    }
    let [hdr, _] = files(at.path(), 8, 4, |_, _| [1.0; 3]);
    assert!(refused(&hdr, "tiny").contains("at least 8 rows"), "too few pixels");
    let other = at.path().join("photo.hdr");
    fs::write(&other, b"\x89PNG\r\n\x1a\n and so on").expect("it can be written");
    assert!(refused(&other, "a PNG").contains("neither a Radiance"), "another kind");
    fs::write(&other, b"").expect("it can be written");
    refused(&other, "empty");
    refused(&at.path().join("nowhere.exr"), "missing");
    refused(at.path(), "a folder");
}

#[test]
fn enormous_pictures_are_refused_before_they_are_decoded() {
    let at = folder();
    let path = at.path().join("huge.hdr");
    fs::write(&path, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 200000\n")
        .expect("it can be written");
    let error = load(&path).expect_err("20 thousand million pixels").to_string();
    assert!(error.contains("huge.hdr") && error.contains("200000x100000"), "{error}");
    // A good file whose header claims to be larger.
    let [_, exr] = files(at.path(), 64, 32, |_, _| [1.0; 3]);
    let mut bytes = fs::read(&exr).expect("it was written");
    let window: Vec<u8> = [0i32, 0, 63, 31].iter().flat_map(|edge| edge.to_le_bytes()).collect();
    let claimed: Vec<u8> = [0i32, 0, 199_999, 99_999].iter().flat_map(|edge| edge.to_le_bytes()).collect();
    let places: Vec<usize> = (0..bytes.len() - 16).filter(|&at| bytes[at..at + 16] == window).collect();
    assert_eq!(places.len(), 2, "a header has two windows");
    for place in places {
        bytes[place..place + 16].copy_from_slice(&claimed);
    }
    fs::write(&exr, &bytes).expect("it can be written");
    let error = load(&exr).expect_err("20 thousand million pixels").to_string();
    assert!(error.contains("sky.exr"), "{error}");
}

/// Found by fuzzing: the picture is small, but the window of its data claims to be enormous.
#[test]
fn layers_larger_than_any_picture_are_refused_before_they_are_decoded() {
    let at = folder();
    let path = at.path().join("sky.exr");
    for (compression, blocks) in
        [(Compression::PXR24, Blocks::ScanLines), (Compression::ZIP16, Blocks::Tiles(Vec2(16, 8)))]
    {
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        let channels = SpecificChannels::rgb(|_| (1.0_f32, 2.0_f32, 3.0_f32));
        let layer = Layer::new((16, 8), LayerAttributes::default(), encoding, channels);
        Image::from_layer(layer).write().to_file(&path).expect("a picture can be written");
        load(&path).expect("a good file");
        let mut bytes = fs::read(&path).expect("it was written");
        let (name, size) = match blocks {
            Blocks::ScanLines => (&b"dataWindow\0box2i\0"[..], 12),
            Blocks::Tiles(_) => (&b"tiles\0tiledesc\0"[..], 4),
        };
        let found = bytes.windows(name.len()).position(|window| window == name).expect("an attribute");
        let width = found + name.len() + size;
        bytes[width..][..4].copy_from_slice(&0x1000_0000_u32.to_le_bytes());
        fs::write(&path, &bytes).expect("it can be written");
        let error = load(&path).expect_err("a row of 268 million pixels").to_string();
        assert!(error.contains("sky.exr") && error.contains("bytes; allowed: at most"), "{error}");
    }
}

/// Found by fuzzing.
#[test]
fn the_sun_of_a_faint_picture_has_a_direction_of_unit_length() {
    for brightest in [1e-16, 1e-18, 1e-19, 1e-20] {
        let towards = Vec3::new(1.0, 2.0, 0.5).normalize();
        let radiance =
            |direction: Vec3| if direction.dot(towards) > 0.999 { brightest } else { 1e-4 * brightest };
        let map = EnvironmentMap::from_fn(128, 64, |direction| Vec3::splat(radiance(direction)));
        let (sun, _) = take_sun(&map);
        assert!(sun.direction.is_normalized(), "{} at {brightest}", sun.direction);
        assert!(sun.direction.dot(towards) > 0.99, "{} at {brightest}", sun.direction);
    }
}
