// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks every number of a scene: first each against its own range, then those that depend on one another. One file, because it follows
//! the scene from top to bottom; longer parts have files of their own.

mod burning;
mod check;
mod cross;
mod forces;
mod lens;
mod nests;
mod objects;
mod particle_look;
mod particles;
#[cfg(test)]
mod tests;
mod tree_flow;
mod trees;
mod weather;

use super::{
    Aerodynamics, Camera, DEEPEST_BED_M, FlightModel, Ground, Haze, Jet, Litter, MAX_JET_KEYS, MAX_JETS,
    MAX_LEAVES, MAX_PLUME_KEYS, MAX_PLUMES, MAX_SOURCES, MAX_SPECIES, MAX_SPLINE_POINTS, MAX_TREE_LEAVES,
    MAX_VORTICES, MeanSpeed, MotionParameters, PhysicalSky, Plume, Profile, Release, RotationModel, Scene,
    Sky, SkyMap, Source, SourceShape, Species, Sun, Terrain, View, Vortex, VortexProfile, WindParameters,
    limits,
};
use crate::SceneError;
use check::Check;

impl Scene {
    /// Checks every number against the range that its field documents, and those that depend on one another.
    /// `file` is the file or preset that the error names.
    ///
    /// # Errors
    /// [`SceneError::Field`] for the first value that is not allowed.
    pub fn validate(&self, file: &str) -> Result<(), SceneError> {
        let check = Check::new(file);
        check.numbers([
            ("dt_s", self.dt_s.into(), limits::DT_S),
            ("fall_speed", self.fall_speed.into(), limits::FALL_SPEED),
            ("rotation_speed", self.rotation_speed.into(), limits::ROTATION_SPEED),
            ("gravity_m_s2", self.gravity_m_s2.into(), limits::GRAVITY_M_S2),
        ])?;
        check.numbers([("sway_every", Some(self.sway_every), limits::SWAY_EVERY)])?;
        check.length("species", self.species.len(), 1, MAX_SPECIES)?;
        let has_bed = self.ground.litter.is_some_and(|litter| litter.leaf_area_index > 0.0);
        let fewest = usize::from(self.trees.is_empty() && !has_bed);
        check.holds((fewest..=MAX_SOURCES).contains(&self.sources.len()), "sources", || {
            let allowed =
                format!("1 to {MAX_SOURCES} entries, or none if there are trees or a bed of litter");
            (format!("a list of {}", self.sources.len()), allowed)
        })?;
        for (index, species) in self.species.iter().enumerate() {
            species.check(&check.inside(format!("species[{index}]")))?;
        }
        for (index, source) in self.sources.iter().enumerate() {
            source.check(&check.inside(format!("sources[{index}]")))?;
        }
        self.wind.check(&check.inside("wind"))?;
        self.ground.check(&check.inside("ground"))?;
        self.view.check(&check.inside("view"))?;
        self.check_objects(&check)?;
        self.check_particles(&check)?;

        let on_trees: u64 = self.trees.iter().map(|tree| u64::from(tree.leaves)).sum();
        check.holds(on_trees <= u64::from(MAX_TREE_LEAVES), "trees", || {
            (format!("{on_trees} leaves"), format!("at most {MAX_TREE_LEAVES} leaves over all trees"))
        })?;
        let leaves = on_trees + self.sources.iter().map(|source| u64::from(source.count)).sum::<u64>();
        check.holds(leaves <= u64::from(MAX_LEAVES), "sources", || {
            (format!("{leaves} leaves"), format!("at most {MAX_LEAVES} leaves over all sources and trees"))
        })?;
        let lying = u64::from(self.bed_leaf_count());
        check.holds(leaves + lying <= u64::from(MAX_LEAVES), "ground.litter.leaf_area_index", || {
            (format!("{lying} leaves"), format!("at most {MAX_LEAVES} leaves, those that fall included"))
        })?;
        if let Some(litter) = &self.ground.litter {
            let depth_m = litter.bed_depth_m(&self.species);
            check.holds(depth_m <= DEEPEST_BED_M.into(), "ground.litter.leaf_area_index", || {
                let found = format!("{:?}, a bed {depth_m:.1} m deep", litter.leaf_area_index);
                (found, format!("beds of at most {DEEPEST_BED_M} m"))
            })?;
        }
        self.check_burning(&check)?;
        self.check_weather(&check)?;
        self.check_species_names(&check)?;
        self.check_trees(&check)?;
        self.check_transitions(&check)?;
        self.check_rates(&check)?;
        self.check_heights(&check)?;
        self.check_times(&check)
    }
}

