// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Light on leaves of a few pixels, once for each.

#import leaves/leaf_light

@group(3) @binding(1) var<storage, read_write> lights: array<LeafLight>;
@group(3) @binding(2) var<storage, read> draws: array<LeafDraw, 4>;

// Distance of the points of a blade from its middle in edges, on average.
const MEAN_AWAY: f32 = 0.22;
// Halvings of a leaf's pictures of which a texel is a large part.
const BLADE_LEVEL: f32 = 5.0;

fn light_on(record: LeafRecord) -> LeafLight {
    let center = record.center_m;
    let attitude = normalize(vec4(unpack2x16snorm(record.attitude_xy), unpack2x16snorm(record.attitude_zw)));
    let outward = outward_of(record);
    let settled = outward.w;
    let is_free = dot(outward.xyz, outward.xyz) == 0.0;
    let random = leaf_random(record);

    let to_eye = normalize(frame.eye_m - center);
    let blade = rotate(attitude, vec3(0.0, 1.0, 0.0));
    let seen = select(-1.0, 1.0, dot(blade, to_eye) > 0.0);
    let sheet = blade * seen;
    let normal = normalize(sheet + outward.xyz);
    let light = frame.sun_direction;
    let sun = frame.sun_color * tree_shade(center).r * leaf_shadow(center + light * 0.035);
    let facing = dot(normal, light);
    let wet = leaf_wetness(center.xz, settled);
    let lies = select(snow_on_blade(snow_on_leaves(center.xz), abs(blade.y), MEAN_AWAY, unit_from(random)), 0.0, is_free);
    let snow = lies * f32(blade.y * seen > 0.0);
    let roughness = mix(select(ROUGHNESS.y, ROUGHNESS.x, seen > 0.0), WET_ROUGHNESS, wet);
    let open = unpack2x16float(record.blue_open).y * mix(0.35, 1.0, open_above(center, select(0u, SKY_TAPS, is_free)));
    let nearness = mix(1.0, 0.75, settled) * open;
    let ambient = ambient_light_on(normal);
    let front = sun * max(facing, 0.0) + ambient.front * nearness + fire_light(center, normal);
    let back = (sun * max(-facing, 0.0) + ambient.back * nearness + fire_light(center, -normal)) * (1.0 - 0.85 * lies);
    let share = mirrored_share(clamp(dot(sheet, to_eye), 0.0, 1.0)) * nearness;
    let glint = sun * PI * gloss(sheet, to_eye, light, roughness) * mix(1.0, 0.35, settled * (1.0 - wet));
    let mirrored = (glint + sky_reflection(reflect(-to_eye, sheet), roughness) * share) * (1.0 - snow);
    let clear = textureSampleLevel(surfaces, image_sampler, vec2(0.5), record.layer_slot & LAYER_MASK, BLADE_LEVEL).z;
    let again = RECOLLISION * min(length(outward.xyz) / 0.5, 1.0);
    let air = air_before(center);
    return LeafLight(
        pack2x16float(front.rg),
        pack2x16float(vec2(front.b, back.r)),
        pack2x16float(back.gb),
        pack2x16float(mirrored.rg),
        pack2x16float(vec2(mirrored.b, clear * seen)),
        pack2x16float(air.rg),
        pack2x16float(air.ba),
        pack4x8unorm(vec4(again, settled, wet, snow)),
    );
}

@compute @workgroup_size(CULL_GROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let first = draws[0].first_record;
    for (var number = id.x; number < draws[0].instance_count; number += CULL_GROUP_SIZE * groups.x) {
        lights[first + number] = light_on(records[first + number]);
    }
}
