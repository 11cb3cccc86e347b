// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A wind tunnel for leaves that lie: they are strewn on a ground, the wind blows, and it is seen who moves how.

use glam::{Vec2, Vec3};
use serde::Serialize;
use windfall_core::device::leaf::record::{leaf_species, size_ratio};
use windfall_core::leaf::LeafState;
use windfall_core::scene::{
    Gusts, Litter, MeanSpeed, Planform, Profile, Release, Source, SourceShape, Species, Turbulence,
    WindParameters,
};
use windfall_core::{REST_OFFSET_M, Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

use crate::run::cancel::Cancel;

/// Height of the stated wind in m.
const REFERENCE_M: f32 = 10.0;
/// Half edge in m of the square on which the leaves lie at first.
const HALF_PATCH_M: f32 = 10.0;
/// Way in m from which on a leaf counts as moved.
const MOVED_M: f64 = 0.5;
/// Leaf area index of the litter in which the leaves of that ground lie.
const LITTER_AREA_INDEX: f32 = 1.5;
/// Standard deviation of the wind along its way over its friction velocity near the ground.
const DEVIATION_RATIO: f64 = 2.4;
/// The constant of von Kármán.
const KARMAN: f64 = 0.4;

/// A ground that leaves lie on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(crate) enum TunnelGround {
    /// Paving: roughness length 0.5 mm, friction 0.45.
    Pavement,
    /// A mown lawn: roughness length 5 mm, friction 0.6.
    Lawn,
    /// Leaves of the same kind, one and a half layers of them: roughness length 5 mm.
    Litter,
}

impl TunnelGround {
    /// As the command line calls it.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Pavement => "pavement",
            Self::Lawn => "lawn",
            Self::Litter => "litter",
        }
    }

    const fn roughness_m(self) -> f32 {
        match self {
            Self::Pavement => 0.0005,
            Self::Lawn | Self::Litter => 0.005,
        }
    }

    const fn friction(self) -> f32 {
        match self {
            Self::Pavement => 0.45,
            Self::Lawn | Self::Litter => 0.6,
        }
    }
}

/// Options of the tunnel.
#[derive(Clone, Debug)]
pub(crate) struct Tunnel {
    /// Kind of leaves.
    pub(crate) species: Species,
    /// The ground.
    pub(crate) ground: TunnelGround,
    /// Number of leaves on bare ground.
    pub(crate) leaves: u32,
    /// Seconds for which the wind blows.
    pub(crate) seconds: f32,
    /// Water per dry mass.
    pub(crate) moisture: f32,
    /// Suction of wet leaves in N/m².
    pub(crate) adhesion_n_m2: f32,
    /// Seed of everything random.
    pub(crate) seed: u64,
}

/// Outcome of one wind. The names of these fields are keys of JSON; they stay.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct TunnelPoint {
    /// Kind of leaves.
    pub(crate) species: String,
    /// The ground.
    pub(crate) ground: TunnelGround,
    /// Mean wind 10 m above the ground.
    pub(crate) u10_m_s: f64,
    /// Share of the leaves that are more than half a metre away in the end.
    pub(crate) moved_share: f64,
    /// Mean distance from where the leaves lay at first, per second.
    pub(crate) mean_speed_m_s: f64,
    /// Share of the leaves' way on which they touch nothing.
    pub(crate) airborne_share: f64,
    /// Flights without a touch, per leaf.
    pub(crate) hops_per_leaf: f64,
    /// Mean length of such a flight over the ground.
    pub(crate) mean_hop_m: f64,
}

/// A leaf on its way.
#[derive(Clone, Copy, Debug)]
struct Track {
    start: Vec2,
    before: Vec2,
    /// Place of the take-off, while the leaf is in the air.
    took_off: Option<Vec2>,
}

/// Longest half axis of a leaf relative to the radius of the disc with its area.
fn reach_ratio(planform: Planform) -> f32 {
    let stretch = planform.aspect.sqrt();
    planform.extent * stretch.max(1.0 / stretch)
}

