// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Any picture and any mask gives a leaf or one clear line.

use std::path::{Path, PathBuf};

use glam::Vec2;
use image::{GrayImage, ImageBuffer, Luma, Rgb, RgbImage, Rgba, RgbaImage};
use proptest::prelude::*;

use super::outline::{crosses_itself, twice_area};
use super::photo::cut_out;
use super::veins::is_planar;
use super::{Extraction, Overlay, Photo};
use crate::math::floor_i32;
use crate::{Mask, TexgenError};

/// A folder of its own that goes with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("windfall-extract-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a temporary folder");
        Self(path)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Returns true if a pixel belongs to a leaf with a petiole, in a picture of 120 by 160.
fn leaf(x: u32, y: u32) -> bool {
    let (x, y) = (x as f32 - 59.5, y as f32 - 60.0);
    let width = 34.0 * (1.0 - (y / 50.0) * (y / 50.0)).max(0.0).sqrt();
    x.abs() < width || (x.abs() < 2.5 && (0.0..90.0).contains(&y))
}

/// The leaf on paper, with a light midrib and light laterals that climb outward.
fn picture() -> RgbImage {
    RgbImage::from_fn(120, 160, |x, y| {
        let (out, up) = ((x as f32 - 59.5).abs(), 110.0 - y as f32);
        let on_vein = out < 1.5 || (up - out).rem_euclid(16.0) < 2.0;
        match (leaf(x, y), on_vein) {
            (false, _) => Rgb([236, 236, 232]),
            (true, false) => Rgb([60, 110, 40]),
            (true, true) => Rgb([130, 170, 90]),
        }
    })
}

fn extract(path: &Path, mask: Option<&Path>) -> Result<Extraction, TexgenError> {
    Photo { path, mask, root: None }.extract()
}

/// The rules that every extraction keeps.
fn check(extraction: &Extraction) {
    let specimen = &extraction.specimen;
    let blade = &specimen.blade;
    let (width, height) = specimen.picture.dimensions();
    assert_eq!((blade.mask.width, blade.mask.height), (width, height), "mask as large as the picture");
    assert!(blade.outline.len() >= 3 && !crosses_itself(&blade.outline), "a simple outline");
    assert!(twice_area(&blade.outline) < 0.0, "counter-clockwise with y up");
    assert!((0.0..=1.0).contains(&blade.confidence), "confidence {}", blade.confidence);
    assert!(blade.root.is_finite() && blade.tip.is_finite(), "ends {} {}", blade.root, blade.tip);
    let nodes = &specimen.veins.nodes;
    assert!(!nodes.is_empty() && nodes[0].parent.is_none(), "the root comes first");
    for (i, node) in nodes.iter().enumerate().skip(1) {
        let parent = node.parent.expect("one root only") as usize;
        assert!(parent < i, "parents come first");
        assert!(node.radius <= nodes[parent].radius && node.radius > 0.0, "radii never grow outward");
        assert!(node.order >= nodes[parent].order, "finer veins spring from coarser ones");
    }
    assert!(is_planar(&specimen.veins), "veins do not cross");
    let stray = nodes.iter().filter(|node| {
        let (x, y) = (floor_i32(node.position.x), floor_i32(node.position.y));
        !(-1..=1).any(|dy| (-1..=1).any(|dx| blade.mask.contains(x + dx, y + dy)))
    });
    assert_eq!(stray.count(), 0, "veins stay on the blade");
}

#[test]
fn a_drawn_leaf_is_read_right_from_its_background() {
    let folder = Folder::new("plain");
    let path = folder.file("leaf.png");
    picture().save(&path).expect("a picture");
    let extraction = extract(&path, None).expect("a leaf on paper");
    check(&extraction);
    let blade = &extraction.specimen.blade;
    assert!(blade.root.distance(Vec2::new(60.0, 110.0)) < 6.0, "root {}", blade.root);
    assert!(blade.tip.distance(Vec2::new(60.0, 10.0)) < 6.0, "tip {}", blade.tip);
    assert!(blade.confidence > 0.8, "confidence {}", blade.confidence);
    assert!(extraction.petiole.area() > 100, "the petiole is set apart");
    let nodes = &extraction.specimen.veins.nodes;
    assert!(nodes.iter().filter(|node| node.order == 2).count() > 20, "laterals are followed");
    assert!(Overlay::of(&extraction).image().width() >= 120, "it can be drawn");
    assert_eq!(
        extract(&path, None).expect("again").specimen.veins,
        extraction.specimen.veins,
        "the same every time"
    );
}

