// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Writes where leaves are into their ring of past positions.

#import leaf_records
#import marks/structs

@group(0) @binding(0) var<uniform> trail: TrailUniform;
@group(0) @binding(1) var<storage, read> places: array<Place>;
@group(0) @binding(2) var<storage, read_write> ring: array<TrailSample>;

@compute @workgroup_size(MARKS_GROUP_SIZE)
fn sample(@builtin(global_invocation_id) id: vec3<u32>) {
    let leaf = id.x;
    if leaf >= trail.leaf_count {
        return;
    }
    let base = leaf * trail.sample_count;
    let newest = trail.newest;
    let began = trail.has_begun == 1u;
    let last = ring[base + select(newest, (newest + trail.sample_count - 1u) % trail.sample_count, began)];
    let place = places[leaf];
    if leaf_state(place.bits) == STATE_DORMANT {
        ring[base + newest] = TrailSample(vec3(0.0), NO_PLACE);
        return;
    }
    let last_joint = last.joint_regime & JOINT_MASK;
    let is_near = last_joint != NO_PLACE && distance(place.position, last.position) < trail.break_m;
    // Within one sample a break stays a break until the next sample begins.
    let is_joined = is_near && (began || last_joint != BROKEN);
    let regime = select(0u, 1u + leaf_regime(place.bits), flies(place.bits));
    let joint = select(BROKEN, JOINED, is_joined);
    ring[base + newest] = TrailSample(place.position, joint | (regime << JOINT_REGIME_SHIFT));
}
