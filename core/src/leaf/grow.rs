// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Places the leaves of trees at time zero: on their twigs, or beneath them if the season has taken them.

use super::seek::leaf_seek_any;
use super::store::{LeafMut, Leaves};
use crate::arith::rng::random;
use crate::blocks::{LENGTH_UNIT, NEVER, SOURCE_TREES};
use crate::compile::{CompiledScene, leaf_site};
use crate::context::Context;
use crate::device::leaf::carry::{CarriedLeaf, leaf_size_on_twig, leaf_twig_pose};
use crate::device::leaf::petiole::{petiole_of, petiole_species};
use crate::device::leaf::record::{STATE_ATTACHED, leaf_appearance, leaf_state, place_bits};
use crate::device::leaf::release::{SizeSpeed, leaf_drop, release_fall_time, release_size_speed};
use crate::device::motion::feature::STREAM_TRAITS;
use crate::device::terrain::ground::ground_surface;
use crate::flight::drop_table::DropTable;
use crate::tree::Branches;
use crate::tree::record::NO_SEGMENT;

/// Steps after which every leaf that has fallen before time zero lies on the ground.
const LONG_AGO: u32 = 1 << 22;

/// Writes the state at time zero of the leaf in a tree's slot.
pub(crate) fn leaf_grow(
    compiled: &CompiledScene,
    cx: &Context<'_>,
    branches: &Branches,
    tables: &[Option<DropTable>],
    leaf: &mut LeafMut<'_>,
    slot: u32,
) {
    let petiole = petiole_of(cx, slot);
    leaf.identity.id = slot;
    leaf.identity.appearance = leaf_appearance(0, 0, SOURCE_TREES);
    leaf.schedule.event = NEVER;
    if petiole.segment == NO_SEGMENT {
        return;
    }
    let seed = cx.scene.seed;
    let traits = random(seed, slot, STREAM_TRAITS);
    let species_index = petiole_species(petiole.bits);
    if leaf_site(compiled.scene(), slot).1 {
        let release = 0u32.wrapping_sub(LONG_AGO);
        leaf_drop(cx, leaf, slot, traits, SOURCE_TREES, species_index, petiole.blade, release);
        leaf_seek_any(cx, tables, leaf, LONG_AGO);
        return;
    }
    let species = &cx.scene.species[species_index as usize];
    let SizeSpeed { size, speed } = release_size_speed(species, traits);
    let [x, z] = [petiole.blade[0], petiole.blade[2]].map(|units| units as f32 * LENGTH_UNIT);
    let ground = ((ground_surface(cx, x, z) + cx.scene.surface_height_m) * 1024.0).floor();
    #[expect(clippy::cast_possible_truncation, reason = "a whole number in range")]
    let height = petiole.blade[1] - ground as i32;
    leaf.identity.fall_time = release_fall_time(species, height, speed);
    leaf.identity.appearance = leaf_appearance(traits[3], traits[0], SOURCE_TREES);
    let row = petiole.segment as usize;
    leaf.schedule.size = leaf_size_on_twig(size, petiole.bits);
    leaf.place.bits = place_bits(STATE_ATTACHED, 0, 0, species_index, 0);
    leaf.drift.phase = 0;
    let mut carried = CarriedLeaf {
        place: leaf.place,
        drift: leaf.drift,
        attitude: leaf.attitude,
        schedule: leaf.schedule,
    };
    carried.set_pose(&leaf_twig_pose(cx, 0.0, slot, &(&petiole).into(), &branches.body(row)));
}

/// Counts the leaves that hang on every segment.
pub(crate) fn count_leaves(
    compiled: &CompiledScene,
    branches: &mut Branches,
    cx: &Context<'_>,
    leaves: &Leaves,
) {
    let rows = compiled.shard_rows();
    for (slot, place) in (rows.first_row..cx.scene.tree_leaf_count).zip(&leaves.place) {
        if leaf_state(place.bits) == STATE_ATTACHED {
            branches.leaf_count[petiole_of(cx, slot).segment as usize] += 1;
        }
    }
}
