// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/advance.rs
// One step of one leaf: plain steps apart from those with an event.
#import bindings
#import leaf/afloat
#import leaf/air
#import leaf/fall
#import leaf/fly
#import leaf/join
#import leaf/lie
#import leaf/record
#import leaf/release
#import leaf/settle

fn leaf_has_event(leaf: u32) -> bool {
    return step_block.index >= schedules[leaf].event;
}

fn leaf_is_settling(leaf: u32) -> bool {
    let drift = drifts[leaf];
    let slides = ((bitcast<u32>(drift.velocity.x) | bitcast<u32>(drift.velocity.z)) << 1u) != 0u;
    return ground_steps(drift.phase) < scene.settle_steps || slides;
}

fn leaf_advance_plain(leaf: u32) -> bool {
    let schedule = schedules[leaf];
    if (step_block.index >= schedule.event) {
        return false;
    }
    let place = places[leaf];
    let state = leaf_state(place.bits);
    if (state == STATE_FALLING) {
        if (flies(place.bits)) {
            return true;
        }
        return leaf_fall_aloft(leaf, place, schedule);
    }
    return state != STATE_RESTING || !leaf_is_settling(leaf);
}

fn leaf_advance_event(leaf: u32) {
    let now = step_block.index;
    let identity = identities[leaf];
    let source = leaf_source(identity.appearance);
    let lifetime = scene.sources[source].lifetime_steps;
    let before = places[leaf].bits;
    if (lies(before) && !is_held(before)) {
        if (is_afloat(before) && now < recycling_step(leaf)) {
            leaf_soak(leaf);
        } else {
            // The litter gives it back first.
            places[leaf].bits = with_litter_change(before, CHANGE_REMOVED);
        }
        return;
    }
    let state = leaf_state(before);
    var is_let_go = true;
    if (state == STATE_ATTACHED) {
        leaf_detach(leaf, now);
    } else if (state == STATE_DORMANT) {
        leaf_release(leaf, identity.id, source, now);
    } else if (source != SOURCE_TREES && lifetime != 0u && now - identity.release >= lifetime) {
        leaf_release(leaf, identity.id + scene.ids_per_life, source, now);
    } else {
        is_let_go = false;
    }
    if (is_let_go) {
        leaf_sample_air(leaf);
    }
    let bits = places[leaf].bits;
    if (leaf_state(bits) == STATE_FALLING && !flies(bits)) {
        leaf_fall_joining(leaf);
    }
}

fn leaf_advance(leaf: u32) {
    if (leaf_has_event(leaf)) {
        leaf_advance_event(leaf);
        return;
    }
    let place = places[leaf];
    let state = leaf_state(place.bits);
    if (state == STATE_FALLING && !flies(place.bits)) {
        leaf_fall(leaf, place, schedules[leaf]);
    } else if (state == STATE_RESTING && scene.litter.columns != 0u) {
        if (leaf_is_settling(leaf) && lies(place.bits)) {
            leaf_drift(leaf);
        } else if (leaf_is_settling(leaf)) {
            leaf_settle_on_litter(leaf);
        }
    } else if (state == STATE_RESTING) {
        leaf_settle(leaf);
    }
}
