// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/stack.rs
// The end of a step in the litter: leaves give it their volume, or take the same back.
#import leaf/record
#import terrain/litter

struct LitterChange {
    shares: LitterShares,
    is_added: bool,
    is_woken: bool,
}

fn leaf_changes_litter(bits: u32) -> bool {
    return lies(bits) && litter_change(bits) != CHANGE_NONE;
}

fn leaf_stack(leaf: u32) -> LitterChange {
    let place = places[leaf];
    let bits = place.bits;
    let change = litter_change(bits);
    let shares = litter_shares(lying_volume(bits), place.position.x, place.position.z);
    let species = leaf_species(bits);
    if (change == CHANGE_ADDED) {
        places[leaf].bits = with_litter_change(bits, CHANGE_NONE);
    } else if (change == CHANGE_WOKEN) {
        places[leaf].bits = place_bits(STATE_FALLING, 0u, AERODYNAMIC, species, 0u);
        identities[leaf].fall_time = 0u;
    } else {
        places[leaf].bits = place_bits(STATE_RESTING, 0u, 0u, species, 0u);
        drifts[leaf].phase = 0u;
        schedules[leaf].rate = 0u;
        schedules[leaf].heading = 0u;
    }
    return LitterChange(shares, change == CHANGE_ADDED, change == CHANGE_WOKEN);
}
