// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/record.rs
// Accessors of every word of a leaf's records that packs several values or changes its meaning with the leaf's state.
#import prelude

fn leaf_state(bits: u32) -> u32 {
    return bits & STATE_MASK;
}

fn with_state(bits: u32, state: u32) -> u32 {
    return (bits & ~STATE_MASK) | state;
}

fn blend_steps_left(bits: u32) -> u32 {
    return (bits >> BLEND_SHIFT) & BLEND_MASK;
}

fn with_blend(bits: u32, steps: u32) -> u32 {
    return (bits & ~(BLEND_MASK << BLEND_SHIFT)) | (steps << BLEND_SHIFT);
}

fn count_down_blend(bits: u32, is_blending: bool) -> u32 {
    return bits - select(0u, 1u << BLEND_SHIFT, is_blending);
}

fn motion_table(bits: u32) -> u32 {
    return (bits >> TABLE_SHIFT) & TABLE_MASK;
}

fn leaf_primitive(bits: u32) -> u32 {
    return (bits >> PRIMITIVE_SHIFT) & PRIMITIVE_MASK;
}

fn with_primitive(bits: u32, primitive: u32) -> u32 {
    return (bits & ~(PRIMITIVE_MASK << PRIMITIVE_SHIFT)) | (primitive << PRIMITIVE_SHIFT);
}

fn flies(bits: u32) -> bool {
    let flying = STATE_FALLING | (AERODYNAMIC << PRIMITIVE_SHIFT);
    return (bits & (STATE_MASK | (PRIMITIVE_MASK << PRIMITIVE_SHIFT))) == flying;
}

fn landed_bits(bits: u32) -> u32 {
    let is_spiral = leaf_primitive(bits) == CONE_SPIRAL;
    return with_state(with_blend(select(bits, with_primitive(bits, 0u), is_spiral), 0u), STATE_RESTING);
}

fn leaf_regime(bits: u32) -> u32 {
    return (bits >> REGIME_SHIFT) & REGIME_MASK;
}

fn with_regime(bits: u32, regime: u32) -> u32 {
    return (bits & ~(REGIME_MASK << REGIME_SHIFT)) | (regime << REGIME_SHIFT);
}

fn leaf_species(bits: u32) -> u32 {
    return (bits >> SPECIES_SHIFT) & SPECIES_MASK;
}

fn with_species(bits: u32, species: u32) -> u32 {
    return (bits & ~(SPECIES_MASK << SPECIES_SHIFT)) | (species << SPECIES_SHIFT);
}

fn spin_angle(bits: u32) -> u32 {
    return bits >> SPIN_SHIFT;
}

fn turn_spin(bits: u32, turn: u32) -> u32 {
    return bits + (turn << SPIN_SHIFT);
}

fn lies(bits: u32) -> bool {
    let lying = STATE_RESTING | (LYING << PRIMITIVE_SHIFT);
    return (bits & (STATE_MASK | (PRIMITIVE_MASK << PRIMITIVE_SHIFT))) == lying;
}

fn litter_change(bits: u32) -> u32 {
    return (bits >> CHANGE_SHIFT) & CHANGE_MASK;
}

fn lies_still(bits: u32) -> bool {
    return lies(bits) && litter_change(bits) == CHANGE_NONE;
}

fn with_litter_change(bits: u32, change: u32) -> u32 {
    return (bits & ~(CHANGE_MASK << CHANGE_SHIFT)) | (change << CHANGE_SHIFT);
}

fn is_covered(bits: u32) -> bool {
    return ((bits >> COVERED_SHIFT) & 1u) != 0u;
}

fn with_cover(bits: u32, covered: bool) -> u32 {
    let mark = 1u << COVERED_SHIFT;
    return (bits & ~mark) | select(0u, mark, covered);
}

fn is_held(bits: u32) -> bool {
    return ((bits >> HELD_SHIFT) & 1u) != 0u;
}

fn held_bits(species: u32) -> u32 {
    return place_bits(STATE_RESTING, 1u << (HELD_SHIFT - BLEND_SHIFT), LYING, species, 0u);
}

fn is_afloat(bits: u32) -> bool {
    return ((bits >> AFLOAT_SHIFT) & 1u) != 0u;
}

fn with_afloat(bits: u32) -> u32 {
    return bits | (1u << AFLOAT_SHIFT);
}

fn is_sunk(bits: u32) -> bool {
    return ((bits >> SUNK_SHIFT) & 1u) != 0u;
}

fn soaked_bits(bits: u32) -> u32 {
    return with_litter_change(bits, CHANGE_REMOVED) | (1u << SUNK_SHIFT);
}

