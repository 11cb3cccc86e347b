// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The allowed range of every number in a scene, stated once: validation, error messages and sliders read it here.
//! A test compares it with the ranges that the documentation of the fields promises.

use std::fmt::{self, Debug, Display, Formatter};

/// Smallest and largest allowed value of a number, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit<T> {
    /// Smallest allowed value.
    pub low: T,
    /// Largest allowed value.
    pub high: T,
    /// Unit; empty for plain numbers.
    pub unit: &'static str,
}

impl<T: PartialOrd> Limit<T> {
    /// Returns true if `value` is allowed; NaN never is.
    pub fn contains(&self, value: T) -> bool {
        self.low <= value && value <= self.high
    }
}

impl<T: Display> Display for Limit<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", self.low, self.high)?;
        if self.unit.is_empty() { Ok(()) } else { write!(f, " {}", self.unit) }
    }
}

/// Each row: constant, type, lowest, highest, unit, fields of the scene description that it holds for.
macro_rules! limits {
    ($($name:ident: $kind:ty = $low:expr, $high:expr, $unit:literal, $($field:ident)+;)*) => {
        $(
            #[doc = concat!("Range of", $(" `", stringify!($field), "`",)+ ".")]
            pub const $name: Limit<$kind> = Limit { low: $low, high: $high, unit: $unit };
        )*

        /// Every field with its range, as its documentation should state it.
        #[cfg(test)]
        pub(super) fn documented() -> Vec<(&'static str, String)> {
            vec![$($((stringify!($field), format!("{} to {}", $name.low, $name.high)),)+)*]
        }
    };
}

