// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/vortex.rs
// A vortex about a straight axis or a curve.
#import bindings
#import arith/math
#import arith/vector

struct NearAxis {
    radial: vec3<f32>,
    axis: vec3<f32>,
}

fn wind_vortex(moment: u32, vortex: u32, place: vec3<f32>) -> vec3<f32> {
    let near = vortex_axis(moment, vortex, place);
    let swirl_m2_s = step_block.moments[moment].vortices[vortex].swirl_m2_s;
    let axial_m3_s = step_block.moments[moment].vortices[vortex].axial_m3_s;
    let core_m2 = step_block.moments[moment].vortices[vortex].core_m2;
    let profile = step_block.moments[moment].vortices[vortex].profile;
    let squared = vec3_dot(near.radial, near.radial);
    let inverse = reciprocal(squared + core_m2);
    if (profile == SWIRL_KAUFMANN) {
        return vec3_cross(near.axis, near.radial) * (inverse * swirl_m2_s) + near.axis * (inverse * axial_m3_s);
    }
    let inv_core = reciprocal(core_m2);
    let share = swirl_profile(profile, step_block.moments[moment].vortices[vortex].widening, squared * inv_core);
    return vec3_cross(near.axis, near.radial) * (share * (inv_core * swirl_m2_s)) + near.axis * (inverse * axial_m3_s);
}

fn vortex_axis(moment: u32, vortex: u32, place: vec3<f32>) -> NearAxis {
    var axis = step_block.moments[moment].vortices[vortex].axis;
    let from_center = place - step_block.moments[moment].vortices[vortex].center_m;
    var radial = from_center - axis * vec3_dot(from_center, axis);
    if (step_block.moments[moment].vortices[vortex].is_curved == 0u) {
        return NearAxis(radial, axis);
    }
    var least = 1e30;
    for (var number = 0u; number < CURVE_SEGMENTS; number += 1u) {
        let node = step_block.moments[moment].vortices[vortex].nodes[number];
        let start = node.place_m;
        let along = step_block.moments[moment].vortices[vortex].nodes[number + 1u].place_m - start;
        let apart = place - start;
        var share = vec3_dot(apart, along) * node.inv_squared;
        if (number != 0u) {
            share = max(share, 0.0);
        }
        if (number + 1u != CURVE_SEGMENTS) {
            share = min(share, 1.0);
        }
        let across = apart - along * share;
        let squared = vec3_dot(across, across);
        if (squared < least) {
            least = squared;
            radial = across;
            axis = along;
        }
    }
    return NearAxis(radial, axis * inverse_sqrt(max(vec3_dot(axis, axis), TINY_SQUARED)));
}

fn swirl_profile(profile: u32, widening: f32, squared: f32) -> f32 {
    if (profile == SWIRL_COMPACT) {
        let left = 1.0 - squared;
        let share = (left * left) * reciprocal(squared * widening + 1.0);
        return select(0.0, share, squared < 1.0);
    }
    let least = max(squared, SWIRL_LEAST_SQUARED);
    if (profile == 0u) {
        return 1.0;
    } else if (profile == 1u) {
        return inverse_sqrt(least);
    }
    return reciprocal(least);
}
