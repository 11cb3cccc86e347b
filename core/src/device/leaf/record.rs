// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/record.wgsl
//!
//! The five records of 16 bytes that make a leaf besides its air, and the accessors of every word that packs several
//! values or changes its meaning with the leaf's state. One file, so that no two places pack the same word.

use crate::arith::lane::{Mask, Real, Word};
use crate::arith::vector::Vec3;

crate::shared_constants! {
    /// Mask of a leaf's state in [`Place::bits`].
    pub const STATE_MASK: u32 = 3;
    /// Not released yet; not drawn.
    pub const STATE_DORMANT: u32 = 0;
    /// Riding a branch.
    pub const STATE_ATTACHED: u32 = 1;
    /// In the air.
    pub const STATE_FALLING: u32 = 2;
    /// On the ground.
    pub const STATE_RESTING: u32 = 3;
    /// Place of the orientation blend's remaining steps.
    pub const BLEND_SHIFT: u32 = 2;
    /// Largest number of remaining steps.
    pub const BLEND_MASK: u32 = 63;
    /// Place of the motion table's number: species times eight plus primitive motion.
    pub const TABLE_SHIFT: u32 = 8;
    /// Mask of the table number.
    pub const TABLE_MASK: u32 = 255;
    /// Place of the primitive motion.
    pub const PRIMITIVE_SHIFT: u32 = 8;
    /// Mask of the primitive motion.
    pub const PRIMITIVE_MASK: u32 = 7;
    /// In place of a primitive motion: the leaf flies as a body in the air.
    pub const AERODYNAMIC: u32 = 6;
    /// In place of a primitive motion, of a leaf on the ground: it lies in the litter.
    pub const LYING: u32 = 7;
    /// Primitive motion of a leaf in the air: the cone spiral. One that comes to the ground no longer has it ([`landed_bits`]).
    pub const CONE_SPIRAL: u32 = 7;
    /// Place of a lying leaf's change of the litter, where others keep their blend.
    pub const CHANGE_SHIFT: u32 = 2;
    /// Mask of the change.
    pub const CHANGE_MASK: u32 = 3;
    /// The litter has the leaf's volume, and the leaf lies still.
    pub const CHANGE_NONE: u32 = 0;
    /// The leaf has just lain down: the litter takes its volume.
    pub const CHANGE_ADDED: u32 = 1;
    /// The wind takes the leaf: the litter loses its volume, and the leaf flies.
    pub const CHANGE_WOKEN: u32 = 2;
    /// The leaf sinks or is recycled: the litter loses its volume.
    pub const CHANGE_REMOVED: u32 = 3;
    /// Place of the mark of a lying leaf that others cover.
    pub const COVERED_SHIFT: u32 = 4;
    /// Place of the mark of a lying leaf that a solid part holds, not the ground: it has no volume in the litter.
    pub const HELD_SHIFT: u32 = 5;
    /// Place of the mark of a lying leaf that floats on water.
    pub const AFLOAT_SHIFT: u32 = 6;
    /// Place of the mark of a lying leaf that sinks or lies under water: it has no volume in the litter.
    pub const SUNK_SHIFT: u32 = 7;
    /// Place of a body's regime, where others keep their blend.
    pub const REGIME_SHIFT: u32 = 2;
    /// Mask of the regime.
    pub const REGIME_MASK: u32 = 7;
    /// Place of the species.
    pub const SPECIES_SHIFT: u32 = 11;
    /// Mask of the species.
    pub const SPECIES_MASK: u32 = 31;
    /// Place of the spin angle in 2^-16 turns.
    pub const SPIN_SHIFT: u32 = 16;
    /// Mask of half a word.
    pub const HALF_MASK: u32 = 0xffff;
    /// Place of the variant among a species' leaf images in [`Identity::appearance`].
    pub const VARIANT_SHIFT: u32 = 16;
    /// Mask of the variant.
    pub const VARIANT_MASK: u32 = 255;
    /// Place of the source.
    pub const SOURCE_SHIFT: u32 = 24;
    /// Mask of the source.
    pub const SOURCE_MASK: u32 = 31;
    /// Place of the stage.
    pub const STAGE_SHIFT: u32 = 29;
    /// Mask of the stage.
    pub const STAGE_MASK: u32 = 7;
    /// A leaf of nominal size in the low half of [`Schedule::size`].
    pub const SIZE_ONE: u32 = 16384;
    /// Inverse of it.
    pub const SIZE_UNIT: f32 = 1.0 / 16384.0;
    /// Place of a body's asymmetries in the same word: four of four bits.
    pub const ASYMMETRY_SHIFT: u32 = 16;
    /// Mask of one of them.
    pub const ASYMMETRY_MASK: u32 = 15;
    /// Middle of their range.
    pub const ASYMMETRY_MIDDLE: f32 = 7.5;
    /// Inverse of it.
    pub const ASYMMETRY_UNIT: f32 = 1.0 / 7.5;
    /// A friction coefficient of one of a leaf in the litter.
    pub const LYING_FRICTION_ONE: f32 = 4096.0;
    /// Inverse of it.
    pub const LYING_FRICTION_UNIT: f32 = 1.0 / 4096.0;
    /// Middle of a range, 32 to 64, in which floats lie [`GRID_UNIT`] apart.
    pub const GRID_ANCHOR: f32 = 48.0;
    /// Distance of the grid that displacements lie on, in metres.
    pub const GRID_UNIT: f32 = 1.0 / 262_144.0;
}

