// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The five 16-byte records that make a leaf, and the bits packed into them.

use bytemuck::{Pod, Zeroable};

use crate::store::{Field, Record};

crate::shared_constants! {
    /// Mask of a leaf's state in [`Place::bits`].
    pub const STATE_MASK: u32 = 3;
    /// Not let go yet; not drawn.
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
    /// Place of such a leaf's regime, where others keep their blend.
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
    /// Place of the variant among a species' leaf images in [`Identity::look`].
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
    /// A leaf of nominal size in the size field of [`Course::size`].
    pub const SIZE_ONE: u32 = 16384;
    /// Inverse of it.
    pub const SIZE_UNIT: f32 = 1.0 / 16384.0;
    /// Place of a body's quirks in the same word: four of four bits.
    pub const QUIRK_SHIFT: u32 = 16;
    /// Mask of one of them.
    pub const QUIRK_MASK: u32 = 15;
    /// Middle of their range.
    pub const QUIRK_MIDDLE: f32 = 7.5;
    /// Inverse of it.
    pub const QUIRK_UNIT: f32 = 1.0 / 7.5;
    /// Middle of a range, 32 to 64, in which floats lie [`GRID_UNIT`] apart.
    pub const GRID_ANCHOR: f32 = 48.0;
    /// Distance of the grid that displacements lie on, in metres.
    pub const GRID_UNIT: f32 = 1.0 / 262_144.0;
}

/// Where a leaf is, and what it is doing. Hot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C, align(16))]
pub struct Place {
    /// Position in metres.
    pub position: [f32; 3],
    /// State, blend, primitive motion, species and spin angle.
    pub bits: u32,
}

/// How the wind carries a leaf. Hot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C, align(16))]
pub struct Drift {
    /// Velocity beyond the leaf's own motion in m/s: the wind as far as the leaf follows it, and what is left of
    /// earlier motion. Of a body in the air: all its velocity. On the ground: the velocity of sliding. On the twig: the
    /// velocity of the blade.
    pub velocity: [f32; 3],
    /// Phase of the primitive motion in 2^-32 periods. Of a body in the air: float bits of its spin about x in rad/s. On
    /// the ground: steps since landing. On the twig: float bits of the speed in m/s of the air that it has got used to.
    pub phase: u32,
}

/// Orientation as a unit quaternion x, y, z, w that turns the leaf frame into place: the blade in the x-z plane,
/// normal +y, petiole towards -z, tip towards +z. Written every step, read only while it blends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C, align(16))]
pub struct Attitude {
    /// x, y, z, w.
    pub quaternion: [f32; 4],
}

/// What a leaf is up to until its next event. Read every step, written at events; of a body in the air at every step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C, align(16))]
pub struct Course {
    /// Step at which something happens: release, end of a stage, recycling, the petiole's break.
    pub event: u32,
    /// Phase per step in 2^-32 periods. Of a body in the air: float bits of its spin about y, its normal.
    pub rate: u32,
    /// Low half: size relative to the species' in 2^-14. High half: of a leaf on its twig, its own size, for there it may
    /// stand for several and be drawn larger; of a body in the air, its quirks.
    pub size: u32,
    /// High half: heading in 2^-16 turns about +y. Low half: spin rate, signed, full scale the species' fastest. Of a body
    /// in the air: float bits of its spin about z.
    pub heading: u32,
}

/// Who a leaf is. Cold: read and written at events only, but for what a body in the air remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C, align(16))]
pub struct Identity {
    /// Number of the leaf, slot plus a multiple of the slot count; everything random about it follows from this.
    pub id: u32,
    /// Step of its release, two's complement.
    pub release: u32,
    /// Time a fall through still air takes in 2^-16 steps. Of a body in the air: what it remembers of its motion.
    pub fall_time: u32,
    /// Tint (low half), image variant, source and stage.
    pub look: u32,
}

impl Record for Place {
    const NAME: &'static str = "Place";
    const FIELDS: &'static [Field] = &[Field::floats("position", 3), Field::integer("bits")];
}

impl Record for Drift {
    const NAME: &'static str = "Drift";
    const FIELDS: &'static [Field] = &[Field::floats("velocity", 3), Field::integer("phase")];
}

impl Record for Attitude {
    const NAME: &'static str = "Attitude";
    const FIELDS: &'static [Field] = &[Field::floats("quaternion", 4)];
}

impl Record for Course {
    const NAME: &'static str = "Course";
    const FIELDS: &'static [Field] =
        &[Field::integer("event"), Field::integer("rate"), Field::integer("size"), Field::integer("heading")];
}

impl Record for Identity {
    const NAME: &'static str = "Identity";
    const FIELDS: &'static [Field] = &[
        Field::integer("id"),
        Field::integer("release"),
        Field::integer("fall_time"),
        Field::integer("look"),
    ];
}

/// Returns true if [`Course::rate`] and [`Course::heading`] hold floats: of a leaf on its twig and of a body.
pub(super) fn spin_is_float(bits: u32) -> bool {
    bits & STATE_MASK == STATE_ATTACHED || (bits >> PRIMITIVE_SHIFT) & PRIMITIVE_MASK == AERODYNAMIC
}

/// Returns true if [`Drift::phase`] holds a float: of the same leaves, unless they lie on the ground.
pub(super) fn phase_is_float(bits: u32) -> bool {
    spin_is_float(bits) && bits & STATE_MASK != STATE_RESTING
}
