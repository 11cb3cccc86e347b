// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/wind/vortex.rs
#import bindings
#import kernel/math
#import kernel/vector

fn wind_vortex(vortex: u32, place: vec3<f32>) -> vec3<f32> {
    let center = step_block.vortices[vortex].center;
    let axis_and_swirl = step_block.vortices[vortex].axis;
    let axis = vec3<f32>(axis_and_swirl.x, axis_and_swirl.y, axis_and_swirl.z);
    let from_center = place - vec3<f32>(center.x, center.y, center.z);
    let radial = from_center - axis * vec3_dot(from_center, axis);
    let inverse = reciprocal(vec3_dot(radial, radial) + center.w);
    return vec3_cross(axis, radial) * (inverse * axis_and_swirl.w)
        + axis * (inverse * step_block.vortices[vortex].axial.x);
}
