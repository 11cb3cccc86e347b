// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/land_flakes.rs
// Gives the water of the flakes that landed in a step to the snow.
#import particle/flake_bindings
#import particle/record
#import terrain/snow
#import tree/branch_fall
#import tree/branch_snow

// The tables, behind which the snow is: nothing else of them is written.
@group(0) @binding(2) var<storage, read_write> table_words: array<atomic<u32>>;

fn snow_word(plane: u32, cell: u32) -> u32 {
    let cells = scene.snow.columns * scene.snow.lines;
    return scene.litter.first_row * 4u + scene.snow.first_word + plane * cells + cell;
}

fn open_above(cell: u32) -> f32 {
    return snow_floor(0u, atomicLoad(&table_words[scene.snow.first_row * 4u + 2u * cell + 1u])).open;
}

fn fall(cell: u32, water: u32) {
    atomicAdd(&table_words[snow_word(SNOW_LANDED, cell)], water);
    if (open_above(cell) < 0.0) {
        atomicAdd(&table_words[snow_word(SNOW_MELTED, cell)], water);
        return;
    }
    atomicAdd(&table_words[snow_word(SNOW_WATER, cell)], water);
    atomicAdd(&table_words[snow_word(SNOW_DEPTH, cell)], fresh_depth(water));
}

fn land(middle: u32, water: u32) {
    var left = water;
    for (var part = 0u; part < FLAKE_CELLS * FLAKE_CELLS; part++) {
        let cell = flake_cell(middle, part);
        if (cell != NEVER && cell != middle) {
            let share = flake_share(water, part);
            fall(cell, share);
            left -= share;
        }
    }
    fall(middle, left);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn land_flakes(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= flake_run.count) {
        return;
    }
    let flake = flake_run.first + id.x;
    let place = flake_places[flake];
    if ((scene.populations[particle_population(place.bits)].flags & POPULATION_BRANCH_SNOW) != 0u) {
        if ((place.bits & PARTICLE_DIED) != 0u) {
            let falling = scene.litter.first_row * 4u + fall_word(flake_traits[flake].id);
            let inside = snow_inside(place.position.x, place.position.z);
            land(snow_cell(inside.x, inside.y), atomicExchange(&table_words[falling], 0u));
        }
        return;
    }
    let landed = PARTICLE_DIED | PARTICLE_HIT;
    if ((place.bits & landed) != landed) {
        return;
    }
    let middle = snow_cell(place.position.x, place.position.z);
    if (middle == NEVER) {
        return;
    }
    let water = scene.snow.flake_water;
    let open = open_above(middle);
    if (flake_is_caught(place.position.x, place.position.z, open)) {
        let square = crown_square(crown_cell(middle));
        let pool = crown_pool(step_block.index);
        let bed = scene.litter.first_row * 4u;
        atomicAdd(&table_words[bed + crown_word(square, pool)], water);
        atomicAdd(&table_words[bed + crown_word(square, pool + 1u)], water);
        return;
    }
    land(middle, water);
}
