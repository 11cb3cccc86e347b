// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The entry point around the statements of a function, and how they reach the words of their case.
@group(2) @binding(0) var<storage, read> cases: array<vec4<u32>>;
@group(2) @binding(1) var<storage, read_write> results: array<vec4<u32>>;

// Vectors of four words in a case.
const CASE_ROWS: u32 = 16u;
var<private> first_row: u32;
var<private> answer: array<vec4<u32>, CASE_ROWS>;

fn in_word(at: u32) -> u32 {
    return cases[first_row + (at >> 2u)][at & 3u];
}

fn in_words(at: u32) -> vec4<u32> {
    return vec4<u32>(in_word(at), in_word(at + 1u), in_word(at + 2u), in_word(at + 3u));
}

fn in_float(at: u32) -> f32 {
    return bitcast<f32>(in_word(at));
}

fn in_vec3(at: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(in_words(at).xyz);
}

fn in_vec4(at: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(in_words(at));
}

fn out_float(at: u32, value: f32) {
    answer[at >> 2u][at & 3u] = bitcast<u32>(value);
}

fn out_vec3(at: u32, value: vec3<f32>) {
    out_float(at, value.x);
    out_float(at + 1u, value.y);
    out_float(at + 2u, value.z);
}

fn out_vec4(at: u32, value: vec4<f32>) {
    out_vec3(at, value.xyz);
    out_float(at + 3u, value.w);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn evaluate(@builtin(global_invocation_id) id: vec3<u32>) {
    first_row = CASE_ROWS * id.x;
    if (first_row >= arrayLength(&cases)) {
        return;
    }
    statements();
    for (var row = 0u; row < CASE_ROWS; row++) {
        results[first_row + row] = answer[row];
    }
}