fn sunk_bits(species: u32) -> u32 {
    let marks = (1u << (SUNK_SHIFT - BLEND_SHIFT)) | (1u << (COVERED_SHIFT - BLEND_SHIFT));
    return place_bits(STATE_RESTING, marks, LYING, species, 0u);
}

fn is_on_ground(bits: u32) -> bool {
    return (bits & ((1u << HELD_SHIFT) | (1u << AFLOAT_SHIFT) | (1u << SUNK_SHIFT))) == 0u;
}

fn lying_volume(bits: u32) -> u32 {
    return bits >> SPIN_SHIFT;
}

fn touch_steps(bits: u32) -> u32 {
    return bits >> SPIN_SHIFT;
}

fn with_touch_steps(bits: u32, steps: u32) -> u32 {
    return (bits & HALF_MASK) | (steps << SPIN_SHIFT);
}

fn place_bits(state: u32, blend: u32, primitive: u32, species: u32, spin: u32) -> u32 {
    return state
        | (blend << BLEND_SHIFT)
        | (primitive << PRIMITIVE_SHIFT)
        | (species << SPECIES_SHIFT)
        | (spin << SPIN_SHIFT);
}

fn body_spin(phase: u32, rate: u32, heading: u32) -> vec3<f32> {
    return vec3<f32>(bitcast<f32>(phase), bitcast<f32>(rate), bitcast<f32>(heading));
}

fn body_spin_words(spin: vec3<f32>) -> vec3<u32> {
    return bitcast<vec3<u32>>(spin);
}

fn ground_steps(phase: u32) -> u32 {
    return phase;
}

fn wake_speed_squared(phase: u32) -> f32 {
    return bitcast<f32>(phase);
}

fn wake_speed_word(square: f32) -> u32 {
    return bitcast<u32>(square);
}

fn lying_support(rate: u32) -> f32 {
    return bitcast<f32>(rate);
}

fn lying_support_word(height_m: f32) -> u32 {
    return bitcast<u32>(height_m);
}

fn lying_friction(heading: u32) -> f32 {
    return f32(heading & HALF_MASK) * LYING_FRICTION_UNIT;
}

fn lying_raise(heading: u32) -> u32 {
    return heading >> 16u;
}

fn lying_word(friction: f32, raise: u32) -> u32 {
    return u32(friction * LYING_FRICTION_ONE) | (raise << 16u);
}

fn smoothed_air_speed(phase: u32) -> f32 {
    return bitcast<f32>(phase);
}

fn smoothed_air_speed_word(speed: f32) -> u32 {
    return bitcast<u32>(speed);
}

fn drawn_size(size: u32) -> u32 {
    return size & HALF_MASK;
}

fn size_ratio(size: u32) -> f32 {
    return f32(drawn_size(size)) * SIZE_UNIT;
}

fn own_size(size: u32) -> u32 {
    return size >> 16u;
}

fn twig_sizes(own: u32, drawn: u32) -> u32 {
    return (own << 16u) | drawn;
}

fn asymmetry(size: u32, number: u32) -> f32 {
    return (f32((size >> (ASYMMETRY_SHIFT + 4u * number)) & ASYMMETRY_MASK) - ASYMMETRY_MIDDLE) * ASYMMETRY_UNIT;
}

fn with_asymmetry(size: u32, asymmetry: u32) -> u32 {
    return (size & HALF_MASK) | (asymmetry << ASYMMETRY_SHIFT);
}

fn heading_angle(heading: u32) -> u32 {
    return heading >> 16u;
}

fn spin_rate(heading: u32) -> u32 {
    return bitcast<u32>(bitcast<i32>(heading << 16u) >> 16u);
}

fn heading_word(angle: u32, rate: u32) -> u32 {
    return (angle << 16u) | (rate & HALF_MASK);
}

fn regime_state(fall_time: u32) -> u32 {
    return fall_time;
}

fn leaf_tint(appearance: u32) -> u32 {
    return appearance & HALF_MASK;
}

fn leaf_variant(appearance: u32) -> u32 {
    return (appearance >> VARIANT_SHIFT) & VARIANT_MASK;
}

fn leaf_source(appearance: u32) -> u32 {
    return (appearance >> SOURCE_SHIFT) & SOURCE_MASK;
}

fn leaf_stage(appearance: u32) -> u32 {
    return (appearance >> STAGE_SHIFT) & STAGE_MASK;
}

fn with_stage(appearance: u32, stage: u32) -> u32 {
    return (appearance & ~(STAGE_MASK << STAGE_SHIFT)) | (stage << STAGE_SHIFT);
}

fn leaf_appearance(tint: u32, variant: u32, source: u32) -> u32 {
    return (tint & HALF_MASK) | ((variant & VARIANT_MASK) << VARIANT_SHIFT) | (source << SOURCE_SHIFT);
}