limits! {
    DT_S: f32 = 0.001, 0.05, "s", dt_s;
    FALL_SPEED: f32 = 0.0, 3.0, "", fall_speed;
    ROTATION_SPEED: f32 = 0.1, 3.0, "", rotation_speed;
    GRAVITY_M_S2: f32 = 0.5, 30.0, "m/s²", gravity_m_s2;
    SWAY_EVERY: u32 = 1, 2, "steps", sway_every;

    SEASON: f32 = 0.0, 1.0, "", season;
    SIZE_M: f32 = 0.005, 0.5, "m", size_m;
    SIZE_VARIATION: f32 = 0.0, 0.5, "", size_variation;
    SPEED_VARIATION: f32 = 0.0, 0.5, "", speed_variation;
    AREAL_DENSITY_KG_M2: f32 = 0.005, 2.0, "kg/m²", areal_density_kg_m2;
    SPIN_RAD_S: f32 = 0.0, 20.0, "rad/s", spin_rad_s;
    HEAT_MJ_KG: f32 = 5.0, 30.0, "MJ/kg", heat_mj_kg;
    IGNITION_C: f32 = 150.0, 700.0, "°C", ignition_c;
    FRONT_MM_S: f32 = 0.5, 50.0, "mm/s", front_mm_s;
    ASH: f32 = 0.0, 0.4, "", ash;
    SNOW_EDGE_M: f32 = 1.0, 200.0, "m", size_m;
    LYING_MM: f32 = 0.0, 500.0, "mm", lying_mm;
    LYING_H: f32 = 0.0, 12.0, "h", lying_h;
    THROUGH_M: f32 = 0.5, 4096.0, "m", half_extent_m;
    FED_WITHIN_M: f32 = 0.1, 20.0, "m", fed_within_m;
    FRICTION_PER_S: f32 = 0.1, 1000.0, "1/s", friction_per_s;

    ASPECT: f32 = 0.1, 10.0, "", aspect;
    EXTENT: f32 = 1.0, 3.0, "", extent;
    PETIOLE_BASE: f32 = 0.0, 5.0, "", base;
    PETIOLE_LENGTH: f32 = 0.0, 10.0, "", length;
    PETIOLE_MASS: f32 = 0.0, 0.5, "", mass;
    DROOP_DEG: f32 = -90.0, 90.0, "degrees", droop_deg;
    MOISTURE: f32 = 0.0, 4.0, "", moisture;
    MASS_OFFSET: f32 = -1.0, 1.0, "", mass_offset;
    CURL: f32 = -1.0, 1.0, "", curl;
    TWIST: f32 = -1.0, 1.0, "", twist;
    GYRATION: f32 = 0.05, 1.0, "", gyration;
    EDGE_DRAG: f32 = 0.0, 1.0, "", edge_drag;
    PITCH_DAMPING: f32 = -1.0, 1.0, "", pitch_damping;
    IRREGULARITY: f32 = 0.0, 0.5, "", irregularity;
    TILT_DEG: f32 = 0.0, 90.0, "degrees", tilt_deg;

    DESCENT_M_S: f32 = 0.05, 10.0, "m/s", descent_m_s;
    HORIZONTAL_M_S: f32 = 0.0, 10.0, "m/s", horizontal_m_s;
    VERTICAL_M_S: f32 = 0.0, 10.0, "m/s", vertical_m_s;
    FLUTTER_RAD_S: f32 = 0.5, 60.0, "rad/s", flutter_rad_s;
    TUMBLE_RAD_S: f32 = 0.5, 120.0, "rad/s", tumble_rad_s;
    TUMBLE_WOBBLE: f32 = 0.0, 0.49, "", tumble_wobble;
    CHAOS_KEEP: f32 = 0.0, 1.0, "", chaos_keep;
    CHAOS_JITTER: f32 = 0.0, 0.5, "", chaos_jitter;
    ROSE_RADIUS_M: f32 = 0.0, 5.0, "m", rose_radius_m;
    ROSE_ELLIPTICITY: f32 = 0.0, 1.0, "", rose_ellipticity;
    ROSE_SWINGS: u32 = 2, 12, "", rose_swings;
    SPIRAL_RADIUS_M: f32 = 0.0, 5.0, "m", spiral_radius_m;
    SPIRAL_RAD_S: f32 = 0.5, 30.0, "rad/s", spiral_rad_s;
    CONE_RADIUS_M: f32 = 0.0, 5.0, "m", cone_radius_m;
    CONE_DEPTH_M: f32 = 0.1, 100.0, "m", cone_depth_m;
    CONE_RAD_S: f32 = 0.5, 30.0, "rad/s", cone_rad_s;
    CONE_UNEVENNESS: f32 = 0.0, 0.9, "", cone_unevenness;
    CORNER_SWING_DEG: f32 = 0.0, 80.0, "degrees", corner_swing_deg;
    CORNER_SWING_RAD_S: f32 = 0.5, 60.0, "rad/s", corner_swing_rad_s;
    WANDER_M_S: f32 = 0.0, 2.0, "m/s", wander_m_s;
    WANDER_S: f32 = 0.05, 2.0, "s", wander_s;

    CENTER_M: f32 = -4096.0, 4096.0, "m", center_m;
    HALF_EXTENT_M: f32 = 0.0, 4096.0, "m", half_extent_m;
    RADIUS_M: f32 = 0.0, 4096.0, "m", radius_m;
    COUNT: u32 = 1, super::MAX_LEAVES, "", count;
    AT_S: f32 = 0.0, 86_400.0, "s", at_s;
    PER_S: f32 = 0.001, 100_000_000.0, "1/s", per_s;
    FROM_S: f32 = -3600.0, 86_400.0, "s", from_s;
    RECYCLE_AFTER_S: f32 = 0.1, 86_400.0, "s", recycle_after_s;
    WEIGHT: u32 = 1, 1000, "", weight;

    ALPHA: u32 = 0, 2, "", alpha;
    SWIRL_D: f32 = -0.99, 1000.0, "", d;
    FORCE_AT_M: f32 = -4096.0, 4096.0, "m", at_m;
    GM_M3_S2: f32 = -1000000.0, 1000000.0, "m³/s²", gm_m3_s2;
    SOFTENING_M: f32 = 0.001, 1000.0, "m", softening_m swirl_radius_m;
    NOISE_M_S2: f32 = 0.0, 1000.0, "m/s²", m_s2;
    B_T: f32 = -1000.0, 1000.0, "T", b_t;
    E_V_M: f32 = -1000000.0, 1000000.0, "V/m", e_v_m;
    FORCE_RAD_S: f32 = -1000.0, 1000.0, "rad/s", rad_s rate_rad_s;
    WEIGHT_SHARE: f32 = -10.0, 10.0, "", gravity;
    CHARGE_C_KG: f32 = -1000000.0, 1000000.0, "C/kg", charge_c_kg;
    PARTICLE_COUNT: u32 = 1, super::MAX_PARTICLES, "", count;
    PARTICLE_AT_M: f32 = -4096.0, 4096.0, "m", tip_m base_m from_m to_m;
    HALF_ANGLE_DEG: f32 = 0.0, 180.0, "degrees", half_angle_deg;
    SPREAD: f32 = -1000000.0, 1000000.0, "", Constant Uniform Normal Cubic;
    PARTICLE_DENSITY_KG_M3: f32 = 0.01, 25000.0, "kg/m³", density_kg_m3;
    PARTICLE_DRAG: f32 = 0.01, 10.0, "", drag;
    BELOW: f32 = -4096.0, 4096.0, "m", Below;
    PARTICLE_BRIGHTNESS_KCD_M2: f32 = 0.001, 1000000.0, "kcd/m²", brightness_kcd_m2;
    OPACITY: f32 = 0.0, 1.0, "", opacity;
    CARRIED_STRENGTH: f32 = -1000.0, 1000.0, "", strength;
    SIZE_OVER_AGE: f32 = 0.0, 1000.0, "", size;
    BLINK_S: f32 = 0.1, 60.0, "s", blink_s;
    BLOB_RADIUS_M: f32 = 0.001, 10.0, "m", radius_m;
    BLOB_THRESHOLD: f32 = 0.01, 0.95, "", threshold;
    RIBBON_WIDTH: f32 = 0.01, 100.0, "", width;
    HISTORY_SAMPLES: u32 = 2, 64, "", samples;
    HISTORY_STEPS: u32 = 1, 240, "steps", every_steps;
    LAYER: u32 = 0, 15, "", layer;
    FAN: u32 = 1, 64, "", fan;
    INHERIT: f32 = -1.0, 1.0, "", inherit;
    NEST_STEPS: u32 = 1, 65535, "steps", steps;

    AUTUMN: f32 = 0.0, 1.0, "", autumn;
    AT_M: f32 = -2048.0, 2048.0, "m", at_m;
    TREE_HEIGHT_M: f32 = 0.2, 60.0, "m", height_m;
    REGROW_AFTER_S: f32 = 1.0, 86400.0, "s", regrow_after_s;
    AGE: f32 = 0.05, 1.0, "", age;
    HEADING_DEG: f32 = -360.0, 360.0, "degrees", heading_deg;
    NUMBER: u32 = 0, u32::MAX, "", number;
    TREE_LEAVES: u32 = 0, 200_000, "", leaves;
    YOUNGS_MODULUS_GPA: f32 = 0.000001, 1000.0, "GPa", youngs_modulus_gpa;
    DENSITY_KG_M3: f32 = 100.0, 2000.0, "kg/m³", density_kg_m3;
    DAMPING: f32 = 0.0, 1.0, "", damping;
    WOOD_DRAG: f32 = 0.0, 3.0, "", drag;
    ANCHORAGE: f32 = 0.01, 1000000.0, "", anchorage;
    LEAF_AREA_INDEX: f32 = 0.1, 12.0, "", leaf_area_index;
    LEAF_DENSITY_KG_M2: f32 = 0.01, 1.0, "kg/m²", areal_density_kg_m2;
    LEAF_DRAG: f32 = 0.0, 2.0, "", drag;
    YIELD_M_S: f32 = 1.0, 1000.0, "m/s", yield_m_s;
    STRENGTH_N: f32 = 0.01, 100.0, "N", strength_n;
    CROWN_PARTICLES: u32 = 1, 20_000, "", particles points;
    BULGES: f32 = 0.0, 0.5, "", bulges;
    TO_ROOT: f32 = 0.05, 1.0, "", to_root;
    TO_PARTICLE: f32 = 0.0, 0.9, "", to_particle;
    GROWTH_STEP_M: f32 = 0.02, 1.0, "m", step_m;
    INFLUENCE_M: f32 = 0.1, 20.0, "m", influence_m;
    KILL_M: f32 = 0.02, 10.0, "m", kill_m;
    LIGHT_SHARE: f32 = 0.0, 1.0, "", light direct;
    TRUNK: f32 = 0.0, 0.95, "", trunk;
    GIRTH: f32 = 0.001, 0.2, "", girth;
    LIGHT_NODES: u32 = 4, 32, "", nodes;
    EXTINCTION_PER_M: f32 = 0.0, 10.0, "1/m", extinction_per_m;

    HEIGHT_M: f32 = -4096.0, 4096.0, "m", height_m;
    FRICTION: f32 = 0.05, 5.0, "", friction;
    LITTER_SIZE_M: f32 = 1.0, 256.0, "m", size_m;
    LITTER_AREA_INDEX: f32 = 0.0, 30.0, "", leaf_area_index;
    BULK_DENSITY_KG_M3: f32 = 1.0, 100.0, "kg/m³", bulk_density_kg_m3;
    RAISED_DEG: f32 = 0.0, 60.0, "degrees", raised_deg;
    RESTITUTION: f32 = 0.0, 1.0, "", restitution;
    OPEN: f32 = 0.0, 0.9, "", open;
    ADHESION_N_M2: f32 = 0.0, 20.0, "N/m²", adhesion_n_m2;
    FLOAT_HOURS: f32 = 0.001, 48.0, "h", float_hours;
    SURFACE_ROUGHNESS_M: f32 = 0.0001, 0.1, "m", surface_roughness_m;
    OBJECT_RADIUS_M: f32 = 0.005, 50.0, "m", radius_m;
    OBJECT_LENGTH_M: f32 = 0.0, 200.0, "m", length_m;
    OBJECT_HEIGHT_M: f32 = 0.02, 200.0, "m", height_m;
    OBJECT_SIZE_M: f32 = 0.02, 200.0, "m", size_m;
    CORNER_M: f32 = -100.0, 100.0, "m", corners_m;
    MESH_SCALE: f32 = 0.001, 1000.0, "", scale;
    OBJECT_AT_M: f32 = -4096.0, 4096.0, "m", at_m moved_m way_m spline_m;
    OBJECT_TILT_DEG: f32 = -180.0, 180.0, "degrees", tilt_deg;
    TURNED_DEG: f32 = -360.0, 360.0, "degrees", turned_deg;
    COULOMB: f32 = 0.0, 5.0, "", Coulomb;
    LOSS: f32 = 0.0, 1.0, "", Loss;
    COLOR: f32 = 0.0, 1.0, "", color;
    WALK_M_S: f32 = 0.2, 3.0, "m/s", speed_m_s;
    START_S: f32 = 0.0, 86_400.0, "s", start_s;
    EDGE_M: f32 = 16.0, 4096.0, "m", edge_m;
    RELIEF_M: f32 = 0.0, 500.0, "m", relief_m;
    TERRAIN_LEVELS: u32 = 2, 9, "", levels;
    NOISE: f32 = 0.0, 1.0, "", noise;
    PULLED: f32 = 0.0, 1.0, "", pulled;
    SMOOTHING: u32 = 0, 8, "", smoothing;

    DIRECTION_DEG: f32 = -360.0, 360.0, "degrees", direction_deg;
    METRES_PER_SECOND: f32 = 0.0, 80.0, "m/s", MetresPerSecond;
    BEAUFORT: u8 = 0, 12, "", Beaufort;
    REFERENCE_HEIGHT_M: f32 = 1.0, 100.0, "m", reference_height_m;
    EXPONENT: f32 = 0.0, 1.0, "", exponent;
    ROUGHNESS_M: f32 = 0.0001, 5.0, "m", roughness_m;
    DISPLACEMENT_M: f32 = 0.0, 9.0, "m", displacement_m;
    STRENGTH: f32 = 0.0, 2.0, "", strength;
    INTERVAL_S: f32 = 0.5, 120.0, "s", interval_s;
    INTENSITY: f32 = 0.0, 1.0, "", intensity;
    CELL_M: f32 = 0.1, 20.0, "m", cell_m;
    CALM_M_S: f32 = 0.0, 10.0, "m/s", calm_m_s;
    AXIS: f32 = -1000.0, 1000.0, "", axis;
    CIRCULATION_M2_S: f32 = -1000.0, 1000.0, "m²/s", circulation_m2_s;
    CORE_M: f32 = 0.05, 100.0, "m", core_m;
    AXIAL_M_S: f32 = -50.0, 50.0, "m/s", axial_m_s;
    DRIFT_M_S: f32 = -50.0, 50.0, "m/s", drift_m_s;
    NOZZLE_M: f32 = 0.01, 20.0, "m", nozzle_m;
    JET_SPEED_M_S: f32 = 0.0, 300.0, "m/s", speed_m_s;
    JET_M: f32 = -4096.0, 4096.0, "m", at_m toward_m;
    FEET: u32 = 1, 256, "", feet;
    TEMPERATURE_K: f32 = 500.0, 3000.0, "K", temperature_k;
    FLAME_SAMPLES: u32 = 1, 64, "", samples;
    FLAME_SHELL: f32 = 0.05, 20.0, "", shell;
    BASE_RADIUS_M: f32 = 0.05, 20.0, "m", base_radius_m;
    POWER_KW: f32 = 0.0, 10_000.0, "kW", power_kw;

    CAMERA_M: f32 = -100_000.0, 100_000.0, "m", eye_m target_m;
    VERTICAL_FOV_DEG: f32 = 5.0, 120.0, "degrees", vertical_fov_deg;
    AZIMUTH_DEG: f32 = -360.0, 360.0, "degrees", azimuth_deg;
    ELEVATION_DEG: f32 = -6.0, 90.0, "degrees", elevation_deg;
    AEROSOL: f32 = 0.0, 1.0, "", aerosol;
    CLOUD_COVER: f32 = 0.0, 1.0, "", cloud_cover;
    ROTATION_DEG: f32 = -360.0, 360.0, "degrees", rotation_deg;
    INTENSITY_KCD_M2: f32 = 0.001, 1000.0, "kcd/m²", intensity_kcd_m2;
    VISIBILITY_M: f32 = 20.0, 100_000.0, "m", visibility_m;
    HAZE_DEPTH_M: f32 = 1.0, 10_000.0, "m", depth_m;
    TRAIL_S: f32 = 0.0, 30.0, "s", trail_s;
    KEY_TIME_S: f32 = 0.0, 86_400.0, "s", time_s;
    COMPENSATION_EV: f32 = -8.0, 8.0, "EV", compensation_ev;
    ADAPTATION_S: f32 = 0.0, 60.0, "s", adaptation_s;
    EV100: f32 = -6.0, 24.0, "EV", ev100;
    GAMMA: f32 = 1.0, 4.0, "", gamma;
    WHITE: f32 = 1.0, 1000.0, "", white;
    GLARE_THRESHOLD: f32 = 0.0, 0.99, "", threshold;
    GLARE_STRENGTH: f32 = 0.0, 1.0, "", strength;
    FOCUS_DISTANCE_M: f32 = 0.1, 10_000.0, "m", distance_m;
    F_NUMBER: f32 = 0.5, 64.0, "", f_number;
    SHUTTER_S: f32 = 0.0, 0.1, "s", shutter_s;
    SATURATION: f32 = 0.0, 2.0, "", saturation;
    VIGNETTE: f32 = 0.0, 1.0, "", vignette;
}

