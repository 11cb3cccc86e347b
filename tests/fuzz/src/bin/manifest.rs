// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Folders of leaves. An input is a manifest, the meshes of its leaf and the leaf's picture, parted by zero bytes; the leaf's other
//! pictures are good ones.
#![no_main]

use std::sync::LazyLock;

use image::{ColorType, ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use windfall_fuzz::folder::Folder;
use windfall_fuzz::{checksum, pieces};
use windfall_texgen::{Layer, LeafFolder, MANIFEST_NAME};

/// Side of the pictures in pixels.
const SIZE_PX: u32 = 16;

/// A folder with all pictures of a leaf called `leaf`, and one to save to.
static FOLDERS: LazyLock<[Folder; 2]> = LazyLock::new(|| {
    let folder = Folder::new();
    let files = [
        ("leaf.png", ColorType::Rgba8),
        ("leaf.normal.png", ColorType::Rgb8),
        ("leaf.height.png", ColorType::L8),
        ("leaf.translucency.png", ColorType::L8),
        ("leaf.mask.png", ColorType::L8),
    ];
    for (name, colour) in files {
        folder.write(name, &picture(colour));
    }
    [folder, Folder::new()]
});

/// A picture with something in it.
fn picture(colour: ColorType) -> Vec<u8> {
    let bytes: Vec<u8> = (0u8..=255)
        .cycle()
        .take((SIZE_PX * SIZE_PX) as usize * usize::from(colour.bytes_per_pixel()))
        .collect();
    let mut out = Vec::new();
    let written =
        PngEncoder::new(&mut out).write_image(&bytes, SIZE_PX, SIZE_PX, ExtendedColorType::from(colour));
    written.expect("memory takes everything");
    out
}

fuzz_target!(|data: &[u8]| {
    let [folder, other] = &*FOLDERS;
    let mut parts = data.splitn(3, |byte| *byte == 0);
    folder.write(MANIFEST_NAME, parts.next().unwrap_or_default());
    folder.write("leaf.mesh.ron", parts.next().unwrap_or_default());
    match parts.next() {
        Some(bytes) => folder.write("leaf.png", bytes),
        None => folder.write("leaf.png", &picture(ColorType::Rgba8)),
    };
    match LeafFolder::load(folder.path()) {
        Ok(leaves) => {
            leaves.save(other.path()).expect("what is read can be written");
            LeafFolder::load(other.path()).expect("what is written can be read");
            for leaf in &leaves.leaves {
                Layer::of_leaf(leaf, SIZE_PX);
            }
        }
        Err(error) => assert!(!error.to_string().is_empty(), "an error says something"),
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let size = pieces::mutate(data, size, max_size, seed);
    let picture =
        data[..size].splitn(3, |byte| *byte == 0).nth(2).map_or(size, |picture| size - picture.len());
    checksum::set_png(&mut data[picture..size]);
    size
});
