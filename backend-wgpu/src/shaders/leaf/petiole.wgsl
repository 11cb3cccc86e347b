// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/petiole.rs
// Constants of the leaf slots that belong to trees.
#import bindings

fn petiole_strength(bits: u32) -> u32 {
    return (bits >> PETIOLE_STRENGTH_SHIFT) & PETIOLE_STRENGTH_MASK;
}

fn petiole_kind(bits: u32) -> u32 {
    return (bits >> PETIOLE_KIND_SHIFT) & PETIOLE_KIND_MASK;
}

fn petiole_length(bits: u32) -> f32 {
    return f32((bits >> PETIOLE_LENGTH_SHIFT) & PETIOLE_LENGTH_MASK) * PETIOLE_LENGTH_UNIT;
}

fn petiole_cluster(bits: u32) -> u32 {
    return bits >> PETIOLE_CLUSTER_SHIFT;
}

fn petiole_of(slot: u32) -> Petiole {
    let first = scene.first_petiole_row + slot * PETIOLE_ROWS;
    let base = tables[first];
    let blade = tables[first + 2u];
    return Petiole(
        bitcast<vec3<f32>>(base.xyz),
        base.w,
        bitcast<vec4<f32>>(tables[first + 1u]),
        bitcast<vec3<i32>>(blade.xyz),
        blade.w,
    );
}
