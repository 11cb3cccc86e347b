// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Report of a simulation, in words and as JSON.

use std::fmt::Write as _;

use serde::Serialize;
use windfall_core::device::flight::regime::REGIME_NAMES;
use windfall_core::leaf::{BurnStats, LEAF_BYTES, LeafState};
use windfall_core::litter::{LitterStats, SnowStats};
use windfall_core::motion::Primitive;
use windfall_core::particle::ParticleStats;
use windfall_core::{LeafStats, Simulator, Stats, World};

use crate::run::stepping::Stepping;
use crate::run::swaying::TreeReport;

/// Numbers of leaves by what they do.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct LeafCounts {
    /// All that have been let go or ride a branch.
    pub total: u32,
    /// On branches.
    pub attached: u32,
    /// In the air.
    pub falling: u32,
    /// On the ground.
    pub resting: u32,
    /// Not let go yet, and not part of the total.
    pub dormant: u32,
}

/// Leaves that lie on one another.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct LitterReport {
    /// In the litter.
    pub lying: u32,
    /// Lying on solid things.
    pub held: u32,
    /// Floating on water.
    pub afloat: u32,
    /// Sinking in water, or lying under it.
    pub sunk: u32,
    /// Moving as bodies, in the air or on the ground.
    pub awake: u32,
    /// Taken from the litter by the wind since time zero, each time that one was.
    pub woken: u32,
    /// Greatest height of the litter.
    pub deepest_m: f64,
    /// Volume of the litter.
    pub volume_m3: f64,
    /// Mass of the leaves in it, with their water.
    pub mass_kg: f64,
}

impl From<LitterStats> for LitterReport {
    fn from(stats: LitterStats) -> Self {
        let LitterStats { lying, held, afloat, sunk, awake, woken, deepest_m, volume_m3, mass_kg } = stats;
        Self { lying, held, afloat, sunk, awake, woken, deepest_m, volume_m3, mass_kg }
    }
}

/// A population of particles.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct ParticleReport {
    /// Name of the population.
    pub name: String,
    /// Slots.
    pub slots: u32,
    /// Particles alive.
    pub alive: u32,
    /// Births, those before time zero included.
    pub born: u32,
    /// Deaths by age, region or hit.
    pub died: u32,
    /// Hits.
    pub hits: u32,
    /// Steps in which a particle was stopped by its fourth hit.
    pub stopped: u32,
    /// Lives that ended since the slot was needed for the next.
    pub cut_short: u32,
}

impl From<ParticleStats> for ParticleReport {
    fn from(stats: ParticleStats) -> Self {
        let ParticleStats { name, slots, alive, born, died, hits, stopped, cut_short } = stats;
        Self { name, slots, alive, born, died, hits, stopped, cut_short }
    }
}

/// Leaves that burn.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct BurningReport {
    /// Leaves that burn now.
    pub burning: u64,
    /// Leaves that have burnt and are gone.
    pub burnt: u64,
    /// Leaves that water has put out.
    pub put_out: u64,
    /// Dry mass of what is left of leaves, without ash.
    pub left_kg: f64,
    /// Ash.
    pub ash_kg: f64,
    /// Mass that has gone up in flames.
    pub gone_kg: f64,
    /// Heat that has been released.
    pub heat_mj: f64,
    /// Heat that is released per second now.
    pub power_kw: f64,
}

impl From<BurnStats> for BurningReport {
    fn from(stats: BurnStats) -> Self {
        let BurnStats { burning, burnt, put_out, left_ug, ash_ug, gone_ug, heat_j, power_w } = stats;
        let [left_kg, ash_kg, gone_kg] = [left_ug, ash_ug, gone_ug].map(|mass| mass as f64 * 1e-9);
        let (heat_mj, power_kw) = (heat_j * 1e-6, power_w * 1e-3);
        Self { burning, burnt, put_out, left_kg, ash_kg, gone_kg, heat_mj, power_kw }
    }
}

