// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Surfaces of objects, and the look of a walker's limbs: tapered where a body is, and joined smoothly where they meet.

use windfall_core::scene::Finish;
use windfall_core::shared_constants;
use windfall_core::solid::Limb;

shared_constants! {
    /// Limbs of a body.
    pub(super) const BODY_LIMBS: u32 = 10;
    /// Stone, plaster or concrete with the marks of weather.
    const STONE_SURFACE: u32 = 0;
    /// Woven cloth.
    pub(super) const CLOTH_SURFACE: u32 = 1;
    /// A sleeve with a hand at its lower end.
    pub(super) const SLEEVE_SURFACE: u32 = 2;
    /// Leather.
    pub(super) const LEATHER_SURFACE: u32 = 3;
    /// Skin under hair.
    pub(super) const HEAD_SURFACE: u32 = 4;
    /// Trousers that end in the shaft of a boot.
    pub(super) const SHANK_SURFACE: u32 = 5;
    /// Trousers under the hem of a jacket.
    pub(super) const THIGH_SURFACE: u32 = 6;
    /// Boards with their grain along the longest edge.
    const WOOD_SURFACE: u32 = 7;
    /// Painted or bare metal.
    const METAL_SURFACE: u32 = 8;
    /// Panes that mirror the sky.
    const GLASS_SURFACE: u32 = 9;
    /// Number of the limb that a jacket has its colour of.
    pub(super) const TRUNK_LIMB: u32 = 8;
}

/// Number of the surface of an object of some material.
pub(super) fn surface_of(finish: Finish) -> u32 {
    match finish {
        Finish::Stone => STONE_SURFACE,
        Finish::Wood => WOOD_SURFACE,
        Finish::Metal => METAL_SURFACE,
        Finish::Glass => GLASS_SURFACE,
    }
}

/// A limb as it is drawn: within some two centimetres of the capsule that leaves meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct LimbLook {
    /// Part of the radius by which its upper end is thicker than the middle, and its lower end thinner.
    pub(super) taper: f32,
    /// Factor by which it is thinner from front to back than from side to side.
    pub(super) flatness: f32,
    /// Number of its surface.
    pub(super) surface: u32,
}

impl LimbLook {
    /// The look of a limb.
    pub(super) fn of(limb: Limb) -> Self {
        let (taper, flatness, surface) = match limb {
            Limb::Boot(_) => (-0.06, 1.0, LEATHER_SURFACE),
            Limb::Shank(_) => (0.10, 1.0, SHANK_SURFACE),
            Limb::Thigh(_) => (0.12, 1.0, THIGH_SURFACE),
            Limb::Arm(_) => (0.14, 1.0, SLEEVE_SURFACE),
            Limb::Trunk => (0.06, 0.76, CLOTH_SURFACE),
            Limb::Head => (0.1, 1.0, HEAD_SURFACE),
        };
        Self { taper, flatness, surface }
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::solid::LIMBS;

    use super::*;

    #[test]
    fn shaders_see_all_limbs() {
        assert_eq!(LIMBS.len(), BODY_LIMBS as usize, "as many");
        assert!(LIMBS.iter().all(|limb| LIMBS[limb.number()] == *limb), "each by its number");
        assert_eq!(LIMBS[TRUNK_LIMB as usize], Limb::Trunk, "the trunk");
    }
}
