// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/measure.rs
// Counts leaves by state and motion.
#import bindings
#import leaf/record

@group(1) @binding(0) var<storage, read_write> counters: array<atomic<u32>>;

var<workgroup> local_counters: array<atomic<u32>, COUNTER_COUNT>;

fn count_leaf(place: Place) {
    let state = leaf_state(place.bits);
    atomicAdd(&local_counters[state], 1u);
    if (state == STATE_FALLING) {
        let motion = leaf_primitive(place.bits);
        let counter =
            select(COUNTER_PRIMITIVE + motion, COUNTER_REGIME + leaf_regime(place.bits), motion == AERODYNAMIC);
        atomicAdd(&local_counters[counter], 1u);
    }
    let bits = bitcast<vec3<u32>>(place.position) & vec3<u32>(0x7fffffffu);
    if (bits.x >= INFINITY_BITS || bits.y >= INFINITY_BITS || bits.z >= INFINITY_BITS) {
        atomicAdd(&local_counters[COUNTER_BROKEN], 1u);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn measure(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_id) local_id: vec3<u32>,
) {
    if (local_id.x < COUNTER_COUNT) {
        atomicStore(&local_counters[local_id.x], 0u);
    }
    workgroupBarrier();
    if (id.x < arrayLength(&places)) {
        count_leaf(places[id.x]);
    }
    workgroupBarrier();
    if (local_id.x < COUNTER_COUNT) {
        let counted = atomicLoad(&local_counters[local_id.x]);
        if (counted > 0u) {
            atomicAdd(&counters[local_id.x], counted);
        }
    }
}
