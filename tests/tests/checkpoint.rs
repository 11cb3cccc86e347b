// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checkpoints: a resumed run equals an unbroken one to the bit; anything else is refused in one line, without a panic.

mod common;

use std::sync::OnceLock;

use common::{many_species, step};
use glam::Vec3;
use proptest::prelude::*;
use windfall_core::scene::{MeanSpeed, Release, Scene, Source, SourceShape};
use windfall_core::{SceneError, World};

fn scene(seed: u64, count: u32, wind_m_s: f32, recycle_after_s: Option<f32>) -> Scene {
    let mut scene = Scene {
        name: "Rückkehr \"zum\" Anfang".into(),
        seed,
        species: many_species().into_iter().step_by(7).collect(),
        sources: vec![Source {
            shape: SourceShape::Sphere { center_m: Vec3::new(0.3, 3.0, -0.1), radius_m: 1.5 },
            count,
            release: Release::Rate { per_s: 20.0, from_s: -1.1 },
            recycle_after_s,
            species: Vec::new(),
        }],
        ..Scene::default()
    };
    scene.wind.speed = MeanSpeed::MetresPerSecond(wind_m_s);
    scene
}

fn build(scene: &Scene) -> World {
    World::build(scene).expect("the scene of this test is valid")
}

fn saved(world: &World) -> Vec<u8> {
    let mut bytes = Vec::new();
    world.write_checkpoint(&mut bytes).expect("memory takes every byte");
    bytes
}

/// Bytes of a good checkpoint, made once.
fn good() -> &'static [u8] {
    static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
    BYTES.get_or_init(|| {
        let mut world = build(&scene(11, 40, 3.0, Some(2.0)));
        step(&mut world, 90);
        saved(&world)
    })
}

/// The reason for which bytes are refused.
fn refusal(bytes: &[u8]) -> String {
    match World::from_checkpoint(bytes, "walk.windfall") {
        Err(SceneError::Checkpoint { file, reason }) => {
            assert_eq!(file, "walk.windfall", "the error names the file");
            assert!(!reason.contains('\n'), "one line: {reason}");
            reason
        }
        Err(other) => panic!("another error: {other}"),
        Ok(_) => panic!("{} bytes accepted", bytes.len()),
    }
}

/// The same bytes with a checksum that fits them again.
fn resealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let body = bytes.len() - 4;
    let crc = crc32fast::hash(&bytes[..body]);
    bytes[body..].copy_from_slice(&crc.to_le_bytes());
    bytes
}

