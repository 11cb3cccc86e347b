// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Uniform blocks that every kernel reads: the compiled scene, and the state of one step. One file, because they are the parts of two
//! blocks, and shaders get them as one list.
//!
//! Both backends get these same bytes, so nothing that depends on time or scene alone is computed twice.

use crate::flight::block::BodyBlock;
use crate::layout::{Float4, Uint4};
use crate::scene::{
    MAX_BURNING_SPECIES, MAX_JETS, MAX_MOVERS, MAX_PLUMES, MAX_POPULATIONS, MAX_SOURCES, MAX_SPECIES,
    MAX_VORTICES, SPLINE_SEGMENTS,
};

crate::shared_struct! {
    /// One species, compiled.
    pub struct SpeciesBlock {
        /// Time that a fall of one metre takes, in 2^-16 steps.
        pub fall_steps_q16_per_m: u32,
        /// Half width of the spread of sizes in 2^-14 of the nominal size.
        pub size_spread_q14: u32,
        /// Half width of the spread of speeds in 2^-14 of the nominal speed.
        pub speed_spread_q14: u32,
        /// First primitive motion, or [`AERODYNAMIC`](crate::device::leaf::record::AERODYNAMIC).
        pub first_motion: u32,
        /// Phase per step of each primitive motion for a leaf of nominal size and speed, four to a vector (see
        /// [`species_rate`](crate::device::leaf::release::species_rate)).
        pub rates: [Uint4; 2],
        /// Transition counts, row by row, four to a vector (see
        /// [`transition_count`](crate::device::motion::feature::transition_count)).
        pub transitions: [Uint4; 9],
    }
}

crate::shared_struct! {
    /// One source, compiled. Lengths are integers in units of 2^-10 m, so that both contracts place leaves alike.
    pub struct SourceBlock {
        /// Centre x, y, z.
        pub center_units: [i32; 3],
        /// Kind: [`SOURCE_BOX`], [`SOURCE_DISC`] or [`SOURCE_SPHERE`].
        pub kind: u32,
        /// Half extent or radius along x, y, z.
        pub extent_units: [u32; 3],
        /// Steps until a slot is released again; 0 for never.
        pub lifetime_steps: u32,
        /// Upper end of each species' share of random words, four to a vector (see
        /// [`source_share`](crate::device::leaf::release::source_share)).
        pub shares: [Uint4; SHARE_VECTORS as usize],
    }
}

crate::shared_struct! {
    /// The wind, compiled.
    pub struct WindBlock, padding 4 {
        /// Unit vector that the mean wind blows towards, along x.
        pub direction_x: f32,
        /// The same along z.
        pub direction_z: f32,
        /// Mean speed at the reference height in m/s.
        pub mean_speed_m_s: f32,
        /// Excess of a typical gust relative to the mean speed.
        pub gust_strength: f32,
        /// Standard deviation of the turbulence along, up and across the wind in m/s.
        pub deviation_m_s: [f32; 3],
        /// Rows of the gust table per metre.
        pub gust_rows_per_m: f32,
        /// Turbulence cells per metre along, up and across the wind.
        pub cells_per_m: [f32; 3],
        /// First row of the profile table.
        pub first_profile_row: u32,
        /// First row of the gust table.
        pub first_gust_row: u32,
        /// First row of the turbulence table.
        pub first_turbulence_row: u32,
        /// Steps of the interval for which a falling leaf samples the wind: 1, 2 or 4.
        pub interval_steps: u32,
        /// Half of the interval in s.
        pub half_interval_s: f32,
        /// Share of vertical turbulence that the ground leaves at no height.
        pub least_vertical: f32,
        /// Growth of that share with height, up to 1, in 1/m.
        pub vertical_per_m: f32,
        /// Height in m above the ground at the origin of water on which leaves float: the wind blows over its surface.
        pub lowest_surface_m: f32,
    }
}

crate::shared_struct! {
    /// Place of a shelter table (see [`wind_shelter`](crate::device::wind::shelter::wind_shelter)).
    pub struct ShelterBlock {
        /// Lack of wind that a unit of the table stands for, as a share of the mean wind; 0 if nothing shelters anything. Zero in the finer table, whose
        /// units are those of the other.
        pub lack_unit: f32,
        /// First row of the table.
        pub first_row: u32,
        /// Least x in m.
        pub west_m: f32,
        /// Least z in m.
        pub north_m: f32,
        /// Cells per metre along x and z.
        pub cells_per_m: f32,
        /// Layers per metre up.
        pub layers_per_m: f32,
        /// Number of cells along x.
        pub cells_x: f32,
        /// Number of cells along z.
        pub cells_z: f32,
    }
}

