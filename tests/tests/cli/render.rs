// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall render`: pictures and clips of both backends, and what it refuses.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::common_cli::{
    assert_interrupted, assert_refused, assert_refused_without_adapter, command, contents, file, folder,
    windfall,
};
use image::codecs::gif::GifDecoder;
use image::{AnimationDecoder, RgbaImage};
use windfall_core::Contract;
use windfall_core::scene::PRESETS;
use windfall_tests::adapter;

const BACKENDS: [&str; 2] = ["cpu", "wgpu"];

fn picture(path: &Path) -> RgbaImage {
    image::open(path).expect("a picture").to_rgba8()
}

/// Mean difference of the channels, of 255.
fn difference(a: &RgbaImage, b: &RgbaImage) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions(), "the same size");
    let sum: u64 = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / a.as_raw().len() as f64
}

/// Number of different colours.
fn colours(picture: &RgbaImage) -> usize {
    picture.pixels().map(|pixel| pixel.0).collect::<std::collections::HashSet<_>>().len()
}

#[test]
fn both_backends_draw_the_same_picture() {
    let gpu = &adapter::all()[0];
    for scene in ["autumn-park", "six-motions", "storm"] {
        let there = folder();
        let [cpu, wgpu] = BACKENDS.map(|backend| {
            let out = format!("{backend}.png");
            let options = ["--backend", backend, "--frames", "40", "--size", "320x180", "--out", &out];
            let text = windfall(&there, &[&["render", scene], &options[..]].concat()).text();
            assert_eq!(text, format!("{out}\n"), "the path of what was written");
            picture(&there.path().join(out))
        });
        assert_eq!(cpu.dimensions(), (320, 180), "as asked for");
        assert!(colours(&cpu) > 5000, "{scene} is a picture: {} colours", colours(&cpu));
        let apart = difference(&cpu, &wgpu);
        assert!(apart < 0.5, "{scene}: {apart} apart");
        if gpu.contract() == Contract::Exact {
            assert!(cpu == wgpu, "{scene}: the same leaves give the same pixels; {apart} apart");
        }
        assert_eq!(contents(there.path()).len(), 2, "{scene}: two files and nothing else");
    }
}

#[test]
fn both_backends_make_the_same_clip_of_living_litter() {
    if adapter::all()[0].contract() != Contract::Exact {
        return;
    }
    let there = folder();
    let [cpu, wgpu] = BACKENDS.map(|backend| {
        let options =
            ["--backend", backend, "--frames", "8", "--fps", "6", "--size", "320x180", "--out", backend];
        windfall(&there, &[&["render", "square"], &options[..]].concat()).text();
        let names = |(path, bytes): (PathBuf, Vec<u8>)| (path.file_name().map(OsString::from), bytes);
        contents(&there.path().join(backend)).into_iter().map(names).collect::<Vec<_>>()
    });
    assert_eq!(cpu.len(), 8, "every frame");
    assert!(cpu.windows(2).all(|frames| frames[0].1 != frames[1].1), "leaves run");
    assert!(cpu == wgpu, "the same leaves give the same bytes");
}

#[test]
fn overlays_colour_leaves_that_lie() {
    adapter::all();
    let there = folder();
    file(
        &there,
        "bed.ron",
        "(sources: [], ground: (litter: Some((size_m: (12.0, 12.0), leaf_area_index: 2.0))), objects: [()])",
    );
    let drawn = |show: &[&str]| {
        let still = ["render", "bed.ron", "--frames", "1", "--size", "160x90", "--out", "a.png"];
        windfall(&there, &[&still, show].concat()).text();
        picture(&there.path().join("a.png"))
    };
    let pictures =
        [&[][..], &["--show", "wake"], &["--show", "depth"], &["--show", "shelter"], &["--show", "landings"]]
            .map(drawn);
    for (number, a) in pictures.iter().enumerate() {
        for b in &pictures[number + 1..] {
            assert!(difference(a, b) > 0.5, "picture {number} and another: {} apart", difference(a, b));
        }
    }
    for show in ["wind", "trails", "leaf", "compare"] {
        assert_refused(&there, &["render", "--show", show, "--out", "b.png"], &[show, "window", "depth"]);
    }
}