crate::shared_record! {
    /// Position and packed flags. Hot.
    pub struct Place {
        /// Position in metres.
        pub position: [f32; 3],
        /// State; blend, regime or change of the litter; primitive motion; species; spin angle, steps of touch or volume: see
        /// [`leaf_state`] to [`lying_volume`].
        pub bits: u32,
    }
}

crate::shared_record! {
    /// Residual velocity and phase. Hot.
    pub struct Drift {
        /// Velocity beyond the leaf's own motion in m/s: the wind as far as the leaf follows it, and what is left of
        /// earlier motion. Of a body in the air: all its velocity. On the ground: the velocity of sliding. On and under water:
        /// that of drifting and sinking. On the twig: the velocity of the blade.
        pub velocity: [f32; 3],
        /// Phase of the primitive motion in 2^-32 periods; of the cone spiral, its age in 2^-16 steps. Of a body in the air: its spin about x ([`body_spin`]). On the
        /// ground: [`ground_steps`], in the litter [`wake_speed_squared`]. On the twig: [`smoothed_air_speed`].
        pub phase: u32,
    }
}

crate::shared_record! {
    /// Orientation. Written every step, read only while it blends.
    pub struct Attitude {
        /// Unit quaternion x, y, z, w that turns the leaf frame into place: the blade in the x-z plane, normal +y, petiole
        /// towards -z, tip towards +z.
        pub quaternion: [f32; 4],
    }
}

crate::shared_record! {
    /// Next event and the parameters of the motion until then. Read every step, written at events; of a body in the air
    /// at every step.
    #[derive(Eq)]
    pub struct Schedule {
        /// Step of the next event: release, end of a stage, recycling, the petiole's break.
        pub event: u32,
        /// Phase per step in 2^-32 periods; of the cone spiral, in 2^-16 steps. Of a body in the air: its spin about y ([`body_spin`]). In the litter:
        /// [`lying_support`]. Afloat: the height in m above the water at which the leaf's wind is sampled.
        pub rate: u32,
        /// Low half: size relative to the species' ([`size_ratio`]). High half: of a leaf on its twig, [`own_size`]; of a
        /// body in the air, [`asymmetry`].
        pub size: u32,
        /// Heading and spin rate ([`heading_angle`], [`spin_rate`]). Of a body in the air: its spin about z
        /// ([`body_spin`]). In the litter: [`lying_friction`], [`lying_raise`].
        pub heading: u32,
    }
}