impl Species {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("season.0", self.season.0.into(), limits::SEASON),
            ("season.1", self.season.1.into(), limits::SEASON),
            ("size_m", self.size_m.into(), limits::SIZE_M),
            ("size_variation", self.size_variation.into(), limits::SIZE_VARIATION),
            ("speed_variation", self.speed_variation.into(), limits::SPEED_VARIATION),
            ("areal_density_kg_m2", self.areal_density_kg_m2.into(), limits::AREAL_DENSITY_KG_M2),
            ("spin_rad_s", self.spin_rad_s.into(), limits::SPIN_RAD_S),
        ])?;
        at.holds(self.season.0 <= self.season.1, "season", || {
            (format!("{:?}", self.season), "two values in rising order".into())
        })?;
        at.holds(self.tables.as_deref() != Some(""), "tables", || {
            ("\"\"".into(), "a file, or nothing to make the tables".into())
        })?;
        at.holds(self.leaves.as_deref() != Some(""), "leaves", || {
            ("\"\"".into(), "a folder, or nothing to choose pictures by shape and season".into())
        })?;
        if let RotationModel::TanabeKaneko { friction_per_s } = self.rotation {
            let at = at.inside("rotation");
            at.numbers([("friction_per_s", friction_per_s.into(), limits::FRICTION_PER_S)])?;
        }
        if let Some(burning) = &self.burns {
            burning.check(&at.inside("burns"))?;
        }
        if let FlightModel::Aerodynamic(body) = self.flight {
            body.check(&at.inside("flight"))?;
        }
        self.motion.check(&at.inside("motion"))
    }
}

impl Aerodynamics {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        if let Some(planform) = self.planform {
            at.inside("planform").numbers([
                ("aspect", planform.aspect.into(), limits::ASPECT),
                ("extent", planform.extent.into(), limits::EXTENT),
            ])?;
        }
        if let Some(petiole) = self.petiole {
            at.inside("petiole").numbers([
                ("base", petiole.base.into(), limits::PETIOLE_BASE),
                ("length", petiole.length.into(), limits::PETIOLE_LENGTH),
                ("mass", petiole.mass.into(), limits::PETIOLE_MASS),
                ("droop_deg", petiole.droop_deg.into(), limits::DROOP_DEG),
            ])?;
        }
        at.numbers([
            ("moisture", self.moisture.into(), limits::MOISTURE),
            ("mass_offset.0", self.mass_offset.0.into(), limits::MASS_OFFSET),
            ("mass_offset.1", self.mass_offset.1.into(), limits::MASS_OFFSET),
            ("curl", self.curl.into(), limits::CURL),
            ("twist", self.twist.into(), limits::TWIST),
            ("gyration.0", self.gyration.0.into(), limits::GYRATION),
            ("gyration.1", self.gyration.1.into(), limits::GYRATION),
            ("edge_drag", self.edge_drag.into(), limits::EDGE_DRAG),
            ("pitch_damping", self.pitch_damping.into(), limits::PITCH_DAMPING),
            ("irregularity", self.irregularity.into(), limits::IRREGULARITY),
            ("tilt_deg", self.tilt_deg.into(), limits::TILT_DEG),
        ])
    }
}

impl MotionParameters {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("descent_m_s", self.descent_m_s, limits::DESCENT_M_S),
            ("horizontal_m_s", self.horizontal_m_s, limits::HORIZONTAL_M_S),
            ("vertical_m_s", self.vertical_m_s, limits::VERTICAL_M_S),
            ("flutter_rad_s", self.flutter_rad_s, limits::FLUTTER_RAD_S),
            ("tumble_rad_s", self.tumble_rad_s, limits::TUMBLE_RAD_S),
            ("tumble_wobble", self.tumble_wobble, limits::TUMBLE_WOBBLE),
            ("chaos_keep", self.chaos_keep, limits::CHAOS_KEEP),
            ("chaos_jitter", self.chaos_jitter, limits::CHAOS_JITTER),
            ("rose_radius_m", self.rose_radius_m, limits::ROSE_RADIUS_M),
            ("rose_ellipticity", self.rose_ellipticity, limits::ROSE_ELLIPTICITY),
            ("spiral_radius_m", self.spiral_radius_m, limits::SPIRAL_RADIUS_M),
            ("spiral_rad_s", self.spiral_rad_s, limits::SPIRAL_RAD_S),
            ("cone_radius_m", self.cone_radius_m, limits::CONE_RADIUS_M),
            ("cone_depth_m", self.cone_depth_m, limits::CONE_DEPTH_M),
            ("cone_rad_s", self.cone_rad_s, limits::CONE_RAD_S),
            ("cone_unevenness", self.cone_unevenness, limits::CONE_UNEVENNESS),
            ("corner_swing_deg", self.corner_swing_deg, limits::CORNER_SWING_DEG),
            ("corner_swing_rad_s", self.corner_swing_rad_s, limits::CORNER_SWING_RAD_S),
            ("wander_m_s", self.wander_m_s, limits::WANDER_M_S),
            ("wander_s", self.wander_s, limits::WANDER_S),
        ])?;
        at.numbers([("rose_swings", self.rose_swings, limits::ROSE_SWINGS)])
    }
}

