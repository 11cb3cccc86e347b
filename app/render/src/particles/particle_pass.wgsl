// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Particles as discs that face the camera, drawn out along their way while the shutter is open, and ribbons behind them. Premultiplied:
// balls and puffs hide by their opacity what is behind them, lights hide nothing.

#import frame/fire_light
#import frame/light
#import gpu/sort_pair
#import particles/paint
#import particles/ribbon

@group(2) @binding(5) var<storage, read> pairs: array<SortPair>;
@group(2) @binding(6) var<storage, read> traits: array<ParticleTraits>;
@group(2) @binding(7) var<storage, read> rows: array<LookRow>;

// Least radius in pixels of balls and of what has no edge: what is smaller is drawn as large, and as much fainter. Any narrower,
// it would fall between the middles of pixels.
const LEAST_BALL_PX: f32 = 0.7;
const LEAST_SOFT_PX: f32 = 1.5;
// Room around the disc for its soft rim, in pixels.
const RIM_PX: f32 = 0.75;
// Asymmetry of the light that puffs scatter (Henyey, Greenstein 1941), of dust and droplets about this in total: forward.
const FORWARD: f32 = 0.5;
// Mean radiance of a white ball in sunlight over that of a white surface that faces the sun, over all directions: it takes the light
// of its disc, and gives it back to the whole sphere.
const BALL_SHARE: f32 = 0.25;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    // Place on the disc in radii, along the way and across it; on a ribbon from its middle line, along only before the head.
    @location(0) at: vec2<f32>,
    // Half the way in radii, and reciprocal of a pixel in radii. Only along a ribbon these differ from vertex to vertex.
    @location(1) way_px: vec2<f32>,
    // Of light from the sun, of the sky, and of the air before it; opacity.
    @location(2) sun: vec4<f32>,
    @location(3) sky: vec4<f32>,
    @location(4) air: vec4<f32>,
    // Axes of the disc: along the way, and across it.
    @location(5) along: vec3<f32>,
    @location(6) across: vec3<f32>,
    @location(7) world: vec3<f32>,
    // Radius in metres, and a number of its own from 0 to 1.
    @location(8) radius_own: vec2<f32>,
    // Way of drawing, and a flag for ribbons.
    @location(9) @interpolate(flat) kind: u32,
}

// Light that is scattered at an angle over that scattered evenly.
fn scattering(cosine: f32) -> f32 {
    let g2 = FORWARD * FORWARD;
    return (1.0 - g2) / pow(1.0 + g2 - 2.0 * FORWARD * cosine, 1.5);
}

// A particle as it is drawn at a moment.
struct Drawn {
    population: u32,
    age: u32,
    row: LookRow,
    // Half the diameter in metres.
    radius_m: f32,
    own: f32,
}

fn drawn_particle(slot: u32) -> Drawn {
    let motion = motions[slot];
    let born_with = traits[slot];
    let population = particle_population(places[slot].bits);
    let look = populations[population];
    let age = particle_age(motion, drawn.step);
    let at = row_place(population, age_share(age, born_with.life_size));
    var row = row_between(rows[at.row], rows[at.row + 1u], at.t);
    if drawn.paint != PAINT_NONE {
        let hue = palette_place(drawn.paint, drawn.paint_most, population, length(motion.velocity), f32(age) * drawn.dt_s);
        let is_light = look_kind(look) == LOOK_GLOW;
        row.color = painted(drawn.palette[hue.color].rgb, drawn.palette[hue.color + 1u].rgb, hue.t, row.color, is_light);
    }
    let radius_m = 0.5 * look.size_m * row.size * f32(particle_size(born_with.life_size)) / f32(PARTICLE_SIZE_ONE);
    return Drawn(population, age, row, radius_m, own_number(born_with.id, population));
}

// Size of a pixel at a distance in metres.
fn pixel_at(distance_m: f32) -> f32 {
    return distance_m * length(frame.up) * 2.0 * frame.inv_viewport_px.y;
}

// Least radius in pixels of a way of drawing.
fn least_px(kind: u32) -> f32 {
    return select(LEAST_SOFT_PX, LEAST_BALL_PX, kind == LOOK_DOT);
}

