// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
use image::{GrayImage, RgbImage, RgbaImage};

use super::*;

fn sample() -> LeafFolder {
    let leaf = |name: &str, shade: u8| FolderLeaf {
        facts: LeafFacts {
            name: name.into(),
            season: 0.4,
            area_m2: 0.003,
            mass_kg: 0.000_2,
            mean_chord_m: 0.04,
            side_m: 0.1,
            body: Some(BodyFacts {
                aspect: 1.8,
                extent: 1.06,
                curl: 0.1,
                petiole: Some(PetioleFacts { base: 1.1, length: 0.8, mass: 0.1, droop_deg: 15.0 }),
            }),
            has_mesh: true,
        },
        maps: LeafMaps {
            albedo: RgbaImage::from_pixel(16, 16, image::Rgba([shade, 90, 20, 255])),
            normal: RgbImage::from_pixel(16, 16, image::Rgb([128, 128, 255])),
            height: GrayImage::from_pixel(16, 16, image::Luma([128])),
            translucency: GrayImage::from_pixel(16, 16, image::Luma([shade])),
            mask: GrayImage::from_pixel(16, 16, image::Luma([255])),
        },
        form: Some(LeafForm {
            levels: vec![FormLevel {
                positions: vec![[0.5, 0.9], [0.7, 0.4], [0.3, 0.4]],
                triangles: vec![[0, 1, 2]],
                shapes: vec![FormShape { water: 0.2, offsets: vec![[0.0, 0.01, 0.02]; 3] }],
            }],
        }),
    };
    LeafFolder { size_px: 16, leaves: vec![leaf("oak-1", 200), leaf("oak-2", 120)] }
}

fn saved() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    sample().save(folder.path()).expect("the folder is writable");
    folder
}

/// The error of loading a folder after a change to one of its files.
fn after(change: impl FnOnce(&Path)) -> FolderError {
    let folder = saved();
    change(folder.path());
    LeafFolder::load(folder.path()).expect_err("it must be refused")
}

fn rewrite(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).expect("a manifest");
    assert!(text.contains(from), "{from} is in {text}");
    fs::write(path, text.replace(from, to)).expect("writable");
}

#[test]
fn what_was_saved_is_loaded() {
    let folder = saved();
    assert_eq!(LeafFolder::load(folder.path()).expect("it was saved"), sample(), "the same leaves");
    let found = fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(found, sample().file_names().len(), "no other files");
}

#[test]
fn every_fault_is_told() {
    let error = after(|at| fs::remove_file(at.join("oak-2.height.png")).expect("it was there"));
    assert!(matches!(&error, FolderError::Missing { path } if path.ends_with("oak-2.height.png")), "{error}");
    let error = after(|at| fs::remove_file(at.join(MANIFEST_NAME)).expect("it was there"));
    assert!(matches!(&error, FolderError::Missing { path } if path.ends_with(MANIFEST_NAME)), "{error}");
    let error = after(|at| {
        let path = at.join("oak-1.png");
        let bytes = fs::read(&path).expect("a picture");
        fs::write(&path, &bytes[..bytes.len() - 30]).expect("writable");
    });
    assert!(matches!(&error, FolderError::Picture { path, .. } if path.ends_with("oak-1.png")), "{error}");
    let error = after(|at| {
        RgbImage::new(16, 8).save(at.join("oak-1.normal.png")).expect("writable");
    });
    assert!(matches!(error, FolderError::Size { found: (16, 8), allowed: 16, .. }), "{error}");
    let error = after(|at| rewrite(&at.join(MANIFEST_NAME), "version: 1", "version: 7"));
    assert!(matches!(error, FolderError::Version { found: 7, allowed: 1, .. }), "{error}");
    let error = after(|at| rewrite(&at.join(MANIFEST_NAME), "area_m2", "aera_m2"));
    assert!(matches!(error, FolderError::Manifest { .. }), "{error}");
    let error = after(|at| rewrite(&at.join("oak-1.mesh.ron"), "(0,1,2)", "(0,1,3)"));
    assert!(matches!(&error, FolderError::Field { field, .. } if field == "levels[0].triangles"), "{error}");
    let error = after(|at| fs::remove_file(at.join("oak-1.mesh.ron")).expect("it was there"));
    assert!(matches!(&error, FolderError::Missing { path } if path.ends_with("oak-1.mesh.ron")), "{error}");
    for (from, to, field) in [
        ("size_px: 16", "size_px: 17", "size_px"),
        ("\"oak-2\"", "\"../oak\"", "leaves[1].name"),
        ("\"oak-2\"", "\"OAK-1\"", "leaves[1].name"),
        ("season: 0.4", "season: 1.5", "leaves[0].season"),
        ("mass_kg: 0.0002", "mass_kg: -1.0", "leaves[0].mass_kg"),
        ("aspect: 1.8", "aspect: 0.0", "leaves[0].body.aspect"),
        ("curl: 0.1", "curl: 1.5", "leaves[0].body.curl"),
    ] {
        let error = after(|at| rewrite(&at.join(MANIFEST_NAME), from, to));
        let is_named = matches!(&error, FolderError::Field { field: found, .. } if found == field);
        assert!(is_named, "{to}: {error}");
    }
}

