// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall tree info`: a tree in numbers.

use std::fmt::{Display, Write as _};

use clap::Args;
use serde::Serialize;
use windfall_core::tree::{AttachmentKind, BarkDetail, Skeleton, bark_mesh};

use super::source::{GivenTree, TreeArguments};
use crate::run::terminal;

/// Height at which foresters measure trunks, in metres.
const BREAST_HEIGHT_M: f32 = 1.3;

/// Options of `windfall tree info`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    /// Print everything as one line of JSON.
    #[arg(long)]
    json: bool,
}

/// A tree in numbers. The names of these fields are the keys of its JSON; they stay.
#[derive(Debug, Serialize)]
struct Report {
    tree: String,
    height_m: f32,
    crown_m: f32,
    diameter_m: Option<f32>,
    segments: usize,
    depth: u32,
    orders: u32,
    leaves: usize,
    fruit: usize,
    full_leaf_count: f64,
    bark: Bark,
}

/// Sizes of the bark at its details.
#[derive(Debug, Serialize)]
struct Bark {
    full: Size,
    middle: Size,
    far: Size,
}

/// Size of a mesh.
#[derive(Debug, Serialize)]
struct Size {
    vertices: usize,
    triangles: usize,
}

/// Runs the command.
///
/// # Errors
/// A tree that cannot be had.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let report = Report::of(&arguments.tree.load()?);
    if arguments.json {
        return terminal::print(&(serde_json::to_string(&report)? + "\n"));
    }
    let mut text = String::new();
    row(&mut text, "tree", &report.tree);
    row(&mut text, "height", format!("{:.2} m", report.height_m));
    row(&mut text, "crown", format!("{:.2} m across", report.crown_m));
    let diameter = report.diameter_m.map_or("–".into(), |m| format!("{:.3} m at {BREAST_HEIGHT_M} m", m));
    row(&mut text, "trunk", diameter);
    row(&mut text, "segments", report.segments);
    row(&mut text, "depth", format!("{} segments from the foot to a tip", report.depth));
    row(&mut text, "orders", format!("{} of branches", report.orders));
    row(&mut text, "leaves", format!("{} of {:.0} in the full crown", report.leaves, report.full_leaf_count));
    row(&mut text, "fruit", report.fruit);
    for (name, size) in [
        ("bark full", &report.bark.full),
        ("bark middle", &report.bark.middle),
        ("bark far", &report.bark.far),
    ] {
        row(&mut text, name, format!("{} triangles, {} vertices", size.triangles, size.vertices));
    }
    terminal::print(&text)
}

impl Report {
    fn of(tree: &GivenTree) -> Self {
        let skeleton = &tree.skeleton;
        let size = |detail: BarkDetail| {
            let mesh = bark_mesh(skeleton, detail);
            Size { vertices: mesh.positions_m.len(), triangles: mesh.triangle_count() }
        };
        let count = |wanted: AttachmentKind| skeleton.attachments.iter().filter(|a| a.kind == wanted).count();
        Self {
            tree: tree.name.clone(),
            height_m: skeleton.height_m(),
            crown_m: crown_m(skeleton),
            diameter_m: diameter_m(skeleton),
            segments: skeleton.segments.len(),
            depth: skeleton.depth(),
            orders: skeleton.segments.iter().map(|segment| segment.order).max().unwrap_or(0),
            leaves: count(AttachmentKind::Leaf),
            fruit: count(AttachmentKind::Fruit),
            full_leaf_count: tree.full_leaf_count,
            bark: Bark {
                full: size(BarkDetail::Full),
                middle: size(BarkDetail::Middle),
                far: size(BarkDetail::Far),
            },
        }
    }
}

/// Largest extent of the wood along the horizontal axes.
fn crown_m(skeleton: &Skeleton) -> f32 {
    let ends = || skeleton.segments.iter().map(|segment| segment.end_m);
    let (Some(low), Some(high)) = (ends().reduce(|a, b| a.min(b)), ends().reduce(|a, b| a.max(b))) else {
        return 0.0;
    };
    (high.x - low.x).max(high.z - low.z)
}

/// Diameter of the trunk at breast height; none if it ends or parts below.
fn diameter_m(skeleton: &Skeleton) -> Option<f32> {
    let mut trunk = skeleton.segments.iter().filter(|segment| segment.order == 0);
    let segment =
        trunk.find(|segment| segment.start_m.y <= BREAST_HEIGHT_M && BREAST_HEIGHT_M < segment.end_m.y)?;
    let share = (BREAST_HEIGHT_M - segment.start_m.y) / (segment.end_m.y - segment.start_m.y);
    Some(2.0 * (segment.start_radius_m + (segment.end_radius_m - segment.start_radius_m) * share))
}

fn row(text: &mut String, name: &str, value: impl Display) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{name:<13}{value}");
}