crate::shared_record! {
    /// Identity and appearance. Cold: read and written at events only, but for the regime's state of a body in the air.
    #[derive(Eq)]
    pub struct Identity {
        /// Number of the leaf, slot plus a multiple of the slot count; everything random about it follows from this.
        pub id: u32,
        /// Step of its release, two's complement.
        pub release: u32,
        /// Time of a fall through still air in 2^-16 steps. Of a body in the air: [`regime_state`].
        pub fall_time: u32,
        /// Tint, image variant, source and stage: see [`leaf_tint`] to [`leaf_stage`].
        pub appearance: u32,
    }
}

/// State of a leaf with these bits: [`STATE_DORMANT`] to [`STATE_RESTING`].
#[inline(always)]
pub fn leaf_state<W: Word>(bits: W) -> W {
    bits & STATE_MASK
}

/// Bits with another state.
#[inline(always)]
pub fn with_state(bits: u32, state: u32) -> u32 {
    (bits & !STATE_MASK) | state
}

/// Steps that the orientation still blends for. Not of a body in the air.
#[inline(always)]
pub fn blend_steps_left<W: Word>(bits: W) -> W {
    (bits >> BLEND_SHIFT) & BLEND_MASK
}

/// Bits with another number of such steps.
#[inline(always)]
pub fn with_blend(bits: u32, steps: u32) -> u32 {
    (bits & !(BLEND_MASK << BLEND_SHIFT)) | (steps << BLEND_SHIFT)
}

/// Bits with one such step less where `is_blending` is true.
#[inline(always)]
pub fn count_down_blend<W: Word>(bits: W, is_blending: W::Mask) -> W {
    bits.minus(is_blending.select(bits.all(1 << BLEND_SHIFT), bits.all(0)))
}

/// Motion table: species times eight plus primitive motion.
#[inline(always)]
pub fn motion_table<W: Word>(bits: W) -> W {
    (bits >> TABLE_SHIFT) & TABLE_MASK
}

/// Primitive motion, or [`AERODYNAMIC`].
#[inline(always)]
pub fn leaf_primitive<W: Word>(bits: W) -> W {
    (bits >> PRIMITIVE_SHIFT) & PRIMITIVE_MASK
}

/// Bits with another primitive motion.
#[inline(always)]
pub fn with_primitive(bits: u32, primitive: u32) -> u32 {
    (bits & !(PRIMITIVE_MASK << PRIMITIVE_SHIFT)) | (primitive << PRIMITIVE_SHIFT)
}

/// Returns true if leaves with these bits fly as bodies.
#[inline(always)]
pub fn flies<W: Word>(bits: W) -> W::Mask {
    let flying = STATE_FALLING | (AERODYNAMIC << PRIMITIVE_SHIFT);
    (bits & (STATE_MASK | (PRIMITIVE_MASK << PRIMITIVE_SHIFT))).equals(flying)
}

/// Bits of a leaf of those that has come to the ground: the number of the cone spiral would say there that it lies in the litter.
#[inline(always)]
pub fn landed_bits(bits: u32) -> u32 {
    let is_spiral = leaf_primitive(bits) == CONE_SPIRAL;
    with_state(with_blend(if is_spiral { with_primitive(bits, 0) } else { bits }, 0), STATE_RESTING)
}

/// Regime of a body in the air: [`REGIME_STEADY`](crate::device::flight::regime::REGIME_STEADY) and so on.
#[inline(always)]
pub fn leaf_regime<W: Word>(bits: W) -> W {
    (bits >> REGIME_SHIFT) & REGIME_MASK
}

/// Bits with another regime.
#[inline(always)]
pub fn with_regime<W: Word>(bits: W, regime: W) -> W {
    (bits & !(REGIME_MASK << REGIME_SHIFT)) | (regime << REGIME_SHIFT)
}

/// Number of the species.
#[inline(always)]
pub fn leaf_species<W: Word>(bits: W) -> W {
    (bits >> SPECIES_SHIFT) & SPECIES_MASK
}

/// Bits of another species.
#[inline(always)]
pub fn with_species(bits: u32, species: u32) -> u32 {
    (bits & !(SPECIES_MASK << SPECIES_SHIFT)) | (species << SPECIES_SHIFT)
}

/// Spin angle in 2^-16 turns. Not of a body in the air.
#[inline(always)]
pub fn spin_angle<W: Word>(bits: W) -> W {
    bits >> SPIN_SHIFT
}

