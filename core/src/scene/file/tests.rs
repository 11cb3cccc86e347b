// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Round trips of random scenes; broken texts and files.

mod strategies;

use std::fs;
use std::path::PathBuf;

use proptest::prelude::*;

use super::*;
use crate::scene::{Sky, TreeForm};
use strategies::any_scene;

proptest! {
    #[test]
    fn what_is_written_is_read_back_to_the_bit(scene in any_scene()) {
        scene.validate("random").expect("random scenes are made valid");
        let text = scene.to_ron();
        let read = Scene::from_ron(&text, "random").expect("what is written can be read");
        prop_assert_eq!(&read, &scene, "every field is the same");
        // Equality takes 0.0 for -0.0; the text does not.
        prop_assert_eq!(read.to_ron(), text, "and so is every bit");
    }

    #[test]
    fn no_text_brings_the_reader_down(text in "[(){}\\[\\]:,.0-9a-z_\" \n-]{0,80}") {
        // Whether it is a scene does not matter here.
        let _ = Scene::from_ron(&text, "random");
    }
}

/// Line, column and message of the error that a text gives.
fn syntax(text: &str) -> (usize, usize, String) {
    match Scene::from_ron(text, "broken.ron") {
        Err(SceneError::Syntax { file, line, column, message }) => {
            assert_eq!(file, "broken.ron", "the error names the file");
            (line, column, message)
        }
        other => panic!("{text:?} should be a syntax error, not {other:?}"),
    }
}

#[test]
fn broken_text_is_found_to_the_line_and_column() {
    for (text, line, column, message) in [
        ("(\n    seed: 1,\n    sede: 2,\n)", 3, 5, "did you mean `seed`?"),
        ("(\n    ground: (friktion: 1.0),\n)", 2, 14, "did you mean `friction`?"),
        ("(\n    species: [(shape: Mapel)],\n)", 2, 23, "did you mean `Maple`?"),
        ("(seed: -1)", 1, 9, "whole number, not negative"),
        ("(name: 5)", 1, 8, "Expected string"),
        ("(name: \"abc", 1, 8, "end of string"),
        ("(\n  dt_s:   // in seconds\n    // or so\n   fast,\n)", 4, 4, "Expected float"),
        ("(dt_s: 0.01 seed: 1)", 1, 13, "Expected a comma"),
        ("(seed: 1", 1, 9, "a closing bracket is missing"),
        ("(\n  species: [\n    (name: \"oak\"),\n", 4, 1, "end"),
        ("(seed: 1) x", 1, 11, "trailing"),
        ("(seed: 1, seed: 2)", 1, 11, "duplicate field named `seed`"),
        ("(sources: [(shape: Disc(radius_m: 2.0))])", 1, 38, "`center_m` is missing"),
        ("/* open", 1, 8, "Unclosed block comment"),
        ("", 1, 1, "empty; the smallest scene is ()"),
        (" \n\n", 3, 1, "empty; the smallest scene is ()"),
    ] {
        let (found_line, found_column, found) = syntax(text);
        assert!(found.contains(message), "{text:?}: {found:?} should contain {message:?}");
        assert_eq!((found_line, found_column), (line, column), "{text:?}: {found}");
    }
}

#[test]
fn a_syntax_error_is_one_line() {
    let line = Scene::from_ron("(\n  seed: one,\n)", "a.ron").expect_err("not a number").to_string();
    assert!(line.starts_with("a.ron:2:9: ") && !line.contains('\n'), "{line}");
}

#[test]
fn deep_nesting_is_refused() {
    let (_, _, message) = syntax(&"(species: [".repeat(100_000));
    assert!(!message.is_empty(), "an error and no overflow of the stack");
}

#[test]
fn an_empty_pair_of_brackets_is_the_default_scene() {
    for text in ["()", "Scene()", "\u{feff}()", "// nothing\n()\n"] {
        assert_eq!(Scene::from_ron(text, "test").expect("a scene"), Scene::default(), "{text:?}");
    }
}

#[test]
fn options_need_no_some() {
    let text = "(sources: [(recycle_after_s: 20.0), (recycle_after_s: None), (recycle_after_s: Some(3.0))])";
    // The third is how other RON writers put it, with the extension switched off.
    let scene = Scene::from_ron(&text.replace("Some(3.0)", "3.0"), "test").expect("a scene");
    let found: Vec<_> = scene.sources.iter().map(|source| source.recycle_after_s).collect();
    assert_eq!(found, [Some(20.0), None, Some(3.0)], "values as they are, or None");
    assert!(Scene::from_ron(text, "test").is_ok(), "Some(…) is understood as well");
}

/// A fresh directory of this test.
fn directory(test: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("windfall-core-{}-{test}", std::process::id()));
    fs::create_dir_all(&path).expect("temporary files can be written");
    path
}