crate::shared_struct! {
    /// Times at which the joints of trees are solved.
    pub struct SwayBlock {
        /// Steps from one solution to the next: 1 or 2.
        pub interval_steps: u32,
        /// Time from one solution to the next in s.
        pub dt_s: f32,
        /// Its inverse in 1/s.
        pub inv_dt_s: f32,
        /// Part of that time after which springs act in s (see [`IMPLICITNESS`](crate::device::tree::sway::IMPLICITNESS)).
        pub ahead_s: f32,
    }
}

crate::shared_struct! {
    /// Litter, compiled.
    pub struct LitterBlock {
        /// First row of the heights, behind all tables; four heights to a row.
        pub first_row: u32,
        /// Cells along x; 0 without litter.
        pub columns: u32,
        /// Cells along z.
        pub lines: u32,
        /// 1 if leaves raise litter and leave it, else 0.
        pub is_living: u32,
        /// Number of the first column among cells from the origin on, two's complement.
        pub first_column: u32,
        /// The same of lines.
        pub first_line: u32,
        /// Friction coefficient of leaf on leaf.
        pub friction: f32,
        /// Friction coefficient of leaf on ground.
        pub ground_friction: f32,
        /// Restitution of leaves that strike the bare ground.
        pub restitution: f32,
        /// Suction of wet leaves over the density of the air in m²/s².
        pub adhesion_m2_s2: f32,
        /// Least angle by which the edges of a leaf stand up in 2^-16 turns.
        pub least_raise: u32,
        /// Largest angle beyond that.
        pub raise_spread: u32,
        /// Steps from one sample of the wind at a lying leaf to the next.
        pub wake_steps: u32,
        /// Steps after which it is seen what lies on and beneath a leaf; a multiple of the other.
        pub cover_steps: u32,
        /// 1 if there is no wind, else 0.
        pub is_calm: u32,
        /// Square of the speed in m²/s² below which a body that touches the ground comes to rest.
        pub rest_m2_s2: f32,
        /// Steps for which a leaf floats on water; 0 where none does.
        pub soaking_steps: u32,
        /// Speed of a leaf afloat relative to the wind at its height of sampling.
        pub drift_share: f32,
        /// Share of the difference to that speed that is left after as many steps as lie between two samples of the wind.
        pub drift_kept: f32,
        /// Height in m of a leaf that lies on the ground at the origin, whatever the water above it.
        pub bottom_m: f32,
    }
}

crate::shared_struct! {
    /// Snow (see [`SnowMut`](crate::litter::SnowMut)).
    pub struct SnowBlock {
        /// Cells along x; 0 without snow.
        pub columns: u32,
        /// Cells along z.
        pub lines: u32,
        /// Number of the first column among cells from the origin on, two's complement.
        pub first_column: u32,
        /// The same of lines.
        pub first_line: u32,
        /// Place of its words among those of the litter.
        pub first_word: u32,
        /// First row of what the cells lie on.
        pub first_row: u32,
        /// Units of water of a flake.
        pub flake_water: u32,
        /// Segments of trees, on which snow lies; 0 where none of them is above the cells.
        pub branches: u32,
        /// First row of the areas with which they catch it, and behind these of their middles.
        pub first_branch_row: u32,
        /// Particles as which snow falls from them; 0 where it comes down at once.
        pub fall_slots: u32,
        /// Zeros; fill the block up to 16 bytes.
        pub unused: [u32; 2],
    }
}

