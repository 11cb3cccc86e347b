// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Burning of the leaves of a species.

use serde::{Deserialize, Serialize};

/// Heat value, ignition and speed of burning of leaves.
///
/// A leaf is heated by the plumes of fires and by leaves that burn beside it. Its water boils away first, at 100 °C; at its ignition
/// temperature it catches. A front then runs over it, behind which it is char, and in the end it is gone. As it loses mass it becomes light
/// enough to rise in the plume.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Burning {
    /// Heat released per mass of dry leaf that burns in MJ/kg, 5 to 30: 15.6 of cellulose, 16 of grass as fire models take it.
    #[serde(default = "unstated")]
    pub heat_mj_kg: f32,
    /// Least and largest temperature in °C at which a leaf catches, each 150 to 700: 227 to 453 of live cuttings of eight shrubs (Fletcher et al.
    /// 2007), with great scatter.
    #[serde(default = "usual_ignition")]
    pub ignition_c: (f32, f32),
    /// Speed of the front over a dry leaf in mm/s, 0.5 to 50: water slows it. The default, 12, is an assumption: single leaves burn for a few
    /// seconds.
    #[serde(default = "usual_front")]
    pub front_mm_s: f32,
    /// Share of the dry mass that is left as ash, 0 to 0.4. The default is 0.06.
    #[serde(default = "usual_ash")]
    pub ash: f32,
}

/// Heat value of one that states none, which no check lets pass.
fn unstated() -> f32 {
    0.0
}

fn usual_ignition() -> (f32, f32) {
    (227.0, 453.0)
}

fn usual_front() -> f32 {
    12.0
}

fn usual_ash() -> f32 {
    0.06
}

impl Default for Burning {
    fn default() -> Self {
        Self { heat_mj_kg: 16.0, ignition_c: usual_ignition(), front_mm_s: usual_front(), ash: usual_ash() }
    }
}
