// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The wet surface of blobs, by rays through the cells that it may cross.

#import frame/light
#import particles/blob_field

// Reflectance of a wet skin seen from straight above (Fresnel, index of refraction 1.4), and its roughness.
const WET_F0: f32 = 0.028;
const WET_ROUGHNESS: f32 = 0.16;
// Most that it mirrors at a glance: there the surface behind stands before the sky.
const WET_F90: f32 = 0.55;
// Light from the sun that goes on below the surface and comes out beside where it fell in, as the part of the cosine by which it reaches
// around the edge of the lit side.
const WRAP: f32 = 0.35;
// Share of the sunlight behind a body that comes through it, forwards.
const THROUGH: f32 = 0.35;
// Number of samples of the sky: on what is smooth few of them would show.
const BLOB_SKY_TAPS: u32 = 18u;
// Places of the samples in a pixel, from its middle: the same on all devices.
const SAMPLES: u32 = 4u;
const SAMPLE_AT: array<vec2<f32>, 4> = array(vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(-0.375, 0.125), vec2(0.125, 0.375));
const ALL_SAMPLES: u32 = 15u;
// Largest room for rays around a cell, as a share of its edge: less than the seam.
const MOST_ROOM: f32 = 0.05;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) @interpolate(flat) cell: u32,
}

struct Shown {
    @location(0) light: vec4<f32>,
    @builtin(frag_depth) depth: f32,
    @builtin(sample_mask) samples: u32,
}

// Width of a pixel at a place.
fn pixel_at(at: vec3<f32>) -> f32 {
    return max(dot(at - frame.eye_m, frame.forward), 0.0) * length(frame.up) * 2.0 * frame.inv_viewport_px.y;
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) number: u32) -> Varyings {
    let cell = cells[number];
    var out: Varyings;
    out.cell = number;
    if cell.count == 0u {
        out.clip = vec4(0.0, 0.0, -1.0, 1.0);
        return out;
    }
    // Room for all samples of the pixels whose middle sees the cell.
    let edge_m = looks[cell.population].cell_m;
    let room_m = 1.5 * (pixel_at(cell.low_m + 0.5 * edge_m) + 1.75 * edge_m * length(frame.up) * frame.inv_viewport_px.y);
    let corner = cell_vertex(cell, index, room_m, vec4(frame.eye_m, 1.0));
    out.world = corner.at;
    out.clip = frame.view_projection * vec4(corner.at, 1.0);
    if !corner.is_back {
        out.clip = vec4(0.0, 0.0, -1.0, 1.0);
    }
    return out;
}

// Light of the surface at a place towards the eye, which looks along `ray`. What lies within half of `thick_m`, the radius of a ball, does
// not shade it: light goes on through that.
fn blob_light(at: vec3<f32>, surface: BlobSurface, ray: vec3<f32>, thick_m: f32) -> vec3<f32> {
    let normal = surface.normal;
    let light = frame.sun_direction;
    let distance_m = distance(at, frame.eye_m);
    let clear = clamp(0.0025 * distance_m, 0.012, 0.15);
    let sun = frame.sun_color * tree_shade(at).r * leaf_shadow(at + normal * clear + light * (0.5 * thick_m));
    let facing = dot(normal, light);
    let half_way = normalize(light - ray);
    let before = open_above(at + vec3(normal.x, 0.0, normal.z) * 0.2 + normal * 0.1, BLOB_SKY_TAPS);
    let height = at.y - ground_height(at.xz);
    let beneath = mix(1.0, smoothstep(-0.1, 0.8, height), 0.7 * max(-normal.y, 0.0));
    let open = mix(0.4, 1.0, before) * beneath * sky_openness(at);

    // Below the skin: matt, soft at the edge of the light, and lit through.
    let wrapped = max((facing + WRAP) / (1.0 + WRAP), 0.0);
    let through = THROUGH * pow(max(dot(ray, light), 0.0), 3.0) * (1.0 - max(-dot(normal, ray), 0.0));
    let below = surface.color * (sun * (wrapped * wrapped + through) + ambient_light(normal) * open);

    // The skin mirrors sun and sky (Schlick 1994; Walter et al. 2007; visibility after Kelemen and Szirmay-Kalos 2001).
    let grazing = pow(1.0 - clamp(-dot(normal, ray), 0.0, 1.0), 5.0);
    let fresnel = WET_F0 + (WET_F90 - WET_F0) * grazing;
    let a2 = WET_ROUGHNESS * WET_ROUGHNESS * WET_ROUGHNESS * WET_ROUGHNESS;
    let cosine = max(dot(normal, half_way), 0.0);
    let spread = cosine * cosine * (a2 - 1.0) + 1.0;
    let lobe = a2 / (spread * spread);
    let lit_half = max(dot(light, half_way), 0.1);
    let sun_fresnel = WET_F0 + (1.0 - WET_F0) * pow(1.0 - lit_half, 5.0);
    let glint = sun * (sun_fresnel * lobe * max(facing, 0.0) / (4.0 * lit_half * lit_half));
    let mirrored = sky_reflection(reflect(ray, normal), WET_ROUGHNESS) * open;
    return mix(below, mirrored, fresnel) + glint;
}

@fragment
fn fragment(in: Varyings) -> Shown {
    let across = dpdx(in.world);
    let down = dpdy(in.world);
    let cell = cells[in.cell];
    let look = looks[cell.population];
    let ray = normalize(in.world - frame.eye_m);
    let pixel_m = pixel_at(cell.low_m + 0.5 * look.cell_m);
    let room_m = min(pixel_m, MOST_ROOM * look.cell_m);
    var at = vec3(0.0);
    var hits = 0u;
    let span = cell_span(cell, room_m, frame.eye_m, ray);
    var surface: BlobSurface;
    // Each sample of a pixel in which the surface ends has a ray of its own.
    var is_edge = false;
    if span.x < span.y {
        let meeting = meet_surface(cell, frame.eye_m, ray, span);
        // Rise of the field where a ball alone has its surface.
        let lone = look.lone_radius_m / look.radius_m;
        let rise = 6.0 * lone * pow(look.threshold, 2.0 / 3.0) / look.radius_m;
        is_edge = meeting.passed > look.threshold - 2.5 * rise * pixel_m;
        if meeting.distance_m >= 0.0 {
            at = frame.eye_m + ray * meeting.distance_m;
            surface = surface_at(cell, at);
            hits = ALL_SAMPLES;
            is_edge = is_edge || -dot(surface.normal, ray) < 0.1 + sqrt(2.0 * pixel_m / look.lone_radius_m);
        }
    }
    if is_edge {
        let is_seen = hits != 0u;
        hits = 0u;
        for (var number = 0u; number < SAMPLES; number++) {
            let place = SAMPLE_AT[number];
            let own = normalize(in.world + across * place.x + down * place.y - frame.eye_m);
            let meeting = meet_surface(cell, frame.eye_m, own, cell_span(cell, room_m, frame.eye_m, own));
            if meeting.distance_m >= 0.0 {
                hits |= 1u << number;
                if !is_seen {
                    at = frame.eye_m + own * meeting.distance_m;
                }
            }
        }
        if !is_seen {
            surface = surface_at(cell, at);
        }
    }
    let clip = frame.view_projection * vec4(at, 1.0);
    // A mirror shows nothing below its surface.
    if hits == 0u || clip.z > clip.w {
        discard;
    }
    return Shown(vec4(haze(blob_light(at, surface, ray, look.lone_radius_m), at), 1.0), clip.z / clip.w, hits);
}