#[test]
fn every_preset_can_be_drawn() {
    adapter::all();
    let there = folder();
    for &(scene, _) in PRESETS {
        let out = format!("{scene}.png");
        let tiny = ["--leaves", "1000", "--frames", "1", "--size", "160x90", "--out", &out];
        windfall(&there, &[&["render", scene], &tiny[..]].concat()).text();
        let picture = picture(&there.path().join(out));
        assert!(colours(&picture) > 500, "{scene}: {} colours", colours(&picture));
    }
}

#[test]
fn a_picture_has_the_usual_size_and_leaves_fall_from_frame_to_frame() {
    let there = folder();
    for (frames, out) in [("1", "first.png"), ("90", "later.png")] {
        windfall(&there, &["render", "--backend", "cpu", "--frames", frames, "--out", out]).text();
    }
    let [first, later] = ["first.png", "later.png"].map(|name| picture(&there.path().join(name)));
    assert_eq!(first.dimensions(), (1280, 720), "by default");
    let apart = difference(&first, &later);
    // Crowns that sway are half of the picture.
    assert!((0.02..35.0).contains(&apart), "something has moved, but not everything: {apart}");
}

#[test]
fn a_still_has_the_trails_of_the_frames_before() {
    let there = folder();
    let colourful = |frames: &str| {
        let options = ["--backend", "wgpu", "--frames", frames, "--size", "320x180", "--out", "a.png"];
        windfall(&there, &[&["render", "six-motions"], &options[..]].concat()).text();
        // The colour of the last trail, which nothing else in a park has.
        let is_magenta = |[r, g, b, _]: [u8; 4]| r.min(b) > g.saturating_add(30);
        picture(&there.path().join("a.png")).pixels().filter(|pixel| is_magenta(pixel.0)).count()
    };
    let (begun, later) = (colourful("1"), colourful("150"));
    assert!(begun == 0 && later > 60, "{begun} pixels of trail at first, then {later}");
}

#[test]
fn a_sequence_has_every_frame() {
    for backend in BACKENDS {
        let there = folder();
        let options = ["--backend", backend, "--frames", "5", "--size", "96x54", "--out", "new/frames"];
        windfall(&there, &[&["render", "--leaves", "300"], &options[..]].concat()).text();
        let mut names: Vec<_> = fs::read_dir(there.path().join("new/frames"))
            .expect("a folder")
            .map(|entry| entry.expect("an entry").path())
            .collect();
        names.sort();
        assert_eq!(names.len(), 5, "{backend}: {names:?}");
        for (number, path) in (1..).zip(&names) {
            assert!(path.ends_with(format!("frame_{number:04}.png")), "{path:?}");
            assert_eq!(picture(path).dimensions(), (96, 54), "{path:?}");
        }
        assert!(difference(&picture(&names[0]), &picture(&names[4])) > 0.0, "{backend}: leaves fall");
    }
}

#[test]
fn a_gif_has_thirty_frames_a_second() {
    for backend in BACKENDS {
        let there = folder();
        let options = ["--backend", backend, "--frames", "12", "--size", "96x54", "--out", "a.gif"];
        windfall(&there, &[&["render", "six-motions"], &options[..]].concat()).text();
        let file = BufReader::new(File::open(there.path().join("a.gif")).expect("the clip"));
        let frames = GifDecoder::new(file).expect("a GIF").into_frames().collect_frames().expect("frames");
        assert_eq!(frames.len(), 6, "{backend}: every second of sixty a second");
        let total: Duration = frames.iter().map(|frame| Duration::from(frame.delay())).sum();
        assert_eq!(total, Duration::from_millis(200), "{backend}: they last as long");
        assert_eq!(frames[0].buffer().dimensions(), (96, 54), "{backend}: the size asked for");
    }
}

#[test]
fn numbers_that_make_no_sense() {
    let there = folder();
    let refuse = |options: &[&str], essentials: &[&str]| {
        assert_refused(&there, &[&["render", "--out", "a.png"], options].concat(), essentials);
    };
    for size in ["0x720", "1280x0", "1280", "x", "axb", "-5x5", "16385x1", "16384x16384", "1e3x1e3"] {
        refuse(&[&format!("--size={size}")], &["--size", "1280x720", "16384"]);
    }
    for frames in ["0", "-1", "1000001", "1e12", "some"] {
        refuse(&[&format!("--frames={frames}")], &["--frames", "1 to 1000000"]);
    }
    for rate in ["0", "-5", "nan", "inf", "1e9", "fast"] {
        refuse(&[&format!("--fps={rate}")], &["--fps", "1 to 1000"]);
        refuse(&[&format!("--speed={rate}")], &["--speed", "0.001 to 1000"]);
    }
    refuse(&["--frames", "1000000", "--speed", "1000", "--fps", "1"], &["steps", "1000000000"]);
    refuse(&["--leaves", "1"], &["--leaves is 1", "to 1073741824"]);
}

