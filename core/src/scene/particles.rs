// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles: points that fly besides the leaves, such as sparks, snow, rain, pollen and smoke.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::{Look, Nest, ObjectFriction};

/// A number that differs from particle to particle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Spread {
    /// The same for all, -1000000 to 1000000 and within the range of its field.
    Constant(f32),
    /// Uniform about a mean, by at most a half width; both -1000000 to 1000000, and all that is drawn within the range of the field.
    Uniform(f32, f32),
    /// Nearly normal about a mean, with a standard deviation; both -1000000 to 1000000. The sum of four uniform numbers: nothing is farther
    /// from the mean than 3.4641 standard deviations, all of it within the range of the field.
    Normal(f32, f32),
    /// The least, and more by the cube of a uniform share of a width; both -1000000 to 1000000, and all that is drawn within the range of the
    /// field. Half of the numbers are within an eighth of the width: so long live tongues that break off a flame.
    Cubic(f32, f32),
}

/// Standard deviations from its mean to the farthest number of [`Spread::Normal`]: twice the root of three.
pub const NORMAL_REACH: f32 = 3.464_102;

impl Spread {
    /// Mean.
    pub fn mean(self) -> f32 {
        self.base() + 0.25 * self.cubic_width()
    }

    /// Width over which the cubic part spreads.
    pub fn cubic_width(self) -> f32 {
        if let Self::Cubic(_, width) = self { width } else { 0.0 }
    }

    /// Half width of the uniform part.
    pub fn half_width(self) -> f32 {
        if let Self::Uniform(_, half_width) = self { half_width } else { 0.0 }
    }

    /// Standard deviation of the normal part.
    pub fn deviation(self) -> f32 {
        if let Self::Normal(_, deviation) = self { deviation } else { 0.0 }
    }

    /// Number about which the others spread: the mean, or the least one of a cubic spread.
    pub fn base(self) -> f32 {
        let (Self::Constant(base) | Self::Uniform(base, _) | Self::Normal(base, _) | Self::Cubic(base, _)) =
            self;
        base
    }

    /// Distance from the mean to the farthest number of an even spread.
    fn reach(self) -> f32 {
        self.half_width() + NORMAL_REACH * self.deviation()
    }

    /// Least number that is drawn.
    pub fn lowest(self) -> f32 {
        self.base() - self.reach()
    }

    /// Largest number that is drawn.
    pub fn highest(self) -> f32 {
        self.base() + self.reach() + self.cubic_width()
    }
}

/// Points that particles start from, uniformly by length, area or volume.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ParticleShape {
    /// An axis-aligned box.
    Box {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Half edge lengths in metres, each 0 to 4096.
        half_extent_m: Vec3,
    },
    /// A disc.
    Disc {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Radius in metres, 0 to 4096.
        radius_m: f32,
        /// Direction across it, each component -1000 to 1000, at least 0.001 long.
        #[serde(default = "upward")]
        axis: Vec3,
    },
    /// A circle.
    Ring {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Radius in metres, 0 to 4096.
        radius_m: f32,
        /// Direction across it, each component -1000 to 1000, at least 0.001 long.
        #[serde(default = "upward")]
        axis: Vec3,
    },
    /// A ball, or its surface.
    Sphere {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Radius in metres, 0 to 4096.
        radius_m: f32,
        /// Only its surface.
        #[serde(default)]
        hollow: bool,
    },
    /// A cone.
    Cone {
        /// Tip in metres, each component -4096 to 4096.
        tip_m: Vec3,
        /// Centre of the base in metres, each component -4096 to 4096, at least 0.001 from the tip.
        base_m: Vec3,
        /// Radius of the base in metres, 0 to 4096.
        radius_m: f32,
    },
    /// Points spread evenly over a level disc, one after another: of so many births each has a point of its own, where the first one of
    /// the next round starts, too. Flames stand on them.
    Feet {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Radius in metres, 0 to 4096.
        radius_m: f32,
        /// Number of points, 1 to 256.
        feet: u32,
    },
    /// A line.
    Line {
        /// One end in metres, each component -4096 to 4096.
        from_m: Vec3,
        /// The other end in metres, each component -4096 to 4096.
        to_m: Vec3,
    },
}

