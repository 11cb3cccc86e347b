// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees that grow towards light: births in a crown's hull, wood by particle flow or space colonisation, and the shoots that it comes to.
//!
//! The shoots are those that a turtle leaves behind, so growth in time, radii, leaves and sway follow as for L-systems. The same form, tree
//! and seed give the same bits on every machine and any number of threads.

mod births;
mod cells;
mod colonize;
mod error;
#[cfg_attr(not(feature = "gltf"), expect(dead_code, reason = "meshes come from glTF files"))]
mod hull;
#[cfg(feature = "gltf")]
mod hull_file;
#[cfg(not(feature = "gltf"))]
#[path = "no_hull_file.rs"]
mod hull_file;
mod light;
mod particles;
#[cfg(test)]
mod tests;
mod traces;
mod trunk;

use glam::DVec3;

pub use error::FlowError;

use self::births::births;
use self::hull::Hull;
use self::light::LightGrid;
use self::traces::Traces;
use self::trunk::Trunk;
use super::grammar::{Draws, Settings};
use super::turtle::{Shoot, rotated};
use crate::scene::{CrownHull, CrownLight, ParticleFlow, SpaceColonization, Tree};

/// Objects that stand in the way of light and wood: the distance in metres at which a ray from a place in a direction meets the first of
/// them, if it meets any. The place is in metres from the tree's foot, and both are along the axes of the scene.
pub type Obstacles<'a> = &'a (dyn Fn(DVec3, DVec3) -> Option<f64> + Sync);

/// No objects at all.
pub fn in_the_open(_: DVec3, _: DVec3) -> Option<f64> {
    None
}

/// Exponent of the pipe model: areas of wood add up, as Leonardo da Vinci has it.
const PIPE_EXPONENT: f64 = 2.0;

/// Step number of the draws of hulls, which no step of a derivation has.
const HULL_DRAWS: u32 = (1 << 17) + 2;

/// Either way to grow.
#[derive(Clone, Copy, Debug)]
pub(super) enum Grower<'a> {
    Flow(&'a ParticleFlow),
    Space(&'a SpaceColonization),
}

impl Grower<'_> {
    /// Shoots of the full-grown tree, of lengths in metres, and its settings.
    ///
    /// # Errors
    /// A hull that cannot be used, or a place without light.
    pub(super) fn shoots(
        self,
        tree: &Tree,
        seed: u64,
        obstacles: Obstacles<'_>,
    ) -> Result<(Vec<Shoot>, Settings), FlowError> {
        let crown = Crown::of(self, tree, seed)?;
        let traces = crown.traces(self, tree, seed, obstacles)?;
        let settings = Settings {
            height_m: crown.height_m,
            girth: crown.girth,
            pipe_exponent: PIPE_EXPONENT,
            ..Settings::default()
        };
        Ok((traces.shoots(crown.step_m, 0.5 * crown.girth * crown.height_m), settings))
    }
}

/// Hull and numbers that both ways to grow have, at the size of a tree.
struct Crown {
    hull: Hull,
    height_m: f64,
    /// Factor from the lengths of the form to those of the tree.
    scale: f64,
    step_m: f64,
    count: u32,
    light: f64,
    trunk: f64,
    girth: f64,
    shade: CrownLight,
}

impl Crown {
    fn of(grower: Grower<'_>, tree: &Tree, seed: u64) -> Result<Self, FlowError> {
        let (form_hull, count, step_m, light, trunk, girth, shade) = match grower {
            Grower::Flow(flow) => {
                let ParticleFlow { hull, particles, step_m, light, trunk, girth, shade, .. } = flow;
                (hull, *particles, *step_m, *light, *trunk, *girth, *shade)
            }
            Grower::Space(space) => {
                let SpaceColonization { hull, points, step_m, light, trunk, girth, shade, .. } = space;
                (hull, *points, *step_m, *light, *trunk, *girth, *shade)
            }
        };
        let hull = match form_hull {
            CrownHull::Profile { height_m, radii, bulges } => {
                let draw = Draws::new(seed, tree.number, HULL_DRAWS, 0);
                Hull::of_profile((*height_m).into(), radii, (*bulges).into(), draw)
            }
            CrownHull::Mesh { file, scale } => hull_file::read(file, *scale)?,
        };
        let own_m = hull.high_m().y;
        let height_m = tree.height_m.map_or(own_m, f64::from);
        let scale = height_m / own_m;
        Ok(Self {
            hull: hull.scaled(scale),
            height_m,
            scale,
            step_m: f64::from(step_m) * scale,
            count,
            light: light.into(),
            trunk: trunk.into(),
            girth: girth.into(),
            shade,
        })
    }

    fn traces(
        &self,
        grower: Grower<'_>,
        tree: &Tree,
        seed: u64,
        obstacles: Obstacles<'_>,
    ) -> Result<Traces, FlowError> {
        // The tree is turned by its heading afterwards, while sun and obstacles stay.
        let heading = f64::from(tree.heading_deg).to_radians();
        let turned = |vector: DVec3, radians: f64| rotated(vector, DVec3::Y, radians);
        let meets = |place: DVec3, toward: DVec3| obstacles(turned(place, heading), turned(toward, heading));
        let sun = turned(light::toward(&self.shade.sun), -heading);
        let light =
            LightGrid::of(&self.hull, &self.shade, sun, &|place, toward| meets(place, toward).is_some());
        let draws = |step, index| Draws::new(seed, tree.number, step, index);
        let places = births(&self.hull, &light, self.light, self.count, &meets, draws)?;
        let trunk = Trunk::of(&places, self.trunk * self.height_m, self.step_m, draws);
        let low_m = self.hull.low_m().y;
        Ok(match grower {
            Grower::Flow(flow) => particles::flow(
                &places,
                &trunk,
                &particles::Pulls {
                    to_root: flow.to_root.into(),
                    to_particle: flow.to_particle.into(),
                    step_m: self.step_m,
                    crown_m: (low_m, self.height_m),
                },
            ),
            Grower::Space(space) => colonize::colonize(
                &places,
                &trunk,
                f64::from(space.influence_m) * self.scale,
                f64::from(space.kill_m) * self.scale,
                self.step_m,
            ),
        })
    }
}