/// Bits with the spin angle turned on by `turn` in 2^-16 turns, two's complement.
#[inline(always)]
pub fn turn_spin<W: Word>(bits: W, turn: W) -> W {
    bits.plus(turn << SPIN_SHIFT)
}

/// Returns true if leaves with these bits lie in the litter.
#[inline(always)]
pub fn lies<W: Word>(bits: W) -> W::Mask {
    let lying = STATE_RESTING | (LYING << PRIMITIVE_SHIFT);
    (bits & (STATE_MASK | (PRIMITIVE_MASK << PRIMITIVE_SHIFT))).equals(lying)
}

/// Change of the litter that a lying leaf waits for: [`CHANGE_NONE`] to [`CHANGE_REMOVED`].
#[inline(always)]
pub fn litter_change<W: Word>(bits: W) -> W {
    (bits >> CHANGE_SHIFT) & CHANGE_MASK
}

/// Returns true if leaves with these bits lie in the litter and wait for no change of it.
#[inline(always)]
pub fn lies_still<W: Word>(bits: W) -> W::Mask {
    lies(bits) & litter_change(bits).equals(CHANGE_NONE)
}

/// Bits of a lying leaf with another change.
#[inline(always)]
pub fn with_litter_change(bits: u32, change: u32) -> u32 {
    (bits & !(CHANGE_MASK << CHANGE_SHIFT)) | (change << CHANGE_SHIFT)
}

/// Returns true if others cover a lying leaf, so that no wind reaches it.
#[inline(always)]
pub fn is_covered<W: Word>(bits: W) -> W::Mask {
    !((bits >> COVERED_SHIFT) & 1).equals(0)
}

/// Bits of a lying leaf that others cover, or no longer do.
#[inline(always)]
pub fn with_cover<W: Word>(bits: W, is_covered: W::Mask) -> W {
    let mark = 1 << COVERED_SHIFT;
    (bits & !mark) | is_covered.select(bits.all(mark), bits.all(0))
}

/// Returns true if a solid part holds a lying leaf.
#[inline(always)]
pub fn is_held<W: Word>(bits: W) -> W::Mask {
    !((bits >> HELD_SHIFT) & 1).equals(0)
}

/// Bits of a leaf of a species that a solid part holds.
#[inline(always)]
pub fn held_bits(species: u32) -> u32 {
    place_bits(STATE_RESTING, 1 << (HELD_SHIFT - BLEND_SHIFT), LYING, species, 0)
}

/// Returns true if a lying leaf floats on water.
#[inline(always)]
pub fn is_afloat<W: Word>(bits: W) -> W::Mask {
    !((bits >> AFLOAT_SHIFT) & 1).equals(0)
}

/// Bits of a lying leaf that floats from now on.
#[inline(always)]
pub fn with_afloat(bits: u32) -> u32 {
    bits | (1 << AFLOAT_SHIFT)
}

/// Returns true if a lying leaf sinks or lies under water; of a leaf afloat, if it is about to.
#[inline(always)]
pub fn is_sunk<W: Word>(bits: W) -> W::Mask {
    !((bits >> SUNK_SHIFT) & 1).equals(0)
}

/// Bits of a leaf afloat that is about to sink: the litter loses its volume first.
#[inline(always)]
pub fn soaked_bits(bits: u32) -> u32 {
    with_litter_change(bits, CHANGE_REMOVED) | (1 << SUNK_SHIFT)
}

/// Bits of a leaf of a species under water. No wind reaches it there.
#[inline(always)]
pub fn sunk_bits(species: u32) -> u32 {
    let marks = (1 << (SUNK_SHIFT - BLEND_SHIFT)) | (1 << (COVERED_SHIFT - BLEND_SHIFT));
    place_bits(STATE_RESTING, marks, LYING, species, 0)
}

/// Returns true if a lying leaf lies on the ground or on litter: not on a solid part, nor on or under water.
#[inline(always)]
pub fn is_on_ground<W: Word>(bits: W) -> W::Mask {
    (bits & ((1 << HELD_SHIFT) | (1 << AFLOAT_SHIFT) | (1 << SUNK_SHIFT))).equals(0)
}

