// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A machine that fails while the program is at work: its device, disk, memory, clock and reader go, and it is stopped and ended from outside.
//! Work goes on to the same bytes, or ends in one line with all that is finished kept.

use std::fs;
use std::io::Read as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::common_cli::{Outcome, assert_same, command, file, folder, restless, windfall};

/// Environment variable with the step from which on the graphics device is lost.
const LOSS: &str = "WINDFALL_LOSE_DEVICE_AT";
/// Seconds after which the program is taken to have begun work that it ought to have refused.
const PATIENCE: Duration = Duration::from_secs(60);

/// Outcome of a command that ends by itself.
fn outcome(mut command: Command) -> Outcome {
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    outcome_of(child)
}

fn outcome_of(child: Child) -> Outcome {
    let output = child.wait_with_output().expect("it ends");
    let text = |bytes| String::from_utf8(bytes).expect("the program speaks UTF-8");
    Outcome { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// Runs the program, whose graphics device is lost at a step.
fn with_loss(there: &TempDir, arguments: &[&str], step: u32) -> Outcome {
    let mut command = command(there, arguments);
    command.env(LOSS, step.to_string());
    outcome(command)
}

#[test]
fn a_simulation_outlives_its_device() {
    let (whole, broken) = (restless(), restless());
    let options = ["--backend", "wgpu", "--checkpoint", "state", "--tracks", "t.csv", "--track-every", "20"];
    let arguments = [&["simulate", "scene.ron", "--steps", "90", "--json"], &options[..]].concat();
    let without = windfall(&whole, &arguments);
    assert!(!without.stderr.contains("lost"), "{without:?}");
    let with = with_loss(&broken, &arguments, 50);
    assert!(
        with.stderr.contains("device lost")
            && with.stderr.contains("on the cpu, with the same bits, from step "),
        "{with:?}"
    );
    let (without, with) = (without.json(), with.json());
    assert_eq!((&without["backend"], &with["backend"]), (&"wgpu".into(), &"cpu".into()), "where it ends");
    assert_eq!(without["state_hash"], with["state_hash"], "the same bits");
    assert_same(&whole, &broken, "state and tracks");
}

#[test]
fn an_export_outlives_its_device() {
    let (whole, broken) = (restless(), restless());
    let options = ["--backend", "wgpu", "--frames", "0..20", "--fps", "20", "--out", "a.csv"];
    let arguments = [&["export", "scene.ron"], &options[..]].concat();
    windfall(&whole, &arguments).text();
    let with = with_loss(&broken, &arguments, 30);
    assert!(with.stderr.contains("device lost"), "{with:?}");
    with.text();
    assert_same(&whole, &broken, "the table");
}

#[test]
fn a_clip_outlives_the_device_that_draws_and_simulates() {
    for (backend, out) in [("wgpu", "frames"), ("cpu", "a.gif"), ("wgpu", "last.png")] {
        let (whole, broken) = (restless(), restless());
        let options = ["--backend", backend, "--frames", "14", "--size", "96x54", "--out", out];
        let arguments = [&["render", "scene.ron"], &options[..]].concat();
        windfall(&whole, &arguments).text();
        let with = with_loss(&broken, &arguments, 8);
        assert!(
            with.stderr.contains("the graphics device is lost") && with.stderr.contains("with the same bits"),
            "{backend}: {with:?}"
        );
        with.text();
        assert_same(&whole, &broken, out);
    }
}

/// The program with files of at most so many KiB, as on a disk that is full behind them.
fn on_a_full_disk(there: &TempDir, arguments: &[&str], kib: u32) -> Outcome {
    let plain = command(there, arguments);
    let mut command = Command::new("sh");
    // Blocks of ulimit have 512 bytes. Ignored, the signal leaves the error of the write.
    let script = format!("trap '' XFSZ; ulimit -f {}; exec \"$@\"", 2 * kib);
    command.args(["-c", &script, "sh"]).arg(plain.get_program()).args(plain.get_args());
    command.current_dir(there.path()).stdin(Stdio::null()).env("NODEVICE_SELECT", "1");
    outcome(command)
}

#[test]
fn a_full_disk_is_an_error_and_what_is_finished_is_kept() {
    let clip =
        ["render", "scene.ron", "--backend", "cpu", "--frames", "40", "--size", "96x54", "--out", "a.gif"];
    let table = ["export", "scene.ron", "--backend", "cpu", "--frames", "0..200", "--out", "a.csv"];
    let state = [
        "simulate",
        "scene.ron",
        "--backend",
        "cpu",
        "--leaves",
        "9000",
        "--steps",
        "9",
        "--checkpoint",
        "state",
    ];
    for (arguments, kib, keeps) in [(&clip[..], 24, true), (&table, 64, false), (&state, 64, false)] {
        let out = arguments[arguments.len() - 1];
        let (whole, full) = (restless(), restless());
        let failed = on_a_full_disk(&full, arguments, kib);
        assert_eq!(failed.code, Some(2), "{out}: {failed:?}");
        let last = failed.stderr.lines().last().unwrap_or_default();
        assert!(
            last.contains(out) && last.contains("cannot write") && last.contains("too large"),
            "{out}: {last}"
        );
        assert!(!full.path().join(out).exists(), "{out}: nothing broken lies there");
        let again = windfall(&full, arguments);
        assert!(!keeps || again.stderr.contains("going on with"), "{out}: {again:?}");
        again.text();
        windfall(&whole, arguments).text();
        assert_same(&full, &whole, out);
    }
}

/// A folder that nothing can be written to: one without that permission, or for those who need none the system's own.
fn read_only(there: &TempDir) -> String {
    use std::os::unix::fs::PermissionsExt;

    let path = there.path().join("locked");
    fs::create_dir(&path).expect("writable");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o555)).expect("ours");
    if fs::write(path.join("try"), "").is_err() {
        return path.to_str().expect("plain").to_owned();
    }
    fs::remove_file(path.join("try")).expect("just made");
    "/proc".into()
}

