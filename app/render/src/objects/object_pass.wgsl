// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Objects and those who walk: stone with the marks of weather, boards, metal and panes, and clothes.

#import frame/fire_light
#import frame/light
#import objects/object_shape

struct Varyings {
    @builtin(position) @invariant clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) world: vec3<f32>,
    @location(1) @interpolate(perspective, centroid) normal: vec3<f32>,
    @location(2) @interpolate(perspective, centroid) standing: vec3<f32>,
    @location(3) @interpolate(perspective, centroid) edge: f32,
    @location(4) @interpolate(flat) part: u32,
}

@vertex
fn vertex(solid: SolidVertex, @builtin(instance_index) part: u32) -> Varyings {
    let point = object_point(solid, part);
    var out: Varyings;
    out.world = point.world;
    out.clip = frame.view_projection * vec4(point.world, 1.0);
    out.normal = point.normal;
    out.standing = point.standing;
    out.edge = solid.edge;
    out.part = part;
    return out;
}

// Shares of the three planes that a texture is laid on a surface from.
fn plane_shares(normal: vec3<f32>) -> vec3<f32> {
    let sharp = pow(abs(normal), vec3(4.0));
    return sharp / (sharp.x + sharp.y + sharp.z);
}

// The noise at a place, as fine as a level has it.
fn noise_at(at: vec2<f32>, level: f32) -> vec4<f32> {
    return textureSampleLevel(noise, repeat_sampler, at, level);
}

// Level of the noise for pixels that are so many repeats of it wide. Levels of the sampler's own would come from
// neighbours outside of the triangle, for which a device need not load the record.
fn level_of(repeats: f32) -> f32 {
    return log2(max(repeats * f32(textureDimensions(noise).x), 1.0e-6));
}

// Noise on a surface at a place in the frame of the part. The lattice of the noise lies askew on it.
fn noise_on(part_at: vec3<f32>, shares: vec3<f32>, level: f32) -> vec4<f32> {
    let at = part_at + 0.37 * part_at.yzx;
    return shares.x * noise_at(at.zy, level) + shares.y * noise_at(at.xz, level) + shares.z * noise_at(at.xy, level);
}

// Rise to both sides of a relief made of noise, per repeat of the noise, with a weight for each of its fields.
fn noise_slope(at: vec2<f32>, level: f32, weights: vec4<f32>) -> vec2<f32> {
    let texels = f32(textureDimensions(noise).x);
    let step = vec2(1.5 / texels, 0.0);
    let right = noise_at(at + step, level) - noise_at(at - step, level);
    let up = noise_at(at + step.yx, level) - noise_at(at - step.yx, level);
    return vec2(dot(right, weights), dot(up, weights)) * (texels / 3.0);
}

// The same along the axes of the part.
fn noise_rise(at: vec3<f32>, shares: vec3<f32>, level: f32, weights: vec4<f32>) -> vec3<f32> {
    let zy = noise_slope(at.zy, level, weights);
    let xz = noise_slope(at.xz, level, weights);
    let xy = noise_slope(at.xy, level, weights);
    return shares.x * vec3(0.0, zy.y, zy.x) + shares.y * vec3(xz.x, 0.0, xz.y) + shares.z * vec3(xy.x, xy.y, 0.0);
}

// Repeats of the noise in a metre that the grain of a surface is made of.
const FINE_PER_M: f32 = 3.1;

// Number of samples of the sky: on smooth faces few of them would show.
const OBJECT_SKY_TAPS: u32 = 18u;

// Limb of the same body that a place belongs to.
fn nearest_limb(object: ObjectRecord, at: vec3<f32>) -> u32 {
    var best = 1.0e3;
    var nearest = object.body;
    for (var number = 0u; number < BODY_LIMBS; number++) {
        if ((object.joined >> number) & 1u) == 1u {
            let limb = objects[object.body + number];
            let found = limb_distance(limb, into_part(limb.turn, at - limb.center_m));
            nearest = select(nearest, object.body + number, found < best);
            best = min(found, best);
        }
    }
    return nearest;
}

// Place on boards in metres, along their grain and across it.
fn board_place(object: ObjectRecord, local: vec3<f32>) -> vec2<f32> {
    let half = object.inner_m;
    if half.y >= max(half.x, half.z) {
        return vec2(local.y, local.x + 0.7 * local.z);
    }
    return select(vec2(local.z, local.x + 0.7 * local.y), vec2(local.x, local.z + 0.7 * local.y), half.x >= half.z);
}