/// Range of the radii of a crown's hull.
pub const HULL_RADIUS_M: Limit<f32> = Limit { low: 0.0, high: 30.0, unit: "m" };
/// Range of the shares of the height of a crown's hull.
pub const HULL_HEIGHT: Limit<f32> = Limit { low: 0.0, high: 1.0, unit: "" };
/// Range of the speeds at which particles set off.
pub const PARTICLE_SPEED_M_S: Limit<f32> = Limit { low: 0.0, high: 1000.0, unit: "m/s" };
/// Range of the lives of particles, which have at most [`MOST_LIFE_STEPS`] steps as well.
pub const PARTICLE_LIFE_S: Limit<f32> = Limit { low: 0.001, high: 3276.0, unit: "s" };
/// Range of the diameters of particles.
pub const PARTICLE_SIZE_M: Limit<f32> = Limit { low: 1e-6, high: 100.0, unit: "m" };
/// Range of the time constants of linear drag.
pub const AIR_TIME_S: Limit<f32> = Limit { low: 1e-4, high: 1000.0, unit: "s" };
/// Range of terminal speeds.
pub const SETTLING_M_S: Limit<f32> = Limit { low: 1e-4, high: 100.0, unit: "m/s" };
/// Snowfall at a key of the weather.
pub const SNOW_MM_H: Limit<f32> = Limit { low: 0.0, high: 50.0, unit: "mm/h" };
/// Temperature of the air at a key of the weather.
pub const AIR_C: Limit<f32> = Limit { low: -40.0, high: 30.0, unit: "°C" };
/// Range of ages as a share of the life.
pub const AGE_SHARE: Limit<f32> = Limit { low: 0.0, high: 1.0, unit: "" };
/// Most steps of the life of a particle: it is kept in 16 bits.
pub const MOST_LIFE_STEPS: f64 = 65_535.0;
/// Most that a particle may be larger than the mean of its population: it is kept in 16 bits, 2^14 for the mean.
pub const MOST_SIZE_RATIO: f32 = 3.999;