#[test]
fn a_folder_that_cannot_be_written_to_is_found_before_anything_long_begins() {
    let there = restless();
    let locked = read_only(&there);
    let out = |name: &str| format!("{locked}/{name}");
    let long = ["--frames", "1000000", "--size", "96x54", "--out"];
    let cases = [
        ([&["simulate", "scene.ron", "--steps", "1000000000", "--checkpoint"][..]].concat(), out("state")),
        ([&["simulate", "scene.ron", "--steps", "1000000000", "--tracks"][..]].concat(), out("t.csv")),
        ([&["render", "scene.ron"], &long[..]].concat(), out("clip")),
        ([&["render", "scene.ron"], &long[..]].concat(), out("clip.gif")),
        (["export", "scene.ron", "--frames", "0..9000", "--out"].to_vec(), out("a.csv")),
        (["export", "scene.ron", "--frames", "0..9000", "--out"].to_vec(), out("a.usda")),
        (["study", "scene.ron", "--vary", "wind.speed=0..12/13", "--out"].to_vec(), out("study")),
        (["motions", "--out"].to_vec(), out("motions")),
        (["man", "--out"].to_vec(), out("pages")),
        (["leaf", "make", "oak", "--out"].to_vec(), out("leaves")),
    ];
    for (mut arguments, path) in cases {
        arguments.push(&path);
        let mut child = command(&there, &arguments);
        let mut child =
            child.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
        let began = Instant::now();
        while child.try_wait().expect("a child").is_none() {
            if began.elapsed() > PATIENCE {
                child.kill().expect("it runs");
                panic!("{arguments:?}: it works for what it cannot write");
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        let refused = outcome_of(child);
        assert_eq!(refused.code, Some(2), "{arguments:?}: {refused:?}");
        let lines: Vec<&str> = refused.stderr.lines().collect();
        assert!(lines.len() == 1 && lines[0].contains(&path), "{arguments:?}: {lines:?}");
    }
}

#[test]
fn a_reader_that_goes_away_ends_no_long_work() {
    let there = restless();
    let arguments = ["render", "scene.ron", "--frames", "30", "--size", "96x54", "--out", "a.gif"];
    let mut child = command(&there, &arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // The first words of it, and then nobody listens any more, neither to its path nor to its progress.
    drop(child.stdout.take());
    let mut heard = [0];
    let mut stderr = child.stderr.take().expect("piped");
    stderr.read_exact(&mut heard).expect("it says which backend it takes");
    drop(stderr);
    assert_eq!(child.wait().expect("it ends").code(), Some(0), "it has finished");
    assert!(there.path().join("a.gif").is_file(), "and there it is");
}

/// Sends a signal.
fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args([&format!("-{name}"), &child.id().to_string()]).status();
    assert!(sent.is_ok_and(|status| status.success()), "{name} is sent");
}

/// Waits until a folder holds a file or folder whose path ends like this; false if the program ends before.
fn wait_for(child: &mut Child, there: &Path, ending: &str) -> bool {
    let is_there = || {
        let mut folders = vec![there.to_owned()];
        while let Some(folder) = folders.pop() {
            // Things come and go while the program is at work.
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                if entry.path().to_string_lossy().ends_with(ending) {
                    return true;
                }
                folders.push(entry.path());
            }
        }
        false
    };
    while !is_there() {
        if child.try_wait().expect("a child").is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    true
}

/// Work of a second or more, and the ending of something that it has made on the way.
fn long_work() -> [(Vec<&'static str>, &'static str); 3] {
    let steps = ["simulate", "scene.ron", "--leaves", "40000", "--steps", "6000", "--checkpoint", "state"];
    let wgpu = ["simulate", "scene.ron", "--leaves", "3000", "--steps", "1200", "--checkpoint", "state"];
    let frames =
        ["render", "scene.ron", "--frames", "60", "--size", "96x54", "--out", "a.gif", "--backend", "cpu"];
    [
        ([&steps[..], &["--backend", "cpu"]].concat(), "work.json"),
        ([&wgpu[..], &["--backend", "wgpu"]].concat(), "work.json"),
        (frames.to_vec(), "frame_0005.png"),
    ]
}

#[test]
fn a_request_to_terminate_keeps_what_is_done_and_the_same_command_goes_on() {
    for (arguments, ending) in long_work() {
        let (whole, ended) = (restless(), restless());
        let mut child = command(&ended, &arguments);
        let mut child =
            child.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
        assert!(wait_for(&mut child, ended.path(), ending), "{arguments:?}: it is at work");
        // A moment before it takes its first step a signal still ends it at once.
        std::thread::sleep(Duration::from_millis(300));
        signal(&child, "TERM");
        let outcome = outcome_of(child);
        assert_eq!(outcome.code, Some(2), "{arguments:?}: {outcome:?}");
        assert!(outcome.stderr.contains("the same command goes on"), "{arguments:?}: {outcome:?}");
        let out = if arguments[0] == "render" { "a.gif" } else { "state" };
        let names: Vec<_> = fs::read_dir(ended.path())
            .expect("a folder")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .filter(|name| name != "scene.ron")
            .collect();
        assert_eq!(
            names,
            [format!(".{out}.unfinished")],
            "{arguments:?}: what it goes on with and nothing else"
        );
        let again = windfall(&ended, &arguments);
        assert!(again.stderr.contains("going on"), "{arguments:?}: {again:?}");
        again.text();
        windfall(&whole, &arguments).text();
        assert_same(&whole, &ended, out);
    }
}

/// `WINDFALL_SUSPEND_S` is the number of seconds that work is suspended for, three if it is not set.
#[test]
fn suspended_work_goes_on_to_the_same_bytes() {
    let seconds = std::env::var("WINDFALL_SUSPEND_S").map_or(3, |seconds| seconds.parse().expect("a number"));
    for (arguments, ending) in long_work() {
        let (whole, suspended) = (restless(), restless());
        let mut child = command(&suspended, &arguments);
        let mut child =
            child.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
        assert!(wait_for(&mut child, suspended.path(), ending), "{arguments:?}: it is at work");
        signal(&child, "STOP");
        std::thread::sleep(Duration::from_secs(seconds));
        assert!(child.try_wait().expect("a child").is_none(), "{arguments:?}: it sleeps");
        signal(&child, "CONT");
        outcome_of(child).text();
        windfall(&whole, &arguments).text();
        assert_same(&whole, &suspended, arguments[0]);
    }
}

#[test]
fn memory_that_is_not_there_is_refused_before_building() {
    let there = folder();
    // Together some sixty gigabytes, in two copies.
    let text = r#"(
        sources: [(shape: Sphere(center_m: (0.0, 1.5, 0.0), radius_m: 1.0), count: 268435456)],
        particles: [(name: "sparks", count: 33554432, release: Rate(per_s: 60.0, from_s: 0.0))],
    )"#;
    file(&there, "scene.ron", text);
    let began = Instant::now();
    for arguments in [&["simulate", "scene.ron"][..], &["render", "scene.ron", "--out", "a.png"]] {
        let refused = windfall(&there, arguments);
        assert_eq!(refused.code, Some(2), "{refused:?}");
        for part in [
            "scene.ron: the memory that it needs is ",
            "MiB, for 268435456 leaves and 33554432 particles",
            "MiB that are free",
        ] {
            assert!(refused.stderr.contains(part), "{part}: {refused:?}");
        }
    }
    assert!(began.elapsed() < PATIENCE, "nothing is built before");
}

/// A clock that jumps moves nothing that reads none: all time is measured by one that only goes forward.
#[test]
fn no_source_reads_a_clock_that_jumps() {
    let root =
        Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the package is a folder of the workspace");
    let rooms = ["app", "backend-cpu", "backend-wgpu", "core", "texgen"];
    let mut folders: Vec<_> = rooms.iter().map(|room| root.join(room)).collect();
    let mut read = 0;
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry")) {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let text = fs::read_to_string(&path).expect("readable");
                for word in ["SystemTime", "UNIX_EPOCH", ".modified()", ".created()"] {
                    assert!(
                        !text.contains(word),
                        "{} reads {word}, which jumps with the clock",
                        path.display()
                    );
                }
                read += 1;
            }
        }
    }
    assert!(read > 300, "{read} sources");
}