crate::shared_struct! {
    /// Snow in one step.
    pub struct SnowStepBlock {
        /// Units of water of a cell under the open sky that melt in a round.
        pub melt_open: f32,
        /// The same in woods.
        pub melt_woods: f32,
        /// Share by which loose snow settles in a round.
        pub settled: f32,
        /// Units of depth per unit of water of fresh snow in 2^-12.
        pub fresh_depth_q12: u32,
        /// Friction velocity of the wind over snow in the open in m/s.
        pub drift_m_s: f32,
        /// Friction velocity in m/s from which on it takes fresh snow along.
        pub lifts_fresh_m_s: f32,
        /// The same of old snow.
        pub lifts_old_m_s: f32,
        /// Units of water that go over an edge, per lift (u*² - lift²) / u*.
        pub drift_units: f32,
        /// Units of water that a square metre of leaves or of level wood bears.
        pub branch_units_m2: f32,
        /// Share of the snow on branches that falls in a round.
        pub branch_sheds: f32,
        /// Zeros; fill the block up to 16 bytes.
        pub unused: [u32; 2],
    }
}

crate::shared_struct! {
    /// Collisions of leaves with each other (see [`collisions_of`](crate::device::leaf::collide::collisions_of)).
    pub struct CollisionBlock {
        /// Steps from one time at which leaves collide to the next.
        pub interval_steps: u32,
        /// The same in s.
        pub interval_s: f32,
        /// Restitution.
        pub restitution: f32,
        /// Weight of a leaf, but for the one that every leaf has, per unit of its volume in litter.
        pub weight_per_unit: f32,
    }
}

crate::shared_struct! {
    /// Burning of the leaves of a species.
    pub struct BurnBlock {
        /// Steps in which the front runs over a leaf of nominal size; 0 where leaves do not burn.
        pub steps: f32,
        /// Mean heat release of such a leaf in W.
        pub mean_w: f32,
        /// Heat in J/m² that leaves take up in an interval per K by which the air is hotter.
        pub exchange_j_m2_k: f32,
        /// Rise of temperature per heat in m² K/J, up to the boiling of water.
        pub wet_m2_k_j: f32,
        /// Heat in J/m² after which all water has boiled away.
        pub dry_j_m2: f32,
        /// Rise of temperature per heat in m² K/J, of dry leaves.
        pub dry_m2_k_j: f32,
        /// Least temperature rise in K at which leaves catch.
        pub ignition_k: f32,
        /// Largest rise beyond that.
        pub ignition_span_k: f32,
    }
}

crate::shared_struct! {
    /// Solid parts, compiled: those that move first (see [`solid_at`](crate::device::solid::shape::solid_at)), and a grid of the lists
    /// of the others (see [`may_meet_solids`](crate::device::solid::near::may_meet_solids)).
    pub struct SolidsBlock, padding 12 {
        /// First row of the parts.
        pub first_row: u32,
        /// Number of parts that move.
        pub mover_count: u32,
        /// Number of all parts.
        pub count: u32,
        /// First row of the grid's cells, four to a row: place of a list's first entry, shifted, and length of the list.
        pub first_cell_row: u32,
        /// First row of the lists, four entries to a row.
        pub first_list_row: u32,
        /// Cells along x.
        pub columns: u32,
        /// Cells along z.
        pub lines: u32,
        /// Cells per metre.
        pub cells_per_m: f32,
        /// Least x of the grid in m.
        pub west_m: f32,
        /// Least z of the grid in m.
        pub north_m: f32,
        /// Height in m above which no leaf meets a part that stands still.
        pub highest_m: f32,
        /// Distance in m from which the fastest leaf may reach a part in a step.
        pub reach_m: f32,
        /// Lowest corner of the occupancy grid in m.
        pub occupancy_low_m: [f32; 3],
        /// Its cells per metre.
        pub occupancy_cells_per_m: f32,
        /// Its cells along x.
        pub occupancy_columns: u32,
        /// Its cells upwards; 0 where nothing stands still.
        pub occupancy_layers: u32,
        /// Its cells along z.
        pub occupancy_lines: u32,
        /// First row of its cells, a bit for each: upwards first, then along x.
        pub first_occupancy_row: u32,
        /// Longest way of a leaf in m that begins in an empty cell and leads to no part that stands still; 0 if some leaf is too large.
        pub clear_way_m: f32,
    }
}

crate::shared_struct! {
    /// Responses of the species' drift and spin to a step, four species to a vector (see
    /// [`response_of`](crate::device::leaf::fall::response_of)).
    pub struct ResponseBlock {
        /// Drift kept over a step, `e^(-dt/tau)`.
        pub drift_kept: [Float4; MAX_SPECIES / 4],
        /// Fastest spin per step in 2^-18 turns, a whole number.
        pub fastest_spin: [Float4; MAX_SPECIES / 4],
        /// Time constant tau in s: the distance per drift speed until none is left.
        pub time_constant_s: [Float4; MAX_SPECIES / 4],
        /// `1/tau` in 1/s.
        pub inv_time_constant: [Float4; MAX_SPECIES / 4],
    }
}