#[test]
fn outputs_that_cannot_be_written() {
    let there = folder();
    file(&there, "plain", b"a file");
    let refuse = |out: &str, essentials: &[&str]| {
        assert_refused(&there, &["render", "--size", "64x36", "--out", out], essentials);
    };
    refuse("a.jpg", &["a.jpg", ".png", ".gif", ".mp4"]);
    refuse("plain/a.png", &["plain/a.png", "cannot write"]);
    refuse("plain", &["plain", "cannot write"]);
    refuse("/proc/none/a.gif", &["/proc/none/a.gif", "cannot write"]);
    refuse("", &["--out"]);
    assert_refused(&there, &["render"], &["--out"]);
    assert_refused(&there, &["render", "--out", "a.mp4", "--size", "63x36"], &["63x36", "even"]);
}

#[test]
fn mp4_without_ffmpeg_says_what_to_install() {
    let there = folder();
    let output = command(&there, &["render", "--frames", "2", "--out", "new/a.mp4"])
        .env("PATH", "")
        .output()
        .expect("the program starts");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert_eq!(stderr.trim().lines().count(), 1, "one line: {stderr}");
    for essential in ["new/a.mp4", "needs ffmpeg", "apt install ffmpeg", ".gif"] {
        assert!(stderr.contains(essential), "{essential:?} is missing in {stderr:?}");
    }
    assert_eq!(contents(there.path()), [], "nothing is left, not even the folder");
}

#[test]
fn nothing_is_drawn_without_an_adapter() {
    let there = folder();
    for backend in BACKENDS {
        let arguments = ["render", "--backend", backend, "--out", "new/folder/a.gif"];
        assert_refused_without_adapter(&there, &arguments, &["no usable adapter", "mesa-vulkan-drivers"]);
    }
    let other = ["render", "--adapter", "no such thing", "--out", "a.png"];
    assert_refused(&there, &other, &["'no such thing'", "found"]);
    let both = ["render", "--backend", "wgpu", "--threads", "2", "--out", "a.png"];
    assert_refused(&there, &both, &["--threads", "--backend cpu"]);
}

#[test]
fn an_interrupt_of_a_still_leaves_nothing_behind() {
    let there = folder();
    let options = ["--backend", "cpu", "--frames", "100000", "--size", "96x54", "--out", "a.png"];
    assert_interrupted(&there, &[&["render", "--leaves", "20000"], &options[..]].concat());
}

#[test]
fn pictures_of_skies_light_scenes_or_are_refused() {
    let there = folder();
    // Eight rows of a grey sky, not compressed.
    let mut sky = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    sky.extend([128, 128, 128, 129].repeat(128));
    file(&there, "sky.hdr", &sky);
    file(&there, "cut.hdr", &sky[..300]);
    file(&there, "grey.ron", b"(view: (sky: Map((path: \"sky.hdr\"))))");
    file(&there, "lost.ron", b"(view: (sky: Map((path: \"nowhere.exr\"))))");
    let options = ["--leaves", "100", "--frames", "1", "--size", "64x48", "--out"];
    let draw =
        |scene: &[&'static str], out: &'static str| [&["render"], scene, &options[..], &[out]].concat();
    windfall(&there, &draw(&["grey.ron"], "a.png")).text();
    windfall(&there, &draw(&["--sky", "sky.hdr"], "b.png")).text();
    assert_refused(&there, &draw(&["lost.ron"], "c.png"), &["nowhere.exr"]);
    assert_refused(&there, &draw(&["--sky", "cut.hdr"], "c.png"), &["cut.hdr", "cut off", "allowed"]);
    assert_refused(&there, &draw(&["--sky", "grey.ron"], "c.png"), &["grey.ron", "Radiance", "OpenEXR"]);
}
