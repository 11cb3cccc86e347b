// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Trails as ribbons that face the camera and fade with age.

#import frame/light
#import marks/structs

@group(2) @binding(0) var<uniform> trail: TrailUniform;
@group(2) @binding(1) var<storage, read> ring: array<TrailSample>;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) color: vec4<f32>,
    @location(1) @interpolate(perspective, centroid) across: f32,
}

fn sample_at(leaf: u32, age: u32) -> TrailSample {
    let count = trail.sample_count;
    return ring[leaf * count + (trail.newest + count - min(age, count - 1u)) % count];
}

// Colours of the regimes of bodies, as `windfall flight` draws them: steady, flutter, tumble, chaotic, helical, spiral,
// autorotation.
const REGIMES = array<vec3<f32>, 7>(
    vec3(0.19, 0.22, 0.24),
    vec3(0.02, 0.20, 0.43),
    vec3(0.73, 0.27, 0.01),
    vec3(0.49, 0.04, 0.03),
    vec3(0.04, 0.26, 0.08),
    vec3(0.22, 0.08, 0.37),
    vec3(0.76, 0.17, 0.39),
);

// NO_PLACE, JOINED or BROKEN.
fn joint(sample: TrailSample) -> u32 {
    return sample.joint_regime & JOINT_MASK;
}

fn hue(at: f32) -> vec3<f32> {
    return clamp(abs(fract(at + vec3(1.0, 0.6666667, 0.3333333)) * 6.0 - 3.0) - 1.0, vec3(0.0), vec3(1.0));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) leaf: u32) -> Varyings {
    // Two triangles a segment; segment 0 is the newest.
    let segment = index / 6u;
    let corner = index % 6u;
    let older = u32(corner == 1u || corner == 2u || corner == 4u);
    let side = select(-1.0, 1.0, corner == 2u || corner == 4u || corner == 5u);
    var out: Varyings;
    let young = sample_at(leaf, segment);
    let old = sample_at(leaf, segment + 1u);
    if joint(young) != JOINED || joint(old) == NO_PLACE || segment + 2u > trail.sample_count {
        out.clip = vec4(0.0, 0.0, -1.0, 1.0);
        return out;
    }
    let age = segment + older;
    let here = sample_at(leaf, age).position;
    // The ribbon's direction at a sample is that of its neighbours, so segments meet without a gap.
    var ahead = young.position;
    var behind = old.position;
    if older == 0u && segment > 0u {
        let next = sample_at(leaf, segment - 1u);
        if joint(next) == JOINED {
            ahead = next.position;
        }
    }
    if older == 1u && joint(old) == JOINED {
        let next = sample_at(leaf, segment + 2u);
        if joint(next) != NO_PLACE && segment + 3u <= trail.sample_count {
            behind = next.position;
        }
    }
    let to_eye = frame.eye_m - here;
    var aside = cross(ahead - behind, to_eye);
    aside = aside / max(length(aside), 1.0e-9);
    let pixel = length(to_eye) * length(frame.up) * 2.0 * frame.inv_viewport_px.y;
    let relative = select(trail.newest_age + f32(age - 1u) * trail.interval, 0.0, age == 0u);
    let life = clamp(1.0 - relative, 0.0, 1.0);
    // A few trails are a diagram and drawn boldly, each in a colour far from the others; many are a pattern.
    let is_diagram = trail.leaf_count <= 12u;
    let finest = pixel * select(0.9, mix(1.0, 1.8, life), is_diagram);
    let half_width = max(trail.half_width_m * (0.35 + 0.65 * life), finest);
    let world = here + aside * side * half_width;
    out.clip = frame.view_projection * vec4(world, 1.0);
    if is_diagram {
        let color = hue(f32(leaf) / f32(trail.leaf_count) + 0.02);
        // Equally bright to the eye, or yellow would outshine blue.
        let even = color * mix(1.0, 0.45 / max(luminance(color), 0.1), 0.4);
        out.color = vec4(even * 1.25, 0.95 * smoothstep(0.0, 0.4, life));
    } else {
        let color = mix(vec3(1.0), hue(f32(leaf) * 0.61803399 + 0.06), 0.72);
        let thin = min(trail.half_width_m / half_width, 1.0);
        out.color = vec4(color * 0.9, 0.85 * life * life * mix(0.5, 1.0, thin));
    }
    let regime = sample_at(leaf, age).joint_regime >> JOINT_REGIME_SHIFT;
    if regime > 0u {
        out.color = vec4(REGIMES[min(regime, 7u) - 1u] * 1.5, out.color.a);
    }
    out.across = side;
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let soft = 1.0 - in.across * in.across;
    let alpha = in.color.a * smoothstep(0.0, 0.6, soft);
    // As bright as paint would be in this light, and a little more; a darker rim sets the ribbon off from a bright sky.
    let glow = 1.6 * luminance(ambient_light(vec3(0.0, 1.0, 0.0)) + frame.sun_color);
    return vec4(in.color.rgb * glow * alpha * mix(0.35, 1.0, smoothstep(0.2, 0.75, soft)), alpha);
}
