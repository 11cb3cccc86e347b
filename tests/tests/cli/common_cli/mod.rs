// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Runs the program as a user does.
#![allow(dead_code, reason = "every test program uses a part of this")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

/// Outcome of a run of the program.
#[derive(Debug)]
pub(crate) struct Outcome {
    /// Exit code; `None` if a signal ended it.
    pub(crate) code: Option<i32>,
    /// Standard output.
    pub(crate) stdout: String,
    /// Standard error.
    pub(crate) stderr: String,
}

impl Outcome {
    /// The standard output of a run that succeeded.
    pub(crate) fn text(self) -> String {
        assert_eq!(self.code, Some(0), "it succeeds: {}", self.stderr);
        self.stdout
    }

    /// The one JSON object that a run printed.
    pub(crate) fn json(self) -> Value {
        let text = self.text();
        assert_eq!(text.lines().count(), 1, "one line: {text}");
        serde_json::from_str(&text).expect("JSON")
    }
}

/// Runs the program with these arguments, in the folder.
pub(crate) fn windfall(folder: &TempDir, arguments: &[&str]) -> Outcome {
    finish(command(folder, arguments))
}

/// Runs the program on a machine without graphics adapters.
pub(crate) fn windfall_without_adapter(folder: &TempDir, arguments: &[&str]) -> Outcome {
    let mut command = command(folder, arguments);
    command.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
    // Other than Vulkan, no API can be hidden like that.
    command.env("WGPU_BACKEND", "vulkan");
    finish(command)
}

/// The program, ready to be run in the folder.
pub(crate) fn command(folder: &TempDir, arguments: &[&str]) -> Command {
    let mut command = Command::new(program());
    command.args(arguments).current_dir(folder.path()).stdin(Stdio::null());
    // Mesa's layer that sorts devices looks for a Wayland display; without a folder for one (XDG_RUNTIME_DIR) the Wayland
    // library complains on the standard error.
    command.env("NODEVICE_SELECT", "1");
    command
}

fn finish(mut command: Command) -> Outcome {
    let output = command.output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("the program speaks UTF-8");
    Outcome { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// Asserts that the program refuses these arguments as it should: exit code 2, one line on the standard error with all
/// the `essentials`, nothing on the standard output, and every file in the folder as it was.
pub(crate) fn assert_refused(folder: &TempDir, arguments: &[&str], essentials: &[&str]) {
    assert_refusal(folder, arguments, essentials, windfall);
}

/// The same on a machine without graphics adapters.
pub(crate) fn assert_refused_without_adapter(folder: &TempDir, arguments: &[&str], essentials: &[&str]) {
    assert_refusal(folder, arguments, essentials, windfall_without_adapter);
}

fn assert_refusal(
    folder: &TempDir,
    arguments: &[&str],
    essentials: &[&str],
    run: fn(&TempDir, &[&str]) -> Outcome,
) {
    let before = contents(folder.path());
    let outcome = run(folder, arguments);
    assert_eq!(outcome.code, Some(2), "exit code of {arguments:?}: {outcome:?}");
    let stderr = &outcome.stderr;
    assert!(
        stderr.ends_with('\n') && stderr.trim().lines().count() == 1,
        "{arguments:?}: one line: {stderr:?}"
    );
    for essential in essentials {
        assert!(stderr.contains(essential), "{arguments:?}: {essential:?} is missing in {stderr:?}");
    }
    assert_eq!(outcome.stdout, "", "{arguments:?} prints nothing");
    assert_eq!(contents(folder.path()), before, "{arguments:?} leaves no file and changes none");
}

/// Asserts that an interrupt while the program is at work ends it as it should: exit code 2, one line, and every file in
/// the folder as it was before.
pub(crate) fn assert_interrupted(folder: &TempDir, arguments: &[&str]) {
    let before = contents(folder.path());
    // Once something new lies there, it is at work.
    let is_at_work = || std::fs::read_dir(folder.path()).expect("a folder").count() > before.len();
    let said = interrupted(folder, arguments, is_at_work);
    assert_eq!(said.trim(), "error: interrupted; nothing was written", "{arguments:?}");
    assert_eq!(contents(folder.path()), before, "{arguments:?}: nothing is left");
}

/// Output of the program when it is interrupted half a second after `is_at_work`; it ends with exit code 2.
pub(crate) fn interrupted(folder: &TempDir, arguments: &[&str], is_at_work: impl Fn() -> bool) -> String {
    let mut child = command(folder, arguments)
        .stderr(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let began = Instant::now();
    while !is_at_work() {
        assert!(child.try_wait().is_ok_and(|ended| ended.is_none()), "{arguments:?}: it ends early");
        assert!(began.elapsed() < Duration::from_secs(60), "{arguments:?}: it does not begin");
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(500));
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.is_ok_and(|status| status.success()), "{arguments:?}: the interrupt is sent");
    let output = child.wait_with_output().expect("it ends");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
    stderr.into_owned()
}

/// Paths and bytes of everything in a folder.
pub(crate) fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            all.extend(contents(&path));
            all.push((path, Vec::new()));
        } else {
            let bytes = std::fs::read(&path).expect("a readable file");
            all.push((path, bytes));
        }
    }
    all.sort();
    all
}