/// Volume of a lying leaf in units of height over a cell.
#[inline(always)]
pub fn lying_volume(bits: u32) -> u32 {
    bits >> SPIN_SHIFT
}

/// Steps for which a body has touched the ground nearly at rest.
#[inline(always)]
pub fn touch_steps<W: Word>(bits: W) -> W {
    bits >> SPIN_SHIFT
}

/// Bits of a body with another number of such steps.
#[inline(always)]
pub fn with_touch_steps<W: Word>(bits: W, steps: W) -> W {
    (bits & HALF_MASK) | (steps << SPIN_SHIFT)
}

/// Bits of a leaf; of `spin` the low half counts.
#[inline(always)]
pub fn place_bits(state: u32, blend: u32, primitive: u32, species: u32, spin: u32) -> u32 {
    state
        | (blend << BLEND_SHIFT)
        | (primitive << PRIMITIVE_SHIFT)
        | (species << SPECIES_SHIFT)
        | (spin << SPIN_SHIFT)
}

/// Spin of a body in the air about its own axes in rad/s, from [`Drift::phase`], [`Schedule::rate`] and
/// [`Schedule::heading`].
#[inline(always)]
pub fn body_spin<W: Word>(phase: W, rate: W, heading: W) -> Vec3<W::Real> {
    Vec3::new(W::Real::from_bits(phase), W::Real::from_bits(rate), W::Real::from_bits(heading))
}

/// The three words of a body's spin.
#[inline(always)]
pub fn body_spin_words<R: Real>(spin: Vec3<R>) -> [R::Word; 3] {
    [spin.x.to_bits(), spin.y.to_bits(), spin.z.to_bits()]
}

/// Steps since a leaf on the ground has landed, or has last slid on hills, from [`Drift::phase`].
#[inline(always)]
pub fn ground_steps<W: Word>(phase: W) -> W {
    phase
}

/// Square in m²/s² of the lowest speed of level wind that moves a leaf in the litter with nothing on it, from [`Drift::phase`].
#[inline(always)]
pub fn wake_speed_squared<W: Word>(phase: W) -> W::Real {
    W::Real::from_bits(phase)
}

/// The word of such a square.
#[inline(always)]
pub fn wake_speed_word(square: f32) -> u32 {
    square.to_bits()
}

/// Height in m of the centre of a leaf in the litter above its lowest point, from [`Schedule::rate`].
#[inline(always)]
pub fn lying_support<W: Word>(rate: W) -> W::Real {
    W::Real::from_bits(rate)
}

/// The word of such a height.
#[inline(always)]
pub fn lying_support_word(height_m: f32) -> u32 {
    height_m.to_bits()
}

/// Friction coefficient of a leaf in the litter, from [`Schedule::heading`].
#[inline(always)]
pub fn lying_friction(heading: u32) -> f32 {
    (heading & HALF_MASK) as f32 * LYING_FRICTION_UNIT
}

/// Angle in 2^-16 turns by which the edges of a leaf in the litter stand up, from [`Schedule::heading`].
#[inline(always)]
pub fn lying_raise(heading: u32) -> u32 {
    heading >> 16
}

/// Heading word of a leaf in the litter.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "below eight, by the scene's limits"
)]
#[inline(always)]
pub fn lying_word(friction: f32, raise: u32) -> u32 {
    ((friction * LYING_FRICTION_ONE) as u32) | (raise << 16)
}

/// Low-pass filtered speed in m/s of the air that blows past a leaf on its twig, from [`Drift::phase`].
#[inline(always)]
pub fn smoothed_air_speed<W: Word>(phase: W) -> W::Real {
    W::Real::from_bits(phase)
}

/// The word of such a speed.
#[inline(always)]
pub fn smoothed_air_speed_word<R: Real>(speed: R) -> R::Word {
    speed.to_bits()
}

/// Size in 2^-14 of the species', as drawn, from [`Schedule::size`].
#[inline(always)]
pub fn drawn_size<W: Word>(size: W) -> W {
    size & HALF_MASK
}

