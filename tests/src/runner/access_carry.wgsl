// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// What holds a leaf among the words of a case: base, rest, and kind, class and reach of the facts.
fn in_petiole(at: u32) -> Petiole {
    let facts = (in_word(at + 7u) << PETIOLE_KIND_SHIFT) | (in_word(at + 8u) << PETIOLE_CLASS_SHIFT)
        | (in_word(at + 9u) << PETIOLE_REACH_SHIFT);
    return Petiole(in_vec3(at), 0u, in_vec4(at + 3u), facts);
}
