// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall view` on a virtual display. Without Xvfb or an adapter these tests fail: scripts/test installs both.

use std::collections::HashSet;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common_cli::{Outcome, assert_refused, command, contents, folder};
use image::RgbaImage;
use tempfile::TempDir;
use windfall_tests::adapter;

/// Width of the panel in pixels on a display of usual density.
const PANEL: u32 = 336;
/// Longest time a test waits for the program: software adapters are slow, and tests run side by side.
const PATIENCE: Duration = Duration::from_secs(180);

/// A display that nobody sees; it ends with the test.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn start() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb is missing: apt install xvfb, or run scripts/test, which does");
        let stdout = server.stdout.take().expect("piped");
        let mut number = String::new();
        BufReader::new(stdout).read_line(&mut number).expect("Xvfb prints its number");
        assert!(!number.trim().is_empty(), "Xvfb starts");
        Self { server, name: format!(":{}", number.trim()) }
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        // It holds nothing worth keeping.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// Runs the program on the display until it ends by itself.
fn view(display: &Display, there: &TempDir, options: &[&str]) -> Outcome {
    finish(view_command(display, there, options))
}

fn view_command(display: &Display, there: &TempDir, options: &[&str]) -> Command {
    let mut command = command(there, &[&["view"], options].concat());
    command.env("DISPLAY", &display.name).env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
    command
}