// The light of a particle, or of its ribbon where it was `back` steps ago, towards the eye.
fn lit(out: ptr<function, Varyings>, particle: Drawn, place: vec3<f32>, view: vec3<f32>, opacity: f32, back: f32) {
    let look = populations[particle.population];
    let kind = look_kind(look);
    let air = air_before(place);
    (*out).air = air;
    if kind == LOOK_GLOW {
        var light = particle.row.color;
        light *= blink_share(look, (f32(particle.age) - back) * drawn.dt_s, particle.own);
        (*out).sun = vec4(0.0);
        (*out).sky = vec4(light * air.a, opacity);
    } else {
        let sunlit = frame.sun_color * leaf_shadow(place) * tree_shade(place).x;
        let puff = BALL_SHARE * scattering(-dot(view, frame.sun_direction));
        (*out).sun = vec4(particle.row.color * sunlit * select(1.0, puff, kind == LOOK_SPLAT) * air.a, opacity);
        let around = 0.5 * (ambient_light(vec3(0.0, 1.0, 0.0)) + ambient_light(vec3(0.0, -1.0, 0.0)));
        let fires = fire_around(place) * BALL_SHARE;
        (*out).sky = vec4(particle.row.color * (around + fires) * air.a, opacity);
    }
}

@vertex
fn vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) rank: u32) -> Varyings {
    let item = pairs[rank].value;
    let slot = item & ((1u << PART_SHIFT) - 1u);
    let number = item >> PART_SHIFT;
    if number != 0u {
        return ribbon_vertex(slot, number - 1u, corner);
    }
    // All items of a scene with ribbons have as many corners as a part of one.
    return disc_vertex(slot, min(corner, 3u));
}

