// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files outside its own folder that a scene names: refused, by every command that reads scenes, unless the user allows them.

use std::fs;

use tempfile::TempDir;

use crate::common_cli::{assert_refused, file, folder, windfall};

/// A folder with a scene folder in it, and motion tables beside that.
fn there() -> TempDir {
    let there = folder();
    fs::create_dir(there.path().join("scenes")).expect("writable");
    windfall(&there, &["motions", "six-motions", "--out", "tables"]).text();
    let first = fs::read_dir(there.path().join("tables")).expect("a folder").next().expect("a file");
    fs::rename(first.expect("an entry").path(), there.path().join("a.motions")).expect("writable");
    there
}

/// Writes the scene that names a file by each kind of field.
fn scene(there: &TempDir, named: &str, part: &str) {
    file(there, "scenes/scene.ron", part.replace("NAME", named));
}

const TABLES: &str = r#"(species: [(name: "a", tables: Some("NAME"))])"#;

#[test]
fn every_field_is_held_to_its_folder() {
    let there = there();
    fs::write(there.path().join("scenes/inside"), "").expect("writable");
    std::os::unix::fs::symlink("../a.motions", there.path().join("scenes/link")).expect("writable");
    let secret = there.path().join("a.motions");
    let absolute = secret.to_str().expect("plain");
    let fields = [
        (TABLES, "species[0].tables"),
        (r#"(species: [(name: "a", leaves: Some("NAME"))])"#, "species[0].leaves"),
        (r#"(view: (sky: Map((path: "NAME"))))"#, "view.sky.path"),
        (r#"(tree_kinds: [(name: "t", form: File("NAME"))], trees: [(kind: "t")])"#, "tree_kinds[0].form"),
        (r#"(ground: (litter: Some(())), objects: [(shape: Mesh(file: "NAME"))])"#, "objects[0].shape.file"),
    ];
    for (part, field) in fields {
        for named in ["../a.motions", absolute, "link", "../none"] {
            scene(&there, named, part);
            let essentials =
                ["scenes/scene.ron: ", field, "outside the folder of this file", "--allow-outside"];
            assert_refused(&there, &["simulate", "scenes/scene.ron", "--steps", "1"], &essentials);
        }
        scene(&there, "inside", part);
        let outcome = windfall(&there, &["simulate", "scenes/scene.ron", "--steps", "1"]);
        assert!(!outcome.stderr.contains("outside"), "{field}: {outcome:?}");
    }
}

#[test]
fn every_command_asks_and_the_user_may_allow() {
    let there = there();
    scene(&there, "../a.motions", TABLES);
    let commands: [&[&str]; 8] = [
        &["simulate", "scenes/scene.ron", "--steps", "1"],
        &["render", "scenes/scene.ron", "--out", "a.png"],
        &["export", "scenes/scene.ron", "--frames", "0..1", "--out", "a.csv"],
        &["study", "scenes/scene.ron", "--vary", "wind.speed=1,2", "--out", "study"],
        &["bench", "scenes/scene.ron", "--leaves", "9"],
        &["motions", "scenes/scene.ron", "--out", "again"],
        &["tree", "info", "scenes/scene.ron#0"],
        &["view", "scenes/scene.ron"],
    ];
    for command in commands {
        assert_refused(&there, command, &["scenes/scene.ron: species[0].tables", "--allow-outside"]);
    }
    let allowed = [commands[0], &["--allow-outside", "--checkpoint", "states"]].concat();
    windfall(&there, &allowed).text();
    let allowed = [commands[5], &["--allow-outside"]].concat();
    windfall(&there, &allowed).text();

    // A checkpoint carries the scene, and with it the path.
    fs::create_dir(there.path().join("elsewhere")).expect("writable");
    fs::rename(there.path().join("states"), there.path().join("elsewhere/state")).expect("there");
    let resume = ["simulate", "--resume", "elsewhere/state", "--steps", "1"];
    assert_refused(&there, &resume, &["elsewhere/state: species[0].tables", "--allow-outside"]);
    windfall(&there, &[&resume[..], &["--allow-outside"]].concat()).text();
}
