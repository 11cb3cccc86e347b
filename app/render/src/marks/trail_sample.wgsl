// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Writes where leaves are into their ring of past positions. `Trail` is laid out by `trail_pass.rs`.

struct Trail {
    // Leaves, samples per leaf, newest sample, 1 when the newest sample only just began.
    counts: vec4<u32>,
    // Farthest a leaf goes between two frames in metres; age of the sample before the newest, interval, both relative
    // to the trail's length; half width in metres.
    shape: vec4<f32>,
}

@group(0) @binding(0) var<uniform> trail: Trail;
@group(0) @binding(1) var<storage, read> places: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> ring: array<vec4<f32>>;

// w of a sample: 0 nothing here, 1 a place, 2 a place that is not joined to the one before it; of a body in the air, four
// for every regime up to its own on top of this.
@compute @workgroup_size(64)
fn sample(@builtin(global_invocation_id) id: vec3<u32>) {
    let leaf = id.x;
    if leaf >= trail.counts.x {
        return;
    }
    let base = leaf * trail.counts.y;
    let newest = trail.counts.z;
    let began = trail.counts.w == 1u;
    let last = ring[base + select(newest, (newest + trail.counts.y - 1u) % trail.counts.y, began)];
    let record = places[leaf];
    if (record.w & STATE_MASK) == STATE_DORMANT {
        ring[base + newest] = vec4(0.0);
        return;
    }
    let place = bitcast<vec3<f32>>(record.xyz);
    let joined = last.w > 0.0 && distance(place, last.xyz) < trail.shape.x;
    // Within one sample a break stays a break until the next sample begins.
    let broken = !joined || (!began && last.w % 4.0 > 1.5);
    let flying = STATE_FALLING | (AERODYNAMIC << PRIMITIVE_SHIFT);
    let is_body = (record.w & (STATE_MASK | (PRIMITIVE_MASK << PRIMITIVE_SHIFT))) == flying;
    let regime = select(0u, 1u + ((record.w >> REGIME_SHIFT) & REGIME_MASK), is_body);
    ring[base + newest] = vec4(place, select(1.0, 2.0, broken) + 4.0 * f32(regime));
}
