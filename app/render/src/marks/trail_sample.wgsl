// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Writes where leaves are into their ring of past positions.

#import leaf_records
#import marks/structs

@group(0) @binding(0) var<uniform> trail: TrailUniform;
@group(0) @binding(1) var<storage, read> places: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> ring: array<vec4<f32>>;

// w of a sample: 0 nothing here, 1 a place, 2 a place that is not joined to the one before it; of a body in the air, four
// for every regime up to its own on top of this.
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
    let record = places[leaf];
    if (record.w & STATE_MASK) == STATE_DORMANT {
        ring[base + newest] = vec4(0.0);
        return;
    }
    let place = bitcast<vec3<f32>>(record.xyz);
    let joined = last.w > 0.0 && distance(place, last.xyz) < trail.break_m;
    // Within one sample a break stays a break until the next sample begins.
    let broken = !joined || (!began && last.w % 4.0 > 1.5);
    let flying = STATE_FALLING | (AERODYNAMIC << PRIMITIVE_SHIFT);
    let is_body = (record.w & (STATE_MASK | (PRIMITIVE_MASK << PRIMITIVE_SHIFT))) == flying;
    let regime = select(0u, 1u + ((record.w >> REGIME_SHIFT) & REGIME_MASK), is_body);
    ring[base + newest] = vec4(place, select(1.0, 2.0, broken) + 4.0 * f32(regime));
}
