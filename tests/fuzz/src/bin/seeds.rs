// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writes the inputs that targets begin with, and lists of words that they put into inputs: `seeds FOLDER` makes a folder `TARGET` and
//! a file `TARGET.dict` below it for each. What they hold comes from the presets, the guide, the files of the tests, and from small
//! pictures, trees and tables made here.

use std::collections::BTreeSet;
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use exr::prelude::{
    Blocks, Compression, Encoding, Image, Layer, LayerAttributes, LineOrder, SpecificChannels, Vec2,
    WritableImage,
};
use image::codecs::hdr::HdrEncoder;
use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgb, RgbImage};
use windfall_core::motion::MotionTables;
use windfall_core::motion::table::TABLE_ROWS;
use windfall_core::scene::{PRESETS, Species, Tree, TreeKind};
use windfall_core::tree::gltf::{GltfLook, to_glb, to_gltf};
use windfall_core::tree::{BarkDetail, bark_mesh, grow};
use windfall_core::{Scene, World};
use windfall_fuzz::budget;
use windfall_texgen::{
    BodyFacts, FOLDER_VERSION, FormLevel, FormShape, LeafFacts, LeafForm, MANIFEST_NAME, Manifest,
};

/// Longest input that is written, in bytes: fuzzers go through small ones faster.
const LONGEST: usize = 64 << 10;

/// The seeds of one target.
struct Seeds {
    folder: PathBuf,
    target: &'static str,
    count: usize,
}

impl Seeds {
    fn new(all: &Path, target: &'static str) -> Self {
        let folder = all.join(target);
        fs::create_dir_all(&folder).expect("a folder for seeds");
        Self { folder, target, count: 0 }
    }

    fn add(&mut self, bytes: impl AsRef<[u8]>) {
        let bytes = bytes.as_ref();
        if bytes.len() <= LONGEST {
            fs::write(self.folder.join(format!("seed-{:03}", self.count)), bytes)
                .expect("a seed can be written");
            self.count += 1;
        }
    }

    /// Writes the words of some texts as a list, and closes the target.
    fn words(self, texts: &[&str]) {
        let mut words = BTreeSet::new();
        for text in texts {
            let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
            words.extend(text.split(|c| !is_word(c)).filter(|word| (2..40).contains(&word.len())));
        }
        let list: String = words.iter().map(|word| format!("\"{word}\"\n")).collect();
        fs::write(self.folder.with_extension("dict"), list).expect("a list can be written");
        println!("{}: {} seeds, {} words", self.target, self.count, words.len());
    }
}

fn main() {
    let all = PathBuf::from(std::env::args().nth(1).expect("usage: seeds FOLDER"));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut texts: Vec<String> = PRESETS.iter().map(|(_, text)| (*text).to_owned()).collect();
    texts.extend(guide_scenes(&root));
    scenes(&all, &texts);
    small_worlds(&all, &texts);
    trees(&all, &root);
    tables(&all, &root);
    skies(&all);
    leaves(&all);
    photos(&all);
}

/// Scenes that the guide shows.
fn guide_scenes(root: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for page in fs::read_dir(root.join("docs/guide")).expect("the guide") {
        let text = fs::read_to_string(page.expect("a page").path()).unwrap_or_default();
        found.extend(
            text.split("```ron\n").skip(1).filter_map(|rest| rest.split("```").next()).map(str::to_owned),
        );
    }
    found
}

fn scenes(all: &Path, texts: &[String]) {
    let mut seeds = Seeds::new(all, "scene");
    let mut printed = Vec::new();
    for text in texts {
        seeds.add(text);
        printed.extend(Scene::from_ron(text, "a seed").ok().map(|scene| scene.to_ron()));
    }
    printed.push(Scene::default().to_ron());
    printed.iter().for_each(|text| seeds.add(text));
    let words: Vec<&str> = printed.iter().chain(texts).map(String::as_str).collect();
    seeds.words(&words);
    let mut usd = Seeds::new(all, "usd");
    usd.add("hot sparks\nhot_sparks\n3\n\nhot+sparks\nhot_sparks_4");
    usd.add("\"quoted\"\\\nÄste\t\u{85}\n__\n_\n9\n9_1\n葉\n/World\n");
    usd.words(&[]);
}

