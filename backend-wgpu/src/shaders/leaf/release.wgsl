// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/release.rs
#import bindings
#import kernel/rng
#import motion/feature
#import leaf/launch
#import leaf/own
#import terrain/ground

fn offset_in_box(word: u32, extent: u32) -> i32 {
    return bitcast<i32>(mul_high(word, 2u * extent + 1u)) - bitcast<i32>(extent);
}

fn offset_scaled(unit: i32, extent: u32) -> i32 {
    let magnitude = bitcast<i32>(mul_high(bitcast<u32>(abs(unit)) << 17u, extent));
    return select(magnitude, -magnitude, unit < 0);
}

fn unit_coordinate(word: u32) -> i32 {
    return bitcast<i32>(mul_high(word, 65535u)) - 32767;
}

fn release_place(source: u32, seed: vec2<u32>, id: u32) -> vec3<i32> {
    let center = environment.sources[source].center_units;
    let extent = environment.sources[source].extent_units;
    let kind = environment.sources[source].kind;
    var words = random(seed, id, STREAM_PLACE);
    if (kind == SOURCE_BOX) {
        return vec3<i32>(
            center.x + offset_in_box(words.x, extent.x),
            center.y + offset_in_box(words.y, extent.y),
            center.z + offset_in_box(words.z, extent.z),
        );
    }
    var unit = vec3<i32>(0, 0, 0);
    var inside = false;
    for (var attempt = 0u; attempt < PLACE_TRIES; attempt++) {
        if (!inside) {
            words = random(seed, id, STREAM_PLACE + attempt);
            unit = vec3<i32>(unit_coordinate(words.x), unit_coordinate(words.y), unit_coordinate(words.z));
            if (kind == SOURCE_DISC) {
                unit.y = 0;
            }
            let squared =
                bitcast<u32>(unit.x * unit.x) + bitcast<u32>(unit.y * unit.y) + bitcast<u32>(unit.z * unit.z);
            inside = squared <= 32767u * 32767u;
        }
    }
    if (!inside) {
        unit = vec3<i32>(unit.x / 2, unit.y / 2, unit.z / 2);
    }
    return vec3<i32>(
        center.x + offset_scaled(unit.x, extent.x),
        center.y + offset_scaled(unit.y, extent.y),
        center.z + offset_scaled(unit.z, extent.z),
    );
}

fn source_share(source: u32, species: u32) -> u32 {
    return environment.sources[source].shares[species >> 2u][species & 3u];
}

fn release_species(source: u32, word: u32) -> u32 {
    var species = 0u;
    for (var candidate = 0u; candidate < 4u * SHARE_VECTORS; candidate++) {
        species += select(0u, 1u, word >= source_share(source, candidate));
    }
    return species;
}

fn release_size_speed(species: u32, words: vec4<u32>) -> vec2<u32> {
    let size_spread = bitcast<i32>(environment.species[species].size_spread_q14);
    let speed_spread = bitcast<i32>(environment.species[species].speed_spread_q14);
    let size = bitcast<i32>(SIZE_ONE) + ((size_spread * triangular(words.y)) >> 16u);
    let speed = bitcast<i32>(SIZE_ONE) + ((speed_spread * triangular(words.z)) >> 16u);
    return vec2<u32>(bitcast<u32>(size), bitcast<u32>(speed));
}

fn release_ratio(size_speed: vec2<u32>) -> u32 {
    return (size_speed.y << 16u) / size_speed.x;
}

fn species_rate(species: u32, primitive: u32) -> u32 {
    return environment.species[species].rates[primitive >> 2u][primitive & 3u];
}

fn release_rate(species: u32, primitive: u32, ratio_q16: u32) -> u32 {
    return mul_q16(species_rate(species, primitive), ratio_q16);
}

fn release_fall_time(species: u32, height: i32, speed: u32) -> u32 {
    let positive = bitcast<u32>(max(height, 0));
    let per_metre = environment.species[species].fall_steps_q16_per_m;
    let nominal = (mul_high(positive, per_metre) << 22u) | ((positive * per_metre) >> 10u);
    return mul_q16(nominal, (1u << 30u) / speed);
}

fn next_event(id: u32, release: u32, fall_time: u32, stage: u32, source: u32) -> u32 {
    let lifetime = environment.sources[source].lifetime_steps;
    // A tree takes its leaves back only from the ground.
    let is_final = lifetime == 0u || source == SOURCE_TREES;
    let recycle = select(release + lifetime, NEVER, is_final);
    if (stage + 1u >= STAGE_COUNT) {
        return recycle;
    }
    let seed = environment.seed;
    return min(recycle, release + (stage_end(seed, id, fall_time, stage) >> 16u));
}