#[cfg(unix)]
#[test]
fn links_that_lead_out_are_refused() {
    let elsewhere = saved();
    for name in [MANIFEST_NAME, "oak-2.mask.png", "oak-1.mesh.ron"] {
        let error = after(|folder| {
            fs::remove_file(folder.join(name)).expect("it was saved");
            std::os::unix::fs::symlink(elsewhere.path().join(name), folder.join(name)).expect("writable");
        });
        let line = error.to_string();
        assert!(line.contains(name) && line.contains("a link that leads out of its folder"), "{line}");
    }
    let linked = tempfile::tempdir().expect("a temporary folder");
    let at = linked.path().join("leaves");
    std::os::unix::fs::symlink(elsewhere.path(), &at).expect("writable");
    assert_eq!(LeafFolder::load(&at).expect("the folder itself may be a link"), sample(), "the same leaves");
}

/// A colour profile of zeros takes a thousandth of its length in the file.
#[test]
fn a_picture_with_an_enormous_profile_takes_little_memory() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut file = Vec::new();
    let mut encoder = PngEncoder::new(&mut file);
    encoder.set_icc_profile(vec![0; 512 << 20]).expect("a file may have a profile");
    encoder.write_image(&[7; 256], 16, 16, ExtendedColorType::L8).expect("memory takes everything");
    assert!(file.len() < 4 << 20, "small on the disk: {} bytes", file.len());
    fs::write(folder.path().join("leaf.png"), &file).expect("writable");
    let info = allocation_counter::measure(|| {
        picture(folder.path(), "leaf.png", 16).expect("the picture itself is good");
    });
    // What is unpacked moves as it grows.
    assert!(info.bytes_max < 3 * DECODER_BYTES, "{} bytes at once", info.bytes_max);
}

#[test]
fn meshes_larger_or_farther_than_any_leaf_are_refused() {
    let refused = |change: &dyn Fn(&mut LeafForm), part: &str, allowed: &str| {
        let error = after(|at| {
            let mut form = LeafForm::load(at, "oak-1").expect("it was saved");
            change(&mut form);
            form.save(at, "oak-1").expect("writable");
        });
        let error = error.to_string();
        assert!(error.contains(part) && error.ends_with(allowed), "{error}");
    };
    refused(&|form| form.levels = vec![form.levels[0].clone(); 9], "levels.len() is 9", "at most 8");
    refused(
        &|form| form.levels[0].triangles = vec![[0, 1, 2]; 65_537],
        "levels[0].triangles.len() is 65537",
        "at most 65536",
    );
    refused(
        &|form| {
            form.levels[0].positions = vec![[0.0; 2]; 65_537];
            form.levels[0].shapes.clear();
        },
        "levels[0].positions.len() is 65537",
        "at most 65536",
    );
    refused(
        &|form| form.levels[0].shapes = vec![form.levels[0].shapes[0].clone(); 17],
        "levels[0].shapes.len() is 17",
        "at most 16",
    );
    let far = "numbers from -100 to 100";
    refused(&|form| form.levels[0].positions[1][0] = f32::NAN, "is NaN", far);
    refused(&|form| form.levels[0].shapes[0].offsets[2][2] = f32::NEG_INFINITY, "is -inf", far);
    refused(&|form| form.levels[0].shapes[0].water = 101.0, "is 101", far);
}
