// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Damage of blades by insects and fungi: holes, bites along the rim and dead spots, its own on each leaf. Shares and sizes are set by eye.

#import frame/light
#import leaves/species_table

// Share of leaves that have any, and most marks on one.
const DAMAGED_SHARE: f32 = 0.34;
const MOST_MARKS: u32 = 5u;
// Width of the dead rim of a hole, in edges of the picture.
const DEAD_RIM: f32 = 0.008;
// Colour of dead tissue.
const DEAD: vec3<f32> = vec3(0.150, 0.078, 0.032);

struct Damage {
    // Share of the pixel that is left.
    left: f32,
    // Share of the tissue that is dead.
    dead: f32,
}

// Damage of the leaf of some random word at a place of its picture, of which a pixel spans `span`.
fn damage_at(layer: u32, word: u32, uv: vec2<f32>, span: f32) -> Damage {
    var out = Damage(1.0, 0.0);
    // Plates, seeds and feathers do not dry, and stay whole.
    if table.layers[layer].dryness < 0.0 || unit_from(word) > DAMAGED_SHARE {
        return out;
    }
    let ragged = textureSampleLevel(noise, repeat_sampler, 1.7 * uv + unit_from(hash_u32(word ^ 0x9du)), 0.0);
    let marks = 1u + hash_u32(word ^ 0x3fu) % MOST_MARKS;
    for (var mark = 0u; mark < marks; mark++) {
        let key = hash_u32(word + 0x9e3779b9u * (mark + 1u));
        let size = unit_from(hash_u32(key));
        let kind = key & 3u;
        let is_bite = kind == 0u;
        let angle = unit_from(key) * 6.2831853;
        let reach = select(0.04 + 0.24 * unit_from(hash_u32(key ^ 0x55u)), 0.30 + 0.12 * unit_from(hash_u32(key ^ 0x55u)), is_bite);
        let away = distance(uv, 0.5 + reach * vec2(cos(angle), sin(angle))) + 0.022 * (ragged.r - 0.5) + 0.022 * (ragged.g - 0.5) + 0.010 * (ragged.a - 0.5);
        if kind < 2u {
            let beyond = away - select(0.003 + 0.020 * size * size, 0.014 + 0.036 * size, is_bite);
            out.left = min(out.left, clamp(beyond / span + 0.5, 0.0, 1.0));
            out.dead = max(out.dead, 1.0 - smoothstep(0.3 * DEAD_RIM, DEAD_RIM, beyond));
        } else {
            let radius = 0.003 + 0.010 * size * size;
            out.dead = max(out.dead, 0.9 * (1.0 - smoothstep(radius - 0.003, radius + 0.003 + span, away)));
        }
    }
    return out;
}