/// Scenes cut down to some leaves, and checkpoints of them.
fn small_worlds(all: &Path, texts: &[String]) {
    let (mut scenes, mut checkpoints) = (Seeds::new(all, "compile"), Seeds::new(all, "checkpoint"));
    let mut printed = Vec::new();
    for text in texts {
        let Ok(mut scene) = Scene::from_ron(text, "a seed") else { continue };
        scene.sources.iter_mut().for_each(|source| source.count = source.count.min(20));
        scene.trees.truncate(1);
        scene.trees.iter_mut().for_each(|tree| tree.leaves = tree.leaves.min(20));
        scene.objects.truncate(2);
        scene.walkers.truncate(1);
        if scene.particle_count() > 2000 {
            scene.particles.clear();
            scene.forces.clear();
            scene.weather = None;
        }
        let text = scene.to_ron();
        if scene.validate("a seed").is_err() || !budget::is_cheap(&scene) {
            continue;
        }
        scenes.add(&text);
        if let Ok(world) = World::build(&scene) {
            let mut bytes = Vec::new();
            world.write_checkpoint(&mut bytes).expect("memory takes everything");
            checkpoints.add(bytes);
        }
        printed.push(text);
    }
    let words: Vec<&str> = printed.iter().map(String::as_str).collect();
    scenes.words(&words);
    checkpoints.words(&words);
}

fn trees(all: &Path, root: &Path) {
    let mut grammars = Seeds::new(all, "grammar");
    let mut words = String::from(
        "abs ceil clamp cos exp floor if ln max min mix pow round sin sqrt chance rand distichous opposite ",
    );
    for file in fs::read_dir(root.join("core/trees")).expect("grammars of the presets") {
        let text = fs::read_to_string(file.expect("a grammar").path()).unwrap_or_default();
        grammars.add(&text);
        words += &text;
    }
    for text in [
        "axiom F(1) A(1); A(l) : l > 0.3 -> {3} F(l) [ &(50) B(l) ] /(90) A(0.85 * l) -> {1} F(l) A(0.9 * l); B(l) -> T(0.1) F(l) L K(2);",
        "iterations = 3; let A = pow(2, 3) % 5; axiom F + - & ^ \\ / | $ [ F(rand(1, 2), 3) ]; F(l, p) -> F(if(chance(0.5), l, -l), p) !l;",
        "axiom A; A -> F [ A ] A;",
    ] {
        grammars.add(text);
    }
    grammars.words(&[&words]);
    let mut files = Seeds::new(all, "gltf");
    for name in ["block.gltf", "crown.gltf", "torus.gltf"] {
        files.add(fs::read(root.join("tests/data").join(name)).expect("a file of the tests"));
    }
    let young = Tree { age: 0.05, leaves: 6, ..Tree::default() };
    let skeleton = grow(&TreeKind::default(), &young, 1).expect("a maple grows");
    let bark = bark_mesh(&skeleton, BarkDetail::Far);
    let text = to_gltf(&skeleton, &bark, &GltfLook::default());
    files.add(&text);
    files.add(to_glb(&skeleton, &bark, &GltfLook::default()));
    let extra = "matrix rotation scale translation sparse normalized byteStride children skeleton inverseBindMatrices extras MASK BLEND";
    files.words(&[text.split("base64").next().unwrap_or_default(), extra]);
}

