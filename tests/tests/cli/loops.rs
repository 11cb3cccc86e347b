// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes that repeat: leaves to the bit on both backends, trees nearly, pictures without a seam.

use std::path::Path;

use tempfile::TempDir;
use windfall_core::device::particle::record::{PARTICLE_ALIVE, PARTICLE_RESTING, particle_state};
use windfall_core::motion::Primitive;
use windfall_core::particle::way_of;
use windfall_core::{Cycle, Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator};

use crate::common_cli::{assert_refused, file, folder, windfall};

/// Two sources, one of bodies, in gusts, turbulence, a vortex, a jet and a plume.
const SCENE: &str = "(
    species: [(name: \"leaf\"), (name: \"body\", flight: Aerodynamic(()))],
    sources: [
        (shape: Box(center_m: (0.0, 3.0, 0.0), half_extent_m: (2.0, 0.5, 2.0)), count: 120,
         release: Rate(per_s: 20.0, from_s: -6.0), recycle_after_s: 6.0, species: [(species: \"leaf\", weight: 1)]),
        (shape: Disc(center_m: (0.0, 3.0, 0.0), radius_m: 2.0), count: 70,
         release: Rate(per_s: 20.0, from_s: -4.0), recycle_after_s: 5.0, species: [(species: \"body\", weight: 1)]),
    ],
    wind: (speed: MetresPerSecond(2.0), vortices: [(center_m: (1.0, 1.0, 0.0), axis: (0.0, 1.0, 0.0),
        circulation_m2_s: 2.0, core_m: 0.5, axial_m_s: 0.0, drift_m_s: (0.0, 0.0, 0.0))],
        jets: [(nozzle_m: 0.5, keys: [(time_s: 0.0, at_m: (-2.0, 1.0, 0.0), toward_m: (0.0, 0.5, 0.0), speed_m_s: 3.0)])],
        plumes: [(name: \"fire\", at_m: (1.0, 0.0, 1.0), base_radius_m: 0.4, keys: [(time_s: 0.0, power_kw: 20.0)])]),
    view: (camera: (eye_m: (0.0, 2.0, 8.0), target_m: (0.0, 1.6, 0.0))),
)";

/// The worlds after the run-in and `steps` later.
fn two_rounds(simulator: &mut dyn Simulator, world: &World, cycle: &Cycle, steps: u32) -> [World; 2] {
    let mut worlds = [world.clone(), world.clone()];
    for (world, count) in worlds.iter_mut().zip([cycle.run_in, steps]) {
        simulator.step(count).expect("it steps");
        simulator.read_state(world).expect("the same size");
    }
    worlds
}

/// Falling leaves, and leaves of which another slot has not every bit one round before.
fn off_after(cycle: &Cycle, [before, after]: &[World; 2]) -> (usize, usize) {
    let scene = after.compiled.scene();
    let dt = f64::from(scene.dt_s);
    let mut first = scene.tree_leaf_count() as usize;
    let (mut falling, mut off) = (0, 0);
    for source in &scene.sources {
        let rounds = f64::from(source.recycle_after_s.expect("recycled")) / dt / f64::from(cycle.steps);
        #[expect(clippy::cast_possible_truncation, reason = "a small whole number")]
        let each = source.count as usize / rounds.round() as usize;
        let count = source.count as usize;
        for place in 0..count {
            let (one, other) = (first + place, first + (place + each) % count);
            let bits = |world: &World, slot: usize| {
                let leaves = &world.leaves;
                let schedule = leaves.schedule[slot];
                (
                    leaves.place[slot],
                    leaves.drift[slot],
                    leaves.attitude[slot],
                    (schedule.rate, schedule.size, schedule.heading),
                    (leaves.identity[slot].id, leaves.identity[slot].appearance),
                )
            };
            falling +=
                usize::from(before.leaves.place[one].state() == windfall_core::leaf::LeafState::Falling);
            off += usize::from(bits(before, one) != bits(after, other));
        }
        first += count;
    }
    (falling, off)
}

#[test]
fn leaves_repeat_to_the_bit_on_both_backends() {
    let scene = Scene::from_ron(SCENE, "loop").expect("valid");
    repeats(&scene);
    // Leaves on cone spirals begin at the same age again.
    let mut winding = scene;
    winding.species[0].start = Primitive::ConeSpiral;
    repeats(&winding);
}

/// Drops that bounce and rest, spray of theirs, dust that goes with the air, and sparks in the frame of the drops.
const PARTICLES: &str = "(
    particles: [
        (name: \"drops\", count: 170, from: Box(center_m: (0.0, 1.0, 0.0), half_extent_m: (1.0, 0.2, 1.0)),
         release: Rate(per_s: 41.3, from_s: -2.0), life_s: Some(Uniform(3.0, 0.9)), air: Quadratic(drag: 0.5),
         meets: Bounce(restitution: 0.3, friction: Coulomb(0.4)), look: (kind: Glow, blink_s: Some(0.7))),
        (name: \"spray\", count: 340, nest: Some((of: \"drops\", on: Hit, fan: 2, inherit: 0.2)), speed_m_s: Normal(0.8, 0.2),
         life_s: Some(Constant(0.2)), air: Linear(time_s: Constant(0.4)), meets: Die),
        (name: \"sparks\", count: 170, nest: Some((of: \"drops\", on: Birth, radius_m: 0.2, space: Local)), life_s: Some(Constant(0.5)),
         gravity: 0.0, air: Linear(time_s: Constant(1.0)), meets: Nothing, feels: [\"stir\"]),
        (name: \"dust\", count: 60, release: Rate(per_s: 10.0, from_s: 0.0), life_s: Some(Constant(4.0)), air: Massless, meets: Nothing,
         history: Some((samples: 5, every_steps: 3))),
    ],
    forces: [(name: \"stir\", of: Noise(m_s2: 2.0, cell_m: 0.5))],
    wind: (speed: MetresPerSecond(2.0)),
)";

/// All that is alive, whatever its slot: bits of every word, births as ages.
fn living(world: &World) -> Vec<[u32; 12]> {
    let store = &world.particles;
    let rows = store.place.iter().zip(&store.motion).zip(&store.traits);
    let mut living: Vec<_> = rows
        .filter(|((place, _), _)| matches!(particle_state(place.bits), PARTICLE_ALIVE | PARTICLE_RESTING))
        .map(|((place, motion), traits)| {
            let [x, y, z] = place.position.map(f32::to_bits);
            let [u, v, w] = motion.velocity.map(f32::to_bits);
            let age = world.clock.step().wrapping_sub(motion.birth);
            let [a, b] = traits.air.map(f32::to_bits);
            [place.bits, traits.id, x, y, z, u, v, w, age, traits.life_size, a, b]
        })
        .collect();
    living.sort_unstable();
    living
}

/// Ways of all that is alive and keeps samples, whatever its slot: numbers, ages and bits of every sample.
fn ways(world: &World) -> Vec<Vec<[u32; 4]>> {
    let (store, now) = (&world.particles, world.clock.step());
    let slots = world
        .compiled
        .histories()
        .iter()
        .flat_map(|(_, run)| (run.first..run.first + run.count).map(move |slot| (run, slot)));
    let alive = slots.filter(|(_, slot)| particle_state(store.place[*slot as usize].bits) == PARTICLE_ALIVE);
    let mut ways: Vec<_> = alive
        .map(|(run, slot)| {
            let id = store.traits[slot as usize].id;
            let samples = way_of(run, store, &world.history, slot, now).map(|sample| {
                let [x, y, z] = sample.position.map(f32::to_bits);
                [x, y, z, now.wrapping_sub(sample.time)]
            });
            std::iter::once([id, 0, 0, 0]).chain(samples).collect()
        })
        .collect();
    ways.sort_unstable();
    ways
}

/// A rhythm of samples that does not fit the loop is refused in one line.
#[test]
fn ways_must_fit_the_loop() {
    let scene =
        Scene::from_ron(&PARTICLES.replace("every_steps: 3", "every_steps: 7"), "particles").expect("valid");
    let refused =
        World::build_cycle(&scene, "particles", 2.0).expect_err("120 is no multiple of seven").to_string();
    assert_eq!(refused.lines().count(), 1, "{refused}");
    let says = |text: &str| assert!(refused.contains(text), "{refused}");
    ["particles[3].history.every_steps", "7", "a divisor of its 120 steps in a loop"]
        .into_iter()
        .for_each(says);
}

#[test]
fn particles_repeat_to_the_bit_on_both_backends() {
    let scene = Scene::from_ron(PARTICLES, "particles").expect("valid");
    let (world, cycle) = World::build_cycle(&scene, "particles", 2.0).expect("it can repeat");
    let mut cpu = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    let rounds = two_rounds(&mut cpu, &world, &cycle, cycle.steps);
    let [before, after] = rounds.each_ref().map(ways);
    assert!(before.iter().filter(|way| way.len() == 6).count() > 30, "{} ways", before.len());
    assert_eq!(before, after, "the same ways");
    let [before, after] = rounds.each_ref().map(living);
    let resting = rounds[0].particles.place.iter().filter(|row| particle_state(row.bits) == PARTICLE_RESTING);
    assert!(before.len() > 200 && resting.count() > 20, "{} are alive", before.len());
    assert_eq!(before, after, "the same particles, in whatever slots");
    let mut late = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    let [before, after] = two_rounds(&mut late, &world, &cycle, cycle.steps + 1).each_ref().map(living);
    assert_ne!(before, after, "a step too many is noticed");
    let gpu = Gpu::request(None).expect("an adapter");
    let mut wgpu = WgpuSimulator::new(&gpu, &world, &WgpuOptions::default()).expect("the device takes it");
    let [_, end] = two_rounds(&mut wgpu, &world, &cycle, cycle.steps);
    assert_eq!(end.state_hash(), rounds[1].state_hash(), "the same bits on the device");
    assert_eq!(world.compiled.scene().particles[0].look.blink_s, Some(2.0 / 3.0), "whole blinks");
}

fn repeats(scene: &Scene) {
    let (world, cycle) = World::build_cycle(scene, "loop", 2.0).expect("it can repeat");
    assert_eq!(cycle.steps, 120, "two seconds");
    let mut cpu = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    let rounds = two_rounds(&mut cpu, &world, &cycle, cycle.steps);
    let (falling, off) = off_after(&cycle, &rounds);
    assert!(falling > 40, "{falling} leaves are in the air");
    assert_eq!(off, 0, "every leaf is where another was a round ago");
    // A step too many: what the comparison would say of a cut somewhere else.
    let mut late = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    let (_, off) = off_after(&cycle, &two_rounds(&mut late, &world, &cycle, cycle.steps + 1));
    assert!(off >= falling, "only {off} leaves notice a step too many");
    let gpu = Gpu::request(None).expect("an adapter");
    let mut wgpu = WgpuSimulator::new(&gpu, &world, &WgpuOptions::default()).expect("the device takes it");
    let [_, end] = two_rounds(&mut wgpu, &world, &cycle, cycle.steps);
    assert_eq!(end.state_hash(), rounds[1].state_hash(), "the same bits on the device");
}

#[test]
fn trees_repeat_within_a_tenth_of_a_millimetre() {
    let text = "(sources: [], trees: [(kind: \"bush\", leaves: 200)],
        wind: (speed: MetresPerSecond(5.0)), autumn: 0.6)";
    let scene = Scene::from_ron(text, "bush").expect("valid");
    let (world, cycle) = World::build_cycle(&scene, "bush", 6.0).expect("it can repeat");
    let mut cpu = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    let apart = |[before, after]: &[World; 2]| {
        let places = before.leaves.place.iter().zip(&after.leaves.place);
        let axes = places.flat_map(|(a, b)| (0..3).map(|axis| (a.position[axis] - b.position[axis]).abs()));
        axes.fold(0.0, f32::max)
    };
    let rounds = two_rounds(&mut cpu, &world, &cycle, cycle.steps);
    assert!(apart(&rounds) < 1e-4, "leaves on twigs are {} m off after a round", apart(&rounds));
    let half = two_rounds(&mut cpu, &world, &cycle, cycle.steps / 2);
    assert!(apart(&half) > 1e-2, "they move: {} m in half a round", apart(&half));
    assert_eq!(rounds[0].stats().leaves.attached, rounds[1].stats().leaves.attached, "none comes off");
}

/// Mean differences of each frame of a clip to the next, the last to the first.
fn differences(frames: &Path) -> Vec<f64> {
    let mut paths: Vec<_> =
        std::fs::read_dir(frames).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    let pictures: Vec<_> = paths.iter().map(|path| image::open(path).expect("a picture").to_rgb8()).collect();
    let next = pictures.iter().cycle().skip(1);
    let apart = |a: &image::RgbImage, b: &image::RgbImage| {
        let sum: u64 = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
        sum as f64 / a.as_raw().len() as f64
    };
    pictures.iter().zip(next).map(|(a, b)| apart(a, b)).collect()
}

fn seam(there: &TempDir, out: &str, length: &[&str]) -> (f64, f64) {
    let fixed = ["render", "loop.ron", "--size", "160x90", "--fps", "20", "--out", out];
    windfall(there, &[&fixed[..], length].concat()).text();
    let mut all = differences(&there.path().join(out));
    assert_eq!(all.len(), 19, "56 steps, a multiple of eight");
    let seam = all.pop().expect("the last");
    (seam, all.into_iter().fold(0.0, f64::max))
}

#[test]
fn a_looped_clip_has_no_seam_and_a_plain_one_has() {
    let there = folder();
    file(&there, "loop.ron", SCENE);
    let (at_seam, elsewhere) = seam(&there, "looped", &["--loop", "1"]);
    assert!(at_seam <= 1.1 * elsewhere, "the seam differs by {at_seam}, other frames by up to {elsewhere}");
    let (at_cut, elsewhere) = seam(&there, "plain", &["--frames", "19"]);
    assert!(at_cut > 1.1 * elsewhere, "a cut differs by {at_cut}, other frames by up to {elsewhere}");
}

/// Rows of a frame of a table from the leaf's id on: it comes back in another slot.
fn rows(table: &str, frame: usize) -> Vec<&str> {
    let begin = format!("{frame},");
    let mut rows: Vec<&str> = table
        .lines()
        .skip(1)
        .filter(|row| row.starts_with(&begin))
        .filter_map(|row| row.splitn(5, ',').nth(4))
        .collect();
    rows.sort_unstable();
    rows
}

#[test]
fn an_exported_round_ends_as_it_begins() {
    let there = folder();
    file(&there, "loop.ron", SCENE);
    for backend in ["cpu", "wgpu"] {
        let options = ["--loop", "1", "--fps", "20", "--backend", backend, "--out", "a.csv"];
        windfall(&there, &[&["export", "loop.ron"], &options[..]].concat()).text();
        let table = std::fs::read_to_string(there.path().join("a.csv")).expect("a table");
        assert!(
            table.starts_with("frame,step,time_s,leaf,id,"),
            "{}",
            table.lines().next().unwrap_or_default()
        );
        let (first, last) = (rows(&table, 0), rows(&table, 19));
        assert!(first.len() > 100, "{backend}: {} leaves", first.len());
        assert_eq!(first, last, "{backend}: the same leaves at the same places");
        assert_ne!(first, rows(&table, 18), "{backend}: and not before");
        assert!(rows(&table, 20).is_empty(), "{backend}: nothing follows");
    }
}

#[test]
fn what_cannot_repeat_is_refused() {
    let there = folder();
    let refuse = |text: &str, seconds: &str, essentials: &[&str]| {
        file(&there, "no.ron", text);
        assert_refused(&there, &["render", "no.ron", "--loop", seconds, "--out", "x.gif"], essentials);
    };
    refuse("()", "0.5", &["--loop", "1", "120"]);
    refuse("(trees: [(kind: \"oak\")])", "2", &["no.ron: --loop is 2", "6 to 120 s"]);
    refuse("(sources: [(recycle_after_s: None)])", "4", &["sources[0].recycle_after_s is None", "in a loop"]);
    refuse("(sources: [(release: Burst(at_s: 0.0))])", "4", &["sources[0].release is Burst", "Rate"]);
    refuse("(ground: (water: Some((height_m: -1.0))))", "4", &["ground.water", "ripples"]);
    let vortex =
        "(wind: (vortices: [(center_m: (0.0, 0.0, 0.0), axis: (0.0, 1.0, 0.0), circulation_m2_s: 1.0,
        core_m: 1.0, axial_m_s: 0.0, drift_m_s: (1.0, 0.0, 0.0))]))";
    refuse(vortex, "4", &["wind.vortices[0].drift_m_s", "stay"]);
    let jet = "(wind: (jets: [(nozzle_m: 0.1, keys: [(time_s: 0.0, at_m: (0.0, 1.0, 0.0), toward_m: (1.0, 1.0, 0.0), speed_m_s: 0.0),
        (time_s: 1.0, at_m: (0.0, 1.0, 0.0), toward_m: (1.0, 1.0, 0.0), speed_m_s: 9.0)])]))";
    refuse(jet, "4", &["wind.jets[0].keys is 2 that differ", "jets that stay as they are in a loop"]);
    let plume = "(wind: (plumes: [(name: \"fire\", at_m: (0.0, 0.0, 0.0), base_radius_m: 0.3,
        keys: [(time_s: 0.0, power_kw: 5.0), (time_s: 1.0, power_kw: 9.0)])]))";
    refuse(plume, "4", &["wind.plumes[0].keys is 2 that differ", "plumes of a power that stays in a loop"]);
    let path = "(ground: (litter: Some((still: true))), objects: [(motion: Path([(time_s: 0.0, moved_m: (0.0, 0.0, 0.0))]))])";
    refuse(path, "4", &["objects[0].motion is a path", "Still in a loop"]);
    let walker = "(ground: (litter: Some((still: true))), walkers: [()])";
    refuse(walker, "4", &["walkers is a list of 1", "nobody who walks in a loop"]);
    let poisson = "(particles: [(release: Poisson(per_s: 9.0, from_s: 0.0))])";
    refuse(poisson, "4", &["particles[0].release is Poisson", "Rate", "in a loop"]);
    let rounds = "(particles: [(name: \"a\"), (count: 2000, nest: Some((of: \"a\", on: Birth)), life_s: Some(Constant(1.0)))])";
    refuse(rounds, "4", &["particles[1].count is 2000", "1000: slots for one event"]);
    let carried = "(particles: [(name: \"a\", count: 60, release: Rate(per_s: 5.0, from_s: 0.0), feels: [\"pull\"])],
        forces: [(name: \"pull\", of: Attract(at_m: (0.0, 0.0, 0.0), gm_m3_s2: 1.0, softening_m: 0.1), carried_by: Some((of: \"a\")))])";
    refuse(carried, "4", &["forces[0].carried_by", "None in a loop"]);
    file(&there, "no.ron", "()");
    let exported = ["export", "no.ron", "--loop", "0.5", "--out", "x.csv"];
    assert_refused(&there, &exported, &["--loop", "1", "120"]);
    assert_refused(&there, &["export", "no.ron", "--out", "x.csv"], &["--frames", "--loop"]);
    let both = ["render", "no.ron", "--loop", "2", "--frames", "3", "--out", "x.gif"];
    assert_refused(&there, &both, &["--loop", "--frames"]);
}