#[test]
fn other_kinds_of_pictures_are_read_too() {
    let folder = Folder::new("kinds");
    let rgb = picture();
    let deep: ImageBuffer<Rgb<u16>, Vec<u16>> =
        ImageBuffer::from_fn(120, 160, |x, y| Rgb(rgb.get_pixel(x, y).0.map(|c| u16::from(c) * 257)));
    deep.save(folder.file("deep.png")).expect("16 bits");
    let grey = GrayImage::from_fn(120, 160, |x, y| Luma([rgb.get_pixel(x, y).0[1]]));
    grey.save(folder.file("grey.png")).expect("grey");
    rgb.save(folder.file("photo.jpg")).expect("JPEG");
    let clear = RgbaImage::from_fn(120, 160, |x, y| {
        let [r, g, b] = rgb.get_pixel(x, y).0;
        Rgba([r, g, b, if leaf(x, y) { 255 } else { 0 }])
    });
    clear.save(folder.file("alpha.png")).expect("alpha");
    std::fs::write(folder.file("cmyk.jpg"), include_bytes!("cmyk.jpg")).expect("CMYK");
    for name in ["deep.png", "grey.png", "photo.jpg", "alpha.png", "cmyk.jpg"] {
        let extraction = extract(&folder.file(name), None).unwrap_or_else(|error| panic!("{name}: {error}"));
        check(&extraction);
        let blade = &extraction.specimen.blade;
        assert!(blade.root.distance(Vec2::new(60.0, 110.0)) < 8.0, "{name}: root {}", blade.root);
        assert_eq!(extraction.specimen.picture.dimensions(), (120, 160), "{name}");
        let [r, g, b] = extraction.specimen.picture.get_pixel(40, 60).0;
        assert!(name == "grey.png" || (g > r && g > b), "{name} is green: {r} {g} {b}");
    }
}

#[test]
fn bad_files_are_told_on_one_line() {
    let folder = Folder::new("bad");
    let good = folder.file("good.png");
    picture().save(&good).expect("a picture");
    let bytes = std::fs::read(&good).expect("its bytes");
    std::fs::write(folder.file("cut.png"), &bytes[..bytes.len() / 2]).expect("half of it");
    std::fs::write(folder.file("text.png"), "no picture").expect("text");
    std::fs::write(folder.file("empty.png"), "").expect("nothing");
    // A header that promises 100 000 by 100 000 pixels; its checksum is right, so that only its size is wrong.
    let mut huge = bytes[..33].to_vec();
    huge[16..24].copy_from_slice(&[0, 1, 0x86, 0xa0, 0, 1, 0x86, 0xa0]);
    let sum = crc(&huge[12..29]);
    huge[29..33].copy_from_slice(&sum.to_be_bytes());
    huge.extend(&bytes[33..]);
    std::fs::write(folder.file("huge.png"), huge).expect("a large promise");
    RgbImage::from_pixel(50, 50, Rgb([200; 3])).save(folder.file("paper.png")).expect("paper");
    let cases = [
        ("cut.png", "cut off"),
        ("text.png", "no picture"),
        ("empty.png", "no picture"),
        ("huge.png", "64 megapixels"),
        ("paper.png", "no leaf stands out"),
        ("missing.png", "No such file"),
    ];
    for (name, expected) in cases {
        let error = extract(&folder.file(name), None).expect_err(name).to_string();
        let plain = error.contains(expected) || name == "missing.png";
        assert!(plain && error.contains(name) && !error.contains('\n'), "{name}: {error}");
    }
}

#[test]
fn masks_are_fitted_or_refused() {
    let folder = Folder::new("masks");
    let path = folder.file("leaf.png");
    picture().save(&path).expect("a picture");
    let save = |name: &str, width: u32, height: u32, inside: &dyn Fn(u32, u32) -> bool| {
        let mask = GrayImage::from_fn(width, height, |x, y| Luma([if inside(x, y) { 255 } else { 0 }]));
        mask.save(folder.file(name)).expect("a mask");
        folder.file(name)
    };
    let half = save("half.png", 60, 80, &|x, y| leaf(2 * x, 2 * y));
    let extraction = extract(&path, Some(&half)).expect("half the size is the same shape");
    check(&extraction);
    assert!(extraction.notes.iter().any(|note| note.contains("scaled")), "{:?}", extraction.notes);
    let two = save("two.png", 120, 160, &|x, y| leaf(x, y) || (x > 105 && y > 80));
    let extraction = extract(&path, Some(&two)).expect("the larger of two");
    assert!(extraction.notes.iter().any(|note| note.contains("several leaves")), "{:?}", extraction.notes);
    let refused = [
        (save("other.png", 80, 80, &|_, y| y > 40), "same shape"),
        (save("none.png", 120, 160, &|_, _| false), "empty"),
        (save("full.png", 120, 160, &|_, _| true), "whole picture"),
        (save("dots.png", 120, 160, &|x, y| x % 7 == 0 && y % 7 == 0), "pixels"),
    ];
    for (mask, expected) in refused {
        let error = extract(&path, Some(&mask)).expect_err(expected).to_string();
        assert!(error.contains(expected) && !error.contains('\n'), "{error}");
    }
}