/// The outcome of `windfall simulate`. The names of these fields are the keys of its JSON; they stay.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Report {
    /// The scene as it was asked for, or the name that a checkpoint gives it.
    pub scene: String,
    /// Backend.
    pub backend: &'static str,
    /// Adapter and driver, or threads.
    pub adapter: String,
    /// Agreement with the oracle.
    pub contract: String,
    /// Seed of everything random.
    pub seed: u64,
    /// Steps of this run.
    pub steps: u32,
    /// Simulated seconds from the beginning of the scene, earlier runs included.
    pub time_s: f64,
    /// Numbers of leaves.
    pub leaves: LeafCounts,
    /// The trees.
    pub trees: TreeReport,
    /// The litter; null without any.
    pub litter: Option<LitterReport>,
    /// Leaves that burn; null where none do.
    pub burning: Option<BurningReport>,
    /// The snow; null without weather that brings any.
    pub snow: Option<SnowStats>,
    /// The populations of particles.
    pub particles: Vec<ParticleReport>,
    /// Mean position over the total.
    pub mean_position_m: [f64; 3],
    /// Mean velocity over the total.
    pub mean_velocity_m_s: [f64; 3],
    /// Fingerprint of the whole state, sixteen hexadecimal digits.
    pub state_hash: String,
    /// Speed.
    pub leaf_steps_per_s: f64,
    /// Processor time spent stepping, over all threads.
    pub cpu_s: f64,
    /// Memory of one leaf.
    pub bytes_per_leaf: usize,
}

impl Report {
    /// The outcome of `steps` steps that led to `world`, the first `earlier` of which another run has done.
    pub(crate) fn new(
        scene: String,
        simulator: &dyn Simulator,
        world: &World,
        (steps, earlier): (u32, u32),
        stepping: &Stepping,
        trees: TreeReport,
    ) -> Self {
        let info = simulator.info();
        let counts = world.stats().leaves;
        let LeafStats { attached, falling, resting, dormant, .. } = counts;
        let total = counts.total();
        let slots = &world.compiled.shard_rows().slots;
        let leaves = slots.end - slots.start;
        let (mean_position_m, mean_velocity_m_s) = means(world, total);
        Self {
            scene,
            backend: info.backend,
            adapter: info.adapter,
            contract: info.contract.to_string(),
            seed: world.compiled.scene().seed,
            steps,
            time_s: world.clock.seconds(),
            leaves: LeafCounts { total, attached, falling, resting, dormant },
            trees,
            litter: world.litter_stats().map(LitterReport::from),
            burning: world.burn_stats().map(BurningReport::from),
            snow: world.snow_stats(),
            particles: world.particle_stats().into_iter().map(ParticleReport::from).collect(),
            mean_position_m,
            mean_velocity_m_s,
            state_hash: format!("{:016x}", world.state_hash()),
            leaf_steps_per_s: stepping.rate(leaves, steps - earlier),
            cpu_s: stepping.cpu.as_secs_f64(),
            bytes_per_leaf: LEAF_BYTES,
        }
    }

