// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/terrain/snow_print.wgsl
//!
//! Prints in snow: things that move press it down to their undersides, at most to the density of trodden snow. Parts with faces leave none.

use super::snow::{SNOW_DEPTH_M, SnowCell};
use crate::arith::lane::{Real, Word};
use crate::arith::quaternion::quat_rotate_back;
use crate::arith::vector::Vec3;
use crate::blocks::MoverBlock;
use crate::device::solid::shape::{SOLID_GRID, SOLID_HULL, SolidAt, core_distance};

crate::shared_constants! {
    /// Units of depth per unit of water of trodden snow of 300 kg/m³.
    pub const TRODDEN_DEPTH: f32 = 0.213_333;
    /// Steps from one in which things press snow to the next.
    pub const PRESS_INTERVAL: u32 = 4;
    /// The first such step: none in which cells exchange snow.
    pub const PRESS_FIRST: u32 = 2;
    /// Most heights at which the distance to a part is taken.
    pub const UNDERSIDE_PROBES: u32 = 16;
    /// Distance in m at which a part is reached.
    pub const UNDERSIDE_REACHED_M: f32 = 0.002;
}

/// Returns true in steps in which things press snow.
#[inline(always)]
pub fn snow_is_pressed(step: u32) -> bool {
    step % PRESS_INTERVAL == PRESS_FIRST
}

/// Returns true for places that a part which moves may be above or below in a step.
#[inline(always)]
pub fn may_press(mover: &MoverBlock, x: f32, z: f32) -> bool {
    let apart_x = x - mover.center_m[0];
    let apart_z = z - mover.center_m[2];
    apart_x * apart_x + apart_z * apart_z < mover.bound_m * mover.bound_m
}

/// Height in m between two at which a line upwards meets a part; the upper one if it does not.
#[inline(always)]
pub fn underside(solid: &SolidAt, x: f32, z: f32, low: f32, high: f32) -> f32 {
    let mut y = low;
    for _ in 0..UNDERSIDE_PROBES {
        let inner = quat_rotate_back(solid.turn, Vec3::new(x, y, z) - solid.center);
        let distance = core_distance(solid, inner).distance_m;
        if distance < UNDERSIDE_REACHED_M || high <= y {
            return y.min(high);
        }
        y += distance;
    }
    high
}

/// Snow of a cell at a place, on a floor so many metres high, under a part.
#[inline(always)]
pub fn snow_pressed(solid: &SolidAt, x: f32, z: f32, floor_m: f32, cell: SnowCell) -> SnowCell {
    if (solid.flags & (SOLID_HULL | SOLID_GRID)) != 0 {
        return cell;
    }
    let least = (cell.water.to_real() * TRODDEN_DEPTH).floor().to_whole().min(cell.depth);
    let low = floor_m + least.to_real() * SNOW_DEPTH_M;
    let high = floor_m + cell.depth.to_real() * SNOW_DEPTH_M;
    let under = underside(solid, x, z, low, high);
    if high <= under {
        return cell;
    }
    let depth = ((under - low).max(0.0) * (1.0 / SNOW_DEPTH_M)).floor().to_whole();
    SnowCell { water: cell.water, depth: (least + depth).min(cell.depth) }
}