fn finish(mut command: Command) -> Outcome {
    let mut child =
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    let began = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if began.elapsed() > PATIENCE {
            child.kill().expect("it can be ended");
            panic!("it does not end within {PATIENCE:?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = child.wait_with_output().expect("it has ended");
    let text = |bytes| String::from_utf8(bytes).expect("the program speaks UTF-8");
    Outcome { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

fn luminance(picture: &RgbaImage, x: u32, y: u32) -> u32 {
    let [r, g, b, _] = picture.get_pixel(x, y).0.map(u32::from);
    (2 * r + 7 * g + b) / 10
}

/// The panel is dark, with light writing in many different shapes.
fn assert_panel(picture: &RgbaImage) {
    let (_, height) = picture.dimensions();
    let is_light = |x: u32, y: u32| luminance(picture, x, y) > 120;
    let all: Vec<bool> = (0..height).flat_map(|y| (0..PANEL).map(move |x| is_light(x, y))).collect();
    let light = all.iter().filter(|light| **light).count() as f64 / all.len() as f64;
    assert!((0.01..0.2).contains(&light), "writing covers {light} of the panel");
    // Where glyphs are missing, every letter is the same box.
    let tiles: HashSet<Vec<bool>> = (0..height - 10)
        .step_by(5)
        .flat_map(|y| (0..PANEL - 6).step_by(3).map(move |x| (x, y)))
        .map(|(x, y)| (0..60).map(|at| is_light(x + at % 6, y + at / 6)).collect())
        .collect();
    assert!(tiles.len() > 1500, "{} different shapes", tiles.len());
}

/// The picture beside the panel is a park by day: full of colours, brighter above than below.
fn assert_scene(picture: &RgbaImage) {
    let (width, height) = picture.dimensions();
    let scene = (0..height).flat_map(|y| (PANEL + 4..width).map(move |x| (x, y)));
    let colours: HashSet<[u8; 4]> = scene.map(|(x, y)| picture.get_pixel(x, y).0).collect();
    assert!(colours.len() > 10_000, "{} colours", colours.len());
    let mean = |rows: std::ops::Range<u32>| {
        let count = (rows.end - rows.start) * (width - PANEL - 4);
        let sum: u32 = rows.flat_map(|y| (PANEL + 4..width).map(move |x| luminance(picture, x, y))).sum();
        sum / count
    };
    let (sky, meadow) = (mean(0..60), mean(height - 60..height));
    // A message stands before a part of the sky.
    assert!(sky > 80 && meadow > 25 && sky > meadow, "sky {sky}, meadow {meadow}");
}

#[test]
fn the_window_shows_panel_and_leaves_with_each_backend() {
    adapter::all();
    let display = Display::start();
    let there = folder();
    for backend in ["cpu", "wgpu"] {
        let shot = format!("{backend}.png");
        let options = ["--backend", backend, "--size", "800x560", "--screenshot", &shot, "--after", "0.5"];
        let outcome = view(&display, &there, &options);
        assert_eq!(outcome.text(), "", "{backend}: nothing to say");
        let picture = image::open(there.path().join(shot)).expect("a picture").to_rgba8();
        assert_eq!(picture.dimensions(), (800, 560), "{backend}: the whole window");
        assert_panel(&picture);
        assert_scene(&picture);
    }
    assert_eq!(contents(there.path()).len(), 2, "two pictures and nothing else");
}

#[test]
fn the_window_outlives_its_device() {
    adapter::all();
    let display = Display::start();
    let there = folder();
    for backend in ["cpu", "wgpu"] {
        let shot = format!("{backend}.png");
        let options = ["--backend", backend, "--leaves", "2000", "--size", "800x560", "--screenshot", &shot];
        let mut command = view_command(&display, &there, &[&options[..], &["--after", "8"]].concat());
        command.env("WINDFALL_LOSE_DEVICE_AT", "4");
        let outcome = finish(command);
        assert!(outcome.stderr.contains("the graphics device is lost"), "{backend}: {outcome:?}");
        assert_eq!(outcome.text(), "", "{backend}: it goes on");
        let picture = image::open(there.path().join(shot)).expect("a picture").to_rgba8();
        assert_panel(&picture);
        assert_scene(&picture);
    }
}

#[test]
fn every_instrument_can_be_shown() {
    adapter::all();
    let display = Display::start();
    let there = folder();
    let all = "speed,landings,wind,trails,leaf,compare";
    let options =
        ["six-motions", "--size", "700x400", "--screenshot", "a.png", "--after", "0", "--show", all];
    view(&display, &there, &options).text();
    assert_scene(&image::open(there.path().join("a.png")).expect("a picture").to_rgba8());
}

/// Presets that differ in what the window has to show: `autumn-park` and `six-motions` are watched by tests of their own, and all are drawn by
/// `windfall render`, with the same renderer.
const WATCHED: [&str; 4] = ["hills", "walk", "pond", "genesis"];

#[test]
fn presets_can_be_watched() {
    adapter::all();
    let display = Display::start();
    let there = folder();
    for scene in WATCHED {
        let shot = format!("{scene}.png");
        let few = ["--leaves", "1000", "--size", "480x360", "--after", "0", "--screenshot", &shot];
        view(&display, &there, &[&[scene], &few[..]].concat()).text();
        let picture = image::open(there.path().join(shot)).expect("a picture").to_rgba8();
        let (width, height) = picture.dimensions();
        let scene_pixels = (0..height).flat_map(|y| (PANEL + 4..width).map(move |x| (x, y)));
        let colours: HashSet<[u8; 4]> = scene_pixels.map(|(x, y)| picture.get_pixel(x, y).0).collect();
        assert!(colours.len() > 500, "{scene}: {} colours", colours.len());
    }
}

#[test]
fn without_a_display_the_error_names_the_other_way() {
    let there = folder();
    let mut command = command(&there, &["view", "--screenshot", "a.png"]);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
    let outcome = finish(command);
    assert_eq!(outcome.code, Some(2), "{outcome:?}");
    assert_eq!(outcome.stderr.trim().lines().count(), 1, "one line: {outcome:?}");
    assert!(outcome.stderr.contains("`windfall render`"), "{outcome:?}");
    assert!(!outcome.stderr.contains(".rs:"), "no source text: {outcome:?}");
    assert_eq!(contents(there.path()), [], "no file is left");
}

#[test]
fn without_an_adapter_it_says_so() {
    let display = Display::start();
    let there = folder();
    for backend in ["cpu", "wgpu"] {
        let mut command = view_command(&display, &there, &["--backend", backend, "--screenshot", "a.png"]);
        command.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
        command.env("WGPU_BACKEND", "vulkan");
        let outcome = finish(command);
        assert_eq!(outcome.code, Some(2), "{backend}: {outcome:?}");
        assert_eq!(outcome.stderr.trim().lines().count(), 1, "{backend}: one line: {outcome:?}");
        assert!(outcome.stderr.contains("adapter"), "{backend}: {outcome:?}");
        assert_eq!(contents(there.path()), [], "{backend}: no file is left");
    }
}

#[test]
fn bad_options_are_refused_before_a_window_opens() {
    let there = folder();
    assert_refused(&there, &["view", "autum-park"], &["'autum-park'", "did you mean"]);
    assert_refused(&there, &["view", "--size", "0x0"], &["--size", "1280x720"]);
    assert_refused(&there, &["view", "--open", "walls"], &["walls", "tree-kinds"]);
    assert_refused(&there, &["view", "--after", "3"], &["--screenshot"]);
    assert_refused(&there, &["view", "--screenshot", "a.png", "--after", "-1"], &["-1"]);
    assert_refused(&there, &["view", "--screenshot", "none/a.png"], &["none/a.png", "no folder"]);
    assert_refused(&there, &["view", "--show", "sped"], &["'sped'", "speed"]);
    assert_refused(&there, &["view", "--leaves", "1"], &["--leaves is 1"]);
}
