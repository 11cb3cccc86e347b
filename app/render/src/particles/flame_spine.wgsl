// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The splines of flames: particles that were born at one foot, one after another, are their points.

#import particles/bindings

@group(2) @binding(0) var<uniform> drawn: ParticleUniform;
@group(2) @binding(1) var<storage, read> flames: array<Flame>;
@group(2) @binding(2) var<storage, read> places: array<ParticlePlace>;
@group(2) @binding(3) var<storage, read> motions: array<ParticleMotion>;
@group(2) @binding(4) var<storage, read> traits: array<ParticleTraits>;
@group(2) @binding(5) var<storage, read> populations: array<PopulationLook>;
@group(2) @binding(6) var<storage, read> rows: array<LookRow>;
@group(2) @binding(8) var<storage, read> feet: array<FlameFoot>;

// Steps before its death in which a point fades.
const FADE_STEPS: f32 = 6.0;
// Mean of (1 - r²)² over a disc: what a soft light gives of its face.
const MEAN_COVER: f32 = 0.33333333;

// A point of a spline.
struct FlamePoint {
    position: vec3<f32>,
    // Age as a share of the life.
    share: f32,
    // Share of it that is there: 1, less before its death, 0 after it.
    presence: f32,
    // True if it has been born.
    is_born: bool,
}

// The stretch of a spline below one of its points.
struct FlameStretch {
    // Control points, from below; the stretch goes from near the second to near the third.
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
    d: vec3<f32>,
    // Ages at its ends.
    shares: vec2<f32>,
    // Width of the flame at its ends, as a share.
    widths: vec2<f32>,
    is_there: bool,
}

// Place of the foot of a particle.
fn foot_place(flame: Flame, id: u32) -> vec3<f32> {
    return feet[flame.first_foot + id % flame.feet].place_m;
}

// The point of a number, if its slot still holds it.
fn flame_point(flame: Flame, id: u32) -> FlamePoint {
    let slot = flame.first_slot + id % flame.count;
    let place = places[slot];
    let born_with = traits[slot];
    if born_with.id != id || particle_state(place.bits) == PARTICLE_DORMANT {
        return FlamePoint(vec3(0.0), 0.0, 0.0, false);
    }
    let age = particle_age(motions[slot], drawn.step);
    let life = particle_life(born_with.life_size);
    let left = f32(bitcast<i32>(life - age));
    let presence = select(0.0, clamp(left / FADE_STEPS, 0.0, 1.0), is_there(place.bits));
    return FlamePoint(place.position, age_share(age, born_with.life_size), presence, true);
}

// The stretch below the point in a slot.
fn flame_stretch(flame: Flame, slot: u32) -> FlameStretch {
    var stretch: FlameStretch;
    stretch.is_there = false;
    let id = traits[slot].id;
    let here = flame_point(flame, id);
    if here.presence <= 0.0 {
        return stretch;
    }
    let below = flame_point(flame, id + flame.feet);
    stretch.c = here.position;
    stretch.shares.y = here.share;
    if below.is_born && below.presence <= 0.0 {
        return stretch;
    }
    stretch.is_there = true;
    stretch.widths.x = 1.0;
    if below.is_born {
        stretch.b = below.position;
        stretch.shares.x = below.share;
        let lower = flame_point(flame, id + 2u * flame.feet);
        stretch.a = select(foot_place(flame, id), lower.position, lower.is_born);
        if lower.is_born {
            stretch.widths.x = lower.presence;
        }
        if lower.is_born && lower.presence <= 0.0 {
            stretch.a = 2.0 * stretch.b - stretch.c;
        }
    } else {
        stretch.b = foot_place(flame, id);
        stretch.shares.x = 0.0;
        stretch.a = 2.0 * stretch.b - stretch.c;
    }
    stretch.d = 2.0 * stretch.c - stretch.b;
    stretch.widths.y = 0.0;
    if id >= flame.feet {
        let above = flame_point(flame, id - flame.feet);
        if above.presence > 0.0 {
            stretch.d = mix(stretch.d, above.position, above.presence);
            stretch.widths.y = above.presence;
        }
    }
    return stretch;
}

// Place on the uniform cubic B-spline, from 0 to 1 along a stretch.
fn spline_place(stretch: FlameStretch, u: f32) -> vec3<f32> {
    let v = 1.0 - u;
    let wide = v * v * v * stretch.a
        + (4.0 - 6.0 * u * u + 3.0 * u * u * u) * stretch.b
        + (4.0 - 6.0 * v * v + 3.0 * v * v * v) * stretch.c
        + u * u * u * stretch.d;
    return wide * (1.0 / 6.0);
}

// Direction and length of the spline from there.
fn spline_way(stretch: FlameStretch, u: f32) -> vec3<f32> {
    let v = 1.0 - u;
    let first = stretch.b - stretch.a;
    let second = stretch.c - stretch.b;
    let third = stretch.d - stretch.c;
    return 0.5 * (v * v * first + (1.0 + 2.0 * u * v) * second + u * u * third);
}

// Values of the curves at a place along a stretch.
fn stretch_row(population: u32, stretch: FlameStretch, u: f32) -> LookRow {
    let at = row_place(population, mix(stretch.shares.x, stretch.shares.y, u));
    return row_between(rows[at.row], rows[at.row + 1u], at.t);
}

// Radius of the flame there: its ends are round.
fn flame_radius(look: PopulationLook, row: LookRow, stretch: FlameStretch, u: f32) -> f32 {
    let widths = stretch.widths;
    // A piece of one stretch is wide in its middle.
    let alone = 2.0 * (1.0 - widths.x) * (1.0 - widths.y) * u * (1.0 - u);
    return 0.5 * look.size_m * row.size * sqrt(mix(widths.x, widths.y, u) + alone);
}