fn disc_vertex(slot: u32, corner: u32) -> Varyings {
    let place = places[slot];
    let particle = drawn_particle(slot);
    let look = populations[particle.population];
    let kind = look_kind(look);
    let to_eye = frame.eye_m - place.position;
    let distance_m = max(length(to_eye), 1.0e-4);
    let view = to_eye / distance_m;
    let pixel_m = pixel_at(distance_m);
    let radius_m = max(particle.radius_m, least_px(kind) * pixel_m);

    // The way that is seen while the shutter is open.
    let half_way = select(vec3(0.0), motions[slot].velocity * (0.5 * drawn.shutter_s), (look.kind_flags & LOOK_STREAKED) != 0u);
    let seen_way = half_way - view * dot(half_way, view);
    let half_way_m = length(seen_way);
    var along = cross(view, frame.right);
    along = along / max(length(along), 1.0e-6);
    if half_way_m > 0.05 * pixel_m {
        along = seen_way / half_way_m;
    }
    let across = cross(view, along);
    let rim_m = RIM_PX * pixel_m;
    let side = vec2(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    let offset = side * vec2(radius_m + half_way_m + rim_m, radius_m + rim_m);

    var out: Varyings;
    out.world = place.position + along * offset.x + across * offset.y;
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    out.at = offset / radius_m;
    out.way_px = vec2(half_way_m / radius_m, radius_m / pixel_m);
    out.along = along;
    out.across = across;
    out.radius_own = vec2(radius_m, particle.own);
    out.kind = kind;
    let small = particle.radius_m / radius_m;
    lit(&out, particle, place.position, view, particle.row.opacity * small * small, 0.0);
    if kind == LOOK_GLOW && max(out.sky.x, max(out.sky.y, out.sky.z)) <= 0.0 {
        out.clip = vec4(0.0, 0.0, -1.0, 1.0);
    }
    return out;
}

// A corner of a part of the ribbon behind a particle: pairs of them across the way, the first before the head.
fn ribbon_vertex(slot: u32, part: u32, corner: u32) -> Varyings {
    let particle = drawn_particle(slot);
    let look = populations[particle.population];
    let kind = look_kind(look);
    let length_steps = ribbon_length(look.ways, particle.age);
    let pair = corner >> 1u;
    let strip = max(pair, 1u) - 1u;
    let share = ribbon_share(slot, look.ways, part, length_steps) * f32(strip) / f32(RIBBON_STRIPS);
    let at = ribbon_place(slot, look.ways, part, share);
    let to_eye = frame.eye_m - at.place;
    let distance_m = max(length(to_eye), 1.0e-4);
    let view = to_eye / distance_m;
    let pixel_m = pixel_at(distance_m);

    var along = at.pace - view * dot(at.pace, view);
    if dot(along, along) < 1.0e-20 {
        along = cross(view, frame.right);
    }
    along = along / max(length(along), 1.0e-20);
    let across = cross(view, along);
    let left = max(1.0 - at.back / length_steps, 0.0);
    let half_m = particle.radius_m * look.ribbon_width * left;
    let radius_m = max(half_m, least_px(kind) * pixel_m);
    let reach = 1.0 + RIM_PX * pixel_m / radius_m;
    let before = select(0.0, reach, pair == 0u && part == 0u);
    let side = (f32(corner & 1u) * 2.0 - 1.0) * reach;

    var out: Varyings;
    out.world = at.place + (along * before + across * side) * radius_m;
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    out.at = vec2(before, side);
    out.way_px = vec2(0.0, radius_m / pixel_m);
    out.along = along;
    out.across = across;
    out.radius_own = vec2(radius_m, particle.own);
    out.kind = kind | LOOK_RIBBON;
    lit(&out, particle, at.place, view, particle.row.opacity * left * half_m / radius_m, at.back);
    return out;
}

// Share of the time that the shutter is open in which a disc of radius one covers a place, if it goes `way` to both sides.
fn covered(at: vec2<f32>, way: f32, radius_px: f32) -> f32 {
    let still = clamp((1.0 - length(at)) * radius_px + 0.5, 0.0, 1.0);
    if way * radius_px < 0.25 {
        return still;
    }
    let chord = sqrt(max(1.0 - at.y * at.y, 0.0));
    let span = max(min(at.x + chord, way) - max(at.x - chord, -way), 0.0);
    return min(span / (2.0 * way), 1.0);
}

// The same for a disc that thins out to its rim, by the square of one minus the square of the distance.
fn thinly_covered(at: vec2<f32>, way: f32) -> f32 {
    let beside = max(1.0 - at.y * at.y, 0.0);
    let chord = sqrt(beside);
    let low = clamp(at.x - way, -chord, chord);
    let high = clamp(at.x + way, -chord, chord);
    if way < 1.0e-3 {
        let thin = max(beside - at.x * at.x, 0.0);
        return thin * thin;
    }
    // Integral of (b - s^2)^2 over the way, in closed form.
    let integral = beside * beside * (high - low)
        - 2.0 / 3.0 * beside * (high * high * high - low * low * low)
        + 0.2 * (high * high * high * high * high - low * low * low * low * low);
    return integral / (2.0 * way);
}

// Thickness of a puff at a place, 0 to 1: noise of its own, turned by its number.
fn billows(at: vec2<f32>, own: f32) -> f32 {
    let turn = vec2(cos(own * 6.2831853), sin(own * 6.2831853));
    let turned = vec2(turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y);
    let place = turned * 0.11 + vec2(own * 7.31, own * 3.17);
    let coarse = textureSampleLevel(noise, repeat_sampler, place, 1.0).r;
    let fine = textureSampleLevel(noise, repeat_sampler, place * 2.7, 1.0).g;
    return smoothstep(0.25, 0.75, 0.62 * coarse + 0.38 * fine);
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let way = in.way_px.x;
    let radius_px = in.way_px.y;
    let kind = in.kind & LOOK_MASK;
    if kind == LOOK_DOT {
        let share = covered(in.at, way, radius_px) * in.sky.a;
        // A ball that stands still and is seen as one has a lit side.
        let inward = sqrt(max(1.0 - dot(in.at, in.at), 0.0));
        let normal = normalize(in.along * in.at.x + in.across * in.at.y + normalize(frame.eye_m - in.world) * max(inward, 0.05));
        let round = smoothstep(1.5, 4.0, radius_px) * (1.0 - smoothstep(0.2, 1.0, way));
        let sun = in.sun.rgb * mix(BALL_SHARE, max(dot(normal, frame.sun_direction), 0.0), round);
        let sky = in.sky.rgb * mix(1.0, 0.7 + 0.3 * normal.y, round);
        return vec4((sun + sky + in.air.rgb) * share, share);
    }
    var thick = thinly_covered(in.at, way);
    // It meets the ground without an edge.
    let above_m = in.world.y - surface_height(in.world.xz);
    if kind == LOOK_SPLAT {
        thick *= clamp(above_m / (0.6 * in.radius_own.x) + 0.4, 0.0, 1.0);
        let is_large = select(smoothstep(4.0, 16.0, radius_px), 0.0, (in.kind & LOOK_RIBBON) != 0u);
        thick *= mix(1.0, 1.6 * billows(in.at, in.radius_own.y), is_large);
        let share = clamp(thick * in.sky.a, 0.0, 1.0);
        return vec4((in.sun.rgb + in.sky.rgb + in.air.rgb) * share, share);
    }
    return vec4(in.sky.rgb * (thick * in.sky.a), 0.0);
}
