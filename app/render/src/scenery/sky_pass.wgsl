// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Sky, sun, thin clouds and the woods beyond the park, wherever nothing nearer was drawn.

#import frame/light

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) ray: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varyings {
    let corner = vec2(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    var out: Varyings;
    out.clip = vec4(corner, 0.0, 1.0);
    out.ray = view_ray(corner);
    return out;
}

// No skyline is higher, as a tangent.
const HIGHEST_WOOD: f32 = 0.06 * 1.575;

// Height of a wooded skyline, as a tangent.
fn skyline(azimuth: f32, row: f32, height: f32) -> f32 {
    let at = vec2(azimuth * 0.159155 * 3.0, row);
    let hills = textureSampleLevel(noise, repeat_sampler, at * 0.25, 1.0).r;
    let crowns = textureSampleLevel(noise, repeat_sampler, at * vec2(2.0, 1.0), 0.0).g;
    return height * (0.55 + 0.8 * hills + 0.45 * (crowns - 0.5));
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let direction = normalize(in.ray);
    let clear = sky_radiance(direction);
    var color = clear;
    let toward_sun = max(dot(direction, frame.sun_direction), 0.0);
    // Clouds on a plane overhead. A full cover is closed everywhere, but not even.
    let up = max(direction.y, 0.0);
    let plane = direction.xz / (up + 0.12);
    let drift = frame.cloud_time_s * 0.0006;
    let lod = clamp(1.6 - 6.0 * up, 0.0, 3.0);
    let broad = textureSampleLevel(noise, repeat_sampler, plane * 0.055 + drift, lod).r;
    let streak = textureSampleLevel(noise, repeat_sampler, plane * vec2(0.10, 0.21) + 0.4 + drift, lod).g;
    let body = 0.66 * broad + 0.34 * streak;
    // Values between 0.2 and 0.8 are common.
    let edge = mix(0.82, 0.05, frame.cloud_cover);
    let cover = smoothstep(edge, edge + 0.22, body) * mix(smoothstep(0.02, 0.22, up), 1.0, frame.cloud_cover * frame.cloud_cover);
    // The thicker, the darker from below; thin rims pass the sun on.
    let thick = smoothstep(edge, edge + 0.55, body) * frame.cloud_cover;
    let deep = smoothstep(0.38, 0.68, 0.6 * streak + 0.4 * broad) * frame.cloud_cover;
    let overcast = (1.0 + 2.0 * up) / 3.0;
    var cloud = frame.cloud_light * mix(1.0, overcast, frame.cloud_cover) * (1.25 - 0.55 * thick - 0.55 * deep);
    cloud += frame.sun_color * (0.05 + 0.35 * pow(toward_sun, 8.0)) * (1.0 - cover * 0.7);
    color = mix(color, cloud, cover * 0.9);
    // The sun's disc, half a degree wide: as bright as it would have to be, or as 16 bits allow.
    let disc = smoothstep(0.999985, 0.999991, toward_sun) * (1.0 - cover);
    color += min(frame.sun_color * (3.14159265 / 6.8e-5), vec3(30000.0)) * disc;
    // A picture of a sky has its own sun, clouds and horizon.
    if frame.sky_is_picture != 0u {
        return vec4(min(clear, vec3(30000.0)), 1.0);
    }

    // Two rows of far woods in the haze.
    let azimuth = atan2(direction.z, direction.x);
    let slope = direction.y / max(length(direction.xz), 1.0e-3);
    let pixel = frame.inv_viewport_px.y * 2.0 * length(frame.up) * 1.5;
    let rows = select(0u, 2u, slope < HIGHEST_WOOD + pixel);
    for (var row = 0u; row < rows; row++) {
        let near = f32(row);
        let level = sky_reflection(normalize(vec3(direction.x, 0.05, direction.z)), LEAST_ROUGHNESS);
        let top = skyline(azimuth, 0.21 + near * 0.4, mix(0.060, 0.042, near));
        let wood = mix(vec3(0.10, 0.085, 0.05), vec3(0.17, 0.10, 0.035), near) * (0.3 * frame.sun_color + ambient_light(vec3(0.0, 1.0, 0.0)));
        let seen = mix(wood, level, mix(0.90, 0.80, near));
        color = mix(color, seen, smoothstep(pixel, -pixel, slope - top));
    }
    // Air that trees shade adds less to it.
    let air = air_before(frame.eye_m + SHAFT_REACH_M * direction);
    color *= mix(vec3(1.0), shaft_light(direction * SHAFT_REACH_M, SHAFT_REACH_M), 1.0 - air.a);
    return vec4(color, 1.0);
}