fn tables(all: &Path, root: &Path) {
    let mut motions = Seeds::new(all, "motions");
    let text = MotionTables::generate(&Species::default(), [1, 2], 9.8).to_text();
    let rows = TABLE_ROWS as usize;
    // A head and two rows of each table; the second stands for the others.
    let kept = |(number, line): (usize, &str)| match number.checked_sub(2).map(|number| number % (rows + 1)) {
        None | Some(0 | 1) => Some(line.to_owned()),
        Some(2) => Some(format!("{line}\n...")),
        Some(_) => None,
    };
    let short: Vec<String> = text.lines().enumerate().filter_map(kept).collect();
    motions.add(short.join("\n"));
    motions.add(text.lines().take(40).collect::<Vec<_>>().join("\n"));
    motions.words(&[&short.join("\n")]);
    let mut outlines = Seeds::new(all, "outline");
    outlines.add("x,y\n0,0\n30,0\n30,40\n0,40\n");
    outlines.add("# a leaf\r\nx_mm, y_mm\r\n\r\n 0 , 0 \r\n2,0\r\n2,0\r\n# tip\r\n.5,1e0\r\n0,0\r\n");
    outlines.add(fs::read(root.join("tests/data/beaufort.csv")).expect("a file of the tests"));
    let star = |at: u32| {
        let (angle, radius) = (f64::from(at) * 0.1, 1.0 + f64::from(at % 3));
        format!("{},{}\n", radius * angle.cos(), radius * angle.sin())
    };
    outlines.add((0..62).map(star).collect::<String>());
    outlines.words(&[]);
}

fn skies(all: &Path) {
    let value =
        |x: usize, y: usize| [1.0 + x as f32 / 8.0, 2.0, if (x, y) == (3, 1) { 5e4 } else { 0.5 + y as f32 }];
    let mut hdr = Seeds::new(all, "hdr");
    let sizes = [(16, 8), (32, 16), (6, 8), (12, 9)];
    for (width, height) in sizes {
        let pixels: Vec<Rgb<f32>> =
            (0..width * height).map(|at| Rgb(value(at % width, at / width))).collect();
        let mut bytes = Vec::new();
        HdrEncoder::new(&mut bytes).encode(&pixels, width, height).expect("memory takes everything");
        hdr.add(bytes);
    }
    hdr.add("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\nGAMMA=1.1\n\n-Y 8 +X 16\n");
    hdr.words(&["RADIANCE RGBE FORMAT 32 bit_rle_rgbe bit_rle_xyze EXPOSURE GAMMA COLORCORR PRIMARIES PIXASPECT VIEW SOFTWARE"]);
    let mut exr = Seeds::new(all, "exr");
    let methods = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
    ];
    for (number, compression) in methods.into_iter().enumerate() {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(8, 8))] {
            let (width, height) = sizes[number % sizes.len()];
            let channels = SpecificChannels::rgb(|Vec2(x, y)| value(x, y).into());
            let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
            let layer = Layer::new((width, height), LayerAttributes::named("sky"), encoding, channels);
            let mut bytes = Cursor::new(Vec::new());
            Image::from_layer(layer)
                .write()
                .non_parallel()
                .to_buffered(&mut bytes)
                .expect("memory takes everything");
            exr.add(bytes.into_inner());
        }
    }
    exr.words(&["channels chlist compression dataWindow box2i displayWindow lineOrder pixelAspectRatio screenWindowCenter v2f tiles tiledesc name type scanlineimage tiledimage chunkCount multiView"]);
}

