// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves from photos. The first byte of an input says what comes: the file of a photo, the files of a photo and of its mask with the
//! length of the first before them, or plain pixels of a photo and of a mask of this width, so that a leaf is read in every case.
#![no_main]

use std::io::Cursor;
use std::sync::LazyLock;

use image::{GrayImage, ImageFormat, RgbImage};
use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use windfall_fuzz::checksum;
use windfall_fuzz::folder::Folder;
use windfall_texgen::Photo;
use windfall_texgen::form::{Detail, LeafMesh};

/// Widest and highest picture of plain pixels.
const MOST_PX: usize = 64;

static FOLDER: LazyLock<Folder> = LazyLock::new(Folder::new);

fuzz_target!(|data: &[u8]| {
    let Some((&kind, rest)) = data.split_first() else { return };
    match kind % 3 {
        0 => extract(rest, None),
        1 => {
            let Some((&length, rest)) = rest.split_first_chunk::<2>() else { return };
            let (photo, mask) = rest.split_at(usize::from(u16::from_le_bytes(length)).min(rest.len()));
            extract(photo, Some(mask));
        }
        _ => {
            let Some((&width, pixels)) = rest.split_first() else { return };
            if let Some((photo, mask)) = pictures(usize::from(width) % MOST_PX + 1, pixels) {
                extract(&photo, Some(&mask));
            }
        }
    }
});

/// The files of a photo and of its mask from a byte for each pixel: grey with a tint, and in the mask where the byte is odd.
fn pictures(width: usize, pixels: &[u8]) -> Option<(Vec<u8>, Vec<u8>)> {
    let height = (pixels.len() / width).min(MOST_PX);
    if height == 0 {
        return None;
    }
    let pixels = &pixels[..width * height];
    let size = [width, height].map(|side| u32::try_from(side).expect("at most MOST_PX"));
    let colours = pixels.iter().flat_map(|&byte| [byte, byte / 2 + 40, byte.rotate_left(3)]).collect();
    let inside = pixels.iter().map(|byte| (byte & 1) * 255).collect();
    let (mut photo, mut mask) = (Cursor::new(Vec::new()), Cursor::new(Vec::new()));
    let colours = RgbImage::from_raw(size[0], size[1], colours)?;
    colours.write_to(&mut photo, ImageFormat::Png).expect("memory takes everything");
    let inside = GrayImage::from_raw(size[0], size[1], inside)?;
    inside.write_to(&mut mask, ImageFormat::Png).expect("memory takes everything");
    Some((photo.into_inner(), mask.into_inner()))
}

/// Reads the leaf and lays triangles over it.
fn extract(photo: &[u8], mask: Option<&[u8]>) {
    let path = FOLDER.write("photo", photo);
    let mask = mask.map(|mask| FOLDER.write("mask", mask));
    match (Photo { path: &path, mask: mask.as_deref(), root: None }).extract() {
        Ok(found) => {
            let leaf = &found.specimen;
            assert!(leaf.blade.root.is_finite() && leaf.blade.tip.is_finite(), "root and tip are somewhere");
            assert!((0.0..=1.0).contains(&leaf.blade.confidence), "confidence: {}", leaf.blade.confidence);
            if let Err(error) = LeafMesh::build(&leaf.blade, &leaf.veins, Detail::ALL[0]) {
                assert!(!error.to_string().is_empty(), "an error says something");
            }
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "an error in one line: {error}"),
    }
}

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, _seed: u32| {
    let size = fuzzer_mutate(data, size, max_size);
    let whole = &mut data[..size];
    match whole.first().map(|kind| kind % 3) {
        Some(0) => checksum::set_png(&mut whole[1..]),
        Some(1) if size > 3 => {
            let length = usize::from(u16::from_le_bytes([whole[1], whole[2]])).min(size - 3);
            let (photo, mask) = whole[3..].split_at_mut(length);
            checksum::set_png(photo);
            checksum::set_png(mask);
        }
        _ => {}
    }
    size
});