/// Axis of a level disc or ring.
fn upward() -> Vec3 {
    Vec3::Y
}

/// Directions in which particles set off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Direction {
    /// Uniform on a cap of the sphere of directions.
    Cone {
        /// Middle of the cap, each component -1000 to 1000, at least 0.001 long.
        axis: Vec3,
        /// Angle from there to its rim in degrees, 0 to 180: all directions.
        half_angle_deg: f32,
    },
    /// Away from the middle of the shape; upward from the middle itself.
    Outward,
    /// Around an axis through the middle of the shape, anticlockwise seen from its tip; along the axis from the axis itself.
    Around {
        /// Axis, each component -1000 to 1000, at least 0.001 long.
        axis: Vec3,
    },
}

/// Times at which particles are born.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ParticleRelease {
    /// All slots at once.
    Burst {
        /// Time in seconds, 0 to 86400.
        at_s: f32,
    },
    /// One after another, evenly.
    Rate {
        /// Particles per second, 0.001 to 100000000.
        per_s: f32,
        /// Time of the first in seconds, -3600 to 86400. Those born before time zero have flown by then.
        from_s: f32,
    },
    /// Independently of one another: the number in any time is Poisson distributed.
    Poisson {
        /// Mean number per second, 0.001 to 100000000.
        per_s: f32,
        /// Time from which on in seconds, -3600 to 86400. Those born before time zero have flown by then.
        from_s: f32,
    },
    /// As snow falls by the scene's weather: as many as its water needs, each flake with the same, which becomes part of the snow where it lands. The
    /// heavier the snowfall, the more; the slots suffice for the heaviest.
    Snowfall,
    /// As snow falls from the branches of trees, over which it lies by the scene's weather: each takes along what a segment has lost, and it becomes part of the
    /// snow where it lands. A particle serves several segments, one at a time, and what is too little for one comes down at once, as all
    /// does without such particles.
    BranchSnow,
    /// As leaves catch: each particle is where a leaf burns for as long as that burns. There is one for each leaf of the scene, and nothing but
    /// its leaf moves it; others may be born of it.
    BurningLeaves,
}

/// Drag of the air on particles, all in the one wind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Air {
    /// None, and no buoyancy.
    Vacuum,
    /// Proportional to the speed through the air.
    Linear {
        /// Time constant m/b in seconds, 0.0001 to 1000.
        time_s: Spread,
    },
    /// By Stokes' law, from size and density: right while the Reynolds number stays below one.
    Stokes,
    /// Proportional to the speed through the air, for a known terminal speed.
    Settling {
        /// Terminal speed in m/s, 0.0001 to 100.
        m_s: Spread,
    },
    /// Proportional to the square of the speed through the air, of a sphere of size and density.
    Quadratic {
        /// Drag coefficient, 0.01 to 10: 0.47 of a smooth sphere.
        drag: f32,
    },
    /// They go with the air, and feel no weight.
    Massless,
}

/// Answer of particles to the ground, water and solid things.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Meets {
    /// They pass through everything.
    Nothing,
    /// They die.
    Die,
    /// They stay there until they die.
    Stick,
    /// They bounce, slide and come to rest, and the wind may take them up again.
    Bounce {
        /// Coefficient of restitution, 0 to 1.
        restitution: f32,
        /// Friction.
        friction: ObjectFriction,
    },
}

