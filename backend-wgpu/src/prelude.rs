// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The generated head of every shader: structs and constants, from their one statement in `windfall-core`.

use windfall_core::layout::WgslStruct;
use windfall_core::{arith, blocks, device, flight, leaf, motion, particle, stats, tree};

/// Invocations per workgroup.
pub const WORKGROUP_SIZE: u32 = 256;
/// Most workgroups of one dispatch. A page of leaves has no more; over further rows of trees invocations stride.
pub(crate) const MAX_GROUPS: u32 = 65_535;

/// WGSL for shaders of other programs that read the leaf columns: the records [`LeafColumns`](crate::LeafColumns) hold
/// (`array<Place>` and so on), that of their burning, the constants of their packed words, and a function for every value packed there, such as
/// `leaf_state(place.bits)` and `leaf_tint(identity.appearance)`. It declares no bindings.
pub fn leaf_wgsl() -> String {
    let constants = device::leaf::record::wgsl_constants();
    column_wgsl(&leaf_records(), constants, include_str!("shaders/leaf/record.wgsl"))
}

/// The same for shaders that read the columns of particles: the records that [`ParticleColumns`](crate::ParticleColumns) hold, and
/// functions such as `particle_state(place.bits)` and `particle_life(traits.life_size)`.
pub fn particle_wgsl() -> String {
    let records = [
        particle::ParticlePlace::declaration(),
        particle::ParticleMotion::declaration(),
        particle::ParticleTraits::declaration(),
        particle::HistorySample::declaration(),
        particle::HistoryRun::declaration(),
    ];
    let constants = device::particle::record::wgsl_constants();
    let accessors =
        [include_str!("shaders/particle/record.wgsl"), include_str!("shaders/particle/history.wgsl")];
    column_wgsl(&records.concat(), constants, &accessors.concat())
}

/// The records of the leaf columns.
fn leaf_records() -> String {
    [
        leaf::Place::declaration(),
        leaf::Drift::declaration(),
        leaf::Attitude::declaration(),
        leaf::Schedule::declaration(),
        leaf::Identity::declaration(),
        leaf::Burn::declaration(),
    ]
    .concat()
}

