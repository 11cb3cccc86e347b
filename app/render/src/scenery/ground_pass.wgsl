// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The ground under the grass: level out to the horizon, or rings of grid laid on the hills.

#import frame/fire_light
#import scenery/meadow
#import scenery/horizon
#import scenery/structs

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
}

// Level ground out to the horizon.
@vertex
fn vertex_level(@builtin(vertex_index) index: u32) -> Varyings {
    let at = horizon_fan(index);
    var out: Varyings;
    out.world = vec3(at.x, land.base_m - ground_depth(), at.y);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    return out;
}

// Hills: rings of grid around the eye. `terrain_mesh.rs` says why there is no crack.
@vertex
fn vertex_hilly(@location(0) grid: vec2<i32>, @builtin(instance_index) ring: u32) -> Varyings {
    let cell = FINEST_M * f32(1u << ring);
    let half = 0.5 * f32(RING_CELLS) * cell;
    let middle = floor(frame.eye_m.xz / (2.0 * cell)) * (2.0 * cell);
    var at = middle + vec2<f32>(grid) * cell;
    // Odd vertices glide onto the next ring's grid before they come to it.
    let apart = max(abs(at.x - frame.eye_m.x), abs(at.y - frame.eye_m.z)) / half;
    let glide = clamp((apart - 0.6) / (1.0 - 8.0 / f32(RING_CELLS) - 0.6), 0.0, 1.0);
    at -= vec2<f32>(grid & vec2(1)) * (cell * glide);
    var out: Varyings;
    out.world = vec3(at.x, ground_height(at) - ground_depth(), at.y);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let at = in.world.xz;
    let distance_m = distance(in.world, frame.eye_m);
    let grain = ground_grain(at);
    let hill = hills_at(at);
    let normal = normalize(vec3(-hill.y, 1.0, -hill.z));
    let grass = sward(at, clamp(log2(distance_m * 0.02), 0.0, 5.0));
    // Between the blades near by one sees thatch; far away only the blades' tips.
    let far = smoothstep(5.0, 26.0, distance_m);
    let thatch = mix(vec3(0.055, 0.050, 0.022), grass.albedo * 0.55, 0.55);
    var albedo = mix(thatch, grass.albedo, far);
    albedo *= 1.0 + dot(grain.xy, vec2(1.1, 0.8));
    let rise = length(hill.yz);
    let bare = bare_soil(at, in.world.y, rise);
    let above_water_m = in.world.y - land.water_m;
    var rock = 0.0;
    var without_grass = soil_albedo(grain, above_water_m);
    if IS_HILLY {
        rock = rock_share(at, rise);
        without_grass = mix(without_grass, rock_albedo(in.world, grain), rock);
        rock *= bare;
    }
    albedo = mix(albedo, without_grass, bare);
    var path = path_share(at, distance_m);
    // Feet keep the middle of the path firm and pale; along its edges crumbs of soil lie.
    let within_m = -beyond_path(at);
    let firm = smoothstep(0.1, 0.7, within_m + 0.5 * grain.y);
    let crumbs = 1.0 - smoothstep(0.0, 0.14, abs(within_m + 0.02) + 0.25 * grain.y);
    var gravel = gravel_albedo(grain, above_water_m) * mix(0.72, 1.06, firm);
    var stony = 1.0;
    let span_m = vec2(length(dpdx(at)), length(dpdy(at)));
    let pixel_m = max(span_m.x, span_m.y);
    if path > 0.0 {
        let stones = pebbles(at, min(span_m.x, span_m.y));
        gravel *= stones.rgb;
        stony = mix(1.0, stones.a, path);
    }
    albedo = mix(albedo, gravel, path);
    albedo = mix(albedo, 0.7 * soil_albedo(grain, above_water_m), 0.75 * crumbs);
    let paved = paved_share(at, pixel_m);
    if paved > 0.0 {
        let stone = paving(at, pixel_m) * (1.0 + dot(grain, vec3(0.35, 0.45, 0.35)));
        albedo = mix(albedo, stone, paved);
    }
    path = max(path, paved);
    // Fallen leaves too far away to be drawn one by one.
    let shade = tree_shade(in.world);
    let density = clamp(shade.g * 0.85 + 0.10 + 0.25 * grain.y, 0.0, 0.8);
    let seen = smoothstep(12.0, 34.0, distance_m);
    let speck = mix(smoothstep(0.12, 0.20, grain.z), 0.55, smoothstep(18.0, 45.0, distance_m));
    let litter = mix(vec3(0.42, 0.22, 0.05), vec3(0.36, 0.13, 0.04), grain.y * 1.2 + 0.4);
    albedo = mix(albedo, litter, density * speck * seen * (1.0 - paved) * (1.0 - 0.8 * bare));
    let wet = wetness(at);
    albedo = wet_reflectance(albedo, wet);

    // Snow beyond the rectangle on which it is simulated, and what shows of the ground within it.
    let snowy = smoothstep(0.25, 1.0, frame.snow_depth_m / (0.006 + 0.024 * (grain.y + 0.5)));
    albedo = mix(albedo, vec3(0.84, 0.86, 0.88), snowy);

    // The path lies as high as the leaves on it do: their shadows touch them.
    var sun = shade.r * leaf_shadow(in.world + vec3(0.0, 0.8 * ground_depth() * path, 0.0));
    // Snow levels out grains and tufts.
    let relief = mix(mix(1.0, tuft_light(at), far), grain_relief(at), max(path, bare));
    if IS_HILLY {
        sun *= mix(mix(relief, rock_relief(at), rock), 1.0, snowy);
    } else {
        sun *= mix(relief, 1.0, snowy);
    }
    sun *= mix(stony, 1.0, max(snowy, paved));
    // Grass along the path shades its edge.
    let toward_sun = frame.sun_direction.xz * (1.2 * SWARD_M / max(frame.sun_direction.y, 0.12));
    sun *= 1.0 - 0.7 * path * (1.0 - paved) * (1.0 - snowy) * smoothstep(-0.04, 0.06, beyond_path(at + toward_sun));
    // Grass is rough: against the sun it glows, with the sun behind one it shows its lit side.
    let view = normalize(frame.eye_m - in.world);
    let against = pow(max(dot(-view, frame.sun_direction), 0.0), 3.0);
    let rough = far * (1.0 - path);
    let facing = mix(0.75, 1.0, max(far, path)) * max(dot(normal, frame.sun_direction), 0.0) + 0.12;
    var color = albedo * (frame.sun_color * sun * (facing + 0.55 * rough * against));
    color += albedo * ambient_light(normal) * mix(0.55, 0.95, max(far, path))
        * min(sky_openness(in.world), mix(0.35, 1.0, open_above(in.world, SKY_TAPS))) * open_beside(in.world);
    color += albedo * fire_light(in.world, normal) * mix(0.75, 1.0, max(far, path));
    // Rain stands in hollows of paths and paving; between them a film makes them shine.
    let rain = land.wet * path * (1.0 - snowy);
    if rain > 0.0 {
        let hollow = textureSampleLevel(noise, repeat_sampler, at * 0.16 + 0.43, 0.0).r + 0.12 * grain.y;
        let puddle = smoothstep(0.65, 0.68, hollow) * smoothstep(0.4, 0.9, land.wet);
        let uneven = (1.0 - puddle) * vec3(grain.x, 0.0, grain.z) * 0.22;
        let film = film_light(normalize(normal + uneven), view, frame.sun_color * sun, rain * mix(0.42, 1.0, puddle), mix(0.34, 0.1, puddle));
        // At a low view woods at the horizon are mirrored in place of the sky.
        let open = min(sky_openness(in.world), mix(0.35, 1.0, open_above(in.world, SKY_TAPS))) * mix(0.3, 1.0, smoothstep(0.03, 0.24, view.y));
        color = mix(color, 0.45 * color, puddle * rain) + film * mix(0.4, 1.0, open);
    }
    return vec4(haze(color, in.world), 1.0);
}
