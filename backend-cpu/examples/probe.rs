// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! probe
use windfall_core::*;
use windfall_cpu::*;
fn main() {
    let name = std::env::args().nth(1).unwrap();
    let steps: u32 = std::env::args().nth(2).unwrap().parse().unwrap();
    let scene = Scene::load(&name).unwrap();
    let t = std::time::Instant::now();
    let mut world = World::build(&scene).unwrap();
    println!("build {:?}", t.elapsed());
    println!("{:?}", world.stats());
    let mut sim = CpuSimulator::new(&world, CpuOptions::default()).unwrap();
    for _ in 0..4 {
        let t = std::time::Instant::now();
        sim.step(steps / 4).unwrap();
        println!(
            "{:?} per leaf-step {:.2} ns",
            t.elapsed(),
            t.elapsed().as_secs_f64() * 1e9 / (steps / 4) as f64 / sim.leaves().len() as f64
        );
        sim.read_state(&mut world).unwrap();
        println!("{:?}", world.stats());
        for s in 0..world.leaves.len().min(6) {
            let p = world.leaves.place[s];
            println!(
                "{:?} {:?} v {:?} q {:?}",
                p.position,
                p.state(),
                world.velocity(s),
                world.leaves.attitude[s].quaternion
            );
        }
    }
    println!("{:016x}", world.state_hash());
}