crate::shared_struct! {
    /// Cone spirals of the species that have one, four species to a vector (see
    /// [`cone_offset`](crate::device::leaf::cone_spiral::cone_offset)).
    pub struct ConesBlock, padding 12 {
        /// Radius in m where the spiral is open.
        pub radius_m: [Float4; MAX_SPECIES / 4],
        /// Share of the depth until there that a leaf comes down in 2^-16 steps.
        pub share_per_age: [Float4; MAX_SPECIES / 4],
        /// 1 on a bowl, 0 on a cone.
        pub is_bowl: [Float4; MAX_SPECIES / 4],
        /// Slope of the bank per m of radius.
        pub bank_per_m: [Float4; MAX_SPECIES / 4],
        /// Orbit in a step in 2^-32 turns.
        pub orbit_rate: [Uint4; MAX_SPECIES / 4],
        /// Phase of the table of heights and swings in a step.
        pub table_rate: [Uint4; MAX_SPECIES / 4],
        /// Age in 2^-16 steps at which a leaf sets off.
        pub start_age: [Uint4; MAX_SPECIES / 4],
        /// Number of species that have one.
        pub count: u32,
    }
}

crate::shared_struct! {
    /// A number that differs from particle to particle: all of its widths but one are zero.
    pub struct SpreadBlock {
        /// Mean, or least one of a cubic spread.
        pub mean: f32,
        /// Half width of a uniform spread.
        pub half_width: f32,
        /// Standard deviation of a normal one.
        pub deviation: f32,
        /// Width of a cubic one.
        pub cubic_width: f32,
    }
}

crate::shared_struct! {
    /// Births of one population by the particles of another.
    pub struct NestBlock {
        /// Event of a parent at which they are born, such as [`NEST_DEATH`](crate::device::particle::nest::NEST_DEATH).
        pub event: u32,
        /// Steps from one event to the next, where they follow one another.
        pub steps: u32,
        /// Number born at an event; 0 of a population without parents.
        pub fan: u32,
        /// Events of a parent for whose births there are slots at once.
        pub rounds: u32,
        /// Slot of the first parent.
        pub parent_slot: u32,
        /// Number of slots of parents.
        pub parent_count: u32,
        /// First step of the world, two's complement.
        pub first_step: u32,
        /// Share of the parent's velocity that they set off with.
        pub inherit: f32,
    }
}

crate::shared_struct! {
    /// One population of particles, compiled.
    pub struct PopulationBlock {
        /// First slot.
        pub first_slot: u32,
        /// Number of slots.
        pub count: u32,
        /// Kind of the shape that they start from.
        pub shape: u32,
        /// Kind of the drag.
        pub air: u32,
        /// Centre of that shape, or tip of a cone, in m.
        pub center_m: [f32; 3],
        /// Answer to what is in the way.
        pub meets: u32,
        /// Way in m from the centre for the first coordinate of a point in the shape, each from -1 to 1.
        pub span_x_m: [f32; 3],
        /// Kind of the directions in which they set off.
        pub direction: u32,
        /// The same for the second.
        pub span_y_m: [f32; 3],
        /// Share of the sphere's radius that the cap of directions is high.
        pub cap: f32,
        /// The same for the third.
        pub span_z_m: [f32; 3],
        /// Coefficient of restitution.
        pub restitution: f32,
        /// Unit vector to the middle of the cap.
        pub axis: [f32; 3],
        /// Friction coefficient, or share of the speed along a surface that a hit takes.
        pub friction: f32,
        /// Unit vector across it.
        pub side: [f32; 3],
        /// Flags, such as [`POPULATION_LOSS`](crate::device::particle::record::POPULATION_LOSS).
        pub flags: u32,
        /// Unit vector across both.
        pub front: [f32; 3],
        /// Acceleration downward, buoyancy taken off, in m/s².
        pub gravity_m_s2: f32,
        /// Least x, y and z in m outside which they die.
        pub low_m: [f32; 3],
        /// First row of the forces that they feel.
        pub first_force_row: u32,
        /// Largest x, y and z.
        pub high_m: [f32; 3],
        /// Number of these forces.
        pub force_count: u32,
        /// Product GM of each in m³/s², where they attract one another.
        pub mutual_gm_m3_s2: f32,
        /// Squared softening length of that in m².
        pub mutual_softening_m2: f32,
        /// Number of points that they start from; 1 of other shapes.
        pub feet: u32,
        /// Zero.
        pub unused: u32,
        /// Speed at which they set off in m/s.
        pub speed_m_s: SpreadBlock,
        /// Life in steps; zero if age does not end it.
        pub life_steps: SpreadBlock,
        /// Size in 2^-14 of its mean.
        pub size: SpreadBlock,
        /// Time constant in s where drag is linear, for the mean size; drag per m times the step, for the mean size, where it is quadratic.
        pub drag: SpreadBlock,
        /// Births by others.
        pub nest: NestBlock,
    }
}

