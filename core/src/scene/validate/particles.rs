// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks populations of particles.

use glam::Vec3;

use super::check::Check;
use crate::SceneError;
use crate::motion::AIR_DENSITY;
use crate::scene::limits::{self, Limit};
use crate::scene::{
    Air, Bounds, Direction, MAX_FORCES, MAX_HISTORY_SAMPLES, MAX_LIGHTS, MAX_PARTICLES, MAX_POPULATIONS,
    Meets, ObjectFriction, ParticleRelease, ParticleShape, Particles, STANDARD_GRAVITY_M_S2, Scene, Spread,
    VISCOSITY_PA_S,
};

/// Standard deviations of the number of particles alive for which there are slots, where they are born at random.
pub(super) const ROOM_DEVIATIONS: f64 = 6.0;

impl Scene {
    /// Checks particles, each population by itself and all together.
    pub(super) fn check_particles(&self, check: &Check<'_>) -> Result<(), SceneError> {
        check.length("particles", self.particles.len(), 0, MAX_POPULATIONS)?;
        for (index, particles) in self.particles.iter().enumerate() {
            let at = check.inside(format!("particles[{index}]"));
            particles.check(&at)?;
            particles.check_life(&at, f64::from(self.dt_s))?;
            if particles.nest.is_none() {
                particles.check_room(&at, f64::from(self.dt_s))?;
            }
            let earlier = &self.particles[..index];
            at.holds(earlier.iter().all(|other| other.name != particles.name), "name", || {
                (format!("{:?} again", particles.name), "a name of its own".into())
            })?;
            self.check_nest(index, &at)?;
        }
        self.check_forces(check)?;
        let lights: u32 = self.particles.iter().map(|particles| u32::from(particles.look.lights)).sum();
        check.holds(lights <= MAX_LIGHTS, "particles", || {
            (format!("{lights} populations that light the scene"), format!("at most {MAX_LIGHTS} that do"))
        })?;
        let count: u64 = self.particles.iter().map(|particles| u64::from(particles.count)).sum();
        check.holds(count <= u64::from(MAX_PARTICLES), "particles", || {
            (format!("{count} slots"), format!("at most {MAX_PARTICLES} slots over all populations"))
        })?;
        let samples: u64 = self.particles.iter().map(Particles::sample_count).sum();
        check.holds(samples <= u64::from(MAX_HISTORY_SAMPLES), "particles", || {
            let found = format!("{samples} samples of history");
            (found, format!("at most {MAX_HISTORY_SAMPLES} samples over all populations"))
        })
    }
}

