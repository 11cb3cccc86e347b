// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Long work that ends early and is gone on with: killed at random moments it comes to the same bytes as an unbroken run, loses nothing
//! that was finished, and leaves nothing behind. And clips that are drawn in parts.
//!
//! `WINDFALL_KILLS` is the number of kills for each kind of work, three if it is not set.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use tempfile::TempDir;

use crate::common_cli::{assert_refused, assert_same, command, contents, interrupted, restless, windfall};

/// Number of files below a folder whose names begin with this. The program may be at work there: files come and go.
fn count(folder: &Path, beginning: &str) -> usize {
    let Ok(entries) = fs::read_dir(folder) else { return 0 };
    let of = |entry: fs::DirEntry| match entry.file_type() {
        Ok(kind) if kind.is_dir() => count(&entry.path(), beginning),
        Ok(_) => usize::from(entry.file_name().to_string_lossy().starts_with(beginning)),
        Err(_) => 0,
    };
    entries.flatten().map(of).sum()
}

/// Runs the program until it comes to its end, killing it at random moments on the way; `finished` counts what must not be lost.
fn run_with_kills(there: &TempDir, arguments: &[&str], within: Duration, finished: impl Fn(&Path) -> usize) {
    let kills: u32 = std::env::var("WINDFALL_KILLS").map_or(3, |kills| kills.parse().expect("a number"));
    let mut random = TestRunner::default();
    let mut before = finished(there.path());
    for number in 0..kills {
        let mut child =
            command(there, arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
        let share = (0.0..1.0_f64).new_tree(&mut random).expect("a number").current();
        // Rather early than late, so that there is something left to be killed.
        let moment = Instant::now() + within.mul_f64(share.powi(3));
        while Instant::now() < moment && child.try_wait().expect("a child").is_none() {
            std::thread::sleep(Duration::from_millis(2));
        }
        child.kill().expect("it can be killed");
        if child.wait().expect("a child").success() {
            eprintln!("killed {number} times");
            return;
        }
        let now = finished(there.path());
        // Killed behind the end, it may have removed what it no longer needs.
        let is_there = outputs(arguments).all(|out| there.path().join(out).is_file());
        assert!(now >= before || is_there, "{arguments:?}: {now} parts are finished of {before}");
        before = now;
    }
    eprintln!("killed {kills} times");
    windfall(there, arguments).text();
}

/// Files and folders that a command writes.
fn outputs<'a>(arguments: &'a [&str]) -> impl Iterator<Item = &'a str> {
    let names = ["--out", "--checkpoint", "--tracks"];
    arguments.windows(2).filter(move |pair| names.contains(&pair[0])).map(|pair| pair[1])
}

/// Asserts that work that is killed comes to what it comes to otherwise, and that nothing else is left.
fn assert_survives_kills(arguments: &[&str], finished: impl Fn(&Path) -> usize) {
    let whole = restless();
    let began = Instant::now();
    windfall(&whole, arguments).text();
    let took = began.elapsed();
    let killed = restless();
    run_with_kills(&killed, arguments, took, finished);
    assert_same(&whole, &killed, &format!("{arguments:?}"));
}

#[test]
fn clips_survive_kills() {
    for out in ["frames", "clip.gif"] {
        let options = ["--backend", "cpu", "--frames", "40", "--size", "96x54", "--out", out];
        assert_survives_kills(&[&["render", "scene.ron"], &options[..]].concat(), |there| {
            count(there, "frame_")
        });
    }
}

#[test]
fn exports_survive_kills() {
    for (out, part) in [("a.usda", "frames_"), ("a.csv", "a.csv"), ("clouds", "frame_"), ("a.glb", "a.glb")] {
        let options = ["--backend", "cpu", "--frames", "5..1500", "--out", out];
        assert_survives_kills(&[&["export", "scene.ron"], &options[..]].concat(), |there| count(there, part));
    }
}

#[test]
fn simulations_survive_kills() {
    let options = ["--steps", "12000", "--backend", "cpu", "--tracks", "tracks.csv", "--track-every", "3"];
    let arguments =
        [&["simulate", "scene.ron", "--leaves", "40000", "--checkpoint", "state"], &options[..]].concat();
    assert_survives_kills(&arguments, |there| count(there, "state"));
}

#[test]
fn studies_survive_kills() {
    let options =
        ["--backend", "cpu", "--threads", "2", "--vary", "wind.speed=0,1,2,3,4,5", "--drops", "200"];
    let arguments = [&["study", "scene.ron", "--out", "out"], &options[..]].concat();
    assert_survives_kills(&arguments, |there| count(there, "landings.csv"));
}