impl Source {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        let shape = at.inside("shape");
        match self.shape {
            SourceShape::Box { center_m, half_extent_m } => {
                shape.vector("center_m", center_m, limits::CENTER_M)?;
                shape.vector("half_extent_m", half_extent_m, limits::HALF_EXTENT_M)?;
            }
            SourceShape::Disc { center_m, radius_m } | SourceShape::Sphere { center_m, radius_m } => {
                shape.vector("center_m", center_m, limits::CENTER_M)?;
                shape.numbers([("radius_m", radius_m.into(), limits::RADIUS_M)])?;
            }
        }
        at.numbers([("count", self.count.into(), limits::COUNT)])?;
        let release = at.inside("release");
        match self.release {
            Release::Burst { at_s } => release.numbers([("at_s", at_s.into(), limits::AT_S)])?,
            Release::Rate { per_s, from_s } => release.numbers([
                ("per_s", per_s.into(), limits::PER_S),
                ("from_s", from_s.into(), limits::FROM_S),
            ])?,
        }
        at.numbers([("recycle_after_s", self.recycle_after_s, limits::RECYCLE_AFTER_S)])?;
        for (index, share) in self.species.iter().enumerate() {
            let share_at = at.inside(format!("species[{index}]"));
            share_at.numbers([("weight", share.weight.into(), limits::WEIGHT)])?;
        }
        Ok(())
    }
}

impl WindParameters {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("direction_deg", self.direction_deg.into(), limits::DIRECTION_DEG),
            ("reference_height_m", self.reference_height_m.into(), limits::REFERENCE_HEIGHT_M),
            ("gusts.strength", self.gusts.strength.into(), limits::STRENGTH),
            ("gusts.interval_s", self.gusts.interval_s.into(), limits::INTERVAL_S),
            ("turbulence.intensity", self.turbulence.intensity.into(), limits::INTENSITY),
            ("turbulence.cell_m", self.turbulence.cell_m.into(), limits::CELL_M),
            ("turbulence.calm_m_s", self.turbulence.calm_m_s.into(), limits::CALM_M_S),
        ])?;
        match self.speed {
            MeanSpeed::MetresPerSecond(speed) => {
                at.numbers([("speed", speed.into(), limits::METRES_PER_SECOND)])?;
            }
            MeanSpeed::Beaufort(number) => at.numbers([("speed", number.into(), limits::BEAUFORT)])?,
        }
        let profile = at.inside("profile");
        match self.profile {
            Profile::Uniform => {}
            Profile::Power { exponent } => {
                profile.numbers([("exponent", exponent.into(), limits::EXPONENT)])?;
            }
            Profile::Log { roughness_m, displacement_m } => {
                profile.numbers([
                    ("roughness_m", roughness_m.into(), limits::ROUGHNESS_M),
                    ("displacement_m", displacement_m.into(), limits::DISPLACEMENT_M),
                ])?;
                let calm_m = displacement_m + roughness_m;
                at.holds(calm_m < self.reference_height_m, "profile", || {
                    let allowed = format!("below the reference height of {} m", self.reference_height_m);
                    (format!("zero up to {calm_m} m (displacement and roughness)"), allowed)
                })?;
            }
        }
        at.length("vortices", self.vortices.len(), 0, MAX_VORTICES)?;
        for (index, vortex) in self.vortices.iter().enumerate() {
            vortex.check(&at.inside(format!("vortices[{index}]")))?;
        }
        at.length("jets", self.jets.len(), 0, MAX_JETS)?;
        for (index, jet) in self.jets.iter().enumerate() {
            jet.check(&at.inside(format!("jets[{index}]")))?;
        }
        at.length("plumes", self.plumes.len(), 0, MAX_PLUMES)?;
        for (index, plume) in self.plumes.iter().enumerate() {
            let at = at.inside(format!("plumes[{index}]"));
            plume.check(&at)?;
            at.holds(self.plumes[..index].iter().all(|other| other.name != plume.name), "name", || {
                (format!("{:?} again", plume.name), "a name of its own".into())
            })?;
        }
        Ok(())
    }
}