/// Most steps from time zero to the end of the first life of a source's last leaf: step indices are `u32`, and a
/// difference of two must fit an `i32`.
pub const MAX_SCHEDULE_STEPS: f64 = 2_147_483_648.0;
/// Most steps of one fall through still air: times of fall are `u32` in 2^-16 steps, with some room to spare.
pub const MAX_FALL_STEPS: f64 = 60_000.0;
/// Largest part of a period that a primitive motion may pass in one step; more would alias.
pub const MAX_PERIODS_PER_STEP: f64 = 0.25;

#[cfg(test)]
mod tests {
    use super::*;

    /// The text of every file that describes a scene.
    const SOURCES: &[&str] = &[
        include_str!("mod.rs"),
        include_str!("burning.rs"),
        include_str!("flight.rs"),
        include_str!("force.rs"),
        include_str!("ground.rs"),
        include_str!("jet.rs"),
        include_str!("lens.rs"),
        include_str!("litter.rs"),
        include_str!("nest.rs"),
        include_str!("object.rs"),
        include_str!("particle_look.rs"),
        include_str!("particles.rs"),
        include_str!("path.rs"),
        include_str!("plume.rs"),
        include_str!("sky.rs"),
        include_str!("source.rs"),
        include_str!("species.rs"),
        include_str!("terrain.rs"),
        include_str!("tree.rs"),
        include_str!("tree_flow.rs"),
        include_str!("weather.rs"),
        include_str!("view.rs"),
        include_str!("wind.rs"),
    ];

