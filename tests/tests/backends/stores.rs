// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Stores: whatever handles whole states takes a further store as it is, and leaves out no column of those there are.

use glam::Vec2;
use windfall_core::checkpoint::{read_stores, write_stores};
use windfall_core::scene::{Burning, History, Litter, ParticleRelease, Particles};
use windfall_core::store::{Store, StoreSize, check_sizes, copy_stores, hash_stores, state_bytes};
use windfall_core::{SceneError, SimError, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_tests::adapter;
use windfall_tests::compare::{difference, difference_of};
use windfall_tests::strategies::wooded_scene;
use windfall_wgpu::{StoreBuffers, WgpuOptions, WgpuSimulator, WorldBuffers};

windfall_core::columns! {
    /// A store that no world has.
    pub struct Pebbles("pebbles") {
        /// Number of a pebble.
        pub number: u32,
        /// Its size in m.
        pub size_m: f32,
    }
    /// A pebble.
    row PebbleMut;
    /// A run of pebbles.
    run PebblesMut;
}

fn world() -> World {
    let mut scene = wooded_scene(5, 200, 3.0, 1.0 / 60.0);
    scene.ground.litter = Some(Litter { size_m: Vec2::splat(2.0), ..Litter::default() });
    scene.particles = vec![Particles {
        count: 9,
        release: ParticleRelease::Burst { at_s: 0.0 },
        history: Some(History { samples: 3, every_steps: 2 }),
        ..Particles::default()
    }];
    scene.species[0].burns = Some(Burning::default());
    scene.sources.iter_mut().for_each(|source| source.recycle_after_s = None);
    scene.regrow_after_s = None;
    World::build(&scene).expect("the wooded scene is valid with litter that burns")
}

fn pebbles() -> Pebbles {
    let mut pebbles = Pebbles::zeroed(37);
    for (number, pebble) in (1u8..).zip(pebbles.as_mut().iter_mut()) {
        (*pebble.number, *pebble.size_m) = (u32::from(number), 0.01 * f32::from(number));
    }
    pebbles
}

/// The stores of a world, and a further one.
fn all<'a>(world: &'a World, pebbles: &'a Pebbles) -> Vec<&'a dyn Store> {
    world.stores().into_iter().chain([pebbles as &dyn Store]).collect()
}

/// A fingerprint of all rows.
fn hash_all(stores: &[&dyn Store]) -> u64 {
    hash_stores(stores, |store| (0..store.rows(), 0))
}

#[test]
fn a_further_store_is_saved_hashed_copied_compared_and_measured() {
    let (world, full, mut empty) = (world(), pebbles(), Pebbles::zeroed(37));
    assert_eq!(state_bytes(&all(&world, &full)), world.state_bytes() + 37 * 8, "bytes, for the history");
    let sizes: Vec<_> = all(&world, &full).into_iter().map(Store::size).collect();
    let mut others = sizes.clone();
    check_sizes(&sizes, &others).expect("the same sizes");
    others[7].rows += 1;
    let refused = check_sizes(&others, &sizes);
    assert!(
        matches!(refused, Err(SimError::Size { store: "pebbles", world: 38, simulator: 37 })),
        "{refused:?}"
    );
    let shorter = check_sizes(&sizes[..7], &sizes);
    assert!(
        matches!(shorter, Err(SimError::Size { store: "pebbles", world: 0, simulator: 37 })),
        "{shorter:?}"
    );

    let mut bytes = Vec::new();
    write_stores(&mut bytes, &all(&world, &full)).expect("memory takes every byte");
    let mut back = world.clone();
    back.leaves = windfall_core::leaf::Leaves::zeroed(world.leaves.len());
    let mut stores = back.stores_mut();
    stores.push(&mut empty);
    assert_eq!(read_stores(&bytes, "memory", &mut stores).expect("whole").len(), 0, "every byte is read");
    assert_eq!((&back.leaves, &empty), (&world.leaves, &full), "saved and read");
    let cut = read_stores(&bytes[..bytes.len() - 1], "memory", &mut [&mut Pebbles::zeroed(37)]);
    assert!(matches!(cut, Err(SceneError::Checkpoint { .. })), "leaves are no pebbles");

    let hash = hash_all(&all(&world, &full));
    assert_eq!(hash, hash_all(&all(&back, &empty)), "equal stores, equal hashes");
    let found = difference_of(&all(&world, &full), &all(&back, &empty));
    assert!(found.is_none(), "{found:?}");
    empty.number[4] ^= 1;
    let found = difference_of(&all(&world, &full), &all(&back, &empty));
    assert_eq!((found.of("pebbles").bit_rows, found.of("pebbles").integer_rows), (1, 1), "{found:?}");
    assert_ne!(hash, hash_all(&all(&back, &empty)), "an integer counts");
    copy_stores(&[&full], &mut [&mut empty]);
    assert_eq!(empty, full, "copied");
    empty.size_m[36] += 0.5;
    let found = difference_of(&all(&world, &full), &all(&back, &empty));
    assert_eq!((found.of("pebbles").bit_rows, found.of("pebbles").integer_rows), (1, 0), "{found:?}");
    assert!((found.of("pebbles").largest("size_m") - 0.5).abs() < 1e-6, "{found:?}");
    assert_ne!(hash, hash_all(&all(&back, &empty)), "a float counts");
    empty.size_m[36] = f32::NAN;
    let found = difference_of(&all(&world, &full), &all(&back, &empty));
    assert!(!found.is_finite(), "what is not a number is infinitely far off: {found:?}");
}

#[test]
fn a_further_store_has_buffers_and_windows() {
    let full = pebbles();
    for gpu in adapter::all() {
        let buffers = StoreBuffers::new(&gpu, &full).expect("a few rows fit");
        assert_eq!(buffers.size(), StoreSize { store: "pebbles", rows: 37 }, "as large as the store");
        buffers.write(&gpu, &full).expect("as many rows");
        let mut back = Pebbles::zeroed(37);
        buffers.read(&gpu, &mut back).expect("as many rows");
        assert_eq!(back, full, "{}", gpu.info().name);
        let window = buffers.window(1, 8, 4);
        assert_eq!(
            (window.offset, window.size.map(u64::from)),
            (32, Some(16)),
            "four rows from the ninth on"
        );
        let refused = buffers.write(&gpu, &Pebbles::zeroed(36));
        assert!(matches!(refused, Err(SimError::Size { store: "pebbles", .. })), "{refused:?}");
    }
}

/// Every word of every column is saved, hashed, compared, and copied to and from every backend.
#[test]
fn no_column_is_left_out() {
    let world = world();
    let saved = |world: &World| {
        let mut bytes = Vec::new();
        world.write_checkpoint(&mut bytes).expect("memory takes every byte");
        bytes
    };
    let gpu = adapter::all().remove(0);
    let mut simulators: Vec<Box<dyn Simulator>> = vec![
        Box::new(CpuSimulator::new(&world, CpuOptions::default()).expect("threads start")),
        Box::new(WgpuSimulator::new(&gpu, &world, &WgpuOptions::default()).expect("the device takes it")),
    ];
    let mirror = WorldBuffers::new(&gpu, &world).expect("the device takes it");
    for (index, store) in world.stores().into_iter().enumerate() {
        for (column, description) in store.description().iter().enumerate() {
            for word in 0..description.record_bytes / 4 {
                let name = format!("word {word} of {} of {}", description.name, store.name());
                let mut other = world.clone();
                let byte = (store.rows() / 2) * description.record_bytes + 4 * word;
                other.stores_mut()[index].columns_mut()[column][byte] ^= 2;
                assert_ne!(other.state_hash(), world.state_hash(), "{name} is hashed");
                assert_eq!(difference(&other, &world).of(store.name()).bit_rows, 1, "{name} is compared");
                let bytes = saved(&other);
                assert_ne!(bytes, saved(&world), "{name} is saved");
                let read = World::from_checkpoint(&bytes, "memory").expect("whole");
                assert!(difference(&read, &other).is_none(), "{name} is read");
                for simulator in &mut simulators {
                    let mut back = world.clone();
                    simulator.write_state(&other).expect("the same size");
                    simulator.read_state(&mut back).expect("the same size");
                    assert!(difference(&back, &other).is_none(), "{name}: {}", simulator.info().backend);
                }
                let mut back = world.clone();
                mirror.write(&gpu, &other).expect("the same size");
                mirror.read(&gpu, &mut back).expect("the same size");
                assert!(difference(&back, &other).is_none(), "{name} is mirrored");
            }
        }
    }
}

#[test]
fn a_compiled_scene_knows_the_sizes_of_its_stores() {
    let world = world();
    assert_eq!(world.compiled.sizes(), world.sizes(), "one list");
    let mut other = world.clone();
    other.branches = windfall_core::tree::Branches::zeroed(3);
    let refused = other.fits(&world.sizes());
    assert!(matches!(refused, Err(SimError::Size { store: "segments", world: 3, .. })), "{refused:?}");
}
