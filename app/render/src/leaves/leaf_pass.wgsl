// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves, lit by the sun in front of them and through them.

#import frame/coverage
#import frame/fire_light
#import frame/light
#import leaves/front
#import leaves/shape

// Leaves are painted by what they do: the colour is the mark's, the picture only shows in its veins and spots, and both sides
// are alike, with and against the light.
override IS_PAINTED: bool = false;

struct Varyings {
    @builtin(position) @invariant clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) world: vec3<f32>,
    @location(1) @interpolate(perspective, centroid) normal: vec3<f32>,
    @location(2) @interpolate(perspective, centroid) uv: vec2<f32>,
    @location(3) @interpolate(flat) layer: u32,
    @location(4) @interpolate(flat) attitude: vec4<f32>,
    // Factor on the colour; open sky.
    @location(5) @interpolate(flat) tint_open: vec4<f32>,
    // Direction out of the crown, as far as the leaf is one of its surface; 1, or -1 if the picture is mirrored.
    @location(6) @interpolate(flat) outward_mirror: vec4<f32>,
    @location(7) @interpolate(flat) settled: f32,
    // Values that change little over a leaf: sunlight that the trees let through, and the air's effect on its light.
    @location(8) @interpolate(perspective, centroid) sunlit: f32,
    @location(9) @interpolate(perspective, centroid) air: vec4<f32>,
    // Share of the way that its front has run, time and length of that way, and 1 while it burns.
    @location(10) @interpolate(flat) front: vec4<f32>,
    // Share to which snow lies on it while it hangs.
    @location(11) @interpolate(flat) snowy: f32,
}

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

@vertex
fn vertex(in: LeafVertex) -> Varyings {
    let record = record_of(in);
    let point = blade_point(record, in.level, in.vertex);
    var out: Varyings;
    out.world = point.world;
    out.clip = frame.view_projection * vec4(point.world, 1.0);
    out.normal = point.normal;
    out.uv = point.uv;
    out.layer = record.layer_slot & LAYER_MASK;
    out.attitude = point.attitude;
    let blue_open = unpack2x16float(record.blue_open);
    let outward = outward_of(record);
    // Of leaves on twigs it follows from their place in the crown.
    let is_free = dot(outward.xyz, outward.xyz) == 0.0;
    let open = mix(0.35, 1.0, open_above(point.world, select(0u, SKY_TAPS, is_free)));
    out.tint_open = vec4(unpack2x16float(record.red_green), blue_open * vec2(1.0, open));
    out.outward_mirror = vec4(outward.xyz, point.mirror);
    out.settled = outward.w;
    out.sunlit = tree_shade(point.world).r;
    out.air = air_before(point.world);
    let front = front_of(record);
    out.front = vec4(front.way, front.whole_s, front.whole_m, front.lit);
    out.snowy = select(snow_on_leaves(point.world.xz), 0.0, is_free);
    return out;
}

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

struct Painted {
    @location(0) color: vec4<f32>,
    @builtin(sample_mask) mask: u32,
}

// State of a leaf at a point that its front nears or has passed.
fn burnt_tissue(in: Varyings, arrival: f32, span: f32) -> Tissue {
    let front = Front(in.front.x, in.front.y, in.front.z, in.front.w);
    // Grain lies in the plane of the blade, as large on small leaves, and elsewhere on each.
    let edge_m = front.whole_m / max(unpack2x16float(table.layers[in.layer].burning).y, 0.1);
    let place = in.uv * (edge_m / GRAIN_TILE_M) + in.tint_open.rg * 7.0;
    let draught = textureSample(noise, repeat_sampler, place + SMOULDER_PER_S * front.way * front.whole_s).r;
    return tissue_at(front, arrival, span, textureSample(noise, repeat_sampler, place).ab, draught);
}

