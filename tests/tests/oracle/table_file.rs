// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Motion tables on disk: read back to the bit, refused with the right line when broken, used like generated ones.

use std::sync::OnceLock;

use crate::common::{build, quaternion, step, still_scene, uniform_species};
use proptest::prelude::*;
use windfall_core::device::motion::lookup::motion_state;
use windfall_core::motion::{MotionTables, PrimitiveTable};
use windfall_core::scene::{MotionParameters, RotationModel, STANDARD_GRAVITY_M_S2, Species};
use windfall_core::{SceneError, World};

/// Lines of a file: two of head, then six blocks of one and 513.
const BLOCK: usize = 514;

/// Every bit of a table.
fn bits(table: &PrimitiveTable) -> (u64, Vec<u32>) {
    let numbers = table.displacement_m.as_flattened().iter();
    let numbers = numbers.chain(table.orientation.as_flattened()).chain(table.velocity_m.as_flattened());
    (table.period_s.to_bits(), numbers.map(|number| number.to_bits()).collect())
}

prop_compose! {
    fn any_motion()(
        speeds in [prop::option::of(0.05f32..10.0), prop::option::of(0.0f32..10.0), prop::option::of(0.0f32..10.0)],
        rates in [prop::option::of(0.5f32..60.0), prop::option::of(0.5f32..120.0), prop::option::of(0.5f32..30.0)],
        radii in [prop::option::of(0.0f32..5.0), prop::option::of(0.0f32..5.0)],
        shares in [prop::option::of(0.0f32..=1.0), prop::option::of(0.0f32..=0.5), prop::option::of(0.0f32..=1.0)],
        rose_swings in prop::option::of(2u32..=12),
        wander_m_s in prop::option::of(0.0f32..2.0),
    ) -> MotionParameters {
        MotionParameters {
            descent_m_s: speeds[0],
            horizontal_m_s: speeds[1],
            vertical_m_s: speeds[2],
            flutter_rad_s: rates[0],
            tumble_rad_s: rates[1],
            spiral_rad_s: rates[2],
            rose_radius_m: radii[0],
            spiral_radius_m: radii[1],
            chaos_keep: shares[0],
            chaos_jitter: shares[1],
            rose_ellipticity: shares[2],
            rose_swings,
            wander_m_s,
            ..MotionParameters::default()
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_tables_come_back_to_the_bit(
        motion in any_motion(),
        size_m in 0.005f32..0.5,
        areal_density_kg_m2 in 0.005f32..2.0,
        seed in any::<[u32; 2]>(),
        friction in prop::option::weighted(0.2, 0.1f32..1000.0),
    ) {
        let rotation = friction.map_or(RotationModel::SpecificForce, |friction_per_s| {
            RotationModel::TanabeKaneko { friction_per_s }
        });
        let species = Species { motion, size_m, areal_density_kg_m2, rotation, ..uniform_species() };
        let tables = MotionTables::generate(&species, seed, STANDARD_GRAVITY_M_S2);
        let read = MotionTables::from_text(&tables.to_text(), "test")
            .map_err(|error| TestCaseError::fail(error.to_string()))?;
        for (before, after) in tables.0.iter().zip(&read.0) {
            prop_assert_eq!(bits(before), bits(after), "a table changed on its way through the file");
        }
    }

    /// Whatever is done to one line, the answer is tables or an error in that line or one close after it; no panic.
    #[test]
    fn any_damage_is_refused_at_its_line(line in 0usize..(2 + 6 * BLOCK), junk in "[ -~]{0,40}") {
        let mut lines: Vec<_> = text().lines().collect();
        lines[line] = &junk;
        match MotionTables::from_text(&lines.join("\n"), "test") {
            Ok(_) => prop_assert!(
                junk.split('#').next().is_some_and(|numbers| numbers.split_whitespace().count() == 10),
                "accepted {junk:?} as line {}", line + 1
            ),
            Err(SceneError::Syntax { line: found, .. }) => {
                // A line that became empty or a comment is missed where the next one stands in its place.
                let blank = junk.split('#').next().is_some_and(|content| content.trim().is_empty());
                let next_block = (line.saturating_sub(2) / BLOCK + 1) * BLOCK + 3;
                let last = if blank { next_block.min(2 + 6 * BLOCK) } else { line + 1 };
                prop_assert!(
                    (line + 1..=last).contains(&found),
                    "line {} is {junk:?}, error at line {found}", line + 1
                );
            }
            Err(other) => prop_assert!(false, "another error: {other}"),
        }
    }
}

fn tables() -> MotionTables {
    MotionTables::generate(&uniform_species(), [1, 2], STANDARD_GRAVITY_M_S2)
}

/// Those tables as a file, made once.
fn text() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| tables().to_text())
}

/// Reads the text of a good file with one line (counted from 1) replaced, and gives line and message of the error.
fn refusal(line: usize, replacement: &str) -> (usize, String) {
    let mut lines: Vec<_> = text().lines().collect();
    lines[line - 1] = replacement;
    error_of(&lines.join("\n"))
}

fn error_of(text: &str) -> (usize, String) {
    match MotionTables::from_text(text, "walk.motions") {
        Err(SceneError::Syntax { file, line, message, .. }) => {
            assert_eq!(file, "walk.motions", "the error names the file");
            (line, message)
        }
        other => panic!("expected a syntax error, got {:?}", other.map(|_| "tables")),
    }
}

