// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/motion/feature.rs
// The trajectory feature of a leaf: stages, their shares of the fall and their motions.
#import bindings
#import arith/rng

fn stage_weight(words: vec4<u32>, stage: u32) -> u32 {
    let word = select(select(words.z, words.y, stage < 4u), words.x, stage < 2u);
    return ((word >> ((stage & 1u) * 16u)) & 0x1fffu) + 1u;
}

fn stage_end(seed: vec2<u32>, id: u32, fall_q16: u32, stage: u32) -> u32 {
    let words = random(seed, id, STREAM_TIMES);
    var ending = 0u;
    var total = 0u;
    for (var index = 0u; index < STAGE_COUNT; index++) {
        let weight = stage_weight(words, index);
        ending += select(0u, weight, index <= stage);
        total += weight;
    }
    return mul_q16(fall_q16, (ending << 16u) / total);
}

fn transition_count(species: u32, origin: u32, next: u32) -> u32 {
    let index = origin * 6u + next;
    return scene.species[species].transitions[index >> 2u][index & 3u];
}

fn transition_next(species: u32, origin: u32, word: u32) -> u32 {
    var total = 0u;
    for (var candidate = 0u; candidate < 6u; candidate++) {
        total += transition_count(species, origin, candidate);
    }
    let draw = below(word, total);
    var passed = 0u;
    var next = 0u;
    for (var candidate = 0u; candidate < 6u; candidate++) {
        passed += transition_count(species, origin, candidate);
        next += select(0u, 1u, draw >= passed);
    }
    return next;
}

fn stage_words(seed: vec2<u32>, id: u32, stage: u32) -> vec4<u32> {
    return random(seed, id, STREAM_STAGE + stage);
}