    /// Returns true if a declared type is a number, a vector, or an option, list, array or tuple of them. Any `u64` is allowed.
    fn is_number(kind: &str) -> bool {
        let kind = kind.trim_start_matches([' ', '(', '[']);
        let kind = kind.strip_prefix("Option<").or(kind.strip_prefix("Vec<")).unwrap_or(kind);
        ["f32", "u32", "u8", "Vec2", "Vec3"].iter().any(|number| {
            kind.strip_prefix(number).is_some_and(|rest| rest.starts_with([',', ')', '>', ';']))
        })
    }

    /// Name and documentation of every field, and of every tuple variant, that holds a number.
    fn numeric_fields() -> Vec<(String, String)> {
        let mut fields = Vec::new();
        for source in SOURCES {
            let mut documentation = String::new();
            for line in source.lines().map(str::trim) {
                if let Some(text) = line.strip_prefix("///") {
                    documentation.push_str(text);
                    continue;
                }
                if line.starts_with("#[") {
                    continue;
                }
                let declaration = line.strip_prefix("pub ").unwrap_or(line);
                if let Some((name, kind)) = declaration.split_once([':', '('])
                    && line.ends_with(',')
                    && is_number(kind)
                {
                    fields.push((name.to_owned(), documentation.clone()));
                }
                documentation.clear();
            }
        }
        fields
    }