/// The same as a number.
#[inline(always)]
pub fn size_ratio<W: Word>(size: W) -> W::Real {
    drawn_size(size).to_real() * SIZE_UNIT
}

/// Size in 2^-14 of a leaf on its twig by itself, which may be drawn larger there, as it stands for several.
#[inline(always)]
pub fn own_size(size: u32) -> u32 {
    size >> 16
}

/// Size word of a leaf of that size by itself and as drawn.
#[inline(always)]
pub fn twig_sizes(own: u32, drawn: u32) -> u32 {
    (own << 16) | drawn
}

/// One of the four asymmetries of a body in the air, -1 to 1, from [`Schedule::size`].
#[inline(always)]
pub fn asymmetry<W: Word>(size: W, number: u32) -> W::Real {
    (((size >> (ASYMMETRY_SHIFT + 4 * number)) & ASYMMETRY_MASK).to_real() - ASYMMETRY_MIDDLE)
        * ASYMMETRY_UNIT
}

/// Size word with the asymmetries of four of four bits.
#[inline(always)]
pub fn with_asymmetry(size: u32, asymmetry: u32) -> u32 {
    (size & HALF_MASK) | (asymmetry << ASYMMETRY_SHIFT)
}

/// Heading in 2^-16 turns about +y, from [`Schedule::heading`].
#[inline(always)]
pub fn heading_angle<W: Word>(heading: W) -> W {
    heading >> 16
}

/// Spin rate, two's complement, full scale the species' fastest, from [`Schedule::heading`].
#[inline(always)]
pub fn spin_rate<W: Word>(heading: W) -> W {
    (heading << 16).shift_signed(16)
}

/// Heading word of that angle and spin rate, of which the low halves count.
#[inline(always)]
pub fn heading_word(angle: u32, rate: u32) -> u32 {
    (angle << 16) | (rate & HALF_MASK)
}

/// State of a regime's classification of a body in the air, from [`Identity::fall_time`].
#[inline(always)]
pub fn regime_state<W: Word>(fall_time: W) -> W {
    fall_time
}

/// Tint in 2^-16, from [`Identity::appearance`].
#[inline(always)]
pub fn leaf_tint(appearance: u32) -> u32 {
    appearance & HALF_MASK
}

/// Variant among the species' leaf images.
#[inline(always)]
pub fn leaf_variant(appearance: u32) -> u32 {
    (appearance >> VARIANT_SHIFT) & VARIANT_MASK
}

/// Number of the source.
#[inline(always)]
pub fn leaf_source(appearance: u32) -> u32 {
    (appearance >> SOURCE_SHIFT) & SOURCE_MASK
}

/// Stage of the fall.
#[inline(always)]
pub fn leaf_stage(appearance: u32) -> u32 {
    (appearance >> STAGE_SHIFT) & STAGE_MASK
}

/// Appearance with another stage.
#[inline(always)]
pub fn with_stage(appearance: u32, stage: u32) -> u32 {
    (appearance & !(STAGE_MASK << STAGE_SHIFT)) | (stage << STAGE_SHIFT)
}

/// Appearance of a leaf in its first stage; of `tint` the low half, of `variant` the low byte counts.
#[inline(always)]
pub fn leaf_appearance(tint: u32, variant: u32, source: u32) -> u32 {
    (tint & HALF_MASK) | ((variant & VARIANT_MASK) << VARIANT_SHIFT) | (source << SOURCE_SHIFT)
}

/// Returns true if [`Schedule::rate`] and [`Schedule::heading`] hold floats: of a leaf on its twig and of a body.
pub(crate) fn spin_is_float(bits: u32) -> bool {
    leaf_state(bits) == STATE_ATTACHED || leaf_primitive(bits) == AERODYNAMIC
}

/// Returns true if [`Drift::phase`] holds a float: of the same leaves, unless they come to rest on the ground, and in the litter.
pub(crate) fn phase_is_float(bits: u32) -> bool {
    (spin_is_float(bits) && leaf_state(bits) != STATE_RESTING) || lies(bits)
}
