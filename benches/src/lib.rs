// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Common parts of the benches: scenes of any size, both backends with their answers proved, and a timer that waits.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

use glam::{Vec2, Vec3};
use windfall_core::scene::{
    Aerodynamics, Air, Direction, FlightModel, Force, ForceKind, Litter, MeanSpeed, Meets, ObjectFriction,
    ParticleRelease, ParticleShape, Particles, Release, SourceShape, Species, Spread, SwirlProfile, Tree,
    Weather,
};
use windfall_core::{Contract, Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator, describe_adapter};

/// So many elements, or a hundredth of them where benches are only tested (`cargo bench -- --test`): that they run is all it shows.
pub fn sized(whole: u32) -> u32 {
    if std::env::args().any(|argument| argument == "--test") {
        (whole / 100).max(whole.min(1000))
    } else {
        whole
    }
}

/// Steps before anything is timed. Shaders are compiled and memory is touched; the state after them is compared.
pub const WARM_UP_STEPS: u32 = 4;

/// Height in metres that the leaves of [`falling`] start from. In [`FALLING_STEPS`] steps, 33 seconds, none lands:
/// leaves fall at one or two metres per second.
const HIGH_M: f32 = 300.0;
/// Depth of their cloud in metres: they read every layer of the turbulence.
const DEPTH_M: f32 = 40.0;
/// Steps in which the first flakes of [`snowing`] have come down.
pub const SNOWING_STEPS: u32 = 720;
/// Steps after which [`falling`] begins anew.
pub const FALLING_STEPS: u32 = 2000;

/// A preset with `leaves` leaves in total: counts and rates of its sources scaled alike, so that it keeps its course.
///
/// # Panics
/// If there is no such preset, or it has more sources than leaves are asked for.
pub fn scaled(preset: &str, leaves: u32) -> Scene {
    let scene = Scene::preset(preset).expect("benches use presets only");
    scene.with_leaf_count(preset, leaves).expect("at least one leaf for each source")
}

/// `million` with all leaves let go at once from high above, never to be released again: all of them fall.
pub fn falling(leaves: u32) -> Scene {
    let mut scene = scaled("million", leaves);
    for source in &mut scene.sources {
        source.release = Release::Burst { at_s: 0.0 };
        source.recycle_after_s = None;
        if let SourceShape::Box { center_m, half_extent_m } = &mut source.shape {
            center_m.y = HIGH_M;
            half_extent_m.y = 0.5 * DEPTH_M;
        }
    }
    scene
}

/// The same, flown as bodies: dry leaves of the same sizes and masses, in turbulent air.
pub fn flying(leaves: u32) -> Scene {
    let mut scene = falling(leaves);
    for species in &mut scene.species {
        species.flight = FlightModel::Aerodynamic(Aerodynamics::default());
    }
    scene
}

/// The same without turbulence: mean wind and gusts only.
pub fn steady(leaves: u32) -> Scene {
    let mut scene = falling(leaves);
    scene.wind.turbulence.intensity = 0.0;
    scene.wind.turbulence.calm_m_s = 0.0;
    scene
}

/// `million` with every leaf released anew every sixth step: work for `resolve_events`.
pub fn restless(leaves: u32) -> Scene {
    let mut scene = scaled("million", leaves);
    for source in &mut scene.sources {
        source.recycle_after_s = Some(0.1);
    }
    scene
}

/// `million` an hour after its last release: all leaves lie on the ground.
pub fn resting(leaves: u32) -> Scene {
    let mut scene = scaled("million", leaves);
    for source in &mut scene.sources {
        source.release = Release::Rate { per_s: 1e8, from_s: -3600.0 };
        source.recycle_after_s = None;
    }
    scene
}

/// About so many leaves of one kind that lie on a square lawn with that many edges in m, in a wind of a mean speed in m/s at a height of
/// 10 m, with its turbulence. None falls.
pub fn littered(leaves: u32, edge_m: f32, speed_m_s: f32) -> Scene {
    let species = Species { size_m: 0.06, areal_density_kg_m2: 0.05, ..Species::default() };
    let leaf_m2 = std::f32::consts::FRAC_PI_4 * species.size_m * species.size_m;
    let mut scene = Scene { name: format!("litter on {edge_m} m in {speed_m_s} m/s"), ..Scene::default() };
    scene.sources.clear();
    scene.species = vec![species];
    scene.wind.speed = MeanSpeed::MetresPerSecond(speed_m_s);
    scene.wind.turbulence.intensity = 0.12;
    scene.wind.turbulence.calm_m_s = 0.0;
    #[expect(clippy::cast_precision_loss, reason = "a few significant digits")]
    let leaf_area_index = leaves as f32 * leaf_m2 / (edge_m * edge_m);
    let size_m = Vec2::splat(edge_m + 2.0);
    scene.ground.litter = Some(Litter { size_m, leaf_area_index, ..Litter::default() });
    scene
}

