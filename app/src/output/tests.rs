// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0

use std::fs;
use std::path::Path;

use image::codecs::gif::GifDecoder;
use image::{AnimationDecoder, Rgba, RgbaImage};

use super::*;

const SIZE: (u32, u32) = (32, 16);

/// A red square that moves over a blue ground.
fn frame(number: u32) -> RgbaImage {
    RgbaImage::from_fn(SIZE.0, SIZE.1, |x, y| {
        let inside = (number..number + 4).contains(&x) && (4..8).contains(&y);
        if inside { Rgba([220, 30, 20, 255]) } else { Rgba([30, 60, 200, 255]) }
    })
}

fn write(path: &Path, frames: u32, fps: f64) -> Result<PathBuf, OutputError> {
    let mut writer = Output::from_path(path)?.start(SIZE, fps)?;
    for number in 0..frames {
        writer.push(&frame(number))?;
    }
    writer.finish()
}

fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(directory)
        .expect("a directory")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name"))
        .collect();
    names.sort();
    names
}

#[test]
fn kind_follows_the_path() {
    let kind = |path: &str| Output::from_path(Path::new(path)).ok();
    assert_eq!(kind("a/b.PNG"), Some(Output::Png("a/b.PNG".into())), "png");
    assert_eq!(kind("b.gif"), Some(Output::Gif("b.gif".into())), "gif");
    assert_eq!(kind("b.mp4"), Some(Output::Mp4("b.mp4".into())), "mp4");
    assert_eq!(kind("frames"), Some(Output::Sequence("frames".into())), "directory");
    for unknown in ["b.tiff", "", "/", "a."] {
        assert_eq!(kind(unknown), None, "{unknown:?} must be refused");
    }
}

#[test]
fn still_is_the_last_frame() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join("new/still.png");
    assert_eq!(write(&path, 3, 60.0).expect("a still"), path, "the path given");
    assert_eq!(image::open(&path).expect("a png").to_rgba8(), frame(2), "the third frame");
    assert_eq!(names(path.parent().expect("a parent")), ["still.png"], "nothing else is left");
}

#[test]
fn sequence_is_numbered_and_replaces_an_older_one() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join("clip");
    write(&path, 4, 60.0).expect("a sequence");
    fs::write(path.join("notes.txt"), "mine").expect("a file");
    write(&path, 2, 60.0).expect("a shorter sequence");
    assert_eq!(names(&path), ["frame_0001.png", "frame_0002.png", "notes.txt"], "two frames and the notes");
    assert_eq!(names(directory.path()), ["clip"], "nothing beside it");
}

#[test]
fn gif_shows_every_second_frame_of_sixty() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join("clip.gif");
    write(&path, 12, 60.0).expect("a gif");
    let file = std::io::BufReader::new(fs::File::open(&path).expect("a file"));
    let frames = GifDecoder::new(file).expect("a gif").into_frames().collect_frames().expect("frames");
    assert_eq!(frames.len(), 6, "every second of twelve");
    let total: u32 = frames.iter().map(|frame| frame.delay().numer_denom_ms().0).sum();
    assert_eq!(total, 200, "twelve sixtieths of a second, in ms");
    for (number, shown) in (0u32..).zip(&frames) {
        assert_eq!(shown.buffer(), &frame(2 * number), "frame {number}: two colours survive unharmed");
    }
    assert_eq!(names(directory.path()), ["clip.gif"], "the waiting frames are gone");
}

#[test]
fn mp4_needs_even_sizes() {
    let directory = tempfile::tempdir().expect("a directory");
    let output = Output::Mp4(directory.path().join("clip.mp4"));
    let error = output.start((31, 16), 60.0).expect_err("an odd width");
    assert!(error.to_string().contains("even"), "{error}");
}

#[test]
fn mp4_is_a_movie_or_a_hint() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join("clip.mp4");
    match write(&path, 8, 60.0) {
        Ok(_) => {
            let bytes = fs::read(&path).expect("a file");
            assert_eq!(&bytes[4..8], b"ftyp", "an mp4 file");
            assert_eq!(names(directory.path()), ["clip.mp4"], "nothing beside it");
        }
        Err(error) => assert!(matches!(error, OutputError::NoFfmpeg { .. }), "{error}"),
    }
}

#[test]
fn missing_ffmpeg_is_named() {
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join("clip.mp4");
    let nowhere = directory.path().join("no-such-program");
    let error = Video::start_with(nowhere.as_os_str(), &path, SIZE, 60.0).expect_err("no program");
    assert!(matches!(error, OutputError::NoFfmpeg { .. }), "{error}");
    assert!(error.to_string().contains("apt install ffmpeg"), "a hint: {error}");
    assert!(names(directory.path()).is_empty(), "nothing is left behind");
}

#[test]
fn no_frames_leave_nothing() {
    let directory = tempfile::tempdir().expect("a directory");
    for name in ["still.png", "clip.gif", "frames"] {
        let error = write(&directory.path().join(name), 0, 60.0).expect_err("no frames");
        assert!(matches!(error, OutputError::NoFrames { .. }), "{name}: {error}");
    }
    assert!(names(directory.path()).is_empty(), "nothing is left behind: {:?}", names(directory.path()));
}

#[test]
fn abandoned_clip_leaves_nothing() {
    let directory = tempfile::tempdir().expect("a directory");
    for name in ["still.png", "clip.gif", "frames"] {
        let output = Output::from_path(&directory.path().join(name)).expect("a kind");
        let mut writer = output.start(SIZE, 60.0).expect("a writer");
        writer.push(&frame(0)).expect("a frame");
        drop(writer);
    }
    assert!(names(directory.path()).is_empty(), "nothing is left behind: {:?}", names(directory.path()));
}

#[test]
fn unwritable_path_is_found_before_the_first_frame() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("file");
    fs::write(&file, "in the way").expect("a file");
    for name in ["still.png", "clip.gif", "clip.mp4", "frames"] {
        let path = file.join(name);
        let error = Output::from_path(&path).expect("a kind").start(SIZE, 60.0).expect_err("under a file");
        assert!(matches!(error, OutputError::Write(_)), "{error}");
        assert!(error.to_string().contains(name), "the path must be named: {error}");
    }
    let error = Output::Sequence(file).start(SIZE, 60.0).expect_err("a file is no directory");
    assert!(matches!(error, OutputError::Write(_)), "{error}");
}

#[test]
fn wrong_frame_and_rate_are_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    let output = Output::Gif(directory.path().join("clip.gif"));
    for fps in [0.0, -1.0, f64::NAN, 1.0e9] {
        let error = output.start(SIZE, fps).expect_err("no frame rate");
        assert!(matches!(error, OutputError::FrameRate { .. }), "{fps}: {error}");
    }
    let mut writer = output.start(SIZE, 60.0).expect("a writer");
    let error = writer.push(&RgbaImage::new(1, 1)).expect_err("a small frame");
    assert!(matches!(error, OutputError::FrameSize { .. }), "{error}");
}
