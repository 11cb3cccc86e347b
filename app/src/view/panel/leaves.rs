// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves: how many, how fast.

use std::ops::RangeInclusive;

use egui::Ui;
use windfall_core::scene::limits;
use windfall_core::scene::limits::Limit;
use windfall_core::{Scene, SceneError};

use super::field::field;

/// `base` is the scene before the edit that is going on; `range` is what scene and device allow.
///
/// # Errors
/// A number of leaves that trees and sources cannot share.
pub(super) fn show(
    ui: &mut Ui,
    scene: &mut Scene,
    base: &Scene,
    own: &Scene,
    range: &RangeInclusive<u32>,
) -> Result<(), SceneError> {
    let before = scene.leaf_count();
    let mut count = before;
    let tip = "Number of leaves, shared by trees and sources as they share those of the scene";
    let limit = Limit { low: *range.start(), high: *range.end(), unit: "" };
    field("Number", tip, limit).fine(1.0).show(ui, &mut count, own.leaf_count());
    let tip = "Multiplies every leaf's own velocity through the air";
    field("Fall speed", tip, limits::FALL_SPEED).show(ui, &mut scene.fall_speed, own.fall_speed);
    let tip = "Multiplies every leaf's turning and swinging; its path keeps its speed";
    field("Rotation", tip, limits::ROTATION_SPEED).show(ui, &mut scene.rotation_speed, own.rotation_speed);
    let tip =
        "Length of the trail behind every leaf, in the picture alone; the first 4096 leaves have trails";
    field("Trails", tip, limits::TRAIL_S).fine(0.1).show(ui, &mut scene.view.trail_s, own.view.trail_s);
    if count != before {
        *scene = base.with_leaf_count(&base.name, count)?;
    }
    Ok(())
}