/// Offset of the leaf count in a checkpoint: behind magic, version, scene, shard, step and wind travel.
fn leaf_count_at(bytes: &[u8]) -> usize {
    let length = u64::from_le_bytes(bytes[12..20].try_into().expect("eight bytes"));
    20 + usize::try_from(length).expect("a short scene") + 8 + 4 + 8
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_resumed_run_equals_an_unbroken_one(
        seed in any::<u64>(),
        count in 1u32..120,
        wind_m_s in prop_oneof![Just(0.0f32), 0.0f32..15.0],
        recycle_after_s in prop::option::of(0.2f32..4.0),
        before in 0u32..200,
        after in 0u32..200,
        retuned in any::<bool>(),
    ) {
        let scene = scene(seed, count, wind_m_s, recycle_after_s);
        let mut unbroken = build(&scene);
        step(&mut unbroken, before);
        if retuned {
            let mut other = scene.clone();
            other.wind.direction_deg = 123.4;
            other.rotation_speed = 1.7;
            other.ground.friction = 0.9;
            unbroken.compiled.retune(&other);
            step(&mut unbroken, 3);
        }
        let bytes = saved(&unbroken);
        let mut resumed = World::from_checkpoint(&bytes, "test")
            .map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(resumed.state_hash(), unbroken.state_hash(), "right after reading");
        prop_assert!(resumed.compiled.scene() == unbroken.compiled.scene(), "the scene inside");
        prop_assert_eq!(&saved(&resumed), &bytes, "saved again");
        step(&mut unbroken, after);
        step(&mut resumed, after);
        prop_assert_eq!(resumed.clock, unbroken.clock, "clocks after {} more steps", after);
        prop_assert!(resumed.leaves == unbroken.leaves, "leaves after {after} more steps");
        prop_assert_eq!(resumed.state_hash(), unbroken.state_hash(), "after {} more steps", after);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_flipped_bit_is_noticed(place in any::<prop::sample::Index>(), bit in 0u32..8) {
        let mut bytes = good().to_vec();
        let place = place.index(bytes.len());
        bytes[place] ^= 1 << bit;
        let reason = refusal(&bytes);
        let expected = match place {
            0..8 => "WINDFALL",
            8..12 => "version",
            _ => "checksum",
        };
        prop_assert!(reason.contains(expected), "byte {}: {}", place, reason);
    }

    #[test]
    fn any_cut_is_noticed(kept in any::<prop::sample::Index>()) {
        let kept = kept.index(good().len());
        refusal(&good()[..kept]);
    }

    #[test]
    fn any_noise_is_refused(noise in prop::collection::vec(any::<u8>(), 0..200), sealed in any::<bool>()) {
        let mut bytes = if sealed { good()[..12].to_vec() } else { Vec::new() };
        bytes.extend(&noise);
        bytes.extend([0; 4]);
        refusal(&if sealed { resealed(bytes) } else { bytes });
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Bytes put together by someone who can count checksums still cannot make the reader panic.
    #[test]
    fn forged_bytes_do_not_panic(place in any::<prop::sample::Index>(), value in any::<u8>()) {
        let mut bytes = good().to_vec();
        let place = 12 + place.index(leaf_count_at(good()) + 8 - 12);
        bytes[place] = value;
        if let Ok(world) = World::from_checkpoint(&resealed(bytes), "test") {
            prop_assert_eq!(world.leaves.len(), world.compiled.scene().leaf_count() as usize, "byte {}", place);
        }
    }
}

#[test]
fn every_first_bytes_of_a_checkpoint_are_refused() {
    for kept in 0..200 {
        let reason = refusal(&good()[..kept]);
        let expected = if kept < 8 { "begin with WINDFALL" } else { "cut short" };
        assert!(reason.contains(expected), "{kept} bytes: {reason}");
    }
    assert!(refusal(b"").contains("begin with WINDFALL"), "an empty file");
}

#[test]
fn other_files_and_versions_say_so() {
    let mut other = good().to_vec();
    other[..8].copy_from_slice(b"WINDMILL");
    assert!(refusal(&resealed(other)).contains("begin with WINDFALL"), "another magic");
    let mut newer = good().to_vec();
    newer[8..12].copy_from_slice(&12u32.to_le_bytes());
    let reason = refusal(&resealed(newer));
    assert!(
        reason.contains("version 12") && reason.contains("reads version 11"),
        "a newer version: {reason}"
    );
}

#[test]
fn another_number_of_leaves_is_refused() {
    let at = leaf_count_at(good());
    for count in [0u64, 39, 41, 1 << 40, u64::MAX] {
        let mut bytes = good().to_vec();
        bytes[at..at + 8].copy_from_slice(&count.to_le_bytes());
        let reason = refusal(&resealed(bytes));
        assert!(reason.contains(&format!("{count} leaves for a scene of 40")), "{count} leaves: {reason}");
    }
}

#[test]
fn columns_of_another_length_are_refused() {
    let short = resealed(good()[..good().len() - 16].to_vec());
    assert!(refusal(&short).contains("cut short"), "one record too few");
    for more in [1, 4, 16] {
        let mut long = good().to_vec();
        long.extend(vec![0; more]);
        let reason = refusal(&resealed(long));
        assert!(reason.contains("longer"), "{more} bytes too many: {reason}");
    }
}