/// So many sparks over a lawn that live for two seconds and are born again and again: weight, linear drag in a gusty wind, and bounces
/// off the ground. One leaf falls beside them.
pub fn sparks(count: u32) -> Scene {
    let mut scene = Scene { name: format!("{count} sparks"), ..Scene::default() };
    scene.sources[0].count = 1;
    scene.wind.speed = MeanSpeed::MetresPerSecond(4.0);
    scene.wind.turbulence.intensity = 0.0;
    scene.wind.turbulence.calm_m_s = 0.0;
    #[expect(clippy::cast_precision_loss, reason = "a few significant digits")]
    let per_s = count as f32 / 2.04;
    scene.particles = vec![Particles {
        name: "sparks".into(),
        count,
        from: ParticleShape::Disc { center_m: Vec3::Y, radius_m: 40.0, axis: Vec3::Y },
        direction: Direction::Cone { axis: Vec3::Y, half_angle_deg: 40.0 },
        release: ParticleRelease::Rate { per_s, from_s: -2.0 },
        speed_m_s: Spread::Uniform(6.0, 2.0),
        life_s: Some(Spread::Constant(2.0)),
        air: Air::Linear { time_s: Spread::Uniform(0.6, 0.2) },
        meets: Meets::Bounce { restitution: 0.5, friction: ObjectFriction::Coulomb(0.3) },
        ..Particles::default()
    }];
    scene
}

/// The same sparks, in whose way nothing is: they fall through the lawn.
pub fn free_sparks(count: u32) -> Scene {
    let mut scene = sparks(count);
    scene.particles[0].meets = Meets::Nothing;
    scene
}

/// The same sparks as on the lawn, which four forces act on besides: one of each way in which forces act, and noise, the costliest.
pub fn driven_sparks(count: u32) -> Scene {
    let mut scene = sparks(count);
    let (at_m, axis) = (Vec3::new(0.0, 3.0, 0.0), Vec3::Y);
    let profile = SwirlProfile::Compact { d: 1.0 };
    let forces = [
        ("sun", ForceKind::Attract { at_m, gm_m3_s2: 20.0, softening_m: 1.0 }),
        ("noise", ForceKind::Noise { m_s2: 1.0, cell_m: 2.0 }),
        ("curl", ForceKind::Spiral { rad_s: 1.0, axis }),
        ("whirl", ForceKind::Swirl { at_m, axis, rate_rad_s: 1.0, swirl_radius_m: 20.0, profile }),
    ];
    scene.forces = forces.map(|(name, of)| Force { name: name.into(), of, carried_by: None }).into();
    scene.particles[0].feels = scene.forces.iter().map(|force| force.name.clone()).collect();
    scene
}

/// A ball of so many bodies without air or weight that attract one another. One leaf falls beside them.
pub fn attracting(count: u32) -> Scene {
    let mut scene = sparks(count);
    let of = ForceKind::Mutual { gm_m3_s2: 0.01, softening_m: 0.1 };
    scene.forces = vec![Force { name: "others".into(), of, carried_by: None }];
    scene.particles = vec![Particles {
        name: "bodies".into(),
        count,
        from: ParticleShape::Sphere { center_m: Vec3::new(0.0, 40.0, 0.0), radius_m: 10.0, hollow: false },
        release: ParticleRelease::Burst { at_s: 0.0 },
        life_s: None,
        gravity: 0.0,
        air: Air::Vacuum,
        feels: vec!["others".into()],
        meets: Meets::Nothing,
        ..Particles::default()
    }];
    scene
}

/// Ten millimetres of snow on a level square with an edge of so many metres, in frost and a steady wind of a mean speed in m/s at a height of
/// 10 m. None falls.
pub fn snowed(edge_m: f32, speed_m_s: f32) -> Scene {
    let mut scene = Scene { name: format!("snow on {edge_m} m in {speed_m_s} m/s"), ..Scene::default() };
    scene.sources[0].count = 1;
    scene.wind.speed = MeanSpeed::MetresPerSecond(speed_m_s);
    scene.weather = Some(Weather {
        size_m: Vec2::splat(edge_m),
        snow_mm_h: vec![(0.0, 0.0)],
        air_c: vec![(0.0, -5.0)],
        lying_mm: 10.0,
        ..Weather::default()
    });
    scene
}

/// So many flakes in the air of [`falling`], born as fast as they land: nearly all are in the air after [`SNOWING_STEPS`]. One leaf falls beside them.
pub fn snowing(count: u32) -> Scene {
    let mut scene = falling(1);
    scene.name = format!("{count} flakes");
    let half_extent_m = Vec3::new(40.0, 0.5, 40.0);
    scene.weather = Some(Weather {
        size_m: 2.0 * Vec2::new(half_extent_m.x, half_extent_m.z),
        // None before time zero: births there are taken one by one.
        snow_mm_h: vec![(0.0, 0.0), (0.01, 2.0)],
        air_c: vec![(0.0, -5.0), (0.01, -5.0)],
        ..Weather::default()
    });
    scene.particles = vec![Particles {
        name: "flakes".into(),
        count,
        from: ParticleShape::Box { center_m: Vec3::new(0.0, 10.0, 0.0), half_extent_m },
        release: ParticleRelease::Snowfall,
        life_s: Some(Spread::Constant(12.0)),
        size_m: Spread::Uniform(0.0055, 0.0030),
        density_kg_m3: 80.0,
        air: Air::Settling { m_s: Spread::Normal(1.0, 0.12) },
        meets: Meets::Die,
        ..Particles::default()
    }];
    scene
}

