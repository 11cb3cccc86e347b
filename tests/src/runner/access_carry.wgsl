// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Petiole among the words of a case: base, orientation at rest, and kind, strength and length.
fn in_petiole(at: u32) -> Petiole {
    let bits = (in_word(at + 7u) << PETIOLE_KIND_SHIFT) | (in_word(at + 8u) << PETIOLE_STRENGTH_SHIFT)
        | (in_word(at + 9u) << PETIOLE_LENGTH_SHIFT);
    return Petiole(in_vec3(at), 0u, in_vec4(at + 3u), vec3<i32>(0), bits);
}
