// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Light on leaves and through them, as all pictures of leaves share it.

#import frame/coverage
#import frame/fire_light
#import frame/light
#import leaves/front
#import leaves/shape

// Leaves are painted by what they do: the colour is the mark's, the picture only shows in its veins and spots, and both sides
// are alike, with and against the light.
override IS_PAINTED: bool = false;

// Roughness (GGX alpha is its square) of the waxy upper and the dull lower side; reflectance of wax head-on.
const ROUGHNESS: vec2<f32> = vec2(0.42, 0.62);
const WAX: f32 = 0.04;
// Roughness of a leaf with a film of water on it: set by eye.
const WET_ROUGHNESS: f32 = 0.28;
// Share that an uneven sheet mirrors at a slant, set by eye; the rest it mirrors onto itself.
const SLANTED: f32 = 0.25;
// Chance that light which leaves a leaf of a crown meets another one (recollision probability of Smolander and Stenberg,
// 2005), for leaves that the sky can see; the value is set by eye.
const RECOLLISION: f32 = 0.55;
// Light that a blade lets through for each unit that its map says: set by eye.
const CLEARNESS: f32 = 1.6;
// Most light that leaves a blade on both sides together.
const MOST: f32 = 0.94;

// Share that wax mirrors of light that meets it at an angle of this cosine (Schlick).
fn mirrored_share(cosine: f32) -> f32 {
    let slant = 1.0 - cosine;
    return WAX + (SLANTED - WAX) * (slant * slant) * (slant * slant) * slant;
}

// GGX distribution with Smith's visibility and Schlick's Fresnel term, times the cosine at the light.
fn gloss(normal: vec3<f32>, to_eye: vec3<f32>, to_light: vec3<f32>, roughness: f32) -> f32 {
    let half_way = normalize(to_light + to_eye);
    let nl = max(dot(normal, to_light), 0.0);
    let nv = max(dot(normal, to_eye), 0.02);
    let nh = max(dot(normal, half_way), 0.0);
    let alpha = roughness * roughness;
    let a2 = alpha * alpha;
    let lobe = nh * nh * (a2 - 1.0) + 1.0;
    let visible = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2) + 1.0e-4);
    return a2 / (PI * lobe * lobe) * visible * mirrored_share(max(dot(to_eye, half_way), 0.0)) * nl;
}

fn blade_color(image: vec3<f32>, tint: vec3<f32>) -> vec3<f32> {
    if IS_PAINTED {
        return tint * mix(0.75, 1.0, clamp(3.0 * luminance(image), 0.0, 1.0));
    }
    return image * tint;
}

// Random word of a leaf, which its attitude makes.
fn leaf_random(record: LeafRecord) -> u32 {
    return hash_u32(record.attitude_xy ^ hash_u32(record.attitude_zw));
}

// Reflectance of a blade seen from below, through its air spaces.
fn pale(reflectance: vec3<f32>) -> vec3<f32> {
    return mix(reflectance, vec3(luminance(reflectance)) * vec3(1.08, 1.05, 0.92), 0.25) * 1.12 + 0.008;
}

// Transmittance of a blade of some reflectance, as clear as its map says: light that crosses it meets its pigments on a longer way, deeper
// colour for the same lightness.
fn crossing(reflectance: vec3<f32>, clear: f32, settled: f32) -> vec3<f32> {
    if IS_PAINTED {
        return 0.4 * reflectance;
    }
    let deep = reflectance * sqrt(reflectance);
    return deep * (CLEARNESS * clear / max(luminance(deep), 0.004)) * mix(1.0, 0.6, settled);
}

// Share to which snow lies on a blade at some distance from its middle in edges, where `snowy` of leaves carry it: on what is level first,
// and thickest in the middle.
fn snow_on_blade(snowy: f32, level: f32, away: f32, random: f32) -> f32 {
    let edge = away * 0.9 + 0.5 * (random - 0.5);
    return smoothstep(0.0, 0.25, snowy * (0.35 + 0.9 * level) - 0.75 * edge) * smoothstep(0.15, 0.5, level);
}

const SNOW_COLOR: vec3<f32> = vec3(0.84, 0.86, 0.89);

struct Painted {
    @location(0) color: vec4<f32>,
    @builtin(sample_mask) mask: u32,
}

// Halvings of a leaf's picture that are left above one whose texels are as wide as a pixel.
fn halvings_left(uv: vec2<f32>) -> f32 {
    let size = vec2<f32>(textureDimensions(images));
    let span = max(length(dpdx(uv) * size), length(dpdy(uv) * size));
    return f32(textureNumLevels(images)) - 1.0 - log2(max(span, 1.0));
}

// Share of a pixel that a blade covers. A sharp rim at any size: the alpha ramp is made one pixel wide. A leaf of a few texels has no
// rim: its alpha is the share of the pixel that it covers.
fn blade_cover(alpha: f32, uv: vec2<f32>) -> f32 {
    let rim = max(fwidth(alpha), mix(1.0, 0.04, smoothstep(4.0, 6.0, halvings_left(uv))));
    return clamp((alpha - 0.5) / rim + 0.5, 0.0, 1.0);
}