/// A square of so many maples, birches and oaks of an age, in a fresh breeze, with `leaves` leaves on every tree, if it has
/// as many, and none in the air or about to be shed.
pub fn woods(trees: u16, age: f32, leaves: u32) -> Scene {
    let mut scene = Scene::preset("forest").expect("a preset");
    let side = f32::from(trees).sqrt().ceil();
    scene.sources.clear();
    scene.autumn = 0.0;
    scene.wind.speed = MeanSpeed::MetresPerSecond(8.0);
    scene.trees = (0..trees)
        .map(|number| {
            let (row, column) = ((f32::from(number) / side).floor(), f32::from(number) % side);
            Tree {
                kind: ["maple", "birch", "maple", "oak"][usize::from(number % 4)].into(),
                at_m: [8.0 * (column - 0.5 * side), 8.0 * (row - 0.5 * side)],
                age,
                number: number.into(),
                leaves,
                ..Tree::default()
            }
        })
        .collect();
    scene
}

/// Age at which the trees of [`woods`] have about five hundred segments.
pub const YOUNG: f32 = 0.4;

/// A world of a scene.
///
/// # Panics
/// If the scene is not valid.
pub fn world(scene: &Scene) -> World {
    World::build(scene).expect("benches use valid scenes only")
}

/// A world of a scene some steps on.
///
/// # Panics
/// If the scene is not valid.
pub fn stepped(scene: &Scene, steps: u32) -> World {
    let mut simulator =
        CpuSimulator::new(&world(scene), CpuOptions::default()).expect("threads can be started");
    simulator.step(steps).expect("the CPU steps");
    simulator.world().clone()
}

/// The best adapter, or the one that `WINDFALL_BENCH_ADAPTER` names. Says on the terminal, once, which it is or that
/// there is none.
pub fn gpu() -> Option<&'static Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    let request = || {
        let name = std::env::var("WINDFALL_BENCH_ADAPTER").ok();
        match Gpu::request(name.as_deref()) {
            Ok(gpu) => {
                eprintln!("wgpu: {}, contract: {}", describe_adapter(gpu.info()), gpu.contract());
                Some(gpu)
            }
            Err(error) => {
                eprintln!("wgpu: not measured, the cpu only: {error}");
                None
            }
        }
    };
    GPU.get_or_init(request).as_ref()
}

/// Every backend of this machine, [`WARM_UP_STEPS`] steps into the world. All of them have lost no leaf and have come
/// to the state that one thread of the CPU comes to: to the bit under the exact contract, in all counts otherwise.
///
/// # Panics
/// If one of them has not, or fails: its timings would mean nothing.
pub fn contenders(world: &World) -> Vec<Box<dyn Simulator>> {
    let cpu = |threads| {
        let cpu = CpuSimulator::new(world, CpuOptions { threads, ..CpuOptions::default() })
            .expect("threads can be started");
        Box::new(cpu) as Box<dyn Simulator>
    };
    let expected = warmed_up(cpu(Some(1)).as_mut(), world);
    let mut contenders = vec![cpu(None)];
    if let Some(gpu) = gpu() {
        let wgpu = WgpuSimulator::new(gpu, world, &WgpuOptions::default());
        contenders.push(Box::new(wgpu.expect("the adapter holds the leaves")));
    }
    for contender in &mut contenders {
        let state = warmed_up(contender.as_mut(), world);
        let info = contender.info();
        let stats = contender.stats().expect("the device is not lost");
        let count = world.compiled.scene().leaf_count();
        assert_eq!(stats.leaves.total() + stats.leaves.dormant, count, "{} lost leaves", info.backend);
        assert_eq!(stats, expected.stats(), "{} counts otherwise", info.backend);
        if info.contract == Contract::Exact {
            assert_eq!(state.state_hash(), expected.state_hash(), "{} comes to another state", info.backend);
        }
    }
    contenders
}

/// The state after the warm-up.
fn warmed_up(simulator: &mut dyn Simulator, world: &World) -> World {
    let mut state = world.clone();
    simulator.step(WARM_UP_STEPS).expect("the device is not lost");
    simulator.read_state(&mut state).expect("a world of the same size");
    state
}

/// Time that `count` steps take, one by one, each until the backend is done with it.
///
/// # Panics
/// If the device is lost.
pub fn time_steps(simulator: &mut dyn Simulator, count: u64) -> Duration {
    let start = Instant::now();
    for _ in 0..count {
        simulator.step(1).expect("the device is not lost");
        simulator.sync().expect("the device is not lost");
    }
    start.elapsed()
}
