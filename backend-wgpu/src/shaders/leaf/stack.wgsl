// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/stack.rs
// The end of a step in the litter: leaves give it their volume, take the same back, or, drifting on water, both.
#import leaf/record
#import leaf/settle
#import terrain/litter

struct LitterChange {
    taken: LitterShares,
    added: LitterShares,
    lies: bool,
    is_woken: bool,
}

fn leaf_changes_litter(bits: u32, velocity: vec3<f32>) -> bool {
    let drifting = is_afloat(bits) && (velocity.x != 0.0 || velocity.z != 0.0);
    return lies(bits) && (litter_change(bits) != CHANGE_NONE || drifting);
}

fn drifted(place: vec3<f32>, velocity: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(place.x + velocity.x * scene.dt_s, place.y, place.z + velocity.z * scene.dt_s);
}

fn leaf_stack(leaf: u32) -> LitterChange {
    let place = places[leaf];
    let bits = place.bits;
    let change = litter_change(bits);
    let here = litter_shares(lying_volume(bits), place.position.x, place.position.z);
    let none = LitterShares(here.node, vec4<u32>(0u, 0u, 0u, 0u));
    var taken = here;
    var added = none;
    let species = leaf_species(bits);
    if (is_afloat(bits) && (change == CHANGE_WOKEN || change == CHANGE_REMOVED)) {
        schedules[leaf].event = recycling_step(leaf);
    }
    if (change == CHANGE_ADDED) {
        taken = none;
        added = here;
        places[leaf].bits = with_litter_change(bits, CHANGE_NONE);
    } else if (change == CHANGE_WOKEN) {
        places[leaf].bits = place_bits(STATE_FALLING, 0u, AERODYNAMIC, species, 0u);
        identities[leaf].fall_time = 0u;
    } else if (change == CHANGE_NONE) {
        let next = drifted(place.position, drifts[leaf].velocity);
        added = litter_shares(lying_volume(bits), next.x, next.z);
        places[leaf].position = next;
    } else {
        let sinks = is_afloat(bits) && is_sunk(bits);
        places[leaf].bits = select(place_bits(STATE_RESTING, 0u, 0u, species, 0u), sunk_bits(species), sinks);
        drifts[leaf].phase = 0u;
        schedules[leaf].rate = 0u;
        schedules[leaf].heading = 0u;
    }
    return LitterChange(taken, added, change == CHANGE_ADDED, change == CHANGE_WOKEN);
}