fn leaf_release(leaf: u32, id: u32, source: u32, release: u32) {
    let seed = environment.seed;
    let place = release_place(source, seed, id);
    let look = random(seed, id, STREAM_LOOK);
    leaf_drop(leaf, id, look, source, release_species(source, look.x), place, release);
}

fn leaf_drop(
    leaf: u32,
    id: u32,
    look: vec4<u32>,
    source: u32,
    species: u32,
    place: vec3<i32>,
    release: u32,
) {
    let size_speed = release_size_speed(species, look);
    let position =
        vec3<f32>(f32(place.x) * LENGTH_UNIT, f32(place.y) * LENGTH_UNIT, f32(place.z) * LENGTH_UNIT);
    let ground = (ground_surface(position.x, position.z) + environment.surface_height_m) * 1024.0;
    identities[leaf].z = release_fall_time(species, place.y - i32(floor(ground)), size_speed.y);
    identities[leaf].w = (look.w & HALF_MASK)
        | ((look.x & VARIANT_MASK) << VARIANT_SHIFT)
        | (source << SOURCE_SHIFT)
        | (0u << STAGE_SHIFT);
    courses[leaf].z = size_speed.x;
    courses[leaf].w = look.w >> 16u;
    places[leaf] = vec4<u32>(bitcast<vec3<u32>>(position), (0u << BLEND_SHIFT) | (species << SPECIES_SHIFT));
    drifts[leaf] = vec4<u32>(0u, 0u, 0u, 0u);
    if (environment.species[species].first_motion == AERODYNAMIC) {
        leaf_hold(leaf, id);
    }
    leaf_set_off(leaf, id, release, size_speed);
}

fn leaf_set_off(leaf: u32, id: u32, release: u32, size_speed: vec2<u32>) {
    let seed = environment.seed;
    var identity = identities[leaf];
    var course = courses[leaf];
    let before = places[leaf].w;
    let source = (identity.w >> SOURCE_SHIFT) & SOURCE_MASK;
    let species = (before >> SPECIES_SHIFT) & SPECIES_MASK;
    let stage = stage_words(seed, id, 0u);
    let primitive = environment.species[species].first_motion;
    identity.x = id;
    identity.y = release;
    identity.w = identity.w & ~(STAGE_MASK << STAGE_SHIFT);
    if (primitive == AERODYNAMIC) {
        course.x = next_event(id, release, 0u, STAGE_COUNT, source);
        identities[leaf] = identity;
        courses[leaf] = course;
        places[leaf].w = STATE_FALLING
            | (before & (SPECIES_MASK << SPECIES_SHIFT))
            | (primitive << PRIMITIVE_SHIFT);
        leaf_launch(leaf, id);
        return;
    }
    course.x = next_event(id, release, identity.z, 0u, source);
    course.y = release_rate(species, primitive, release_ratio(size_speed));
    course.w = (stage.z & (HALF_MASK << 16u)) | (course.w & HALF_MASK);
    identities[leaf] = identity;
    courses[leaf] = course;
    let bits = STATE_FALLING
        | (before & ((BLEND_MASK << BLEND_SHIFT) | (SPECIES_MASK << SPECIES_SHIFT)))
        | (primitive << PRIMITIVE_SHIFT)
        | ((stage.w & HALF_MASK) << SPIN_SHIFT);
    places[leaf].w = bits;
    let own = own_velocity(bits, stage.y, course);
    let start = bitcast<vec3<f32>>(drifts[leaf].xyz) - own;
    drifts[leaf] = vec4<u32>(bitcast<vec3<u32>>(start), stage.y);
}

fn leaf_detach(leaf: u32, release: u32) {
    let seed = environment.seed;
    let id = identities[leaf].x + environment.ids_per_life;
    let look = random(seed, id, STREAM_LOOK);
    let species = (places[leaf].w >> SPECIES_SHIFT) & SPECIES_MASK;
    let size = courses[leaf].z >> 16u;
    courses[leaf].z = size | (size << 16u);
    if (environment.species[species].first_motion != AERODYNAMIC) {
        courses[leaf].w = look.w >> 16u;
    }
    places[leaf].w = (places[leaf].w & ~(BLEND_MASK << BLEND_SHIFT)) | (environment.blend_steps << BLEND_SHIFT);
    leaf_set_off(leaf, id, release, vec2<u32>(size, release_size_speed(species, look).y));
}