impl Vortex {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.vector("center_m", self.center_m, limits::CENTER_M)?;
        at.vector("axis", self.axis, limits::AXIS)?;
        at.holds(self.axis.length() >= 0.001, "axis", || {
            (format!("{:?}", self.axis.to_array()), "a direction, at least 0.001 long".into())
        })?;
        at.numbers([
            ("circulation_m2_s", self.circulation_m2_s.into(), limits::CIRCULATION_M2_S),
            ("core_m", self.core_m.into(), limits::CORE_M),
            ("axial_m_s", self.axial_m_s.into(), limits::AXIAL_M_S),
        ])?;
        at.vector("drift_m_s", self.drift_m_s, limits::DRIFT_M_S)?;
        match self.profile {
            VortexProfile::Kaufmann => {}
            VortexProfile::Power { alpha } => {
                at.inside("profile").numbers([("alpha", alpha.into(), limits::ALPHA)])?;
            }
            VortexProfile::Compact { d } => {
                at.inside("profile").numbers([("d", d.into(), limits::SWIRL_D)])?;
            }
        }
        let points = self.spline_m.len();
        at.holds(points == 0 || (4..=MAX_SPLINE_POINTS).contains(&points), "spline_m", || {
            (format!("a list of {points}"), format!("no points, or 4 to {MAX_SPLINE_POINTS}"))
        })?;
        for (index, point) in self.spline_m.iter().enumerate() {
            at.vector(&format!("spline_m[{index}]"), *point, limits::CENTER_M)?;
        }
        let is_long = self.spline_m.windows(4).all(|four| four[0].distance(four[3]) >= 0.01);
        at.holds(is_long, "spline_m", || {
            ("points in one place".into(), "points at least 0.01 m from the third behind them".into())
        })
    }
}

impl Jet {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([("nozzle_m", self.nozzle_m.into(), limits::NOZZLE_M)])?;
        at.length("keys", self.keys.len(), 1, MAX_JET_KEYS)?;
        let mut earlier_s = None;
        for (index, key) in self.keys.iter().enumerate() {
            let at = at.inside(format!("keys[{index}]"));
            at.numbers([
                ("time_s", key.time_s.into(), limits::KEY_TIME_S),
                ("speed_m_s", key.speed_m_s.into(), limits::JET_SPEED_M_S),
            ])?;
            at.vector("at_m", key.at_m, limits::JET_M)?;
            at.vector("toward_m", key.toward_m, limits::JET_M)?;
            at.holds(key.at_m.distance(key.toward_m) >= 0.01, "toward_m", || {
                (format!("{:?}", key.toward_m.to_array()), "a point at least 0.01 m from at_m".into())
            })?;
            at.later(key.time_s, &mut earlier_s)?;
        }
        Ok(())
    }
}

impl Plume {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.holds(!self.name.is_empty(), "name", || ("\"\"".into(), "a name".into()))?;
        at.vector("at_m", self.at_m, limits::JET_M)?;
        at.numbers([("base_radius_m", self.base_radius_m.into(), limits::BASE_RADIUS_M)])?;
        at.numbers([("fed_within_m", self.fed_within_m, limits::FED_WITHIN_M)])?;
        if self.fed_within_m.is_some() {
            return at.holds(self.keys.is_empty(), "keys", || {
                (format!("a list of {}", self.keys.len()), "none, where leaves feed the fire".into())
            });
        }
        at.length("keys", self.keys.len(), 1, MAX_PLUME_KEYS)?;
        let mut earlier_s = None;
        for (index, key) in self.keys.iter().enumerate() {
            let at = at.inside(format!("keys[{index}]"));
            at.numbers([
                ("time_s", key.time_s.into(), limits::KEY_TIME_S),
                ("power_kw", key.power_kw.into(), limits::POWER_KW),
            ])?;
            at.later(key.time_s, &mut earlier_s)?;
        }
        Ok(())
    }
}