impl Tunnel {
    /// The scene of a mean wind in m/s.
    fn scene(&self, u10_m_s: f32) -> Scene {
        let roughness_m = self.ground.roughness_m();
        let friction_velocity_ratio = KARMAN / (f64::from(REFERENCE_M) / f64::from(roughness_m)).ln();
        #[expect(clippy::cast_possible_truncation, reason = "scene numbers are single precision")]
        let intensity = (DEVIATION_RATIO * friction_velocity_ratio) as f32;
        let is_bare = self.ground != TunnelGround::Litter;
        let mut scene = Scene { name: "litter".into(), seed: self.seed, ..Scene::default() };
        scene.species = vec![self.species.clone()];
        scene.wind = WindParameters {
            speed: MeanSpeed::MetresPerSecond(u10_m_s),
            direction_deg: 0.0,
            reference_height_m: REFERENCE_M,
            profile: Profile::Log { roughness_m, displacement_m: 0.0 },
            gusts: Gusts { strength: 0.0, ..Gusts::default() },
            turbulence: Turbulence { intensity, cell_m: 1.0, calm_m_s: 0.0 },
            vortices: Vec::new(),
            jets: Vec::new(),
            plumes: Vec::new(),
            shelter: false,
        };
        scene.ground.surface_roughness_m = roughness_m;
        scene.ground.friction = self.ground.friction();
        // The leaves lie at its upwind end.
        scene.ground.litter = Some(Litter {
            center_m: Vec2::new(115.0, 0.0),
            size_m: Vec2::new(256.0, 40.0),
            moisture: self.moisture,
            adhesion_n_m2: self.adhesion_n_m2,
            ..Litter::default()
        });
        scene.sources = vec![Source {
            shape: SourceShape::Box {
                center_m: Vec3::ZERO,
                half_extent_m: Vec3::new(HALF_PATCH_M, 0.0, HALF_PATCH_M),
            },
            count: self.leaves,
            release: Release::Rate { per_s: 1e8, from_s: -60.0 },
            recycle_after_s: None,
            species: Vec::new(),
        }];
        if !is_bare && let Some(litter) = &mut scene.ground.litter {
            scene.sources.clear();
            litter.center_m = Vec2::ZERO;
            litter.size_m = Vec2::splat(2.0 * HALF_PATCH_M);
            litter.leaf_area_index = LITTER_AREA_INDEX;
        }
        scene
    }

    /// Blows at the leaves.
    ///
    /// # Errors
    /// A request to end, or threads that do not start.
    pub(crate) fn blow(&self, u10_m_s: f32, cancel: &Cancel) -> anyhow::Result<TunnelPoint> {
        let world = World::build(&self.scene(u10_m_s))?;
        let mut simulator = CpuSimulator::new(&world, CpuOptions::default())?;
        let species = &world.compiled.scene().species;
        let place = |place: &windfall_core::leaf::Place| Vec2::new(place.position[0], place.position[2]);
        let mut tracks: Vec<Track> = (world.leaves.place.iter())
            .map(|at| Track { start: place(at), before: place(at), took_off: None })
            .collect();
        let (mut way_m, mut flown_m, mut hops, mut hopped_m) = (0.0, 0.0, 0u32, 0.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an hour at most")]
        let steps = (self.seconds / world.compiled.scene().dt_s).round() as u32;
        for step in 0..steps {
            if step % 600 == 0 {
                cancel.check()?;
            }
            simulator.step(1)?;
            let leaves = &simulator.world().leaves;
            for ((track, at), schedule) in tracks.iter_mut().zip(&leaves.place).zip(&leaves.schedule) {
                let here = place(at);
                let moved = f64::from(here.distance(track.before));
                let kind = &species[leaf_species(at.bits) as usize % species.len()];
                let reach_m =
                    0.5 * kind.size_m * size_ratio(schedule.size) * reach_ratio(kind.shape.planform());
                let is_aloft = at.state() == LeafState::Falling && at.position[1] > reach_m + REST_OFFSET_M;
                way_m += moved;
                flown_m += if is_aloft { moved } else { 0.0 };
                match (track.took_off, is_aloft) {
                    (None, true) => track.took_off = Some(here),
                    (Some(from), false) => {
                        hops += 1;
                        hopped_m += f64::from(here.distance(from));
                        track.took_off = None;
                    }
                    _ => {}
                }
                track.before = here;
            }
        }
        let count = tracks.len() as f64;
        let away = |track: &Track| f64::from(track.before.distance(track.start));
        let moved = tracks.iter().filter(|track| away(track) > MOVED_M).count();
        Ok(TunnelPoint {
            species: self.species.name.clone(),
            ground: self.ground,
            u10_m_s: f64::from(u10_m_s),
            moved_share: moved as f64 / count,
            mean_speed_m_s: tracks.iter().map(away).sum::<f64>() / count / f64::from(self.seconds),
            airborne_share: if way_m > 0.0 { flown_m / way_m } else { 0.0 },
            hops_per_leaf: f64::from(hops) / count,
            mean_hop_m: if hops > 0 { hopped_m / f64::from(hops) } else { 0.0 },
        })
    }
}
