// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Appearance of leaves that burn: dry and brown before the front, a glowing rim, char behind it, holes where the char has crumbled.

#import gpu/numbers
#import leaves/species_table

// Leaves of the scene burn: shaders of others are built without it.
override LEAVES_BURN: bool = false;

// Time from the front to where the char has crumbled away, in seconds, on average; and the most as a share of the way.
const CRUMBLING_S: f32 = 1.25;
const MOST_CHAR: f32 = 0.3;
// Widths in metres of tissue that dries and browns before the front, and of what chars there.
const DRYING_M: f32 = 0.012;
const SCORCHED_M: f32 = 0.0035;
// Distance over which the rim dims before the front, where it is still tissue, in metres.
const RIM_M: f32 = 0.00025;
// Unevenness of the front in metres for the whole range of coarse and of fine grain.
const RAGGED_M: vec2<f32> = vec2(0.005, 0.0015);
// Edge of a tile of grain in metres.
const GRAIN_TILE_M: f32 = 0.065;
// Contrast of the rim's light, as the range of its logarithm.
const RIM_CONTRAST: f32 = 8.0;
// Most light of a hot spot relative to the rim's: 100 K hotter.
const MOST_HEAT: f32 = 6.0;
// Way of that unevenness in tiles of grain a second: it smoulders.
const SMOULDER_PER_S: f32 = 0.12;
// Light of sparks in the char relative to the rim's, and how much longer they last.
const SPARKS: f32 = 0.5;
const SPARK_LASTING: f32 = 4.5;
// Reflectance of char, and of the ash on it.
const CHAR: vec3<f32> = vec3(0.022, 0.021, 0.020);
const ASH: vec3<f32> = vec3(0.185, 0.168, 0.150);

// The front of a leaf.
struct Front {
    // Share of its way that it has run; negative where it has none.
    way: f32,
    // Time and length of its whole way.
    whole_s: f32,
    whole_m: f32,
    // 1 while it burns, 0 if it has been put out.
    lit: f32,
}

// Direction out of the crown, and 1 for a leaf at rest.
fn outward_of(record: LeafRecord) -> vec4<f32> {
    let word = record.outward_settled;
    if LEAVES_BURN && (word & BURN_BIT) != 0u {
        return vec4(vec3(0.0), select(0.0, 1.0, (word & BURN_SETTLED_BIT) != 0u));
    }
    return unpack4x8snorm(word);
}

fn front_of(record: LeafRecord) -> Front {
    let word = record.outward_settled;
    if !LEAVES_BURN || (word & BURN_BIT) == 0u {
        return Front(-1.0, 1.0, 1.0, 0.0);
    }
    let pace = unpack2x16float(table.layers[record.layer_slot & LAYER_MASK].burning);
    let edge_m = abs(record.edge_m);
    let lit = select(1.0, 0.0, (word & BURN_OUT_BIT) != 0u);
    return Front(f32(word & 0xffffu) / 65535.0, pace.x * edge_m, pace.y * edge_m, lit);
}

// Arrival before which the char has crumbled. It gains on the front towards the end, so that nothing is left when all has burnt.
fn crumbled_before(front: Front, grain: f32) -> f32 {
    let squared = front.way * front.way;
    let char_share = min(CRUMBLING_S / front.whole_s, MOST_CHAR) * (1.0 - squared * squared);
    return front.way - char_share * (0.35 + 1.3 * grain);
}

// State of a point of a leaf that a front nears or has passed.
struct Tissue {
    // Share of the pixel that is left.
    left: f32,
    // Shares that have dried, have charred and are ash.
    dried: f32,
    charred: f32,
    ash: f32,
    // Light of the rim and of sparks.
    glow: vec3<f32>,
}

// Integral from far before a front to a time behind it of light that rises over `rise_s` and fades.
fn rim_integral(behind_s: f32, rise_s: f32, fade_per_s: vec3<f32>) -> vec3<f32> {
    let before = rise_s * exp(min(behind_s, 0.0) / rise_s);
    return before + (1.0 - exp(-fade_per_s * max(behind_s, 0.0))) / fade_per_s;
}

// A point where a front arrives at share `arrival` of its way; a pixel spans shares of `span`, or what one texel of the picture does. Grain
// is coarse and fine; `draught` makes it glow more or less: all are 0 to 1.
fn tissue_at(front: Front, arrival: f32, span: f32, grain: vec2<f32>, draught: f32) -> Tissue {
    if front.way < 0.0 {
        return Tissue(1.0, 0.0, 0.0, 0.0, vec3(0.0));
    }
    let ragged = arrival + dot(grain - 0.5, RAGGED_M) / front.whole_m;
    let behind = front.way - ragged;
    let behind_s = behind * front.whole_s;
    let ahead_m = -behind * front.whole_m;
    let span_m = span * front.whole_m;
    var out: Tissue;
    out.left = clamp((arrival - crumbled_before(front, 0.45 * grain.y + 0.55 * grain.x)) / span + 0.5, 0.0, 1.0);
    let dried = 1.0 - clamp(ahead_m / (DRYING_M * (0.6 + 0.8 * grain.x)), 0.0, 1.0);
    out.dried = dried * dried * (3.0 - 2.0 * dried);
    out.charred = 1.0 - smoothstep(-0.5 * span_m, SCORCHED_M + 0.5 * span_m, ahead_m);
    let age = behind_s / CRUMBLING_S;
    out.ash = smoothstep(0.3, 1.3, age + 1.2 * (grain.y - 0.5)) * smoothstep(0.3, 0.9, grain.x + 0.2 * age);
    // The mean over the pixel: a rim finer than that is as bright as it is wide.
    let rise_s = RIM_M * front.whole_s / front.whole_m;
    let half_s = 0.5 * span * front.whole_s;
    let fade = FRONT_FADE_PER_S;
    let rim = rim_integral(behind_s + half_s, rise_s, fade) - rim_integral(behind_s - half_s, rise_s, fade);
    let slow = fade / SPARK_LASTING;
    let sparks = rim_integral(behind_s + half_s, rise_s, slow) - rim_integral(behind_s - half_s, rise_s, slow);
    let hot = min(exp(RIM_CONTRAST * (0.6 * draught + 0.25 * grain.x + 0.15 * grain.y - 0.55)), MOST_HEAT);
    let spots = smoothstep(0.62, 0.9, grain.y);
    out.glow = FRONT_RADIANCE * front.lit * (rim * hot + sparks * (SPARKS * spots)) / (2.0 * half_s);
    return out;
}

// Reflectance of tissue that would have `fresh`.
fn burnt_reflectance(tissue: Tissue, fresh: vec3<f32>) -> vec3<f32> {
    let brown = vec3(1.05, 0.62, 0.36) * (0.35 * luminance(fresh) + 0.02);
    let dried = mix(fresh, brown, 0.9 * tissue.dried);
    return mix(dried, mix(CHAR, ASH, tissue.ash), tissue.charred);
}