impl Ground {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("height_m", self.height_m.into(), limits::HEIGHT_M),
            ("friction", self.friction.into(), limits::FRICTION),
            ("surface_roughness_m", self.surface_roughness_m.into(), limits::SURFACE_ROUGHNESS_M),
        ])?;
        if let Some(terrain) = &self.terrain {
            terrain.check(&at.inside("terrain"))?;
        }
        if let Some(water) = &self.water {
            at.inside("water").numbers([("height_m", water.height_m.into(), limits::HEIGHT_M)])?;
        }
        if let Some(litter) = &self.litter {
            litter.check(&at.inside("litter"))?;
        }
        Ok(())
    }
}

impl Litter {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("center_m.x", self.center_m.x.into(), limits::CENTER_M),
            ("center_m.y", self.center_m.y.into(), limits::CENTER_M),
            ("size_m.x", self.size_m.x.into(), limits::LITTER_SIZE_M),
            ("size_m.y", self.size_m.y.into(), limits::LITTER_SIZE_M),
            ("leaf_area_index", self.leaf_area_index.into(), limits::LITTER_AREA_INDEX),
            ("bulk_density_kg_m3", self.bulk_density_kg_m3.into(), limits::BULK_DENSITY_KG_M3),
            ("friction", self.friction.into(), limits::FRICTION),
            ("raised_deg.0", self.raised_deg.0.into(), limits::RAISED_DEG),
            ("raised_deg.1", self.raised_deg.1.into(), limits::RAISED_DEG),
            ("restitution", self.restitution.into(), limits::RESTITUTION),
            ("moisture", self.moisture.into(), limits::MOISTURE),
            ("adhesion_n_m2", self.adhesion_n_m2.into(), limits::ADHESION_N_M2),
            ("float_hours", self.float_hours.into(), limits::FLOAT_HOURS),
        ])?;
        at.holds(self.raised_deg.0 <= self.raised_deg.1, "raised_deg", || {
            (format!("{:?}", self.raised_deg), "two values in rising order".into())
        })
    }
}

impl Terrain {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("edge_m", self.edge_m.into(), limits::EDGE_M),
            ("relief_m", self.relief_m.into(), limits::RELIEF_M),
            ("noise", self.noise.into(), limits::NOISE),
            ("pulled", self.pulled.into(), limits::PULLED),
        ])?;
        at.numbers([
            ("levels", Some(self.levels), limits::TERRAIN_LEVELS),
            ("smoothing", Some(self.smoothing), limits::SMOOTHING),
        ])
    }
}

impl View {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        let Self {
            camera: Camera { eye_m, target_m, vertical_fov_deg },
            sun,
            sky: _,
            haze,
            trail_s,
            path: _,
            lens,
        } = *self;
        let Haze { visibility_m, depth_m } = haze;
        let Sun { azimuth_deg, elevation_deg } = sun;
        at.vector("camera.eye_m", eye_m, limits::CAMERA_M)?;
        at.vector("camera.target_m", target_m, limits::CAMERA_M)?;
        at.holds(eye_m.distance(target_m) >= 0.01, "camera.target_m", || {
            (format!("{:?}", target_m.to_array()), "a point at least 0.01 m from eye_m".into())
        })?;
        at.numbers([
            ("camera.vertical_fov_deg", vertical_fov_deg.into(), limits::VERTICAL_FOV_DEG),
            ("sun.azimuth_deg", azimuth_deg.into(), limits::AZIMUTH_DEG),
            ("sun.elevation_deg", elevation_deg.into(), limits::ELEVATION_DEG),
            ("haze.visibility_m", visibility_m.into(), limits::VISIBILITY_M),
            ("haze.depth_m", depth_m.into(), limits::HAZE_DEPTH_M),
            ("trail_s", trail_s.into(), limits::TRAIL_S),
        ])?;
        self.sky.check(&at.inside("sky"))?;
        lens::check_path(&self.path, at)?;
        lens.check(&at.inside("lens"))
    }
}

impl Sky {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        match self {
            Self::Physical(PhysicalSky { aerosol, cloud_cover }) => at.numbers([
                ("aerosol", (*aerosol).into(), limits::AEROSOL),
                ("cloud_cover", (*cloud_cover).into(), limits::CLOUD_COVER),
            ]),
            Self::Map(SkyMap { path, rotation_deg, intensity_kcd_m2 }) => {
                at.holds(!path.is_empty(), "path", || ("\"\"".into(), "a file".into()))?;
                at.numbers([
                    ("rotation_deg", (*rotation_deg).into(), limits::ROTATION_DEG),
                    ("intensity_kcd_m2", (*intensity_kcd_m2).into(), limits::INTENSITY_KCD_M2),
                ])
            }
        }
    }
}
