// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/terrain/snow_print.rs
// Prints in snow: things that move press it down to their undersides.
#import arith/quaternion
#import bindings
#import solid/shape
#import terrain/snow

fn snow_is_pressed(step: u32) -> bool {
    return step % PRESS_INTERVAL == PRESS_FIRST;
}

fn may_press(mover: MoverBlock, x: f32, z: f32) -> bool {
    let apart_x = x - mover.center_m.x;
    let apart_z = z - mover.center_m.z;
    return apart_x * apart_x + apart_z * apart_z < mover.bound_m * mover.bound_m;
}

fn underside(solid: SolidAt, x: f32, z: f32, low: f32, high: f32) -> f32 {
    var y = low;
    for (var probe = 0u; probe < UNDERSIDE_PROBES; probe++) {
        let inner = quat_rotate_back(solid.turn, vec3<f32>(x, y, z) - solid.center);
        let distance = core_distance(solid, inner).distance_m;
        if (distance < UNDERSIDE_REACHED_M || high <= y) {
            return min(y, high);
        }
        y += distance;
    }
    return high;
}

fn snow_pressed(solid: SolidAt, x: f32, z: f32, floor_m: f32, cell: SnowCell) -> SnowCell {
    if ((solid.flags & (SOLID_HULL | SOLID_GRID)) != 0u) {
        return cell;
    }
    let least = min(u32(floor(f32(cell.water) * TRODDEN_DEPTH)), cell.depth);
    let low = floor_m + f32(least) * SNOW_DEPTH_M;
    let high = floor_m + f32(cell.depth) * SNOW_DEPTH_M;
    let under = underside(solid, x, z, low, high);
    if (high <= under) {
        return cell;
    }
    let depth = u32(floor(max(under - low, 0.0) * (1.0 / SNOW_DEPTH_M)));
    return SnowCell(cell.water, min(least + depth, cell.depth));
}
