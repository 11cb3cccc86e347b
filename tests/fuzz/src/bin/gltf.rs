// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees and triangles from glTF files of both kinds; the bark of what is a tree, and its leaves in a scene.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use windfall_core::scene::{Tree, TreeForm, TreeKind};
use windfall_core::tree::{BarkDetail, bark_mesh, gltf, grow};
use windfall_fuzz::folder::Folder;
use windfall_fuzz::random::Random;
use windfall_fuzz::{glb, pieces};

static FOLDER: LazyLock<Folder> = LazyLock::new(Folder::new);

fuzz_target!(|data: &[u8]| {
    let path = FOLDER.write("tree.gltf", data);
    match gltf::read(&path) {
        Ok(tree) => {
            tree.skeleton.validate().expect("what is read is valid");
            bark_mesh(&tree.skeleton, BarkDetail::Far);
            let form = TreeForm::File(path.to_string_lossy().into_owned());
            let kind = TreeKind { form, ..TreeKind::default() };
            let standing = Tree { height_m: Some(5.0), heading_deg: 30.0, leaves: 50, ..Tree::default() };
            if let Err(error) = grow(&kind, &standing, 1) {
                assert!(!error.to_string().is_empty(), "an error says something");
            }
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "an error in one line: {error}"),
    }
    match gltf::read_triangles(&path) {
        Ok(all) => {
            let count = all.positions_m.len();
            let is_there = |corner: &u32| (*corner as usize) < count;
            assert!(all.triangles.as_flattened().iter().all(is_there), "corners that are there");
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "an error in one line: {error}"),
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let mut random = Random::new(seed);
    let most = max_size.min(data.len());
    let Some((text, binary)) = glb::parts(&data[..size]).filter(|_| random.below(8) > 0) else {
        return pieces::mutate(data, size, max_size, seed);
    };
    let (mut text, mut binary) = (text.to_vec(), binary.to_vec());
    let part = if random.below(4) > 0 { &mut text } else { &mut binary };
    let size = part.len();
    part.resize(size + size / 8 + 64, 0);
    let room = part.len();
    let size = if random.below(2) > 0 {
        pieces::mutate(part, size, room, seed)
    } else {
        fuzzer_mutate(part, size, room)
    };
    part.truncate(size);
    let whole = glb::whole(&text, &binary);
    let size = whole.len().min(most);
    data[..size].copy_from_slice(&whole[..size]);
    size
});