/// Region beyond which particles die.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Bounds {
    /// Below a height in metres, -4096 to 4096.
    Below(f32),
    /// Outside an axis-aligned box.
    Outside {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Half edge lengths in metres, each 0 to 4096.
        half_extent_m: Vec3,
    },
    /// Above and below an axis-aligned box; what leaves it through a side comes in again through the opposite one.
    Through {
        /// Centre in metres, each component -4096 to 4096.
        center_m: Vec3,
        /// Half edge lengths in metres, each 0.5 to 4096.
        half_extent_m: Vec3,
    },
}

/// Samples of the ways of particles, for ribbons behind them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct History {
    /// Samples kept of each particle, 2 to 64; at most 4194304 of all populations together.
    pub samples: u32,
    /// Steps from one to the next, 1 to 240.
    pub every_steps: u32,
}

impl Particles {
    /// Returns true for flakes of snow.
    pub fn is_snow(&self) -> bool {
        self.nest.is_none() && self.release == ParticleRelease::Snowfall
    }

    /// Returns true for snow that falls from branches.
    pub fn is_branch_snow(&self) -> bool {
        self.nest.is_none() && self.release == ParticleRelease::BranchSnow
    }

    /// Returns true if each particle is where a leaf burns.
    pub fn is_on_leaves(&self) -> bool {
        self.nest.is_none() && self.release == ParticleRelease::BurningLeaves
    }
}

/// A population of particles: slots of one kind, used again and again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Particles {
    /// Name, unlike those of the others.
    pub name: String,
    /// Number of slots, 1 to 33554432; the same holds for the sum over all populations. At least as many as are alive at once; with
    /// `nest` a multiple of the parents' number times its `fan`.
    pub count: u32,
    /// Parents that they are born of; with `None` they are born by `release`.
    pub nest: Option<Nest>,
    /// Points that they start from; does not count with `nest`.
    pub from: ParticleShape,
    /// Directions in which they set off; with `nest` `Outward` is away from the parent.
    pub direction: Direction,
    /// Times at which they are born; does not count with `nest`.
    pub release: ParticleRelease,
    /// Speed at which they set off in m/s, 0 to 1000.
    pub speed_m_s: Spread,
    /// Time in seconds from birth to death, 1 to 65535 whole steps; `None` if age does not end them, which only bursts may have and what is
    /// born of their births and deaths.
    pub life_s: Option<Spread>,
    /// Diameter in metres, 0.000001 to 100.
    pub size_m: Spread,
    /// Density in kg/m³, 0.01 to 25000: it counts for weight in air, and for drag by size.
    pub density_kg_m3: f32,
    /// Multiplier of the scene's gravity, -10 to 10: 0 for what floats.
    pub gravity: f32,
    /// Charge over mass in C/kg, -1000000 to 1000000.
    pub charge_c_kg: f32,
    /// Drag of the air.
    pub air: Air,
    /// Names of the forces that they feel besides weight and drag.
    pub feels: Vec<String>,
    /// Answer to what is in the way.
    pub meets: Meets,
    /// Region beyond which they die.
    pub dies: Option<Bounds>,
    /// Samples kept of their ways; `None` keeps none.
    pub history: Option<History>,
    /// Look.
    pub look: Look,
}

impl Default for Particles {
    fn default() -> Self {
        Self {
            name: "particles".into(),
            count: 1000,
            nest: None,
            from: ParticleShape::Box { center_m: Vec3::new(0.0, 4.0, 0.0), half_extent_m: Vec3::splat(2.0) },
            direction: Direction::Cone { axis: Vec3::Y, half_angle_deg: 180.0 },
            release: ParticleRelease::Rate { per_s: 100.0, from_s: 0.0 },
            speed_m_s: Spread::Constant(0.0),
            life_s: Some(Spread::Constant(8.0)),
            size_m: Spread::Constant(0.01),
            density_kg_m3: 1000.0,
            gravity: 1.0,
            charge_c_kg: 0.0,
            feels: Vec::new(),
            air: Air::Settling { m_s: Spread::Constant(1.0) },
            meets: Meets::Die,
            dies: None,
            history: None,
            look: Look::default(),
        }
    }
}
