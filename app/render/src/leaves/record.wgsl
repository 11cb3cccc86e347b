// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// A leaf that is drawn, ready for its corners: 48 bytes, written by `leaf_cull.wgsl`.

struct LeafRecord {
    // Middle of the blade; edge of its picture in metres, negative if the picture is mirrored.
    place: vec4<f32>,
    // Attitude as four signed halves; stage of drying and fold; bend and twist.
    form: vec4<u32>,
    // Layer, and slot of its page from SLOT_SHIFT on; red and green, blue and open sky: factors on the colour; direction out of the crown, as far as the leaf is one
    // of its surface, and how far it has come to rest.
    look: vec4<u32>,
}

// What shares the first word of a look.
const SLOT_SHIFT: u32 = 12u;
const LAYER_MASK: u32 = 0xfffu;

// A leaf at rest lies on what has fallen before it: how high its lowest point lies over the ground, in metres.
const LITTER_M: f32 = 0.005;

fn quaternion_product(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}
