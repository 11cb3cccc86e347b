// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/vortex.rs
// A straight vortex with a smooth core (Kaufmann).
#import bindings
#import arith/math
#import arith/vector

fn wind_vortex(moment: u32, vortex: u32, place: vec3<f32>) -> vec3<f32> {
    let axis = step_block.moments[moment].vortices[vortex].axis;
    let from_center = place - step_block.moments[moment].vortices[vortex].center_m;
    let radial = from_center - axis * vec3_dot(from_center, axis);
    let inverse = reciprocal(vec3_dot(radial, radial) + step_block.moments[moment].vortices[vortex].core_m2);
    return vec3_cross(axis, radial) * (inverse * step_block.moments[moment].vortices[vortex].swirl_m2_s)
        + axis * (inverse * step_block.moments[moment].vortices[vortex].axial_m3_s);
}
