// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/branch_fall.rs
// Snow that falls from branches as particles.
#import bindings
#import solid/shape
#import tree/branch_snow

fn fall_word(row: u32) -> u32 {
    return branch_word(scene.snow.branches) + CROWN_WORDS * crown_squares() + row;
}

fn falls_as_particle(lost: u32, falling: u32) -> bool {
    return scene.snow.fall_slots != 0u && lost >= LEAST_FALL && falling == 0u;
}

fn fall_row(particle: u32) -> u32 {
    for (var row = particle; row < scene.snow.branches; row += scene.snow.fall_slots) {
        let place = fall_word(row);
        if (tables[scene.litter.first_row + (place >> 2u)][place & 3u] != 0u) {
            return row;
        }
    }
    return NEVER;
}

fn fall_start(row: u32) -> vec3<f32> {
    return row_vector(tables[scene.snow.first_branch_row + scene.snow.branches + row]);
}