#[test]
fn an_interrupt_keeps_what_is_finished_and_the_same_command_goes_on() {
    let there = restless();
    let render = |out| {
        let options = ["--backend", "cpu", "--frames", "90", "--size", "96x54", "--out", out];
        [&["render", "scene.ron"], &options[..]].concat()
    };
    let said = interrupted(&there, &render("a.gif"), || count(there.path(), "frame_") > 2);
    assert!(
        said.contains("of 45 frames are kept: the same command goes on"),
        "half of the frames are seen: {said}"
    );
    let other = ["render", "scene.ron", "--frames", "80", "--size", "96x54", "--out", "a.gif"];
    assert_refused(&there, &other, &["a.gif", "other frames", "--restart"]);
    let going_on = windfall(&there, &render("a.gif"));
    assert!(going_on.stderr.contains("going on with"), "{going_on:?}");
    going_on.text();
    windfall(&there, &render("b.gif")).text();
    assert!(
        fs::read(there.path().join("a.gif")).expect("there")
            == fs::read(there.path().join("b.gif")).expect("there"),
        "the same clip"
    );

    let export = |out, more: &[&'static str]| {
        let options = ["--backend", "cpu", "--frames", "0..3000", "--out", out];
        [&["export", "scene.ron"], &options[..], more].concat()
    };
    let said = interrupted(&there, &export("clouds", &[]), || count(there.path(), "frame_") > 2);
    assert!(said.contains("finished frames are kept"), "{said}");
    assert!(!there.path().join("clouds").exists(), "nothing lies at the output");
    let outcome =
        windfall(&there, &["export", "scene.ron", "--frames", "0..2", "--out", "clouds", "--restart"]);
    assert!(!outcome.stderr.contains("going on"), "{outcome:?}");
    outcome.text();
    assert_eq!(count(&there.path().join("clouds"), "frame_"), 3, "those of the new one alone");

    let steps = ["simulate", "scene.ron", "--leaves", "100000", "--steps", "100000", "--backend", "cpu"];
    let steps = [&steps[..], &["--checkpoint", "state"]].concat();
    let said = interrupted(&there, &steps, || there.path().join(".state.unfinished/work.json").exists());
    assert!(said.contains("steps are kept"), "{said}");
    let hidden = |name: &str| name.starts_with('.');
    let left: Vec<_> = fs::read_dir(there.path())
        .expect("a folder")
        .map(|entry| entry.expect("there").file_name().to_string_lossy().into_owned())
        .filter(|name| hidden(name))
        .collect();
    assert_eq!(left, [".state.unfinished"], "only what can be gone on with");
}

#[test]
fn two_runs_do_not_write_the_same_clip_at_once() {
    let there = restless();
    let render =
        ["render", "scene.ron", "--backend", "cpu", "--frames", "2000", "--size", "96x54", "--out", "frames"];
    let mut first =
        command(&there, &render).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    while count(there.path(), "frame_") == 0 {
        assert!(first.try_wait().expect("a child").is_none(), "it is at work");
        std::thread::sleep(Duration::from_millis(10));
    }
    let second = windfall(&there, &render);
    first.kill().expect("it runs");
    first.wait().expect("a child");
    assert_eq!(second.code, Some(2), "{second:?}");
    assert!(second.stderr.contains("frames: another run is writing it"), "{second:?}");
}

#[test]
fn parts_of_a_clip_are_those_of_the_whole() {
    let there = restless();
    let render = |frames: &str, out: &str| {
        let options =
            ["--backend", "cpu", "--frames", frames, "--size", "128x72", "--fps", "30", "--out", out];
        windfall(&there, &[&["render", "scene.ron"], &options[..]].concat()).text();
    };
    render("50", "whole");
    ["38..49", "0..4", "5..37"].iter().for_each(|part| render(part, "parts"));
    let [whole, parts] = ["whole", "parts"].map(|name| contents(&there.path().join(name)));
    assert_eq!((whole.len(), parts.len()), (50, 50), "as many frames");
    for ((path, a), (_, b)) in parts.iter().zip(&whole) {
        assert!(a == b, "{} is that of the whole", path.display());
    }
    render("49..49", "last.png");
    let [alone, last] = [&there.path().join("last.png"), &whole[49].0]
        .map(|path| image::open(path).expect("a picture").into_rgb8());
    assert!(alone == last, "a frame by itself is that of the whole");
    assert_refused(&there, &["render", "--frames", "9..3", "--out", "x.png"], &["--frames", "0..240"]);
    let looped = ["render", "--frames", "3..9", "--loop", "4", "--out", "x.gif"];
    assert_refused(&there, &looped, &["--frames", "--loop"]);
}
