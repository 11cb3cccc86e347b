// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/advance.rs
#import bindings
#import leaf/fall
#import leaf/release
#import leaf/settle

fn leaf_advance(leaf: u32) {
    let now = step_block.index.x;
    if (now >= courses[leaf].x) {
        let identity = identities[leaf];
        let source = (identity.w >> SOURCE_SHIFT) & SOURCE_MASK;
        let lifetime = environment.sources[source].timing.w;
        if ((places[leaf].w & STATE_MASK) == STATE_DORMANT) {
            leaf_release(leaf, identity.x, source, now);
        } else if (lifetime != 0u && now - identity.y >= lifetime) {
            leaf_release(leaf, identity.x + environment.seed.z, source, now);
        }
    }
    let state = places[leaf].w & STATE_MASK;
    if (state == STATE_FALLING) {
        leaf_fall(leaf);
    } else if (state == STATE_RESTING) {
        leaf_settle(leaf);
    }
}