crate::shared_struct! {
    /// Births of one population in one step.
    pub struct BirthBlock {
        /// Number of the first that is born.
        pub first_id: u32,
        /// Number of births.
        pub count: u32,
        /// Place of the first among the slots of the population.
        pub first_place: u32,
        /// 1 if all are born at the step's start, 0 if some time within it.
        pub is_burst: u32,
    }
}

crate::shared_struct! {
    /// Everything that stays the same until the scene is set anew.
    pub struct SceneBlock {
        /// Seed, low and high word.
        pub seed: [u32; 2],
        /// Difference between the numbers of a slot's leaf and of its next one: the number of slots, or 0 in a world that
        /// repeats.
        pub ids_per_life: u32,
        /// Number of species.
        pub species_count: u32,
        /// Steps until a landed leaf lies flat.
        pub settle_steps: u32,
        /// Steps of an orientation blend.
        pub blend_steps: u32,
        /// Rotation speed in 2^-16.
        pub rotation_speed_q16: u32,
        /// Ticks of the regime's clock per step in 2^-16.
        pub ticks_per_step_q16: u32,
        /// First row of the motion tables: all states, then all velocities.
        pub first_motion_row: u32,
        /// A zero that shader compilers cannot know of.
        pub zero: u32,
        /// 1 if leaves of some species fly as bodies, else 0.
        pub has_bodies: u32,
        /// 1 if the ground has hills, else 0.
        pub has_terrain: u32,
        /// Step length in s.
        pub dt_s: f32,
        /// Inverse step length in 1/s.
        pub inv_dt_s: f32,
        /// Displacement per table displacement: fall speed over rotation speed.
        pub displacement_gain: f32,
        /// Tilt kept per step while a landed leaf lies down.
        pub tilt_kept: f32,
        /// Gravity in m/s².
        pub gravity_m_s2: f32,
        /// Height of the ground at the origin in m, which the wind's heights count from.
        pub ground_height_m: f32,
        /// Height in m of what leaves lie on where it is level: the ground, or the water on it. Hills come on top.
        pub surface_height_m: f32,
        /// Height in m of a leaf that rests on it.
        pub rest_height_m: f32,
        /// Speed lost to friction per second on level ground in m/s².
        pub friction_m_s2: f32,
        /// Stopping distance on level ground per squared speed in s²/m.
        pub stop_s2_m: f32,
        /// Height of the water on hilly ground above the ground's in m.
        pub water_relief_m: f32,
        /// Height in m above which no leaf meets the ground.
        pub highest_rest_m: f32,
        /// Cells of the hills' table per metre.
        pub hill_cells_per_m: f32,
        /// First row of the hills' table.
        pub first_hill_row: u32,
        /// Binary logarithm of the cells along its edge.
        pub hill_shift: u32,
        /// Leaf slots of trees, the first of all.
        pub tree_leaf_count: u32,
        /// First row of the chances of petioles to break.
        pub first_shed_row: u32,
        /// First row of the petioles.
        pub first_petiole_row: u32,
        /// Phase per step of the slowest leaf that flutters on its twig, in 2^-32 turns.
        pub flutter_per_step: u32,
        /// Scheme that moves the joints of trees.
        pub sway_scheme: u32,
        /// Times at which it does.
        pub sway: SwayBlock,
        /// Steps from one time at which leaves are heated and burn on to the next; 0 where none burn.
        pub burn_steps: u32,
        /// Place of the fires that leaves feed among the words of the litter ([`FIRE_WORDS`](crate::device::leaf::burn::FIRE_WORDS)), one for each plume; 0 where there are none.
        pub first_fire: u32,
        /// Number of species with motion tables, stages of burning ones included.
        pub table_species: u32,
        /// Zero.
        pub unused: u32,
        /// Shelter from the wind.
        pub shelter: ShelterBlock,
        /// A finer table of it around the solid things, without cells if there is none.
        pub near_shelter: ShelterBlock,
        /// The wind.
        pub wind: WindBlock,
        /// The litter.
        pub litter: LitterBlock,
        /// The snow.
        pub snow: SnowBlock,
        /// Collisions of leaves with each other.
        pub collisions: CollisionBlock,
        /// Solid parts.
        pub solids: SolidsBlock,
        /// Burning of the species; only those of the scene have any, not their stages.
        pub burns: [BurnBlock; MAX_BURNING_SPECIES],
        /// Responses of the species.
        pub responses: ResponseBlock,
        /// Cone spirals of the species.
        pub cones: ConesBlock,
        /// The species.
        pub species: [SpeciesBlock; MAX_SPECIES],
        /// The species as bodies.
        pub bodies: [BodyBlock; MAX_SPECIES],
        /// The populations of particles.
        pub populations: [PopulationBlock; MAX_POPULATIONS],
        /// The sources, and behind them the trees and the leaves that lie on the ground from the start as one each.
        pub sources: [SourceBlock; MAX_SOURCES + 2],
    }
}

