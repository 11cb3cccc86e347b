// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The compute kernels by name, and those that a scene needs.

use windfall_core::CompiledScene;
use windfall_core::scene::{Particles, SwayScheme};

/// The compute kernels; one name for file, entry point and twin. [`KernelId::ListActive`] has none: the CPU notes idle units as it steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum KernelId {
    /// Lists the leaves that the steps of a window can change.
    ListActive,
    /// Adds bodies to the cells of the air that they are in.
    GatherCollisions,
    /// Lets them collide with the others there.
    Collide,
    /// Clears these cells.
    ClearCollisions,
    /// Samples the air for the leaves whose turn it is.
    SampleAir,
    /// Moves the leaves without an event through one step.
    Advance,
    /// Moves the bodies among them.
    Fly,
    /// Moves the others.
    ResolveEvents,
    /// Wakes leaves in the litter that are in the way of solid parts.
    PushLying,
    /// Sees what lies on and beneath leaves in the litter.
    CheckCover,
    /// Samples the wind at leaves that lie in the litter.
    WakeLying,
    /// Makes the changes of the litter that leaves wait for.
    StackLitter,
    /// Counts leaves by state and motion.
    Measure,
    /// Inward pass of the articulated-body algorithm over trees, level by level: responses of joints.
    SwayInward,
    /// Outward pass, level by level: accelerations of segments, and the integration of their joints.
    SwayOutward,
    /// Inward pass of the schemes that step joints one by one: composite bodies.
    SwayGather,
    /// Outward pass of these schemes: the integration of joints.
    SwayFollow,
    /// Moves segments on between two solutions of their joints.
    SwayCoast,
    /// Carries leaves along with their twigs, and breaks petioles.
    Carry,
    /// Moves particles through one step.
    StepParticles,
    /// Sums the attractions of particles by one another.
    PullParticles,
    /// Places the forces that particles carry.
    CarryForces,
    /// Samples the ways of particles.
    KeepHistory,
    /// Adds the heat of burning leaves to cells of the air.
    GatherHeat,
    /// Heats leaves, and lets those that are lit burn on.
    BurnLeaves,
    /// Lets fires follow the leaves that feed them.
    SettleFires,
    /// Lets particles follow burning leaves.
    FollowLeaves,
    /// Gives flakes that landed to the snow.
    LandFlakes,
    /// Lets branches catch snow and lose it.
    StepBranchSnow,
    /// Lets snow slide, settle and melt.
    StepSnow,
    /// Lets things that move press snow.
    PressSnow,
}

impl KernelId {
    /// All kernels.
    pub const ALL: [Self; 31] = [
        Self::ListActive,
        Self::GatherCollisions,
        Self::Collide,
        Self::ClearCollisions,
        Self::SampleAir,
        Self::Advance,
        Self::Fly,
        Self::ResolveEvents,
        Self::PushLying,
        Self::CheckCover,
        Self::WakeLying,
        Self::StackLitter,
        Self::Measure,
        Self::SwayInward,
        Self::SwayOutward,
        Self::SwayGather,
        Self::SwayFollow,
        Self::SwayCoast,
        Self::Carry,
        Self::StepParticles,
        Self::PullParticles,
        Self::CarryForces,
        Self::KeepHistory,
        Self::GatherHeat,
        Self::BurnLeaves,
        Self::SettleFires,
        Self::FollowLeaves,
        Self::LandFlakes,
        Self::StepBranchSnow,
        Self::StepSnow,
        Self::PressSnow,
    ];

    /// Name of the file and of the entry point.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ListActive => "list_active",
            Self::GatherCollisions => "gather_collisions",
            Self::Collide => "collide",
            Self::ClearCollisions => "clear_collisions",
            Self::SampleAir => "sample_air",
            Self::Advance => "advance",
            Self::Fly => "fly",
            Self::ResolveEvents => "resolve_events",
            Self::PushLying => "push_lying",
            Self::CheckCover => "check_cover",
            Self::WakeLying => "wake_lying",
            Self::StackLitter => "stack_litter",
            Self::Measure => "measure",
            Self::SwayInward => "sway_inward",
            Self::SwayOutward => "sway_outward",
            Self::SwayGather => "sway_gather",
            Self::SwayFollow => "sway_follow",
            Self::SwayCoast => "sway_coast",
            Self::Carry => "carry",
            Self::StepParticles => "step_particles",
            Self::PullParticles => "pull_particles",
            Self::CarryForces => "carry_forces",
            Self::KeepHistory => "keep_history",
            Self::GatherHeat => "gather_heat",
            Self::BurnLeaves => "burn_leaves",
            Self::SettleFires => "settle_fires",
            Self::FollowLeaves => "follow_leaves",
            Self::LandFlakes => "land_flakes",
            Self::StepBranchSnow => "step_branch_snow",
            Self::StepSnow => "step_snow",
            Self::PressSnow => "press_snow",
        }
    }

    /// The kernels that step and count a world of this scene.
    pub fn needed(compiled: &CompiledScene) -> Vec<Self> {
        let mut kernels =
            vec![Self::ListActive, Self::SampleAir, Self::Advance, Self::ResolveEvents, Self::Measure];
        if compiled.block().has_bodies() {
            kernels.push(Self::Fly);
        }
        if compiled.block().has_living_litter() {
            kernels.extend([Self::CheckCover, Self::StackLitter]);
            kernels.extend([Self::GatherCollisions, Self::Collide, Self::ClearCollisions]);
            if !compiled.block().is_calm() {
                kernels.push(Self::WakeLying);
            }
            if compiled.block().has_movers() {
                kernels.push(Self::PushLying);
            }
        }
        if compiled.block().leaves_burn() {
            kernels.extend([Self::GatherHeat, Self::BurnLeaves, Self::SettleFires]);
        }
        if compiled.scene().particles.iter().any(Particles::is_on_leaves) {
            kernels.push(Self::FollowLeaves);
        }
        if compiled.block().has_snow() {
            kernels.extend([Self::LandFlakes, Self::StepSnow]);
            if compiled.block().snow.branches != 0 {
                kernels.push(Self::StepBranchSnow);
            }
            if compiled.block().has_movers() {
                kernels.push(Self::PressSnow);
            }
        }
        if compiled.scene().particle_count() > 0 {
            kernels.push(Self::StepParticles);
        }
        if compiled.has_mutual() {
            kernels.push(Self::PullParticles);
        }
        if !compiled.carriers().is_empty() {
            kernels.push(Self::CarryForces);
        }
        if !compiled.histories().is_empty() {
            kernels.push(Self::KeepHistory);
        }
        if !compiled.forest().is_empty() {
            kernels.extend([Self::Carry, Self::SwayCoast]);
            kernels.extend(Self::of_scheme(compiled.scene().sway));
        }
        kernels
    }

    /// The kernels that move trees by a scheme, inward and outward.
    pub(crate) fn of_scheme(scheme: SwayScheme) -> [Self; 2] {
        match scheme {
            SwayScheme::Articulated => [Self::SwayInward, Self::SwayOutward],
            SwayScheme::Quigley | SwayScheme::OliapuramKumar => [Self::SwayGather, Self::SwayFollow],
        }
    }
}
