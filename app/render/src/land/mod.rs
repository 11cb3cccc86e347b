// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lie of the land, for whatever stands on it.

pub(crate) mod hill_shade;
pub(crate) mod texture;

use glam::{Vec2, Vec3};
use windfall_core::scene::Ground;
use windfall_core::terrain::Hills;

/// Largest roughness length in metres of ground that is paved where its litter lies: a mown lawn has five times as much.
const PAVED_ROUGHNESS_M: f32 = 0.001;

/// Water in kg per kg of dry leaf from which all is wet: what litter holds after rain (Zagyvai-Kiss et al. 2019).
const WET_MOISTURE: f32 = 2.0;

/// Heights of a scene's ground and of the water on it.
#[derive(Clone, Debug)]
pub struct Land {
    /// Height of level ground, or of hilly ground at the origin, in metres.
    base_m: f32,
    hills: Option<Hills>,
    water_m: Option<f32>,
    paving: Option<Paving>,
    wet: f32,
}

/// A rectangle of paving.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Paving {
    /// Its centre x, z in metres.
    pub(crate) center_m: Vec2,
    /// Half of its edges in metres.
    pub(crate) half_m: Vec2,
}

impl Land {
    /// The land of a scene.
    pub fn of(ground: &Ground) -> Self {
        Self {
            base_m: ground.height_m,
            hills: ground.terrain.as_ref().map(Hills::grow),
            water_m: ground.water.map(|water| water.height_m),
            paving: Paving::of(ground),
            wet: ground.litter.map_or(0.0, |litter| (litter.moisture / WET_MOISTURE).min(1.0)),
        }
    }

    /// Height of level ground, or of hilly ground at the origin, in metres.
    pub(crate) fn base_m(&self) -> f32 {
        self.base_m
    }

    /// The hills, if there are any.
    pub fn hills(&self) -> Option<&Hills> {
        self.hills.as_ref()
    }

    /// Height of the water's surface in metres, if there is any.
    pub fn water_m(&self) -> Option<f32> {
        self.water_m
    }

    /// The paving, if there is any.
    pub(crate) fn paving(&self) -> Option<Paving> {
        self.paving
    }

    /// Share to which rain has wetted all: as far as the litter has soaked.
    pub(crate) fn wet(&self) -> f32 {
        self.wet
    }

    /// Height of the ground at a place in metres, also under water.
    pub fn ground_m(&self, x_m: f32, z_m: f32) -> f32 {
        self.base_m + self.hills.as_ref().map_or(0.0, |hills| hills.height_m(x_m, z_m))
    }

    /// Height of ground or water at a place in metres, whichever is higher.
    pub(crate) fn surface_m(&self, x_m: f32, z_m: f32) -> f32 {
        self.ground_m(x_m, z_m).max(self.water_m.unwrap_or(f32::MIN))
    }

    /// Returns true if a place is under water.
    pub(crate) fn is_wet(&self, x_m: f32, z_m: f32) -> bool {
        self.water_m.is_some_and(|water_m| self.ground_m(x_m, z_m) < water_m)
    }

    /// Unit normal of the surface at a place, over about a leaf's size.
    pub(crate) fn normal(&self, x_m: f32, z_m: f32) -> Vec3 {
        const APART_M: f32 = 0.05;
        let east = self.surface_m(x_m + APART_M, z_m) - self.surface_m(x_m - APART_M, z_m);
        let south = self.surface_m(x_m, z_m + APART_M) - self.surface_m(x_m, z_m - APART_M);
        Vec3::new(-east, 2.0 * APART_M, -south).normalize()
    }
}

impl Paving {
    /// The paving of level ground that is as smooth as paved areas are: where its litter lies.
    fn of(ground: &Ground) -> Option<Self> {
        let litter = ground.litter.filter(|_| is_paved(ground))?;
        Some(Self { center_m: litter.center_m, half_m: 0.5 * litter.size_m })
    }
}

/// Returns true if a scene's ground is drawn paved where its litter lies.
pub fn is_paved(ground: &Ground) -> bool {
    let is_smooth = ground.terrain.is_none() && ground.surface_roughness_m <= PAVED_ROUGHNESS_M;
    is_smooth && ground.litter.is_some()
}

#[cfg(test)]
mod tests {
    use windfall_core::Scene;
    use windfall_core::World;
    use windfall_core::scene::{Litter, Terrain, Water};

    use super::*;

    #[test]
    fn pictures_and_leaves_agree_on_the_land() {
        let mut scene = Scene::default();
        scene.ground = Ground {
            height_m: -3.0,
            terrain: Some(Terrain { levels: 5, ..Terrain::default() }),
            water: Some(Water { height_m: 1.0 }),
            ..scene.ground
        };
        scene.sources[0].count = 1;
        let world = World::build(&scene).expect("the default scene is valid on hills");
        let land = Land::of(&scene.ground);
        let (mut wet, mut steep) = (0, 0);
        for step in 0u16..400 {
            let (x, z) = (f32::from(step) * 7.3 - 900.0, f32::from(step) * -3.1 + 400.0);
            let own = land.ground_m(x, z);
            let apart = own - world.compiled.ground_height(x, z);
            assert!(apart.abs() < 1.0e-3, "{apart} m apart at {x}, {z}");
            assert_eq!(land.is_wet(x, z), own < 1.0, "under water below its surface");
            assert_eq!(land.surface_m(x, z), own.max(1.0), "the higher of the two");
            wet += u32::from(land.is_wet(x, z));
            steep += u32::from(land.normal(x, z).y < 0.999);
        }
        assert!(wet > 20 && steep > 100, "{wet} places under water, {steep} on slopes");
    }

    #[test]
    fn level_ground_is_level() {
        let land = Land::of(&Ground { height_m: 2.0, ..Ground::default() });
        assert_eq!(land.surface_m(13.0, -7.0), 2.0, "everywhere as high");
        assert_eq!(land.normal(5.0, 5.0), Vec3::Y, "and level");
    }

    #[test]
    fn all_is_as_wet_as_its_litter() {
        let of = |moisture: f32| {
            let litter = Some(Litter { moisture, ..Litter::default() });
            Land::of(&Ground { litter, ..Ground::default() }).wet()
        };
        assert_eq!([of(0.0), of(1.0), of(2.0), of(4.0)], [0.0, 0.5, 1.0, 1.0], "up to what litter holds");
        assert_eq!(Land::of(&Ground::default()).wet(), 0.0, "dry without litter");
    }

    #[test]
    fn smooth_ground_is_paved_where_its_litter_lies() {
        let litter =
            Litter { center_m: Vec2::new(3.0, -1.0), size_m: Vec2::new(8.0, 6.0), ..Litter::default() };
        let lawn = Ground { litter: Some(litter), ..Ground::default() };
        let square = Ground { surface_roughness_m: 0.0003, ..lawn };
        assert_eq!(Land::of(&lawn).paving(), None, "a lawn");
        let paving = Paving { center_m: litter.center_m, half_m: Vec2::new(4.0, 3.0) };
        assert_eq!(Land::of(&square).paving(), Some(paving), "a square");
        assert_eq!(Land::of(&Ground { litter: None, ..square }).paving(), None, "no litter, no edge");
        let hilly = Ground { terrain: Some(Terrain::default()), ..square };
        assert_eq!(Land::of(&hilly).paving(), None, "hills");
    }
}