impl SceneBlock {
    /// Returns true if the ground has hills.
    #[inline(always)]
    pub fn has_terrain(&self) -> bool {
        self.has_terrain != 0
    }

    /// Returns true if leaves of some species wind down in cone spirals.
    #[inline(always)]
    pub fn has_cones(&self) -> bool {
        self.cones.count != 0
    }

    /// Returns true if leaves may lie higher than on level ground.
    #[inline(always)]
    pub fn has_relief(&self) -> bool {
        self.has_terrain() || self.litter.columns != 0
    }

    /// Returns true if leaves raise litter and leave it.
    #[inline(always)]
    pub fn has_living_litter(&self) -> bool {
        self.litter.is_living != 0
    }

    /// Returns true if leaves lie on one another, moving or still.
    #[inline(always)]
    pub fn has_litter(&self) -> bool {
        self.litter.columns != 0
    }

    /// Returns true if snow may lie.
    #[inline(always)]
    pub fn has_snow(&self) -> bool {
        self.snow.columns != 0
    }

    /// Returns true if leaves collide with each other in a step.
    #[inline(always)]
    pub fn collides(&self, step: u32) -> bool {
        self.has_living_litter() && step.is_multiple_of(self.collisions.interval_steps)
    }

    /// Returns true if leaves burn.
    #[inline(always)]
    pub fn leaves_burn(&self) -> bool {
        self.burn_steps != 0
    }

    /// Returns true if leaves are heated and burn on in a step.
    #[inline(always)]
    pub fn heats(&self, step: u32) -> bool {
        self.leaves_burn() && step.is_multiple_of(self.burn_steps)
    }

    /// Returns true if leaves float on water.
    #[inline(always)]
    pub fn leaves_float(&self) -> bool {
        self.litter.soaking_steps != 0
    }

    /// Returns true if there are solid parts in the way of leaves.
    #[inline(always)]
    pub fn has_solids(&self) -> bool {
        self.solids.count != 0
    }

    /// Returns true if solid parts move.
    #[inline(always)]
    pub fn has_movers(&self) -> bool {
        self.solids.mover_count != 0
    }

    /// Returns true if there is no wind that could take a leaf from the litter.
    #[inline(always)]
    pub fn is_calm(&self) -> bool {
        self.litter.is_calm != 0
    }

    /// Returns true if particles of some population are born of others.
    pub fn has_nests(&self) -> bool {
        self.populations.iter().any(|population| population.nest.fan != 0)
    }

    /// Returns true if leaves of some species fly as bodies.
    pub fn has_bodies(&self) -> bool {
        self.has_bodies != 0
    }

    /// Returns true if anything shelters anything from the wind.
    #[inline(always)]
    pub fn has_shelter(&self) -> bool {
        self.shelter.lack_unit != 0.0
    }
}