/// Checksum of a PNG chunk (CRC-32, reflected polynomial 0xedb88320).
fn crc(bytes: &[u8]) -> u32 {
    let byte = |sum: u32, byte: &u8| {
        (0..8).fold(
            sum ^ u32::from(*byte),
            |sum, _| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 },
        )
    };
    !bytes.iter().fold(u32::MAX, byte)
}

/// Cuts a leaf out of a random mask of one of five patterns.
fn try_mask(width: u32, height: u32, share: f32, pattern: u32, seed: u64) {
    let mut rng = crate::rng::Rng::new(seed);
    let mut mask = Mask::empty(width, height);
    for (i, inside) in mask.inside.iter_mut().enumerate() {
        let (x, y) = (i % width as usize, i / width as usize);
        *inside = match pattern {
            0 => rng.chance(share),
            1 => x == width as usize / 2 || rng.chance(0.02),
            2 => y == height as usize / 2 || x % 3 == 0,
            3 => (x / 4 + y / 4) % 2 == 0 || rng.chance(share),
            _ => !rng.chance(share * 0.2),
        };
    }
    let colours = RgbImage::from_fn(width, height, |_, _| {
        Rgb([0, 1, 2].map(|_| u8::try_from(rng.integer(0, 255)).unwrap_or(0)))
    });
    match cut_out("fuzz", colours, mask, None, Vec::new()) {
        Ok(extraction) => check(&extraction),
        Err(problem) => assert!(!problem.is_empty() && !problem.contains('\n'), "{problem}"),
    }
}

/// A comb so fine that thinned-out veins crossed.
#[test]
fn a_comb_of_threads_gives_a_leaf_or_one_line() {
    try_mask(19, 15, 0.0, 2, 5_465_329_905_988_879_915);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Noise, threads, combs, pieces and holes.
    #[test]
    fn any_mask_gives_a_leaf_or_one_line(
        width in 1u32..40,
        height in 1u32..40,
        share in 0.0f32..1.0,
        pattern in 0u32..5,
        seed: u64,
    ) {
        try_mask(width, height, share, pattern, seed);
    }
}

/// Folder of photos with a folder for each species, in which every photo has its mask beside it.
pub(crate) fn photos() -> PathBuf {
    std::env::var_os("WINDFALL_LEAF_PHOTOS")
        .expect("WINDFALL_LEAF_PHOTOS names the folder of the photos")
        .into()
}

/// All photos have their petiole down.
#[test]
#[ignore = "reads the photos in WINDFALL_LEAF_PHOTOS"]
fn photos_are_read_the_right_way_round() {
    let mut count = 0;
    for species in std::fs::read_dir(photos()).expect("the folder of the photos").flatten() {
        for path in crate::leaf_pictures(&species.path()).expect("photos of a species") {
            let mask = path.with_extension("mask.png");
            let extraction = extract(&path, Some(&mask)).expect("a photo of a leaf");
            check(&extraction);
            let blade = &extraction.specimen.blade;
            let lean = (blade.tip - blade.root).angle_to(Vec2::NEG_Y).to_degrees();
            assert!(lean.abs() < 25.0, "{} leans by {lean:.0} degrees", path.display());
            count += 1;
        }
    }
    assert!(count >= 24, "{count} photos");
}

#[test]
#[ignore = "reads the photos in WINDFALL_LEAF_PHOTOS"]
fn backgrounds_and_masks_agree() {
    for species in std::fs::read_dir(photos()).expect("the folder of the photos").flatten() {
        for path in crate::leaf_pictures(&species.path()).expect("photos of a species") {
            let whole = |mask: Option<&Path>| {
                let found = extract(&path, mask).expect("a photo of a leaf");
                let blade = found.specimen.blade.mask.inside;
                blade.iter().zip(&found.petiole.inside).map(|(a, b)| *a || *b).collect::<Vec<bool>>()
            };
            let (found, given) = (whole(None), whole(Some(&path.with_extension("mask.png"))));
            let count = |rule: fn(bool, bool) -> bool| {
                found.iter().zip(&given).filter(|(a, b)| rule(**a, **b)).count()
            };
            let overlap = count(|a, b| a && b) as f32 / count(|a, b| a || b) as f32;
            assert!(overlap > 0.9, "{}: {overlap}", path.display());
        }
    }
}