impl Particles {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.holds(!self.name.is_empty(), "name", || ("\"\"".into(), "a name".into()))?;
        at.numbers([("count", self.count.into(), limits::PARTICLE_COUNT)])?;
        self.from.check(&at.inside("from"))?;
        if let Direction::Cone { axis, half_angle_deg } = self.direction {
            let at = at.inside("direction");
            check_axis(axis, &at)?;
            at.numbers([("half_angle_deg", half_angle_deg.into(), limits::HALF_ANGLE_DEG)])?;
        }
        if let Direction::Around { axis } = self.direction {
            check_axis(axis, &at.inside("direction"))?;
        }
        match self.release {
            ParticleRelease::Burst { at_s } => {
                at.inside("release").numbers([("at_s", at_s.into(), limits::AT_S)])?;
            }
            ParticleRelease::Rate { per_s, from_s } | ParticleRelease::Poisson { per_s, from_s } => {
                at.inside("release").numbers([
                    ("per_s", per_s.into(), limits::PER_S),
                    ("from_s", from_s.into(), limits::FROM_S),
                ])?;
            }
            ParticleRelease::BurningLeaves | ParticleRelease::BranchSnow | ParticleRelease::Snowfall => {}
        }
        check_spread(self.speed_m_s, "speed_m_s", &limits::PARTICLE_SPEED_M_S, at)?;
        if let Some(life_s) = self.life_s {
            check_spread(life_s, "life_s", &limits::PARTICLE_LIFE_S, at)?;
        }
        check_spread(self.size_m, "size_m", &limits::PARTICLE_SIZE_M, at)?;
        // Sizes are kept relative to their mean.
        let most = limits::MOST_SIZE_RATIO * self.size_m.mean();
        at.holds(self.size_m.highest() <= most, "size_m", || {
            (format!("up to {}", self.size_m.highest()), format!("at most {most}, four times the mean"))
        })?;
        at.numbers([("density_kg_m3", self.density_kg_m3.into(), limits::PARTICLE_DENSITY_KG_M3)])?;
        at.numbers([
            ("gravity", self.gravity.into(), limits::WEIGHT_SHARE),
            ("charge_c_kg", self.charge_c_kg.into(), limits::CHARGE_C_KG),
        ])?;
        at.length("feels", self.feels.len(), 0, MAX_FORCES)?;
        match self.air {
            Air::Linear { time_s } => {
                check_spread(time_s, "time_s", &limits::AIR_TIME_S, &at.inside("air"))?;
            }
            Air::Settling { m_s } => {
                check_spread(m_s, "m_s", &limits::SETTLING_M_S, &at.inside("air"))?;
            }
            Air::Quadratic { drag } => {
                at.inside("air").numbers([("drag", drag.into(), limits::PARTICLE_DRAG)])?;
            }
            Air::Stokes => {
                let reynolds = self.stokes_reynolds();
                at.holds(reynolds <= 1.0, "air", || {
                    let found = format!("Stokes at Reynolds numbers up to {reynolds:.1}");
                    (found, "at most 1: smaller ones, or Quadratic".into())
                })?;
            }
            Air::Vacuum | Air::Massless => {}
        }
        if let Meets::Bounce { restitution, friction } = self.meets {
            let at = at.inside("meets");
            at.numbers([("restitution", restitution.into(), limits::RESTITUTION)])?;
            let (name, number, limit) = match friction {
                ObjectFriction::Coulomb(coefficient) => ("Coulomb", coefficient, limits::COULOMB),
                ObjectFriction::Loss(share) => ("Loss", share, limits::LOSS),
            };
            at.inside("friction").numbers([(name, number.into(), limit)])?;
            at.holds(self.air != Air::Massless, "Bounce", || {
                ("of what goes with the air".into(), "Nothing, Die or Stick, where air is Massless".into())
            })?;
        }
        match self.dies {
            None => {}
            Some(Bounds::Below(height_m)) => {
                at.inside("dies").numbers([("Below", height_m.into(), limits::BELOW)])?;
            }
            Some(Bounds::Through { center_m, half_extent_m }) => {
                let at = at.inside("dies");
                at.vector("center_m", center_m, limits::CENTER_M)?;
                at.vector("half_extent_m", half_extent_m, limits::THROUGH_M)?;
            }
            Some(Bounds::Outside { center_m, half_extent_m }) => {
                let at = at.inside("dies");
                at.vector("center_m", center_m, limits::CENTER_M)?;
                at.vector("half_extent_m", half_extent_m, limits::HALF_EXTENT_M)?;
            }
        }
        self.check_look(at)
    }

    /// Number of samples that are kept of the ways of all.
    fn sample_count(&self) -> u64 {
        self.history.map_or(0, |history| u64::from(self.count) * u64::from(history.samples))
    }

    /// Time of the first birth in seconds.
    pub(super) fn first_birth_s(&self) -> f32 {
        match self.release {
            ParticleRelease::Burst { at_s } => at_s,
            ParticleRelease::Rate { from_s, .. } | ParticleRelease::Poisson { from_s, .. } => from_s,
            ParticleRelease::BurningLeaves | ParticleRelease::BranchSnow => 0.0,
            // The air is full of it at time zero.
            ParticleRelease::Snowfall => -self.life_s.map_or(0.0, Spread::highest),
        }
    }

    /// Reynolds number of the largest particle that settles by Stokes' law in standard gravity.
    fn stokes_reynolds(&self) -> f64 {
        let (viscosity, density) = (f64::from(VISCOSITY_PA_S), f64::from(self.density_kg_m3));
        let size_m = f64::from(self.size_m.highest());
        let weight = density * f64::from(STANDARD_GRAVITY_M_S2);
        AIR_DENSITY * weight * size_m * size_m * size_m / (18.0 * viscosity * viscosity)
    }

    /// Checks that lives can be counted in steps.
    fn check_life(&self, at: &Check<'_>, dt_s: f64) -> Result<(), SceneError> {
        let most_s = limits::MOST_LIFE_STEPS * dt_s;
        let longest_s = self.life_s.map(|life_s| f64::from(life_s.highest()));
        at.holds(longest_s.is_none_or(|longest_s| longest_s <= most_s), "life_s", || {
            let found = format!("up to {} s", longest_s.unwrap_or(0.0));
            (found, format!("at most {most_s:.1} s: {} steps", limits::MOST_LIFE_STEPS))
        })
    }

    /// Checks that there are slots for all that are alive at once.
    fn check_room(&self, at: &Check<'_>, dt_s: f64) -> Result<(), SceneError> {
        let longest_s = self.life_s.map(|life_s| f64::from(life_s.highest()));
        let (per_s, deviations) = match self.release {
            ParticleRelease::Burst { .. }
            | ParticleRelease::BurningLeaves
            | ParticleRelease::BranchSnow
            | ParticleRelease::Snowfall => {
                return Ok(());
            }
            ParticleRelease::Rate { per_s, .. } => (f64::from(per_s), 0.0),
            ParticleRelease::Poisson { per_s, .. } => (f64::from(per_s), ROOM_DEVIATIONS),
        };
        let Some(longest_s) = longest_s else {
            return at.holds(false, "life_s", || {
                ("None".into(), "a time, where particles are born again and again".into())
            });
        };
        // A life is rounded to whole steps, and the births of the step in which it ends come after it.
        let mean = per_s * (longest_s + dt_s);
        let needed = libm::ceil(mean + deviations * libm::sqrt(mean)) + 1.0;
        at.holds(f64::from(self.count) >= needed, "count", || {
            let allowed = format!("at least {needed:.0}: {per_s} a second that live up to {longest_s:.3} s");
            (self.count.to_string(), allowed)
        })
    }
}