#[test]
fn files_that_are_no_scenes_are_refused_in_one_line() {
    let at = directory("bad-files");
    for (name, bytes, reason) in [
        ("latin1.ron", b"(\n  name: \"\xe4\",\n)".to_vec(), ":2:10: not UTF-8 text"),
        ("empty.ron", Vec::new(), ":1:1: empty"),
        ("range.ron", b"(dt_s: 7.0)".to_vec(), ": dt_s is 7.0; allowed: 0.001 to 0.05 s"),
        ("huge.ron", vec![b' '; 4 * 1024 * 1024 + 1], "more than 4194304 bytes"),
    ] {
        let path = at.join(name);
        fs::write(&path, bytes).expect("temporary files can be written");
        let path = path.to_str().expect("a UTF-8 path");
        let line = Scene::load(path).expect_err(name).to_string();
        assert!(line.starts_with(path) && line.contains(reason) && !line.contains('\n'), "{name}: {line}");
    }
    let directory = at.to_str().expect("a UTF-8 path");
    let line = Scene::load(directory).expect_err("a directory").to_string();
    assert_eq!(line, format!("{directory}: a directory, not a scene file"), "a directory");
    fs::remove_dir_all(&at).expect("temporary files can be removed");
}

#[test]
fn names_that_stand_for_nothing_are_refused_in_one_line() {
    let all = "presets: autumn-park, six-motions, cone-spirals, flight-lab, storm, million, forest, gale, hurricane, evening, macro, winter, hills, blower, square, drift, walk, heap, pond, particle-lab, whirl, waterfall, rain-pond, pollen, fireflies, genesis, galaxy, slime, ember-whirl, bonfire, burning-leaves, flow-trees, first-snow, snowstorm, thaw, valley, city-square";
    for (name, hint) in [
        ("strom", " (did you mean 'storm'?)"),
        ("no/such/file.ron", ""),
        ("", ""),
        ("storm/", " (did you mean 'storm'?)"),
    ] {
        let line = Scene::load(name).expect_err(name).to_string();
        assert_eq!(line, format!("scene '{name}' is neither a file nor a preset{hint}; {all}"), "{name:?}");
    }
    for name in ["a\0b".to_owned(), "x".repeat(100_000), "two\nlines".to_owned()] {
        let error = Scene::load(&name).expect_err("neither file nor preset");
        assert!(!error.to_string().contains('\n'), "one line whatever the name: {error}");
    }
}

#[test]
fn named_files_are_looked_for_beside_the_scene_file() {
    let at = directory("tables");
    let path = at.join("mine.ron");
    let text = r#"(species: [
        (name: "a", tables: "a.tables", leaves: "oaks"),
        (name: "b", tables: "/b.tables", leaves: "/oaks"),
        (name: "c"),
    ], tree_kinds: [
        (name: "a", form: File("a.glb")),
        (name: "b", form: File("/b.glb")),
        (name: "c", form: ParticleFlow((hull: Mesh(file: "crown.glb")))),
    ],
    view: (sky: Map((path: "skies/noon.hdr"))))"#;
    fs::write(&path, text).expect("temporary files can be written");
    let name = path.to_str().expect("a UTF-8 path");
    let refused = Scene::load(name).expect_err("two lie elsewhere").to_string();
    let essentials = ["mine.ron: species[1].tables is '/b.tables', outside", "--allow-outside"];
    assert!(essentials.iter().all(|part| refused.contains(part)), "{refused}");
    let loaded = Scene::load_naming(name, NamedFiles::Anywhere).expect("a scene");
    fs::remove_dir_all(&at).expect("temporary files can be removed");
    let noon = at.join("skies/noon.hdr").to_str().expect("a UTF-8 path").to_owned();
    assert_eq!(loaded.view.sky, Sky::Map(crate::scene::SkyMap::new(noon)), "the map lies beside it");
    let [a, b, c] = loaded.tree_kinds.as_slice() else { panic!("three kinds: {:?}", loaded.tree_kinds) };
    let hull = at.join("crown.glb").to_str().expect("a UTF-8 path").to_owned();
    assert_eq!(c.form.clone().file_mut(), Some(&mut hull.clone()), "a hull beside it");
    assert_eq!(a.form, TreeForm::File(at.join("a.glb").to_str().expect("a UTF-8 path").into()), "beside it");
    assert_eq!(b.form, TreeForm::File("/b.glb".into()), "where it says");
    let found: Vec<_> = loaded.species.into_iter().map(|species| [species.tables, species.leaves]).collect();
    let beside = |name: &str| Some(at.join(name).to_str().expect("a UTF-8 path").to_owned());
    let wanted = [
        [beside("a.tables"), beside("oaks")],
        [Some("/b.tables".into()), Some("/oaks".into())],
        [None, None],
    ];
    assert_eq!(found, wanted, "relative paths only");
}

#[test]
fn a_file_wins_over_a_preset_and_is_read_as_written() {
    let at = directory("good-file");
    let path = at.join("mine.ron");
    let scene = Scene { name: "Mine".into(), ..Scene::preset("storm").expect("a preset") };
    fs::write(&path, scene.to_ron()).expect("temporary files can be written");
    let loaded = Scene::load(path.to_str().expect("a UTF-8 path")).expect("a scene");
    assert_eq!(loaded, scene, "the same scene");
    fs::remove_dir_all(&at).expect("temporary files can be removed");
    assert_eq!(Scene::load("storm").expect("a preset").name, "Storm", "presets by name");
}
