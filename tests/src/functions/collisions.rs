// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of collisions between leaves.

use windfall_core::device::leaf::collide::{
    COLLISION_WORDS, CollisionCell, Collisions, collision_cell, collisions_of, own_sums,
};
use windfall_core::device::leaf::record::{SIZE_ONE, SPECIES_SHIFT};

use super::{Function, Input, floats, functions, integers, vector};

const SPECIES: Input = Input::Below(2);
const SIZE: Input = Input::Below(8192);
const PLACE: Input = Input::Floats(3, -4.0, 4.0);
const WITHIN: Input = Input::Floats(3, 0.0, 1.0);
const FLOW: Input = Input::Floats(3, -3.0, 3.0);
const FAST: Input = Input::Floats(3, -200.0, 200.0);

functions! {
    COLLISION_FUNCTIONS;

    own_sums in "leaf/collide" (SPECIES, SIZE, PLACE, FAST) tolerance Some(1e-4);
    wgsl "let cell = collision_cell(in_vec3(2u));
        let sums = own_sums(cell, a.x << SPECIES_SHIFT, SIZE_ONE - 4096u + a.y, in_vec3(5u));
        r = vec4<u32>(cell.index, sums.count, sums.key, sums.weight);
        s = vec4<u32>(sums.area, sums.momentum);
        answer[2] = vec4<u32>(sums.energy, sums.place); answer[3].x = sums.virial;";
    rust |cx, w| {
        let cell = collision_cell(cx, vector(w, 2));
        let sums = own_sums(cx, &cell, w[0] << SPECIES_SHIFT, SIZE_ONE - 4096 + w[1], vector(w, 5));
        let ([px, py, pz], [x, y, z]) = (sums.momentum, sums.place);
        integers([
            cell.index, sums.count, sums.key, sums.weight, sums.area, px, py, pz, sums.energy, x, y, z,
            sums.virial,
        ])
    };

    collisions_of in "leaf/collide" (SPECIES, SIZE, PLACE, FLOW, WITHIN, FLOW) tolerance Some(2e-3);
    wgsl "let bits = a.x << SPECIES_SHIFT; let size = SIZE_ONE - 4096u + a.y;
        let cell = collision_cell(in_vec3(2u));
        let other = CollisionCell(cell.index, cell.key, in_vec3(8u));
        let one = own_sums(cell, bits, size, in_vec3(5u));
        let two = own_sums(other, bits, size, in_vec3(11u));
        let sums = CollisionSums(
            one.count + two.count, one.key + two.key, one.weight + two.weight, one.area + two.area,
            one.momentum + two.momentum, one.energy + two.energy, one.place + two.place,
            one.virial + two.virial,
        );
        let c = collisions_of(cell, sums);
        out_vec3(0u, c.velocity); out_float(3u, c.share);";
    rust |cx, w| {
        let (bits, size) = (w[0] << SPECIES_SHIFT, SIZE_ONE - 4096 + w[1]);
        let cell = collision_cell(cx, vector(w, 2));
        let other = CollisionCell { within: vector(w, 8), ..cell };
        let one: [u32; COLLISION_WORDS as usize] =
            bytemuck::cast(own_sums(cx, &cell, bits, size, vector(w, 5)));
        let two: [u32; COLLISION_WORDS as usize] =
            bytemuck::cast(own_sums(cx, &other, bits, size, vector(w, 11)));
        let sums: [u32; COLLISION_WORDS as usize] =
            std::array::from_fn(|word| one[word].wrapping_add(two[word]));
        let Collisions { velocity, share } = collisions_of(cx, &cell, &bytemuck::cast(sums));
        floats([velocity.x, velocity.y, velocity.z, share])
    };
}