#[test]
fn each_kind_of_broken_file_is_refused_in_its_line() {
    let second = 3 + BLOCK;
    let good = "0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.2 -6.1 0.1";
    for (line, text, expected) in [
        (1, "windfall-motions 2", "windfall-motions 1"),
        (1, "", "windfall-motions 1"),
        (2, "rows 512", "rows 513"),
        (3, "primitive PT period_s 8.0", "primitive SD period_s"),
        (3, "primitive SD period_s eight", "primitive SD period_s"),
        (3, "primitive SD period_s 0.0", "0.001 to 1000"),
        (3, "primitive SD period_s NaN", "0.001 to 1000"),
        (3, "primitive SD period_s inf", "0.001 to 1000"),
        (second, good, "primitive PT period_s"),
        (4, "0.0 0.1 0.0 0.0 0.0 0.0 1.0 0.2 -6.1 0.1", "not zero"),
        (5, "0.0 0.0 0.0 0.0 0.0 0.0 1.1 0.2 -6.1 0.1", "unit length"),
        (6, "0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.2 -6.1", "this one 9"),
        (7, "0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.2 -6.1 0.1 0.5", "this one 11"),
        (8, "0.0 zero 0.0 0.0 0.0 0.0 1.0 0.2 -6.1 0.1", "'zero'"),
        (9, "0.0 NaN 0.0 0.0 0.0 0.0 1.0 0.2 -6.1 0.1", "'NaN'"),
        (10, "0.0 0.0 inf 0.0 0.0 0.0 1.0 0.2 -6.1 0.1", "'inf'"),
        (11, "0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.2 -6.1 2e6", "'2e6'"),
        (12, "0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.2 -6.1 1e60", "'1e60'"),
        (13, "primitive PT period_s 0.9", "'primitive'"),
        (second + 7, "0,0 0.0 0.0 0.0 0.0 0.0 1.0 0.2 -6.1 0.1", "'0,0'"),
    ] {
        let (found, message) = refusal(line, text);
        let expected_line = if text.is_empty() { line + 1 } else { line };
        assert_eq!(found, expected_line, "line of {text:?}: {message}");
        assert!(message.contains(expected), "message for {text:?}: {message}");
    }
    let text = text();
    let whole = 2 + 6 * BLOCK;
    for kept in [0, 1, 2, 3, 400, 2 + BLOCK, whole - 1] {
        let cut: Vec<_> = text.lines().take(kept).collect();
        let (found, message) = error_of(&cut.join("\n"));
        assert_eq!(found, kept.max(1), "line of a file cut after {kept} lines: {message}");
        assert!(message.contains("too early"), "message for a file cut after {kept} lines: {message}");
    }
    let (found, message) = error_of(&format!("{text}\n\nmore"));
    assert_eq!(found, whole + 3, "line of what follows the last table: {message}");
    assert!(message.contains("after the last table"), "message for what follows: {message}");
}

#[test]
fn comments_and_empty_lines_count_for_nothing() {
    let spread: Vec<_> = text().lines().map(|line| format!("\n  {line}   # why not\n# a remark")).collect();
    let read = MotionTables::from_text(&spread.join("\r\n"), "test").expect("comments are allowed");
    assert!(read == tables(), "comments changed the tables");
}

#[test]
fn a_scene_with_a_saved_file_falls_like_one_without() {
    let folder = std::env::temp_dir().join(format!("windfall-tables-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    let file = folder.join("saved.motions");
    let scene = still_scene(uniform_species(), 64, 12.0);
    let seed = [u32::try_from(scene.seed).expect("a small seed"), 0];
    let saved = MotionTables::generate(&scene.species[0], seed, STANDARD_GRAVITY_M_S2);
    std::fs::write(&file, saved.to_text()).expect("a file for the test");
    let mut from_file = scene.clone();
    from_file.species[0].tables = Some(file.to_string_lossy().into_owned());
    let mut worlds = [build(&scene), build(&from_file)];
    for world in &mut worlds {
        step(world, 300);
    }
    assert!(worlds[0].leaves == worlds[1].leaves, "the same motions from the file and from the equations");

    // A quaternion and its negative are the same rotation; a file may hold either in any row.
    let mut flipped = saved;
    for table in &mut flipped.0 {
        for quaternion in table.orientation.iter_mut().step_by(2) {
            *quaternion = quaternion.map(|part| -part);
        }
    }
    std::fs::write(&file, flipped.to_text()).expect("a file for the test");
    let read = build(&from_file);
    let contexts = [&worlds[0], &read].map(|world| {
        let block = world.compiled.step_block(&world.clock);
        (world, block)
    });
    for phase in (0..1000).map(|index: u32| index.wrapping_mul(0x9E37_79B9)) {
        let [a, b] = [0, 1].map(|index: usize| {
            let (world, block) = &contexts[index];
            quaternion(motion_state(&world.compiled.context(block).motion, 1, phase).1.to_array())
        });
        let cosine = a.dot(b).abs();
        assert!(
            cosine > 1.0 - 1e-6,
            "phase {phase}: signs in the file changed the rotation, cosine {cosine}"
        );
    }

    // A motion faster than the steps can follow is refused like one from the equations.
    let fast = flipped.to_text().replacen("primitive TC period_s ", "primitive TC period_s 0.0500001 # ", 1);
    std::fs::write(&file, fast).expect("a file for the test");
    match World::build(&from_file) {
        Err(SceneError::Field { field, allowed, .. }) => {
            assert!(field.contains("TC") && allowed.starts_with("0.0667"), "{field}: {allowed}");
        }
        other => panic!("a period of three steps is refused, not {:?}", other.map(|_| "accepted")),
    }
    std::fs::remove_dir_all(&folder).expect("the test's own folder");
}
