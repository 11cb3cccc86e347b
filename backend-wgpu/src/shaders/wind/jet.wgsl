// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/jet.rs
// Round turbulent jets, which turn along the ground that they meet.
#import bindings
#import arith/math
#import arith/vector
#import wind/profile

struct JetPart {
    velocity: vec3<f32>,
    width: f32,
}

fn jet_along_axis(moment: u32, jet: u32, place: vec3<f32>) -> JetPart {
    let axis = step_block.moments[moment].jets[jet].axis;
    let heading = step_block.moments[moment].jets[jet].heading;
    let from_nozzle = place - step_block.moments[moment].jets[jet].nozzle_m;
    let along = vec3_dot(from_nozzle, axis);
    let past = max(along - step_block.moments[moment].jets[jet].turn_start_m, 0.0);
    let turn = min(past * step_block.moments[moment].jets[jet].turns_per_m, 1.0);
    let bent = turn * (past - turn * step_block.moments[moment].jets[jet].half_turn_m);
    let radial = (from_nozzle - axis * along) - step_block.moments[moment].jets[jet].bend * bent;
    let grown = along * JET_SPREAD;
    let width = max(grown, step_block.moments[moment].jets[jet].width_m);
    let half_growth = select(0.0, 0.5 * JET_SPREAD, step_block.moments[moment].jets[jet].width_m < grown);
    let width_squared = width * width;
    let squared = vec3_dot(radial, radial);
    let inverse = reciprocal(squared + width_squared);
    let share = min(max(along * step_block.moments[moment].jets[jet].diameters_per_m + 1.0, 0.0), 1.0);
    let level = (inverse * inverse) * (share * step_block.moments[moment].jets[jet].strength_m2_s);
    let forward = level * (width * width_squared);
    let outward = (level * half_growth) * (width_squared - squared);
    return JetPart((axis + (heading - axis) * turn) * forward + radial * outward, width);
}

fn jet_along_ground(moment: u32, jet: u32, place: vec3<f32>) -> JetPart {
    let from_middle = place - step_block.moments[moment].jets[jet].middle_m;
    let squared = from_middle.x * from_middle.x + from_middle.z * from_middle.z;
    let reach_squared = squared + step_block.moments[moment].jets[jet].middle_m2;
    let inverse_reach = inverse_sqrt(reach_squared);
    let height = (reach_squared * inverse_reach) * WALL_JET_SPREAD;
    let inverse_rim = inverse_sqrt(height * height + from_middle.y * from_middle.y);
    let low = height * inverse_rim;
    let within = from_middle.y * inverse_rim;
    let inverse_squared = inverse_reach * inverse_reach;
    let outward = (inverse_squared * step_block.moments[moment].jets[jet].wall_m2_s) * (low * (low * low));
    let rise = (squared * inverse_squared) * (within * (low * low - 1.0))
        - within * ((inverse_squared * step_block.moments[moment].jets[jet].middle_m2) * 2.0);
    let up = (inverse_reach * (step_block.moments[moment].jets[jet].wall_m2_s * WALL_JET_SPREAD)) * rise;
    return JetPart(vec3<f32>(from_middle.x * outward, up, from_middle.z * outward), height);
}

fn wind_jet(moment: u32, jet: u32, place: vec3<f32>, above: f32) -> vec3<f32> {
    let part = jet_along_axis(moment, jet, place);
    let wall = jet_along_ground(moment, jet, place);
    let velocity = part.velocity + wall.velocity;
    let level = wind_profile(above).y;
    let layer = wind_profile(max(part.width, wall.width) * JET_LAYER).y;
    let slowed = min(level * reciprocal(layer), 1.0);
    return vec3<f32>(velocity.x * slowed, velocity.y * wind_vertical(above), velocity.z * slowed);
}