impl SwayBlock {
    /// Returns true if a step solves the joints: from the state that the solution before left, to the end of this step. In other
    /// steps segments go on as they move.
    #[inline(always)]
    pub fn solves_joints(&self, step: u32) -> bool {
        step.wrapping_add(1).is_multiple_of(self.interval_steps)
    }
}

crate::shared_struct! {
    /// Point of the curved axis of a vortex.
    pub struct VortexNode {
        /// Place in m.
        pub place_m: [f32; 3],
        /// Inverse of the squared distance to the next in 1/m².
        pub inv_squared: f32,
    }
}

crate::shared_struct! {
    /// One vortex at one step.
    pub struct VortexBlock {
        /// A point of the axis in m.
        pub center_m: [f32; 3],
        /// Squared core radius in m².
        pub core_m2: f32,
        /// Unit vector along the axis.
        pub axis: [f32; 3],
        /// Circulation over 2 pi in m²/s.
        pub swirl_m2_s: f32,
        /// Axial speed at the centre times squared core radius in m³/s.
        pub axial_m3_s: f32,
        /// Profile of the speed about the axis.
        pub profile: u32,
        /// Number d of a compact one.
        pub widening: f32,
        /// 1 if its axis is a curve, else 0.
        pub is_curved: u32,
        /// Points of the curve.
        pub nodes: [VortexNode; SPLINE_SEGMENTS as usize + 1],
    }
}

crate::shared_struct! {
    /// One jet at one step (see [`wind_jet`](crate::device::wind::jet::wind_jet)).
    pub struct JetBlock, padding 4 {
        /// Middle of the nozzle in m.
        pub nozzle_m: [f32; 3],
        /// Width b of the core in m.
        pub width_m: f32,
        /// Unit vector along the axis.
        pub axis: [f32; 3],
        /// Speed in the core times its width in m²/s; 0 while nothing blows.
        pub strength_m2_s: f32,
        /// Unit vector along the ground below the axis.
        pub heading: [f32; 3],
        /// Distance along the axis in m from which on it bends.
        pub turn_start_m: f32,
        /// Way across the axis that the bent one is off it, per m along it.
        pub bend: [f32; 3],
        /// Share of the bend per m along the axis.
        pub turns_per_m: f32,
        /// Place at which the axis meets the ground, in m.
        pub middle_m: [f32; 3],
        /// Speed of the radial wall jet times distance in m²/s.
        pub wall_m2_s: f32,
        /// Square of the radius in m² within which that jet begins.
        pub middle_m2: f32,
        /// Half of the length of the bend in m.
        pub half_turn_m: f32,
        /// Diameters of the nozzle per m.
        pub diameters_per_m: f32,
    }
}

crate::shared_struct! {
    /// Height at which the axis of a plume bends.
    pub struct PlumeBend {
        /// Height above the base in m.
        pub from_m: f32,
        /// Change there of how fast the slope grows with height, in 1/m.
        pub turned_per_m: f32,
        /// Zero.
        pub unused: [f32; 2],
    }
}

crate::shared_struct! {
    /// One plume at one step (see [`wind_plume`](crate::device::wind::plume::wind_plume)).
    pub struct PlumeBlock {
        /// Middle of the base in m.
        pub base_m: [f32; 3],
        /// Radius of the base in m.
        pub base_radius_m: f32,
        /// Speed that the fire gives in m/s: its power in kW to 0.2.
        pub speed_m_s: f32,
        /// Inverse of the height that scales the plume in 1/m: its power in kW to -0.4.
        pub heights_per_m: f32,
        /// Inverse of the share of level turbulence at the top of the layer that the ground slows.
        pub inv_layer: f32,
        /// Slope of the axis at the base: way along the wind per m of height.
        pub base_slope: f32,
        /// Square in m² of the distance from the base within which burning leaves feed the fire; 0 if its power is given.
        pub feeding_m2: f32,
        /// Place of such a fire among the words of the litter; 0 if its power is given.
        pub fire: u32,
        /// Puffs that leave the base in a second.
        pub puffs_per_s: f32,
        /// Share of the next puff that has left the base.
        pub puffs: f32,
        /// Heights at which the axis bends, from the base on.
        pub bends: [PlumeBend; PLUME_BENDS as usize],
    }
}

