// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/burn.rs
// Burning leaves: hot air and burning neighbours heat a leaf until it catches, a front runs over it, its mass falls stage by stage, and in
// the end it is gone.
#import leaf/burn_bindings
#import arith/math
#import arith/rng
#import arith/vector
#import leaf/air_cell
#import leaf/record
#import wind/plume
#import wind/sample

struct BurnCell {
    index: u32,
    key: u32,
}

struct LeafHeat {
    index: u32,
    sums: BurnSums,
}

fn scene_species(bits: u32) -> u32 {
    return leaf_species(bits) % scene.species_count;
}

fn burn_way(time: u32, burn: Burn) -> f32 {
    if (burn.lit == UNLIT) {
        return burn.out_way;
    }
    let steps = (time - burn.lit) + 1u;
    return min(f32(bitcast<i32>(steps)) * reciprocal(burn.steps), 1.0);
}

fn burn_power(species: u32, ratio: f32, way: f32) -> f32 {
    return (scene.burns[species].mean_w * ratio) * ((way * (1.0 - way)) * 6.0);
}

fn leaf_rise(species: u32, heat: f32) -> f32 {
    let wet = min(heat * scene.burns[species].wet_m2_k_j, BOILING_RISE_K);
    return wet + max(heat - scene.burns[species].dry_j_m2, 0.0) * scene.burns[species].dry_m2_k_j;
}

fn ignition_rise(species: u32, slot: u32) -> f32 {
    let word = random(scene.seed, slot, STREAM_IGNITION).x;
    return scene.burns[species].ignition_k + scene.burns[species].ignition_span_k * unit_float(word);
}

fn burn_cell(place: vec3<f32>) -> BurnCell {
    let shifted = (place + step_block.collision_shift_m) * BURN_CELLS_PER_M;
    let column = bitcast<u32>(i32(cell_floor(shifted.x)));
    let layer = bitcast<u32>(i32(cell_floor(shifted.y)));
    let line = bitcast<u32>(i32(cell_floor(shifted.z)));
    let key = cell_key(column, layer, line);
    return BurnCell(key >> (32u - BURN_CELL_BITS), key);
}

fn heated_cell(place: vec3<f32>) -> BurnCell {
    let wind = wind_at(place);
    return burn_cell(vec3<f32>(place.x + wind.x * FLAME_LEAN_S, place.y, place.z + wind.z * FLAME_LEAN_S));
}

fn burn_sums(cell: BurnCell, power_w: f32) -> BurnSums {
    let power = u32(floor(min(power_w * BURN_POWER_ONE, BURN_POWER_MOST)));
    return BurnSums(1u, cell.key, power, 0u);
}

fn leaf_heat_release(place: vec3<f32>, bits: u32, size: u32, burn: Burn) -> LeafHeat {
    let none = LeafHeat(0u, BurnSums(0u, 0u, 0u, 0u));
    if (burn.lit == UNLIT || leaf_state(bits) == STATE_DORMANT) {
        return none;
    }
    let way = burn_way(step_block.index, burn);
    if (way >= 1.0) {
        return none;
    }
    let cell = heated_cell(place);
    return LeafHeat(cell.index, burn_sums(cell, burn_power(scene_species(bits), size_ratio(size), way)));
}

fn feeds_plume(plume: u32, place: vec3<f32>) -> bool {
    let from_base = place - step_block.moments[MOMENT_NOW].plumes[plume].base_m;
    return vec3_dot(from_base, from_base) < step_block.moments[MOMENT_NOW].plumes[plume].feeding_m2;
}

fn fire_words(before: u32, fed: u32) -> vec4<u32> {
    let power = before + bitcast<u32>(bitcast<i32>(fed - before) >> FIRE_FOLLOWS);
    let power_kw = min(f32(bitcast<i32>(power)) * FIRE_KW, FIRE_MOST_KW);
    if (power_kw < FIRE_LEAST_KW) {
        return vec4<u32>(power, 0u, 0u, 0u);
    }
    let inverse_root = inverse_fifth_root(power_kw);
    return vec4<u32>(
        power,
        bitcast<u32>(reciprocal(inverse_root)),
        bitcast<u32>(inverse_root * inverse_root),
        0u,
    );
}

fn cell_power(cell: BurnCell, sums: BurnSums) -> f32 {
    if (sums.count == 0u || sums.key != sums.count * cell.key) {
        return 0.0;
    }
    return f32(bitcast<i32>(sums.power)) * (1.0 / BURN_POWER_ONE);
}

fn flame_warmth(power_w: f32) -> f32 {
    let cells_per_m3 = (BURN_CELLS_PER_M * BURN_CELLS_PER_M) * BURN_CELLS_PER_M;
    return min(power_w * (cells_per_m3 * (FLAME_RISE_K / FLAME_W_PER_M3)), FLAME_RISE_K);
}

fn leaf_heat(leaf: u32, slot: u32, species: u32, power_w: f32) {
    let bits = places[leaf].bits;
    let is_open = lies_still(bits) && !is_covered(bits) && !is_afloat(bits) && !is_sunk(bits);
    if (!is_open && !flies(bits)) {
        burns[leaf].heat = 0.0;
        return;
    }
    let warmth = max(plume_warmth(places[leaf].position), flame_warmth(power_w));
    let heat = burns[leaf].heat;
    burns[leaf].heat = max(heat + scene.burns[species].exchange_j_m2_k * (warmth - leaf_rise(species, heat)), 0.0);
    if (leaf_rise(species, burns[leaf].heat) >= ignition_rise(species, slot)) {
        burns[leaf].lit = step_block.index + 1u;
        burns[leaf].steps = scene.burns[species].steps * size_ratio(schedules[leaf].size);
    }
}

fn leaf_waste(leaf: u32, species: u32, way: f32) -> bool {
    let bits = places[leaf].bits;
    let state = leaf_state(bits);
    if (state == STATE_DORMANT) {
        return false;
    }
    if (lies(bits) && (is_afloat(bits) || is_sunk(bits))) {
        burns[leaf] = Burn(0.0, way, UNLIT, 0.0);
        return false;
    }
    let is_lying = lies_still(bits);
    let is_flying = flies(bits);
    if (way >= 1.0) {
        if (is_lying) {
            places[leaf].bits = with_litter_change(bits, CHANGE_REMOVED);
            return true;
        }
        if (is_flying || (state == STATE_RESTING && !lies(bits))) {
            places[leaf].bits = place_bits(STATE_DORMANT, 0u, 0u, species, 0u);
            drifts[leaf].velocity = vec3<f32>(0.0, 0.0, 0.0);
            schedules[leaf].event = NEVER;
        }
        return false;
    }
    let stage = u32(floor(way * f32(BURN_STAGES))) + 1u;
    let number = species + stage * scene.species_count;
    if ((is_lying || is_flying) && number != leaf_species(bits)) {
        places[leaf].bits = with_species(bits, number);
    }
    return false;
}

fn leaf_burn(leaf: u32, slot: u32, power_w: f32) -> bool {
    let species = scene_species(places[leaf].bits);
    if (scene.burns[species].steps == 0.0) {
        return false;
    }
    if (burns[leaf].lit == UNLIT) {
        if (burns[leaf].out_way != 0.0) {
            return false;
        }
        leaf_heat(leaf, slot, species, power_w);
        return false;
    }
    return leaf_waste(leaf, species, burn_way(step_block.index, burns[leaf]));
}