/// Records, constants and accessors in one text, without the imports of the accessors.
fn column_wgsl(records: &str, constants: Vec<(&'static str, String)>, accessors: &str) -> String {
    let constants: String = constants.into_iter().map(|(_, declaration)| declaration).collect();
    let accessors = accessors.lines().filter(|line| !line.starts_with("#import "));
    let accessors: String = accessors.flat_map(|line| [line, "\n"]).collect();
    records.to_owned() + &constants + &accessors
}

/// Structs, in an order in which each is declared before it is used.
pub(crate) fn structs() -> String {
    [
        blocks::SpeciesBlock::declaration(),
        blocks::SourceBlock::declaration(),
        blocks::WindBlock::declaration(),
        blocks::ShelterBlock::declaration(),
        blocks::SwayBlock::declaration(),
        blocks::LitterBlock::declaration(),
        blocks::SnowBlock::declaration(),
        blocks::SnowStepBlock::declaration(),
        blocks::CollisionBlock::declaration(),
        blocks::SolidsBlock::declaration(),
        blocks::BurnBlock::declaration(),
        blocks::ResponseBlock::declaration(),
        blocks::ConesBlock::declaration(),
        flight::block::BodyBlock::declaration(),
        blocks::SpreadBlock::declaration(),
        blocks::NestBlock::declaration(),
        blocks::PopulationBlock::declaration(),
        blocks::BirthBlock::declaration(),
        blocks::SceneBlock::declaration(),
        blocks::VortexNode::declaration(),
        blocks::VortexBlock::declaration(),
        blocks::JetBlock::declaration(),
        blocks::PlumeBend::declaration(),
        blocks::PlumeBlock::declaration(),
        blocks::SlipstreamBlock::declaration(),
        blocks::MomentBlock::declaration(),
        blocks::MoverBlock::declaration(),
        blocks::StepBlock::declaration(),
        tree::record::SegmentConstants::declaration(),
        tree::record::LevelBlock::declaration(),
        tree::record::CarryBlock::declaration(),
        leaf::Petiole::declaration(),
        device::leaf::collide::CollisionSums::declaration(),
        device::leaf::burn::BurnSums::declaration(),
        device::leaf::burn::BurnPage::declaration(),
        particle::LeafParticles::declaration(),
        particle::ParticlePlace::declaration(),
        particle::ParticleMotion::declaration(),
        particle::ParticleTraits::declaration(),
        particle::ParticleRun::declaration(),
        particle::CarrierRun::declaration(),
        particle::HistorySample::declaration(),
        particle::HistoryRun::declaration(),
        particle::ParticleStart::declaration(),
        leaf_records(),
    ]
    .concat()
}

/// All shared constants.
pub(crate) fn constants() -> String {
    let lists = [
        blocks::wgsl_constants(),
        flight::block::wgsl_constants(),
        flight::coefficients::wgsl_constants(),
        device::flight::contact::wgsl_constants(),
        device::flight::regime::wgsl_constants(),
        device::flight::runge_kutta::wgsl_constants(),
        device::flight::strike::wgsl_constants(),
        arith::math::wgsl_constants(),
        arith::matrix::wgsl_constants(),
        arith::quaternion::wgsl_constants(),
        arith::rng::wgsl_constants(),
        arith::vector::wgsl_constants(),
        device::leaf::afloat::wgsl_constants(),
        device::leaf::air::wgsl_constants(),
        device::leaf::at_rest::wgsl_constants(),
        device::leaf::burn::wgsl_constants(),
        device::leaf::carry::wgsl_constants(),
        device::leaf::collide::wgsl_constants(),
        device::leaf::cone_spiral::wgsl_constants(),
        device::leaf::fall::wgsl_constants(),
        device::leaf::fly::wgsl_constants(),
        device::leaf::own::wgsl_constants(),
        device::leaf::launch::wgsl_constants(),
        device::leaf::lie::wgsl_constants(),
        device::leaf::petiole::wgsl_constants(),
        device::leaf::record::wgsl_constants(),
        device::leaf::release::wgsl_constants(),
        device::leaf::settle::wgsl_constants(),
        device::leaf::strike::wgsl_constants(),
        device::leaf::wake::wgsl_constants(),
        device::motion::feature::wgsl_constants(),
        device::motion::lookup::wgsl_constants(),
        device::particle::air::wgsl_constants(),
        device::particle::fly::wgsl_constants(),
        device::particle::birth::wgsl_constants(),
        device::particle::force::wgsl_constants(),
        device::particle::force_carrier::wgsl_constants(),
        device::particle::local_space::wgsl_constants(),
        device::particle::nest::wgsl_constants(),
        device::particle::record::wgsl_constants(),
        device::particle::strike::wgsl_constants(),
        motion::table::wgsl_constants(),
        stats::wgsl_constants(),
        tree::record::wgsl_constants(),
        device::solid::grid::wgsl_constants(),
        device::solid::near::wgsl_constants(),
        device::solid::shape::wgsl_constants(),
        device::terrain::ground::wgsl_constants(),
        device::terrain::litter::wgsl_constants(),
        device::terrain::snow::wgsl_constants(),
        device::terrain::snow_print::wgsl_constants(),
        device::tree::branch_fall::wgsl_constants(),
        device::tree::branch_snow::wgsl_constants(),
        device::tree::sway::quigley::wgsl_constants(),
        device::tree::sway::wgsl_constants(),
        device::wind::gust::wgsl_constants(),
        device::wind::jet::wgsl_constants(),
        device::wind::packed::wgsl_constants(),
        device::wind::pile_shadow::wgsl_constants(),
        device::wind::plume::wgsl_constants(),
        device::wind::profile::wgsl_constants(),
        device::wind::shelter::wgsl_constants(),
        device::wind::slipstream::wgsl_constants(),
        device::wind::turbulence::wgsl_constants(),
        device::wind::vortex::wgsl_constants(),
    ];
    let declarations: String = lists.into_iter().flatten().map(|(_, declaration)| declaration).collect();
    format!("const WORKGROUP_SIZE: u32 = {WORKGROUP_SIZE}u;\n{declarations}")
}
