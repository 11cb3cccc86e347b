// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves, lit point by point by the sun in front of them and through them.

#import leaves/damage
#import leaves/leaf_light

struct Varyings {
    @builtin(position) @invariant clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) world: vec3<f32>,
    @location(1) @interpolate(perspective, centroid) normal: vec3<f32>,
    @location(2) @interpolate(perspective, centroid) uv: vec2<f32>,
    // Layer, and slot within the page.
    @location(3) @interpolate(flat) layer_slot: u32,
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

@vertex
fn vertex(in: LeafVertex) -> Varyings {
    let record = record_of(in);
    let point = blade_point(record, in.level, in.vertex);
    var out: Varyings;
    out.world = point.world;
    out.clip = frame.view_projection * vec4(point.world, 1.0);
    out.normal = point.normal;
    out.uv = point.uv;
    out.layer_slot = record.layer_slot;
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

// State of a leaf at a point that its front nears or has passed.
fn burnt_tissue(in: Varyings, arrival: f32, span: f32) -> Tissue {
    let front = Front(in.front.x, in.front.y, in.front.z, in.front.w);
    // Grain lies in the plane of the blade, as large on small leaves, and elsewhere on each.
    let edge_m = front.whole_m / max(unpack2x16float(table.layers[in.layer_slot & LAYER_MASK].burning).y, 0.1);
    let place = in.uv * (edge_m / GRAIN_TILE_M) + in.tint_open.rg * 7.0;
    let draught = textureSample(noise, repeat_sampler, place + SMOULDER_PER_S * front.way * front.whole_s).r;
    return tissue_at(front, arrival, span, textureSample(noise, repeat_sampler, place).ab, draught);
}

@fragment
fn fragment(in: Varyings) -> Painted {
    let layer = in.layer_slot & LAYER_MASK;
    let image = textureSample(images, image_sampler, in.uv, layer);
    let surface = textureSample(surfaces, image_sampler, in.uv, layer);
    var alpha = blade_cover(image.a, in.uv);
    // Leaves of one branchlet have one slot.
    let own = hash_u32(in.layer_slot ^ hash_u32(bitcast<u32>(in.tint_open.r)));
    let damage = damage_at(layer, own, in.uv, max(length(fwidth(in.uv)), 1.0e-4));
    alpha *= damage.left;
    var tissue: Tissue;
    if LEAVES_BURN {
        tissue = burnt_tissue(in, surface.a, max(fwidth(surface.a), exp2(-halvings_left(in.uv))));
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
    var transmittance = crossing(reflectance, surface.z, in.settled);
    if !IS_PAINTED {
        let tissue_left = 1.0 - damage.dead;
        reflectance = mix(DEAD * (0.6 + 0.8 * luminance(image.rgb)), reflectance, tissue_left);
        transmittance *= mix(0.35, 1.0, tissue_left);
    }
    if seen < 0.0 && !IS_PAINTED {
        reflectance = pale(reflectance);
    }
    // Wet tissue is darker, and a film of water on it mirrors as smoothly as wax.
    let wet = leaf_wetness(in.world.xz, in.settled);
    reflectance = wet_reflectance(min(reflectance, vec3(0.8)), wet);
    var wax = 1.0;
    if in.snowy > 0.0 {
        // From below it only keeps the light out.
        let random = unit_from(hash_u32(bitcast<u32>(in.attitude.z)));
        let lies = snow_on_blade(in.snowy, abs(blade.y), length(in.uv - 0.5), random);
        transmittance *= 1.0 - 0.85 * lies;
        let top = lies * f32(blade.y * seen > 0.0);
        reflectance = mix(reflectance, SNOW_COLOR, top);
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
