// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/advance.rs
#import bindings
#import leaf/fall
#import leaf/fly
#import leaf/join
#import leaf/release
#import leaf/settle

fn leaf_is_due(leaf: u32) -> bool {
    return step_block.index >= courses[leaf].x;
}

fn leaf_stirs(leaf: u32) -> bool {
    let drift = drifts[leaf];
    return drift.w < environment.settle_steps || ((drift.x | drift.z) << 1u) != 0u;
}

fn leaf_advance_plain(leaf: u32) -> bool {
    let course = courses[leaf];
    if (step_block.index >= course.x) {
        return false;
    }
    let place = places[leaf];
    let state = place.w & STATE_MASK;
    if (state == STATE_FALLING) {
        if (flies(place.w)) {
            return true;
        }
        return leaf_glide(leaf, place, course);
    }
    return state != STATE_RESTING || !leaf_stirs(leaf);
}

fn leaf_advance_due(leaf: u32) {
    let now = step_block.index;
    let identity = identities[leaf];
    let source = (identity.w >> SOURCE_SHIFT) & SOURCE_MASK;
    let lifetime = environment.sources[source].lifetime_steps;
    let state = places[leaf].w & STATE_MASK;
    if (state == STATE_ATTACHED) {
        leaf_detach(leaf, now);
    } else if (state == STATE_DORMANT) {
        leaf_release(leaf, identity.x, source, now);
    } else if (source != SOURCE_TREES && lifetime != 0u && now - identity.y >= lifetime) {
        leaf_release(leaf, identity.x + environment.ids_per_life, source, now);
    }
    let bits = places[leaf].w;
    if ((bits & STATE_MASK) == STATE_FALLING && !flies(bits)) {
        leaf_fall_joining(leaf);
    }
}

fn leaf_advance(leaf: u32) {
    if (leaf_is_due(leaf)) {
        leaf_advance_due(leaf);
        return;
    }
    let bits = places[leaf].w;
    let state = bits & STATE_MASK;
    if (state == STATE_FALLING && !flies(bits)) {
        leaf_fall(leaf);
    } else if (state == STATE_RESTING) {
        leaf_settle(leaf);
    }
}
