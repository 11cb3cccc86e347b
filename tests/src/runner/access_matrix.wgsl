// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Matrices among the words of a case: six words of a symmetric one, nine of another.
fn in_sym3(at: u32) -> Sym3 {
    return Sym3(in_vec3(at), in_vec3(at + 3u));
}

fn in_mat3(at: u32) -> Mat3 {
    return Mat3(in_vec3(at), in_vec3(at + 3u), in_vec3(at + 6u));
}

fn out_sym3(at: u32, value: Sym3) {
    out_vec3(at, value.diagonal);
    out_vec3(at + 3u, value.off);
}

fn out_mat3(at: u32, value: Mat3) {
    out_vec3(at, value.x);
    out_vec3(at + 3u, value.y);
    out_vec3(at + 6u, value.z);
}