// Edges in metres of panes that hang a little differently each.
const PANE_M: vec2<f32> = vec2(1.46, 1.85);

// Random number, 0 to 1, of the pane at a place in the frame of a part.
fn pane_random(local: vec3<f32>, shares: vec3<f32>, salt: u32) -> f32 {
    let across = select(local.x, local.z, shares.x > shares.z);
    let pane = vec2<i32>(floor(vec2(across, local.y) / PANE_M));
    return unit_from(hash_u32(bitcast<u32>(pane.x) + hash_u32(bitcast<u32>(pane.y) + salt)));
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let pixel_m = max(length(dpdx(in.standing)), length(dpdy(in.standing)));
    var part = in.part;
    if objects[part].joined != 0u {
        part = nearest_limb(objects[part], in.standing);
    }
    let object = objects[part];
    let smooth_normal = normalize(in.normal);
    let local = into_part(object.turn, in.standing - object.center_m);
    let local_normal = into_part(object.turn, smooth_normal);
    let shares = plane_shares(local_normal);
    let height = in.standing.y - ground_height(in.standing.xz);
    let place = local + object.own * vec3(3.7, 5.3, 7.9);
    let wide = noise_on(place * 0.37, shares, level_of(0.37 * pixel_m));
    let middle = noise_on(place * 1.3, shares, level_of(1.3 * pixel_m));
    // Bent, so that the lattice of the noise does not show in the grain.
    let bent = place + 0.07 * (vec3(middle.r, middle.g, wide.g) - 0.5);
    let fine = noise_on(bent * FINE_PER_M, shares, level_of(FINE_PER_M * pixel_m));
    // Rain runs down: stains are long.
    let runs = noise_at(vec2((place.x + place.z) * 1.7 + 0.06 * middle.g, place.y * 0.16), level_of(1.7 * pixel_m)).g;

    var albedo = object.color;
    // Heights of the relief in metres: soft folds, grains and pits.
    var relief_m = vec4(0.0);
    var relief_per_m = vec3(FINE_PER_M);
    // Share that is mirrored head-on and, besides, at a grazing view, how rough it mirrors, and how narrow the glint of the sun is.
    var gloss = 0.03;
    // Cloth and skin are too rough to mirror the sky at their outlines.
    var grazing = select(0.3, 0.05, object.joined != 0u);
    var roughness = 0.8;
    var shine = 14.0;
    switch object.surface {
        case STONE_SURFACE: {
            let grain = fine.b - 0.5;
            let spots = middle.a - 0.5;
            albedo *= 1.0 + 0.55 * (wide.r - 0.5) + 0.5 * grain + 0.35 * spots;
            // Warm and cool patches.
            albedo *= 1.0 + (wide.g - 0.5) * vec3(0.12, 0.02, -0.12);
            let upright = 1.0 - abs(smooth_normal.y);
            albedo *= 1.0 - 0.3 * upright * smoothstep(0.5, 0.8, runs + 0.5 * (wide.g - 0.5));
            // Dust and lichen where rain stands, algae where the ground keeps it moist.
            let up = smoothstep(0.5, 0.9, smooth_normal.y);
            let lichen = smoothstep(0.60, 0.72, middle.g + 0.5 * (fine.g - 0.5)) * (0.35 * up + 0.12);
            albedo = mix(albedo, mix(vec3(luminance(albedo)), vec3(0.26, 0.27, 0.19), 0.5), lichen);
            let damp = smoothstep(0.45, 0.0, height + 0.5 * (wide.r - 0.5) + 0.2 * spots);
            albedo = mix(albedo, albedo * vec3(0.52, 0.58, 0.44) + vec3(0.002, 0.005, 0.0), 0.75 * damp);
            // Edges are rubbed.
            albedo *= 1.0 + 0.22 * in.edge * (0.5 + middle.a);
            relief_m = vec4(0.006, 0.009, 0.0005, 0.0015);
        }
        case WOOD_SURFACE: {
            let board = board_place(object, local) + object.own * vec2(2.9, 1.3);
            let grain = noise_at(board * vec2(0.55, 9.0) + vec2(0.0, 0.5 * wide.r), level_of(9.0 * pixel_m));
            let rings = noise_at(board * vec2(0.22, 2.6) + vec2(0.0, 0.4 * middle.r), level_of(2.6 * pixel_m));
            albedo *= 1.0 + 0.7 * (grain.b - 0.5) + 0.7 * (rings.r - 0.5) + 0.25 * (wide.r - 0.5);
            // Sun and rain turn wood grey, most where they stand on it; cracks open along the grain.
            let grey = (0.25 + 0.35 * smoothstep(0.4, 0.9, smooth_normal.y)) * smoothstep(0.3, 0.7, wide.g + 0.4 * (rings.g - 0.5));
            albedo = mix(albedo, vec3(luminance(albedo)) * vec3(1.02, 1.0, 0.95), grey);
            albedo *= 1.0 - 0.55 * smoothstep(0.66, 0.74, grain.g);
            albedo *= 1.0 + 0.18 * in.edge * (0.5 + middle.a);
            gloss = 0.04;
        }
        case METAL_SURFACE: {
            let rust = smoothstep(0.72, 0.84, middle.g + 0.35 * (fine.g - 0.5) + 0.06 * smoothstep(0.3, 0.0, height));
            albedo *= 1.0 + 0.25 * (wide.r - 0.5) + 0.12 * (fine.b - 0.5);
            albedo = mix(albedo, vec3(0.13, 0.055, 0.025) * (0.7 + 0.6 * fine.a), 0.55 * rust);
            albedo *= 1.0 + 0.5 * in.edge * (0.5 + middle.a);
            gloss = mix(0.10, 0.03, rust);
            grazing = 0.55;
            roughness = mix(0.42, 0.8, rust);
            shine = mix(48.0, 14.0, rust);
        }
        case GLASS_SURFACE: {
            // Curtains hang behind some panes.
            let curtain = step(0.62, pane_random(local, shares, 1u)) * (0.5 + 0.5 * noise_at(vec2(place.x + place.z, 0.05 * place.y) * 3.0, level_of(3.0 * pixel_m)).g);
            albedo = mix(albedo, vec3(0.16, 0.15, 0.13), 0.6 * curtain) * (0.9 + 0.3 * (wide.r - 0.5));
            relief_m = vec4(0.0030, 0.0020, 0.0, 0.0);
            relief_per_m = vec3(0.35);
            gloss = 0.06;
            grazing = 0.9;
            roughness = 0.1;
            shine = 900.0;
        }
        case LEATHER_SURFACE: {
            albedo *= 1.0 + 0.6 * (fine.a - 0.5);
            // The seam of the cap, and the welt over a sole of rubber with soil on it.
            let seam = local.y - 0.045 - 6.0 * local.x * local.x;
            albedo *= 1.0 - 0.55 * exp(-seam * seam / 6.0e-6);
            let welt = SOLE_M - local.z - 0.017;
            albedo = mix(albedo, vec3(0.20, 0.15, 0.09), 0.7 * exp(-welt * welt / 5.0e-6));
            let sole = smoothstep(0.0015, -0.0015, SOLE_M - local.z - 0.014);
            let soil = mix(vec3(0.016), vec3(0.075, 0.058, 0.040), 0.6 * smoothstep(0.35, 0.65, middle.a));
            albedo = mix(albedo, soil, sole);
            relief_m = vec4(0.0, 0.003, 0.0, 0.001);
            gloss = mix(0.09, 0.02, sole);
        }
        case HEAD_SURFACE: {
            // Hair down to the neck behind and to the forehead before.
            let fringe = local.y - 0.02 - 0.55 * local.z + 0.02 * (fine.a - 0.5);
            let hair = smoothstep(-0.006, 0.006, fringe + 0.03);
            let strand = noise_at(vec2((place.x + place.z) * 2.5, place.y * 0.5), level_of(2.5 * pixel_m)).b;
            albedo = mix(albedo, vec3(0.045, 0.028, 0.016) * (0.5 + strand), hair);
            relief_m = vec4(0.0, 0.0, 0.0, 0.003 * hair);
        }
        default: {
            // Leather of the shaft and cloth of the jacket, each with a rim.
            var leather = 0.0;
            if object.surface == SHANK_SURFACE {
                leather = shaft_at(object, local.y, 0.0015);
                let rim = local.y + object.inner_m.y - SHAFT_M + 0.006;
                albedo = mix(albedo, objects[object.body].color, leather);
                albedo *= 1.0 - 0.5 * exp(-rim * rim / 1.0e-5);
            } else if object.surface == THIGH_SURFACE {
                let rim = local.y - object.inner_m.y + HEM_M;
                albedo = mix(albedo, objects[object.body + TRUNK_LIMB].color, jacket_at(object, local.y, 0.0015));
                albedo *= 1.0 - 0.6 * exp(-rim * rim / 1.0e-5);
            }
            // Folds across, and the weave.
            let folds = noise_at(vec2((place.x + place.z) * 0.55, place.y * 1.35), level_of(1.35 * pixel_m)).g;
            let weave = noise_at(vec2((place.x + place.z) * 6.0, place.y * 6.0), level_of(6.0 * pixel_m)).b;
            albedo *= (1.0 + 0.35 * (weave - 0.5)) * (0.85 + 0.3 * folds);
            // Folds lie across.
            relief_per_m = vec3(0.7, 1.5, 0.7);
            relief_m = vec4(0.028, 0.028, 0.0, 0.0) * (1.0 - 0.7 * leather);
            gloss = mix(gloss, 0.09, leather);
            if object.surface == SLEEVE_SURFACE {
                // The hand below the cuff.
                let cuff = smoothstep(0.004, -0.004, local.y + object.inner_m.y - 0.045);
                albedo = mix(albedo, vec3(0.45, 0.27, 0.18), cuff);
                relief_m *= 1.0 - cuff;
            }
        }
    }
    // Rain wets what it falls on, most of all what lies level, but for those who walk out of it.
    let wet = select(land.wet * mix(0.6, 1.0, smoothstep(0.3, 0.9, smooth_normal.y)), 0.0, object.joined != 0u || object.surface == GLASS_SURFACE);
    albedo = wet_reflectance(min(albedo, vec3(0.9)), wet);
    gloss = max(gloss, 0.05 * wet);
    grazing = mix(grazing, 0.7, 0.7 * wet);
    roughness = mix(roughness, min(roughness, 0.3), wet);
    shine = mix(shine, max(shine, 90.0), wet);
    let distance_m = distance(in.world, frame.eye_m);
    let rise = noise_rise(bent * relief_per_m, shares, level_of(relief_per_m.y * pixel_m), relief_m) * relief_per_m;
    let along = rise - local_normal * dot(rise, local_normal);
    var bent_normal = local_normal - along;
    if object.surface == GLASS_SURFACE {
        let hang = vec3(pane_random(local, shares, 2u), pane_random(local, shares, 3u), pane_random(local, shares, 4u)) - 0.5;
        bent_normal += 0.035 * (hang - local_normal * dot(hang, local_normal));
    }
    let normal = rotate(object.turn, normalize(bent_normal));

    let to_eye = normalize(frame.eye_m - in.world);
    let light = frame.sun_direction;
    let shade = tree_shade(in.world);
    // Past its own texels in the map, which are wider far away.
    let clear = clamp(0.0025 * distance_m, 0.012, 0.15);
    let sun = frame.sun_color * shade.r * leaf_shadow(in.world + smooth_normal * clear + light * 0.01)
        * smoothstep(-0.02, 0.06, dot(smooth_normal, light));
    let facing = max(dot(normal, light), 0.0);
    // The sky before a face, beside what stands there; the ground takes it from what faces down.
    let level = vec3(smooth_normal.x, 0.0, smooth_normal.z);
    // Samples around a place are turned by its numbers: on a plane they would make stripes.
    let at = vec3<u32>(vec3<i32>(in.world * 1024.0));
    let key = hash_u32(at.x + hash_u32(at.y + hash_u32(at.z)));
    let aside = 0.04 * vec3(unit_from(key), unit_from(hash_u32(key)), unit_from(hash_u32(key + 1u)));
    let before = open_above(in.world + aside + level * 1.3 + smooth_normal * 0.1, OBJECT_SKY_TAPS);
    let low = mix(0.5, 1.0, smoothstep(-0.03, 0.35, height));
    let beneath = mix(1.0, smoothstep(-0.1, 0.8, height), 0.7 * max(-smooth_normal.y, 0.0));
    let open = mix(0.4, 1.0, before) * low * beneath;
    var color = albedo * (sun * facing + ambient_light(normal) * open * sky_openness(in.world));
    color += albedo * fire_light(in.world, normal);
    let half_way = normalize(light + to_eye);
    color += sun * gloss * (0.036 * shine) * pow(max(dot(normal, half_way), 0.0), shine) * facing;
    let fresnel = gloss + grazing * pow(1.0 - clamp(dot(normal, to_eye), 0.0, 1.0), 5.0);
    let mirrored = sky_reflection(reflect(-to_eye, normal), roughness) * mix(1.0, 0.6, smoothstep(0.1, 0.8, roughness));
    color += mirrored * fresnel * open;
    return vec4(haze(color, in.world), 1.0);
}