@fragment
fn fragment(in: Varyings) -> Painted {
    let image = textureSample(images, image_sampler, in.uv, in.layer);
    let surface = textureSample(surfaces, image_sampler, in.uv, in.layer);
    // A sharp rim at any size: the alpha ramp is made one pixel wide. A leaf of a few texels has no rim: its alpha is the
    // share of the pixel that it covers.
    let size = vec2<f32>(textureDimensions(images));
    let span = max(length(dpdx(in.uv) * size), length(dpdy(in.uv) * size));
    let levels_left = f32(textureNumLevels(images)) - 1.0 - log2(max(span, 1.0));
    let rim = max(fwidth(image.a), mix(1.0, 0.04, smoothstep(4.0, 6.0, levels_left)));
    var alpha = clamp((image.a - 0.5) / rim + 0.5, 0.0, 1.0);
    var tissue: Tissue;
    if LEAVES_BURN {
        tissue = burnt_tissue(in, surface.a, max(fwidth(surface.a), exp2(-levels_left)));
        alpha *= tissue.left;
    }
    let mask = covered(alpha, hash_u32(bitcast<u32>(in.attitude.x) ^ bitcast<u32>(in.attitude.y)));
    if mask == 0u {
        discard;
    }
    let to_eye = normalize(frame.eye_m - in.world);
    let blade = normalize(in.normal);
    let seen = select(-1.0, 1.0, dot(blade, to_eye) > 0.0);
    // Right and up of the picture, in the plane of the blade; ribs stand out more below.
    let right = rotate(in.attitude, vec3(-in.outward_mirror.w, 0.0, 0.0));
    let up = rotate(in.attitude, vec3(0.0, 0.0, 1.0));
    let relief = (surface.xy * 2.0 - 1.0) * select(1.5, 1.0, seen > 0.0);
    let bumped = normalize(blade + relief.x * (right - blade * dot(right, blade)) + relief.y * (up - blade * dot(up, blade)));
    // A crown is lit like a rounded whole as well as leaf by leaf.
    let sheet = bumped * seen;
    let normal = normalize(sheet + in.outward_mirror.xyz);

    var reflectance = blade_color(image.rgb, in.tint_open.rgb);
    // Light that crosses a blade meets its pigments on a longer way: deeper colour for the same lightness.
    let deep = reflectance * sqrt(reflectance);
    var transmittance = deep * (CLEARNESS * surface.z / max(luminance(deep), 0.004)) * mix(1.0, 0.6, in.settled);
    if IS_PAINTED {
        transmittance = 0.4 * reflectance;
    }
    // The underside, seen through its air spaces, is paler.
    if seen < 0.0 && !IS_PAINTED {
        let pale = mix(reflectance, vec3(luminance(reflectance)) * vec3(1.08, 1.05, 0.92), 0.25) * 1.12 + 0.008;
        reflectance = pale;
    }
    // Melted snow soaks what lies: darker, and a film of water on it mirrors as smoothly as wax.
    let wet = wetness(in.world.xz) * in.settled;
    reflectance = wet_reflectance(min(reflectance, vec3(0.8)), wet);
    var wax = 1.0;
    if in.snowy > 0.0 {
        // It lies on what is level first, and thickest in the middle; from below it only keeps the light out.
        let edge = length(in.uv - 0.5) * 0.9 + 0.5 * (unit_from(hash_u32(bitcast<u32>(in.attitude.z))) - 0.5);
        let lies = smoothstep(0.0, 0.25, in.snowy * (0.35 + 0.9 * abs(blade.y)) - 0.75 * edge) * smoothstep(0.15, 0.5, abs(blade.y));
        transmittance *= 1.0 - 0.85 * lies;
        let top = lies * f32(blade.y * seen > 0.0);
        reflectance = mix(reflectance, vec3(0.84, 0.86, 0.89), top);
        wax = 1.0 - top;
    }
    if LEAVES_BURN {
        reflectance = burnt_reflectance(tissue, reflectance);
        transmittance *= (1.0 - 0.6 * tissue.dried) * (1.0 - tissue.charred);
        wax *= 1.0 - 0.85 * tissue.charred;
    }
    transmittance = min(transmittance, MOST - reflectance);

    let light = frame.sun_direction;
    let sun = frame.sun_color * in.sunlit * leaf_shadow(in.world + light * 0.035);
    let facing = dot(normal, light);
    let roughness = mix(select(ROUGHNESS.y, ROUGHNESS.x, seen > 0.0), WET_ROUGHNESS, wet);
    var color = sun * (reflectance * max(facing, 0.0) + transmittance * max(-facing, 0.0));
    color += sun * PI * gloss(sheet, to_eye, light, roughness) * mix(1.0, 0.35, in.settled * (1.0 - wet)) * wax;

    let nearness = mix(1.0, 0.75, in.settled) * in.tint_open.w;
    let ambient = ambient_light_on(normal);
    color += (reflectance * ambient.front + transmittance * ambient.back) * nearness;
    color += reflectance * fire_light(in.world, normal) + transmittance * fire_light(in.world, -normal);
    let again = RECOLLISION * min(length(in.outward_mirror.xyz) / 0.5, 1.0);
    color /= 1.0 - again * (reflectance + transmittance);
    let mirrored = mirrored_share(clamp(dot(sheet, to_eye), 0.0, 1.0)) * nearness;
    color += sky_reflection(reflect(-to_eye, sheet), roughness) * (mirrored * wax);
    if LEAVES_BURN {
        color += tissue.glow;
    }
    return Painted(vec4(color * in.air.a + in.air.rgb, 1.0), mask);
}