    /// The report for people, with the primitive motions of the falling leaves.
    pub(crate) fn to_text(&self, stats: &Stats) -> String {
        let LeafCounts { total, attached, falling, resting, dormant } = self.leaves;
        let [x, y, z] = self.mean_position_m;
        let [u, v, w] = self.mean_velocity_m_s;
        let motions = Primitive::ALL.iter().zip(stats.leaves.primitives);
        let motions: Vec<_> = motions.map(|(motion, count)| format!("{} {count}", motion.code())).collect();
        let mut text = String::new();
        let mut row = |name: &str, value: String| {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{name:<15}{value}");
        };
        row("scene", format!("{} (seed {})", self.scene, self.seed));
        row("backend", format!("{}: {} ({} contract)", self.backend, self.adapter, self.contract));
        row("steps", format!("{}, to {:.3} s", self.steps, self.time_s));
        row("leaves", format!("{total}: {attached} attached, {falling} falling, {resting} resting"));
        row("not let go yet", dormant.to_string());
        let TreeReport { count, segments, max_joint_angle_rad, tip_speed_max_m_s, leaves_shed } = self.trees;
        let sway = format!("joints to {max_joint_angle_rad:.3} rad, tips to {tip_speed_max_m_s:.2} m/s");
        row("trees", format!("{count} of {segments} segments, {sway}, {leaves_shed} leaves shed"));
        if let Some(litter) = self.litter {
            let LitterReport { lying, held, afloat, sunk, awake, woken, deepest_m, volume_m3, mass_kg } =
                litter;
            let lies =
                format!("{lying} lying, {mass_kg:.3} kg in {volume_m3:.4} m³, up to {deepest_m:.3} m deep");
            row(
                "litter",
                format!("{lies}; {held} held, {afloat} afloat, {sunk} sunk, {awake} awake, {woken} woken"),
            );
        }
        if let Some(snow) = self.snow {
            let SnowStats {
                falling_kg,
                on_branches_kg,
                lying_kg,
                lying_mm,
                deepest_m,
                melted_kg,
                covered,
                ..
            } = snow;
            let above = format!("{falling_kg:.2} kg falling, {on_branches_kg:.2} kg on branches");
            let depth = format!(
                "{lying_mm:.3} mm of water, {deepest_m:.3} m at most, {:.0} % covered",
                100.0 * covered
            );
            row("snow", format!("{above}; {lying_kg:.2} kg lying: {depth}; {melted_kg:.2} kg melted"));
        }
        if let Some(burning) = self.burning {
            let BurningReport { burning, burnt, put_out, left_kg, ash_kg, gone_kg, heat_mj, power_kw } =
                burning;
            let leaves = format!("{burning} leaves, {burnt} burnt, {put_out} put out by water");
            let masses = format!("{left_kg:.4} kg left, {ash_kg:.4} kg of ash, {gone_kg:.4} kg gone");
            row("burning", format!("{leaves}; {masses}; {heat_mj:.3} MJ, {power_kw:.1} kW"));
        }
        for particles in &self.particles {
            let ParticleReport { name, slots, alive, born, died, hits, stopped, cut_short } = particles;
            let lives = format!("{alive} of {slots} alive, {born} born, {died} died, {cut_short} cut short");
            row("particles", format!("{name}: {lives}; {hits} hits, {stopped} stopped"));
        }
        row("motions", motions.join(", "));
        let regimes = REGIME_NAMES.iter().zip(stats.leaves.regimes);
        let regimes: Vec<_> = regimes.map(|(regime, count)| format!("{regime} {count}")).collect();
        row("bodies", regimes.join(", "));
        row("mean position", format!("{x:.4} {y:.4} {z:.4} m"));
        row("mean velocity", format!("{u:.4} {v:.4} {w:.4} m/s"));
        row("state hash", self.state_hash.clone());
        row(
            "speed",
            format!("{:.3e} leaf-steps/s, {:.3} s of processor time", self.leaf_steps_per_s, self.cpu_s),
        );
        row("memory", format!("{} bytes per leaf", self.bytes_per_leaf));
        text
    }
}

/// Mean position and velocity of all leaves that are not dormant, summed in the order of their slots.
fn means(world: &World, total: u32) -> ([f64; 3], [f64; 3]) {
    let step = world.step_block();
    let cx = world.context(&step);
    let mut sums = [[0.0; 3]; 2];
    for slot in 0..world.leaves.len() {
        let leaf = world.leaves.view(&cx, slot);
        if leaf.state == LeafState::Dormant {
            continue;
        }
        let values = [leaf.position.to_array(), leaf.velocity.to_array()];
        for (sum, value) in sums.as_flattened_mut().iter_mut().zip(values.as_flattened()) {
            *sum += f64::from(*value);
        }
    }
    let [position, velocity] = sums.map(|sum| sum.map(|sum: f64| sum / f64::from(total.max(1))));
    (position, velocity)
}
