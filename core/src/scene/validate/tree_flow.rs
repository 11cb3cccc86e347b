// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks of trees that grow towards light. A hull that is a file is read when the tree grows.

use super::check::Check;
use crate::SceneError;
use crate::scene::{CrownHull, CrownLight, MAX_PROFILE_POINTS, ParticleFlow, SpaceColonization, Sun, limits};

impl ParticleFlow {
    pub(super) fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        self.hull.check(&at.inside("hull"))?;
        self.shade.check(&at.inside("shade"))?;
        at.numbers([("particles", Some(self.particles), limits::CROWN_PARTICLES)])?;
        at.numbers([
            ("to_root", self.to_root.into(), limits::TO_ROOT),
            ("to_particle", self.to_particle.into(), limits::TO_PARTICLE),
            ("step_m", self.step_m.into(), limits::GROWTH_STEP_M),
            ("light", self.light.into(), limits::LIGHT_SHARE),
            ("trunk", self.trunk.into(), limits::TRUNK),
            ("girth", self.girth.into(), limits::GIRTH),
        ])
    }
}

impl SpaceColonization {
    pub(super) fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        self.hull.check(&at.inside("hull"))?;
        self.shade.check(&at.inside("shade"))?;
        at.numbers([("points", Some(self.points), limits::CROWN_PARTICLES)])?;
        at.numbers([
            ("influence_m", self.influence_m.into(), limits::INFLUENCE_M),
            ("kill_m", self.kill_m.into(), limits::KILL_M),
            ("step_m", self.step_m.into(), limits::GROWTH_STEP_M),
            ("light", self.light.into(), limits::LIGHT_SHARE),
            ("trunk", self.trunk.into(), limits::TRUNK),
            ("girth", self.girth.into(), limits::GIRTH),
        ])?;
        at.holds(self.influence_m > self.kill_m, "influence_m", || {
            (format!("{:?}", self.influence_m), format!("more than kill_m, {:?}", self.kill_m))
        })?;
        at.holds(self.step_m <= self.kill_m, "step_m", || {
            (format!("{:?}", self.step_m), format!("at most kill_m, {:?}", self.kill_m))
        })
    }
}

impl CrownLight {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([("nodes", Some(self.nodes), limits::LIGHT_NODES)])?;
        let Sun { azimuth_deg, elevation_deg } = self.sun;
        at.numbers([
            ("extinction_per_m", self.extinction_per_m.into(), limits::EXTINCTION_PER_M),
            ("direct", self.direct.into(), limits::LIGHT_SHARE),
            ("sun.azimuth_deg", azimuth_deg.into(), limits::AZIMUTH_DEG),
            ("sun.elevation_deg", elevation_deg.into(), limits::ELEVATION_DEG),
        ])
    }
}

impl CrownHull {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        let (height_m, radii, bulges) = match self {
            Self::Profile { height_m, radii, bulges } => (height_m, radii, bulges),
            Self::Mesh { file, scale } => {
                at.numbers([("scale", (*scale).into(), limits::MESH_SCALE)])?;
                return at.holds(!file.is_empty(), "file", || {
                    ("empty".into(), "the name of a .gltf or .glb file".into())
                });
            }
        };
        at.numbers([
            ("height_m", (*height_m).into(), limits::TREE_HEIGHT_M),
            ("bulges", (*bulges).into(), limits::BULGES),
        ])?;
        at.length("radii", radii.len(), 2, MAX_PROFILE_POINTS)?;
        for (index, (height, radius_m)) in radii.iter().enumerate() {
            at.inside(format!("radii[{index}]")).numbers([
                ("0", (*height).into(), limits::HULL_HEIGHT),
                ("1", (*radius_m).into(), limits::HULL_RADIUS_M),
            ])?;
        }
        for (index, pair) in radii.windows(2).enumerate() {
            at.holds(pair[0].0 < pair[1].0, &format!("radii[{}].0", index + 1), || {
                (format!("{:?}", pair[1].0), format!("more than the {:?} before", pair[0].0))
            })?;
        }
        for index in [0, radii.len() - 1] {
            at.holds(radii[index].1 == 0.0, &format!("radii[{index}].1"), || {
                (format!("{:?}, so the hull is open there", radii[index].1), "0, a closed hull".into())
            })?;
        }
        at.holds(radii.iter().any(|point| point.1 > 0.0), "radii", || {
            ("a hull of no volume".into(), "a radius above 0 in between".into())
        })
    }
}
