// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/release.rs
// The release of a leaf: place, size, speed and first motion, in integers but for the last conversion.
#import bindings
#import arith/rng
#import motion/feature
#import leaf/launch
#import leaf/own
#import leaf/record
#import terrain/ground

struct SizeSpeed {
    size: u32,
    speed: u32,
}

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
    let center = scene.sources[source].center_units;
    let extent = scene.sources[source].extent_units;
    let kind = scene.sources[source].kind;
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
    return scene.sources[source].shares[species >> 2u][species & 3u];
}

fn release_species(source: u32, word: u32) -> u32 {
    var species = 0u;
    for (var candidate = 0u; candidate < 4u * SHARE_VECTORS; candidate++) {
        species += select(0u, 1u, word >= source_share(source, candidate));
    }
    return species;
}

fn release_size_speed(species: u32, words: vec4<u32>) -> SizeSpeed {
    let size_spread = bitcast<i32>(scene.species[species].size_spread_q14);
    let speed_spread = bitcast<i32>(scene.species[species].speed_spread_q14);
    let size = bitcast<i32>(SIZE_ONE) + ((size_spread * triangular(words.y)) >> 16u);
    let speed = bitcast<i32>(SIZE_ONE) + ((speed_spread * triangular(words.z)) >> 16u);
    return SizeSpeed(bitcast<u32>(size), bitcast<u32>(speed));
}

fn release_ratio(size_speed: SizeSpeed) -> u32 {
    return (size_speed.speed << 16u) / size_speed.size;
}

fn species_rate(species: u32, primitive: u32) -> u32 {
    return scene.species[species].rates[primitive >> 2u][primitive & 3u];
}

fn release_rate(species: u32, primitive: u32, ratio_q16: u32) -> u32 {
    return mul_q16(species_rate(species, primitive), ratio_q16);
}

fn release_fall_time(species: u32, height: i32, speed: u32) -> u32 {
    let positive = bitcast<u32>(max(height, 0));
    let per_metre = scene.species[species].fall_steps_q16_per_m;
    let nominal = (mul_high(positive, per_metre) << 22u) | ((positive * per_metre) >> 10u);
    return mul_q16(nominal, (1u << 30u) / speed);
}

fn next_event(id: u32, release: u32, fall_time: u32, stage: u32, source: u32) -> u32 {
    let lifetime = scene.sources[source].lifetime_steps;
    // A tree takes its leaves back only from the ground.
    let is_final = lifetime == 0u || source == SOURCE_TREES;
    let recycle = select(release + lifetime, NEVER, is_final);
    if (stage + 1u >= STAGE_COUNT) {
        return recycle;
    }
    let seed = scene.seed;
    return min(recycle, release + (stage_end(seed, id, fall_time, stage) >> 16u));
}

fn leaf_release(leaf: u32, id: u32, source: u32, release: u32) {
    let seed = scene.seed;
    let place = release_place(source, seed, id);
    let traits = random(seed, id, STREAM_TRAITS);
    leaf_drop(leaf, id, traits, source, release_species(source, traits.x), place, release);
}

fn leaf_drop(
    leaf: u32,
    id: u32,
    traits: vec4<u32>,
    source: u32,
    species: u32,
    place: vec3<i32>,
    release: u32,
) {
    let size_speed = release_size_speed(species, traits);
    let position =
        vec3<f32>(f32(place.x) * LENGTH_UNIT, f32(place.y) * LENGTH_UNIT, f32(place.z) * LENGTH_UNIT);
    let ground = (ground_surface(position.x, position.z) + scene.surface_height_m) * 1024.0;
    identities[leaf].fall_time = release_fall_time(species, place.y - i32(floor(ground)), size_speed.speed);
    identities[leaf].appearance = leaf_appearance(traits.w, traits.x, source);
    schedules[leaf].size = size_speed.size;
    schedules[leaf].heading = heading_word(0u, traits.w >> 16u);
    places[leaf] = Place(position, place_bits(STATE_DORMANT, 0u, 0u, species, 0u));
    drifts[leaf].velocity = vec3<f32>(0.0, 0.0, 0.0);
    if (scene.species[species].first_motion == AERODYNAMIC) {
        leaf_hold(leaf, id);
    }
    leaf_set_off(leaf, id, release, size_speed);
}

fn leaf_set_off(leaf: u32, id: u32, release: u32, size_speed: SizeSpeed) {
    let seed = scene.seed;
    let before = places[leaf].bits;
    let source = leaf_source(identities[leaf].appearance);
    let species = leaf_species(before);
    let stage = stage_words(seed, id, 0u);
    let primitive = scene.species[species].first_motion;
    identities[leaf].id = id;
    identities[leaf].release = release;
    identities[leaf].appearance = with_stage(identities[leaf].appearance, 0u);
    if (primitive == AERODYNAMIC) {
        schedules[leaf].event = next_event(id, release, 0u, STAGE_COUNT, source);
        places[leaf].bits = place_bits(STATE_FALLING, 0u, primitive, species, 0u);
        leaf_launch(leaf, id);
        return;
    }
    let last = select(0u, STAGE_COUNT, primitive == CONE_SPIRAL);
    let schedule = Schedule(
        next_event(id, release, identities[leaf].fall_time, last, source),
        release_rate(species, primitive, release_ratio(size_speed)),
        schedules[leaf].size,
        heading_word(stage.z >> 16u, schedules[leaf].heading),
    );
    schedules[leaf] = schedule;
    let bits = place_bits(STATE_FALLING, blend_steps_left(before), primitive, species, stage.w);
    places[leaf].bits = bits;
    let phase = first_phase(bits, stage.y);
    let own = own_velocity(bits, phase, motion_params(schedule));
    drifts[leaf] = Drift(drifts[leaf].velocity - own, phase);
}

fn leaf_detach(leaf: u32, release: u32) {
    let seed = scene.seed;
    let id = identities[leaf].id + scene.ids_per_life;
    let traits = random(seed, id, STREAM_TRAITS);
    let species = leaf_species(places[leaf].bits);
    let size = own_size(schedules[leaf].size);
    schedules[leaf].size = twig_sizes(size, size);
    if (scene.species[species].first_motion != AERODYNAMIC) {
        schedules[leaf].heading = heading_word(0u, traits.w >> 16u);
    }
    places[leaf].bits = with_blend(places[leaf].bits, scene.blend_steps);
    leaf_set_off(leaf, id, release, SizeSpeed(size, release_size_speed(species, traits).speed));
}