/// A folder's manifest and the meshes of its leaf.
fn leaves(all: &Path) {
    let mut seeds = Seeds::new(all, "manifest");
    let facts = LeafFacts {
        name: "leaf".into(),
        season: 0.5,
        area_m2: 0.003,
        mass_kg: 0.0003,
        mean_chord_m: 0.04,
        side_m: 0.1,
        body: Some(BodyFacts { aspect: 1.5, extent: 1.1, curl: 0.2, petiole: None }),
        has_mesh: true,
    };
    let manifest = |leaves: Vec<LeafFacts>| {
        let folder = tempfile::tempdir().expect("a temporary folder");
        Manifest { version: FOLDER_VERSION, size_px: 16, leaves }
            .save(folder.path())
            .expect("it can be written");
        fs::read_to_string(folder.path().join(MANIFEST_NAME)).expect("it was written")
    };
    let level = FormLevel {
        positions: vec![[0.5, 0.9], [0.8, 0.5], [0.5, 0.1], [0.2, 0.5]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        shapes: vec![FormShape { water: 0.3, offsets: vec![[0.0, 0.1, 0.2]; 4] }],
    };
    let form = LeafForm { levels: vec![level.clone(), level.clone(), level] };
    let folder = tempfile::tempdir().expect("a temporary folder");
    form.save(folder.path(), "leaf").expect("it can be written");
    let mesh = fs::read_to_string(folder.path().join("leaf.mesh.ron")).expect("it was written");
    let flat = manifest(vec![LeafFacts { has_mesh: false, body: None, ..facts.clone() }]);
    let whole = manifest(vec![facts]);
    seeds.add(&whole);
    seeds.add(&flat);
    seeds.add(format!("{whole}\0{mesh}"));
    let mut picture = Cursor::new(Vec::new());
    leaf_picture(16, 16).write_to(&mut picture, ImageFormat::Png).expect("memory takes everything");
    seeds.add([format!("{flat}\0{mesh}\0").as_bytes(), picture.get_ref()].concat());
    seeds.words(&[&whole, &mesh]);
}

/// A green ellipse with a midrib on white.
fn leaf_picture(width: u32, height: u32) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        let along = (y as f32 + 0.5) / height as f32 * 2.0 - 1.0;
        let across = (x as f32 + 0.5) / width as f32 * 2.0 - 1.0;
        match (across * across * 3.0 + along * along * 1.2 < 0.8, across.abs() < 0.08) {
            (false, _) => Rgb([250, 250, 248]),
            (true, true) => Rgb([150, 170, 90]),
            (true, false) => Rgb([40, 110, 30]),
        }
    })
}

fn photos(all: &Path) {
    let mut seeds = Seeds::new(all, "photo");
    let photo = leaf_picture(48, 64);
    let mask =
        GrayImage::from_fn(48, 64, |x, y| Luma([if photo.get_pixel(x, y)[0] < 200 { 255 } else { 0 }]));
    let encoded = |picture: &DynamicImage, format| {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).expect("memory takes everything");
        bytes.into_inner()
    };
    let picture = DynamicImage::from(photo.clone());
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Gif] {
        seeds.add([&[0], &*encoded(&picture, format)].concat());
    }
    seeds.add([&[0], &*encoded(&picture.to_rgb16().into(), ImageFormat::Png)].concat());
    seeds.add([&[0], &*encoded(&picture.to_luma_alpha8().into(), ImageFormat::Png)].concat());
    let mut opaque = picture.to_rgba8();
    for (pixel, inside) in opaque.pixels_mut().zip(mask.pixels()) {
        pixel[3] = inside[0];
    }
    seeds.add([&[0], &*encoded(&opaque.into(), ImageFormat::Png)].concat());
    let file = encoded(&picture, ImageFormat::Png);
    let length = u16::try_from(file.len()).expect("a small file").to_le_bytes();
    seeds.add([&[1], &length[..], &file, &encoded(&mask.clone().into(), ImageFormat::Png)].concat());
    // Plain pixels, odd where the leaf is.
    let pixels =
        photo.pixels().zip(mask.pixels()).map(|(colour, inside)| (colour[0] & 0xfe) | (inside[0] & 1));
    seeds.add([2, 47].into_iter().chain(pixels).collect::<Vec<u8>>());
    seeds.words(&["IHDR PLTE IDAT IEND tRNS gAMA sRGB iCCP acTL fcTL fdAT JFIF Exif GIF87a GIF89a"]);
}
