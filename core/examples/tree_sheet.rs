// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws a contact sheet of tree kinds: from the side, growing up, then bare, then others of the same kind.
//!
//! `cargo run --release -p windfall-core --example tree_sheet -- sheet.png [preset or grammar file]...`

#![expect(clippy::cast_possible_truncation, reason = "pixels, colours and sizes within a picture")]

use std::path::Path;
use std::time::Instant;

use glam::{Vec2, Vec3};
use image::{Rgb, RgbImage};
use windfall_core::scene::{Tree, TreeForm, TreeKind, TreePreset};
use windfall_core::tree::grammar::Grammar;
use windfall_core::tree::{AttachmentKind, Skeleton, full_leaf_count, grow};

/// Width and height of a picture in pixels.
const CELL: (u32, u32) = (400, 400);
/// Age, whether it is bare, number.
const PICTURES: [(f32, bool, u32); 7] = [
    (0.05, false, 1),
    (0.2, false, 1),
    (0.45, false, 1),
    (1.0, true, 1),
    (1.0, false, 1),
    (1.0, false, 2),
    (1.0, false, 3),
];
/// Seed of all trees.
const SEED: u64 = 1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("usage: tree_sheet OUT.png [preset or grammar file]...")?;
    let named: Vec<TreeKind> = arguments.map(|name| kind(&name)).collect::<Result<_, _>>()?;
    let kinds = if named.is_empty() { TreePreset::ALL.map(TreePreset::kind).to_vec() } else { named };

    let columns = u32::try_from(PICTURES.len())?;
    let rows = u32::try_from(kinds.len())?;
    let mut sheet = RgbImage::from_pixel(CELL.0 * columns, CELL.1 * rows, Rgb([226, 232, 238]));
    for (row, kind) in (0..).zip(&kinds) {
        let full = grow(kind, &Tree { leaves: 0, ..Tree::default() }, SEED)?;
        let pixels_per_m = 0.92 * CELL.1 as f32 / full.height_m();
        for (column, (age, is_bare, number)) in (0..).zip(PICTURES) {
            let leaves = if is_bare { 0 } else { 6000 };
            let tree = Tree { age, number, leaves, ..Tree::default() };
            let start = Instant::now();
            let skeleton = grow(kind, &tree, SEED)?;
            let elapsed = start.elapsed();
            println!(
                "{} age {age} number {number}: {} segments, depth {}, height {:.2} m, {} attachments, full crown {}, {elapsed:?}",
                kind.name,
                skeleton.segments.len(),
                skeleton.depth(),
                skeleton.height_m(),
                skeleton.attachments.len(),
                full_leaf_count(kind, &tree, SEED)?,
            );
            // A young tree would be a few pixels high.
            let zoom = if age < 0.3 { (full.height_m() / skeleton.height_m()).min(3.0) } else { 1.0 };
            let leaf_m2 = leaf_m2(kind, &tree, &skeleton)?;
            draw(&mut sheet, (CELL.0 * column, CELL.1 * row), &skeleton, leaf_m2, pixels_per_m * zoom);
        }
    }
    sheet.save(path)?;
    Ok(())
}

/// The preset of this name, or the kind that a grammar file describes.
fn kind(name: &str) -> Result<TreeKind, Box<dyn std::error::Error>> {
    if let Some(preset) = TreePreset::named(name) {
        return Ok(preset.kind());
    }
    let text = std::fs::read_to_string(Path::new(name)).map_err(|error| format!("{name}: {error}"))?;
    Ok(TreeKind { name: name.into(), form: TreeForm::Grammar(text), ..TreeKind::default() })
}

/// Area of a leaf in m², times the leaves that it stands for.
fn leaf_m2(kind: &TreeKind, tree: &Tree, skeleton: &Skeleton) -> Result<f32, Box<dyn std::error::Error>> {
    let text = match &kind.form {
        TreeForm::Preset(preset) => preset.text(),
        TreeForm::Grammar(text) => text,
        _ => unreachable!("kinds are presets or grammars here"),
    };
    let leaves = skeleton.attachments.iter().filter(|one| one.kind == AttachmentKind::Leaf).count();
    let each = full_leaf_count(kind, tree, SEED)? / leaves.max(1) as f64;
    Ok((each * Grammar::parse(text)?.settings().leaf_area_m2) as f32)
}

/// Draws a tree into the picture with this corner, from far to near.
fn draw(sheet: &mut RgbImage, corner: (u32, u32), skeleton: &Skeleton, leaf_m2: f32, pixels_per_m: f32) {
    let place = |point: Vec3| {
        Vec2::new(CELL.0 as f32 / 2.0 + point.x * pixels_per_m, CELL.1 as f32 * 0.97 - point.y * pixels_per_m)
    };
    let mut marks: Vec<(f32, Vec2, Vec2, f32, f32, Rgb<u8>)> = Vec::new();
    for segment in &skeleton.segments {
        let depth = (segment.start_m.z + segment.end_m.z) / 2.0;
        let radii =
            [segment.start_radius_m, segment.end_radius_m].map(|radius| (radius * pixels_per_m).max(0.4));
        marks.push((
            depth,
            place(segment.start_m),
            place(segment.end_m),
            radii[0],
            radii[1],
            Rgb([74, 58, 48]),
        ));
    }
    let reach = skeleton.attachments.iter().map(|one| one.at_m.z.abs()).fold(0.1, f32::max);
    let leaf_m = (leaf_m2 / std::f32::consts::PI).sqrt();
    for attachment in &skeleton.attachments {
        let near = 0.5 + 0.5 * attachment.at_m.z / reach;
        let light = 0.45 + 0.55 * attachment.normal.dot(Vec3::new(-0.6, 0.6, 0.5).normalize()).max(0.0);
        let shade = |value: f32| (value * light * (0.55 + 0.45 * near)) as u8;
        let (colour, radius_m) = match attachment.kind {
            AttachmentKind::Leaf => (Rgb([shade(120.0), shade(170.0), shade(60.0)]), leaf_m),
            AttachmentKind::Fruit => (Rgb([shade(255.0), shade(40.0), shade(60.0)]), 0.008),
        };
        let centre = place(attachment.at_m + attachment.direction * radius_m);
        let radius = radius_m * pixels_per_m;
        marks.push((attachment.at_m.z, centre, centre, radius, radius, colour));
    }
    marks.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, from, to, start, end, colour) in marks {
        let steps = (from.distance(to) * 2.0).ceil().max(1.0);
        for step in 0..=steps as u32 {
            let share = step as f32 / steps;
            disc(sheet, corner, from.lerp(to, share), start + (end - start) * share, colour);
        }
    }
}

/// Fills a disc, within the picture.
fn disc(sheet: &mut RgbImage, corner: (u32, u32), centre: Vec2, radius: f32, colour: Rgb<u8>) {
    let range = |middle: f32, end: u32| {
        let low = (middle - radius).floor().clamp(0.0, end as f32) as u32;
        let high = (middle + radius).ceil().clamp(0.0, end as f32) as u32;
        low..high
    };
    for y in range(centre.y, CELL.1) {
        for x in range(centre.x, CELL.0) {
            if Vec2::new(x as f32 + 0.5, y as f32 + 0.5).distance(centre) <= radius.max(0.6) {
                sheet.put_pixel(corner.0 + x, corner.1 + y, colour);
            }
        }
    }
}