    #[test]
    fn every_numeric_field_documents_the_range_that_is_checked() {
        let limits = documented();
        let fields = numeric_fields();
        assert!(fields.len() >= 60, "the source text was not understood: {} fields found", fields.len());
        for (name, documentation) in &fields {
            // Fields of one name in two structures may differ.
            let ranges: Vec<_> =
                limits.iter().filter(|(field, _)| field == name).map(|(_, range)| range).collect();
            assert!(!ranges.is_empty(), "`{name}` has no range in the table of limits");
            let is_documented = ranges.iter().any(|range| documentation.contains(*range));
            assert!(is_documented, "`{name}` should document one of {ranges:?}:{documentation}");
        }
        for (field, _) in &limits {
            assert!(fields.iter().any(|(name, _)| name == field), "no field is called `{field}`");
        }
    }

    #[test]
    fn limits_include_their_ends_and_exclude_not_a_number() {
        assert!(DT_S.contains(0.001) && DT_S.contains(0.05), "both ends are allowed");
        assert!(!DT_S.contains(f32::NAN) && !DT_S.contains(f32::INFINITY), "only finite numbers are allowed");
        assert_eq!(SPIRAL_RAD_S.to_string(), "0.5 to 30 rad/s", "range and unit");
        assert_eq!(STRENGTH.to_string(), "0 to 2", "no trailing space without a unit");
    }
}
