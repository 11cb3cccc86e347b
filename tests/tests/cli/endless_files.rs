// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files that scenes and options name and that have no end: pipes that nobody writes to, and devices.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::common_cli::{command, file, folder};

/// Seconds after which the program is taken to wait for ever.
const PATIENCE: Duration = Duration::from_secs(60);

/// Asserts that the program refuses arguments for a device, soon and in one line that names the file.
fn assert_refused_soon(there: &TempDir, arguments: &[&str], name: &str) {
    let said = refused_soon(there, arguments, name);
    assert!(said.contains("a device, not a file"), "{arguments:?}: {said}");
}

/// The one line in which the program refuses arguments, soon, with the file's name in it.
fn refused_soon(there: &TempDir, arguments: &[&str], name: &str) -> String {
    let mut child = command(there, arguments)
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    let began = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if began.elapsed() > PATIENCE {
            child.kill().expect("it runs");
            panic!("{arguments:?}: it waits for {name}");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let output = child.wait_with_output().expect("it has ended");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    assert!(said.contains(name), "{arguments:?}: {said}");
    assert_eq!(said.trim().lines().count(), 1, "{arguments:?}: one line: {said}");
    said.into_owned()
}

/// A pipe that nobody writes to.
fn pipe(path: &Path) {
    let made = Command::new("mkfifo").arg(path).status();
    assert!(made.is_ok_and(|status| status.success()), "{} is made", path.display());
}

#[test]
fn pipes_and_devices_that_a_scene_names_are_refused() {
    let there = folder();
    pipe(&there.path().join("pipe"));
    std::os::unix::fs::symlink("/dev/zero", there.path().join("zero")).expect("writable");
    std::fs::create_dir(there.path().join("leaves")).expect("writable");
    pipe(&there.path().join("leaves/leaves.ron"));
    for name in ["pipe", "zero"] {
        let scenes = [
            format!("(species: [(name: \"a\", tables: Some(\"{name}\"))])"),
            format!("(view: (sky: Map((path: \"{name}\"))))"),
            format!("(tree_kinds: [(name: \"t\", form: File(\"{name}\"))], trees: [(kind: \"t\")])"),
            format!("(ground: (litter: Some(())), objects: [(shape: Mesh(file: \"{name}\"))])"),
        ];
        for scene in scenes {
            file(&there, "scene.ron", scene);
            // The link leads out of the folder, which is refused by itself.
            let render = ["render", "scene.ron", "--allow-outside", "--frames", "1", "--out", "a.png"];
            assert_refused_soon(&there, &render, name);
        }
        assert_refused_soon(&there, &["render", "--sky", name, "--frames", "1", "--out", "a.png"], name);
        assert_refused_soon(&there, &["leaf", "veins", name, "--out", "a.png"], name);
    }
    file(&there, "scene.ron", "(species: [(name: \"a\", leaves: Some(\"leaves\"))])");
    assert_refused_soon(&there, &["render", "scene.ron", "--frames", "1", "--out", "a.png"], "leaves.ron");
}

/// A file of a tebibyte that takes no room on the disk.
#[test]
fn files_of_absurd_sizes_are_refused_before_they_are_read() {
    let there = folder();
    let huge = std::fs::File::create(there.path().join("huge")).expect("writable");
    huge.set_len(1 << 40).expect("a disk with sparse files");
    let scenes = [
        ("(species: [(name: \"a\", tables: Some(\"huge\"))])", "huge"),
        ("(view: (sky: Map((path: \"huge\"))))", "huge"),
        ("(tree_kinds: [(name: \"t\", form: File(\"huge\"))], trees: [(kind: \"t\")])", "huge"),
        ("(ground: (litter: Some(())), objects: [(shape: Mesh(file: \"huge\"))])", "huge"),
    ];
    for (scene, name) in scenes {
        file(&there, "scene.ron", scene);
        let said = refused_soon(&there, &["render", "scene.ron", "--frames", "1", "--out", "a.png"], name);
        assert!(said.contains("bytes") || said.contains("large"), "{scene}: {said}");
    }
    for arguments in [
        &["simulate", "huge"][..],
        &["simulate", "--resume", "huge"],
        &["leaf", "veins", "huge", "--out", "a.png"],
    ] {
        refused_soon(&there, arguments, "huge");
    }
}
