// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/flight/body.rs
// A leaf as a body under the air's forces: its species' block, scaled to its size and made asymmetric.
#import bindings
#import arith/math
#import leaf/record

struct LeafBody {
    size_ratio: f32,
    inv_size_ratio: f32,
    air_per_m: f32,
    added_mass: f32,
    air_along: f32,
    air_across: f32,
    half_along_m: f32,
    half_across_m: f32,
    half_mean_m: f32,
    twist_m: f32,
    screw_m: f32,
    viscous_m_s: f32,
    lift_slope_across: f32,
    lift_slope_along: f32,
    pitch_damping: f32,
    edge_drag: f32,
    resistance: f32,
    inv_inertia: vec3<f32>,
    gyration: vec3<f32>,
    centroid: vec3<f32>,
}

fn body_of(bits: u32, size: u32) -> LeafBody {
    let block = scene.bodies[leaf_species(bits)];

    let ratio = size_ratio(size);
    let inv_size_ratio = reciprocal(ratio);
    let x = block.inertia_m2.x + block.air_inertia_x_m2 * ratio;
    let y = block.inertia_m2.y;
    let z = block.inertia_m2.z + block.air_inertia_z_m2 * ratio;
    let inv_inertia = vec3<f32>(reciprocal(x), reciprocal(y), reciprocal(z));
    let gyration = vec3<f32>(
        ((y - z) * inv_inertia.x) * inv_size_ratio,
        ((z - x) * inv_inertia.y) * inv_size_ratio,
        ((x - y) * inv_inertia.z) * inv_size_ratio,
    );
    let centroid = vec3<f32>(
        block.centroid_m.x + asymmetry(size, 0u) * block.centroid_spread_m.x,
        block.centroid_m.y + asymmetry(size, 1u) * block.centroid_spread_m.y,
        block.centroid_m.z + asymmetry(size, 2u) * block.centroid_spread_m.z,
    );
    let narrow = block.half_across_m * reciprocal(block.half_along_m);
    let added = block.added_mass * ratio;
    let swing = (centroid.x * centroid.x) * inv_inertia.z + (centroid.z * centroid.z) * inv_inertia.x;
    return LeafBody(
        ratio,
        inv_size_ratio,
        block.air_per_m,
        block.added_mass,
        block.air_along,
        block.air_across,
        block.half_along_m,
        block.half_across_m,
        block.half_mean_m,
        block.twist_m + asymmetry(size, 3u) * block.twist_spread_m,
        block.twist_m * (narrow * narrow),
        (reciprocal(block.half_mean_m) * inv_size_ratio) * DAMPING_VISCOUS_M2_S,
        block.lift_slope_across,
        block.lift_slope_along,
        block.pitch_damping,
        block.edge_drag,
        added * reciprocal((added + added * swing) + 1.0),
        inv_inertia,
        gyration,
        centroid,
    );
}
