// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Keys by which particles are drawn: layer by layer, and within a layer from far to near.

#import gpu/sort_pair
#import particles/bindings

@group(0) @binding(0) var<uniform> drawn: ParticleUniform;
@group(0) @binding(1) var<storage, read_write> pairs: array<SortPair>;
@group(0) @binding(2) var<storage, read> places: array<ParticlePlace>;
@group(0) @binding(3) var<storage, read> populations: array<PopulationLook>;
@group(0) @binding(4) var<storage, read_write> seen_count: atomic<u32>;

// Key of what is not drawn: behind all others.
const NOT_DRAWN: u32 = 0xffffffffu;
// Bits of the distance in a key, below those of the layer.
const DISTANCE_BITS: u32 = 28u;

@compute @workgroup_size(LIST_THREADS)
fn list(@builtin(global_invocation_id) id: vec3<u32>) {
    let slot = id.x;
    if slot >= drawn.pairs {
        return;
    }
    if slot >= drawn.count {
        pairs[slot] = SortPair(NOT_DRAWN, slot);
        return;
    }
    let place = places[slot];
    let look = populations[particle_population(place.bits)];
    let depth_m = dot(place.position - drawn.eye_m, drawn.forward);
    var key = NOT_DRAWN;
    if is_there(place.bits) && look_kind(look) != LOOK_HIDDEN {
        // Bits of positive numbers are in the order of the numbers. What is behind the camera is clipped; a mirror may show it.
        let nearness = (0x7fffffffu - bitcast<u32>(max(depth_m, 0.0))) >> (31u - DISTANCE_BITS);
        key = (look.layer << DISTANCE_BITS) | nearness;
        atomicAdd(&seen_count, 1u);
    }
    pairs[slot] = SortPair(key, slot);
}