impl ParticleShape {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        match *self {
            Self::Box { center_m, half_extent_m } => {
                at.vector("center_m", center_m, limits::CENTER_M)?;
                at.vector("half_extent_m", half_extent_m, limits::HALF_EXTENT_M)
            }
            Self::Disc { center_m, radius_m, axis } | Self::Ring { center_m, radius_m, axis } => {
                at.vector("center_m", center_m, limits::CENTER_M)?;
                at.numbers([("radius_m", radius_m.into(), limits::RADIUS_M)])?;
                check_axis(axis, at)
            }
            Self::Sphere { center_m, radius_m, hollow: _ } => {
                at.vector("center_m", center_m, limits::CENTER_M)?;
                at.numbers([("radius_m", radius_m.into(), limits::RADIUS_M)])
            }
            Self::Feet { center_m, radius_m, feet } => {
                at.vector("center_m", center_m, limits::CENTER_M)?;
                at.numbers([("radius_m", radius_m.into(), limits::RADIUS_M)])?;
                at.numbers([("feet", feet.into(), limits::FEET)])
            }
            Self::Cone { tip_m, base_m, radius_m } => {
                at.vector("tip_m", tip_m, limits::PARTICLE_AT_M)?;
                at.vector("base_m", base_m, limits::PARTICLE_AT_M)?;
                at.numbers([("radius_m", radius_m.into(), limits::RADIUS_M)])?;
                at.holds(tip_m.distance(base_m) >= 0.001, "base_m", || {
                    (base_m.to_string(), "at least 0.001 m from the tip".into())
                })
            }
            Self::Line { from_m, to_m } => {
                at.vector("from_m", from_m, limits::PARTICLE_AT_M)?;
                at.vector("to_m", to_m, limits::PARTICLE_AT_M)
            }
        }
    }
}

/// Checks the length of a direction.
pub(super) fn check_axis(axis: Vec3, at: &Check<'_>) -> Result<(), SceneError> {
    at.vector("axis", axis, limits::AXIS)?;
    at.holds(axis.length() >= 0.001, "axis", || (axis.to_string(), "at least 0.001 long".into()))
}

/// Checks that all that is drawn lies within a range.
fn check_spread(spread: Spread, name: &str, limit: &Limit<f32>, at: &Check<'_>) -> Result<(), SceneError> {
    let (lowest, highest) = (spread.lowest(), spread.highest());
    let widths = [spread.half_width(), spread.deviation(), spread.cubic_width()];
    let is_allowed =
        widths.into_iter().all(|width| width >= 0.0) && limit.contains(lowest) && limit.contains(highest);
    at.holds(is_allowed, name, || (format!("{lowest:?} to {highest:?}"), limit.to_string()))
}