crate::shared_struct! {
    /// The air that one solid thing drags along at one step (see [`wind_slipstream`](crate::device::wind::slipstream::wind_slipstream)).
    pub struct SlipstreamBlock, padding 4 {
        /// Centre of the thing in m.
        pub center_m: [f32; 3],
        /// Standard deviation of the bell at its centre in m.
        pub spread_m: f32,
        /// Unit vector along its way.
        pub heading: [f32; 3],
        /// Drag over dynamic pressure and 3 pi in m².
        pub drag_m2: f32,
        /// Speed of the thing in m/s.
        pub speed_m_s: f32,
        /// Inverse of the distance in 1/m in front of the centre at which the slipstream begins.
        pub fronts_per_m: f32,
        /// Inverse of its length in 1/m.
        pub lengths_per_m: f32,
    }
}

crate::shared_struct! {
    /// The wind's patterns at one moment.
    pub struct MomentBlock, padding 8 {
        /// The vortices where they are then.
        pub vortices: [VortexBlock; MAX_VORTICES],
        /// The jets where they are then.
        pub jets: [JetBlock; MAX_JETS],
        /// The plumes as they are then.
        pub plumes: [PlumeBlock; MAX_PLUMES],
        /// The air that things drag along then.
        pub slipstreams: [SlipstreamBlock; MAX_MOVERS],
        /// Rows of the gust table that the mean wind has carried past, within one period.
        pub gust_offset: f32,
        /// Cells of turbulence that the mean wind has carried past, within one period.
        pub turbulence_offset: f32,
    }
}

crate::shared_struct! {
    /// One solid part that moves, in one step: it goes straight on, turned as it is in the step's middle.
    pub struct MoverBlock, padding 4 {
        /// Centre at the step's start in m.
        pub center_m: [f32; 3],
        /// Distance in m from there within which leaves may meet it.
        pub bound_m: f32,
        /// Unit quaternion x, y, z, w that turns it into place.
        pub turn: [f32; 4],
        /// Velocity in m/s.
        pub velocity_m_s: [f32; 3],
        /// Distance in m that any of its points moves at most.
        pub way_m: f32,
        /// Angular velocity in rad/s.
        pub spin_rad_s: [f32; 3],
    }
}

crate::shared_struct! {
    /// Everything that changes from step to step.
    pub struct StepBlock {
        /// The wind at the start of the step ([`MOMENT_NOW`]), and in the middle of the interval for which a falling leaf samples it
        /// ([`MOMENT_MIDDLE`]).
        pub moments: [MomentBlock; 2],
        /// Solid parts that move.
        pub movers: [MoverBlock; MAX_MOVERS],
        /// Births of particles.
        pub births: [BirthBlock; MAX_POPULATIONS],
        /// The snow.
        pub snow: SnowStepBlock,
        /// Shift of the grid in which leaves collide with each other, in m.
        pub collision_shift_m: [f32; 3],
        /// Index of the step.
        pub index: u32,
        /// Number of vortices.
        pub vortex_count: u32,
        /// Number of jets.
        pub jet_count: u32,
        /// Number of slipstreams.
        pub slipstream_count: u32,
        /// Number of plumes.
        pub plume_count: u32,
    }
}

crate::shared_constants! {
    /// Vectors of a source's share thresholds: one word for each species.
    pub const SHARE_VECTORS: u32 = 32 / 4;
    /// Heights at which the lean of a plume bends.
    pub const PLUME_BENDS: u32 = 8;
    /// Start of the step, among the moments of a step.
    pub const MOMENT_NOW: u32 = 0;
    /// Middle of the sampling interval of falling leaves, which begins with the step.
    pub const MOMENT_MIDDLE: u32 = 1;
    /// Kind of a box source.
    pub const SOURCE_BOX: u32 = 0;
    /// Kind of a disc source.
    pub const SOURCE_DISC: u32 = 1;
    /// Kind of a sphere source.
    pub const SOURCE_SPHERE: u32 = 2;
    /// Metres per unit of integer lengths.
    pub const LENGTH_UNIT: f32 = 1.0 / 1024.0;
    /// Number of the trees as a source.
    pub const SOURCE_TREES: u32 = 16;
    /// Number of the litter as a source.
    pub const SOURCE_LITTER: u32 = 17;
    /// A step that never comes.
    pub const NEVER: u32 = 0xffff_ffff;
}
