// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that lie on one another.

use glam::Vec2;
use serde::{Deserialize, Serialize};

use super::Species;
use crate::convert::word;

/// Half of the largest width in m within which a bed thins out.
const WIDEST_RIM_M: f32 = 1.0;

/// A rectangle of ground on which leaves pile up, and blow on as soon as the wind at their own edge moves them. Beyond it leaves lie
/// where they land.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Litter {
    /// Centre x, z of the rectangle in metres, each -4096 to 4096.
    pub center_m: Vec2,
    /// Edges along x and z in metres, each 1 to 256.
    pub size_m: Vec2,
    /// Area of the leaves that lie there from the start per area of ground, 0 to 30: broadleaf woods drop 5 to 6 in an autumn. The bed
    /// thins out over the last two metres before the edges. Its leaves are of all species of the scene alike, and have slots of their
    /// own. It is at most 2 m deep.
    pub leaf_area_index: f32,
    /// Mass of dry leaves per volume of litter in kg/m³, 1 to 100: measured beds of hardwood leaves have 8.4 to 29, on average 12.2
    /// (Ottmar and Andreu 2007); fresh curled leaves less.
    pub bulk_density_kg_m3: f32,
    /// Coulomb friction coefficient between leaf and leaf, 0.05 to 5. A heap stands at its angle plus 3 to 4 degrees. The default,
    /// 0.7, gives the 38° that stacked leaves of sugar cane keep (Lei et al. 2022).
    pub friction: f32,
    /// Least and largest angle in degrees by which the edges of a leaf stand up, each 0 to 60: curled leaves stand on their lobes,
    /// whichever way the wind comes. The more, the sooner it takes them.
    pub raised_deg: (f32, f32),
    /// Coefficient of restitution of leaves that strike the bare ground, 0 to 1. Litter gives nothing back.
    pub restitution: f32,
    /// Water in kg per kg of dry leaf, 0 to 4: wet litter holds about 2 (Zagyvai-Kiss et al. 2019). It makes leaves heavier in the
    /// litter and where the wind takes them from there.
    pub moisture: f32,
    /// Suction in N/m² of the film that holds wet leaves, 0 to 20.
    pub adhesion_n_m2: f32,
    /// Hours for which leaves float on water, 0.001 to 48, each between half and one and a half times as long; then they are soaked and
    /// sink. The default, 6, is an assumption: leaves take up their water over hours.
    pub float_hours: f32,
    /// Leaves lie as still as painted: none is woken, and none that lands raises the litter.
    pub still: bool,
}

impl Litter {
    /// The same litter as far as it cannot change while a simulation runs, otherwise as another says.
    pub fn retuned(self, to: Option<Self>) -> Self {
        let Self { friction, raised_deg, restitution, adhesion_n_m2, float_hours, .. } = to.unwrap_or(self);
        Self { friction, raised_deg, restitution, adhesion_n_m2, float_hours, ..self }
    }

    /// Half of the width in m within which a bed thins out towards each edge.
    pub fn rim_m(&self) -> f32 {
        (0.25 * self.size_m.min_element()).min(WIDEST_RIM_M)
    }

    /// Depth in m of the bed that lies there from the start.
    pub(crate) fn bed_depth_m(&self, species: &[Species]) -> f64 {
        let area_m2: f64 = species.iter().map(Species::mean_area_m2).sum();
        let mass_kg: f64 =
            species.iter().map(|one| one.mean_area_m2() * f64::from(one.areal_density_kg_m2)).sum();
        f64::from(self.leaf_area_index) * mass_kg / area_m2 / f64::from(self.bulk_density_kg_m3)
    }

    /// Number of leaves that lie there from the start.
    pub(crate) fn bed_leaf_count(&self, species: &[Species]) -> u32 {
        let full_m = |edge_m: f32| f64::from(edge_m - 2.0 * self.rim_m());
        let area_m2 = full_m(self.size_m.x) * full_m(self.size_m.y);
        let leaf_m2 = species.iter().map(Species::mean_area_m2).sum::<f64>() / species.len() as f64;
        word(f64::from(self.leaf_area_index) * area_m2 / leaf_m2)
    }
}

impl Default for Litter {
    fn default() -> Self {
        Self {
            center_m: Vec2::ZERO,
            size_m: Vec2::splat(40.0),
            leaf_area_index: 0.0,
            bulk_density_kg_m3: 12.2,
            friction: 0.7,
            raised_deg: (5.0, 25.0),
            restitution: 0.1,
            moisture: 0.0,
            adhesion_n_m2: 0.0,
            float_hours: 6.0,
            still: false,
        }
    }
}