/// A folder that goes away with the test.
pub(crate) fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Writes a file and returns its path as text.
pub(crate) fn file(folder: &TempDir, name: &str, bytes: impl AsRef<[u8]>) -> String {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("the folder is writable");
    path.to_str().expect("temporary folders have plain names").to_owned()
}

/// The program under test: what `WINDFALL_PROGRAM` names, or built now, with the profile that this test was built with.
/// Cargo builds the programs of no package but the tested one, and which those are is only known to that package.
fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| std::env::var_os("WINDFALL_PROGRAM").map_or_else(build, PathBuf::from))
}

fn build() -> PathBuf {
    // <target>/<profile>/deps/<test>
    let test = std::env::current_exe().expect("a running test has a path");
    let profile = test.ancestors().nth(2).and_then(Path::file_name).and_then(|name| name.to_str());
    let profile = match profile.expect("tests lie below the folder of their profile") {
        "debug" => "dev",
        other => other,
    };
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        // With the whole workspace and a test beside it, since otherwise its dependencies have other features, and are
        // built anew.
        .args(["build", "--workspace", "--bin", "windfall", "--test", "cli", "--message-format", "json"])
        .args(["--profile", profile])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stderr(Stdio::inherit())
        .output()
        .expect("cargo, which runs this test, starts");
    assert!(output.status.success(), "the program under test builds");
    let messages = String::from_utf8(output.stdout).expect("cargo speaks UTF-8");
    messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|message| message["target"]["name"] == "windfall")
        .find_map(|message| message["executable"].as_str().map(PathBuf::from))
        .expect("cargo prints where the program is")
}

/// Paths and bytes of all that a run has left, seen from its folder.
pub(crate) fn left(there: &TempDir) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = contents(there.path());
    all.iter_mut().for_each(|(path, _)| *path = path.strip_prefix(there).expect("in it").to_owned());
    all
}

/// Asserts that two folders hold the same files with the same bytes.
pub(crate) fn assert_same(one: &TempDir, other: &TempDir, what: &str) {
    let [one, other] = [one, other].map(left);
    let names = |all: &[(PathBuf, Vec<u8>)]| all.iter().map(|(path, _)| path.clone()).collect::<Vec<_>>();
    assert_eq!(names(&one), names(&other), "{what}: the same files");
    for ((path, a), (_, b)) in one.iter().zip(&other) {
        assert!(a == b, "{what}: {} has the same bytes", path.display());
    }
}

/// A few leaves of which some lie, and sparks; a lens that adapts and a shutter that stays open.
pub(crate) const RESTLESS: &str = r#"(
    wind: (speed: Beaufort(4)),
    species: [(name: "plate", shape: Plate, size_m: 0.06)],
    sources: [(shape: Sphere(center_m: (0.0, 1.5, 0.0), radius_m: 1.0), count: 300,
               release: Rate(per_s: 40.0, from_s: -3.0), recycle_after_s: 0.6)],
    particles: [(name: "sparks", count: 500, release: Rate(per_s: 60.0, from_s: 0.0))],
    view: (trail_s: 0.4, lens: (exposure: Auto(adaptation_s: 0.25), shutter_s: 0.02)),
)"#;

/// A folder with `scene.ron`, in which much goes on.
pub(crate) fn restless() -> TempDir {
    let there = folder();
    file(&there, "scene.ron", RESTLESS);
    there
}
