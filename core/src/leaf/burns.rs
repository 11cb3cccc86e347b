// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Burning of the leaves: its store, and the books of what has burnt.

use std::f64::consts::PI;

use super::store::Leaves;
use crate::blocks::SceneBlock;
use crate::device::leaf::burn::{Burn, UNLIT, burn_power, burn_way, burnt_share};
use crate::device::leaf::record::{STATE_DORMANT, leaf_species, leaf_state, size_ratio};
use crate::scene::{Scene, Species};

crate::columns! {
    /// Burning of the leaves of a world, slot by slot; no row where none burn.
    pub struct Burns("burning leaves") {
        /// Heat and ignition.
        pub burn: Burn,
    }
    /// Burning of one leaf.
    row BurnMut;
    /// A run of slots.
    run BurnsMut;
}

impl Burns {
    /// Number of rows for a scene.
    pub(crate) fn rows_of(scene: &Scene) -> usize {
        if scene.leaves_burn() { scene.leaf_count() as usize } else { 0 }
    }
}

/// Masses in µg of a leaf of which a share has burnt: what is left of it, ash, and what has gone up. Whole numbers that sum to that of the whole leaf.
pub fn leaf_masses(species: &Species, size: u32, share: f32) -> [u64; 3] {
    let ratio = f64::from(size_ratio(size));
    let area_m2 = PI / 4.0 * (f64::from(species.size_m) * ratio) * (f64::from(species.size_m) * ratio);
    let whole = micrograms(area_m2 * f64::from(species.areal_density_kg_m2));
    let ash_share = species.burns.map_or(0.0, |burning| f64::from(burning.ash));
    let passed = (whole as f64 * f64::from(share)).floor();
    let ash = whole_number(passed * ash_share);
    let passed = whole_number(passed);
    [whole - passed, ash, passed - ash]
}

fn micrograms(mass_kg: f64) -> u64 {
    whole_number((mass_kg * 1e9).round())
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "masses, below 2^53")]
fn whole_number(number: f64) -> u64 {
    number as u64
}

/// Counts and masses of the leaves of species that burn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BurnStats {
    /// Leaves that burn.
    pub burning: u64,
    /// Leaves that have burnt and are gone.
    pub burnt: u64,
    /// Leaves that water has put out.
    pub put_out: u64,
    /// Dry mass in µg of what is left of leaves, without ash.
    pub left_ug: u64,
    /// Mass in µg of ash.
    pub ash_ug: u64,
    /// Mass in µg of what has gone up in flames.
    pub gone_ug: u64,
    /// Heat in J that it has released.
    pub heat_j: f64,
    /// Heat release in W.
    pub power_w: f64,
}

impl BurnStats {
    /// Counts and masses in a step; `None` where no leaves burn.
    pub(crate) fn of(
        scene: &Scene,
        block: &SceneBlock,
        step: u32,
        leaves: &Leaves,
        burns: &Burns,
    ) -> Option<Self> {
        if burns.is_empty() {
            return None;
        }
        let mut stats = Self::default();
        let count = scene.species.len();
        for ((place, schedule), burn) in leaves.place.iter().zip(&leaves.schedule).zip(&burns.burn) {
            let number = leaf_species(place.bits) as usize % count;
            let species = &scene.species[number];
            let Some(burning) = &species.burns else { continue };
            let (of_species, size) = (&block.burns[number], schedule.size);
            let is_lit = burn.lit != UNLIT;
            // Leaves that wait for their release have no size yet.
            if leaf_state(place.bits) == STATE_DORMANT && !is_lit {
                continue;
            }
            let is_gone = is_lit && leaf_state(place.bits) == STATE_DORMANT;
            let way = if is_gone { 1.0 } else { burn_way(step, burn) };
            let burns = is_lit && way < 1.0;
            let [left, ash, gone] = leaf_masses(species, size, burnt_share(way));
            stats.burning += u64::from(burns);
            stats.burnt += u64::from(is_lit && !burns);
            stats.put_out += u64::from(!is_lit && burn.out_way != 0.0);
            stats.left_ug += left;
            stats.ash_ug += ash;
            stats.gone_ug += gone;
            stats.heat_j += gone as f64 * f64::from(burning.heat_mj_kg) * 1e-3;
            if burns {
                stats.power_w += f64::from(burn_power(of_species, size_ratio(size), way));
            }
        }
        Some(stats)
    }
}
