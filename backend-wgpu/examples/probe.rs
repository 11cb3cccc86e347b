// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! probe
use windfall_core::*;
use windfall_wgpu::*;
fn main() {
    let name = std::env::args().nth(1).unwrap();
    let steps: u32 = std::env::args().nth(2).unwrap().parse().unwrap();
    let scene = Scene::load(&name).unwrap();
    let t = std::time::Instant::now();
    let world = World::build(&scene).unwrap();
    println!("build {:?} {:?}", t.elapsed(), world.stats());
    let gpu = Gpu::request(None).unwrap();
    for contract in [Contract::Exact, Contract::Tolerant] {
    let mut g = WgpuSimulator::new(&gpu, &world, &WgpuOptions { contract: Some(contract), ..Default::default() }).unwrap();
    println!("{:?}", g.info());
    let mut c = world.clone();
    let mut out = world.clone();
    for _ in 0..4 {
        let t = std::time::Instant::now();
        g.step(steps / 4).unwrap();
        g.sync().unwrap();
        println!("gpu {:?} per leaf-step {:.2} ns", t.elapsed(), t.elapsed().as_secs_f64() * 1e9 / (steps / 4) as f64 / world.leaves.len() as f64);
        let t = std::time::Instant::now();
        for _ in 0..steps / 4 {
            let b = c.environment.step_block(&c.clock);
            let cx = c.environment.context(&b);
            for mut leaf in c.leaves.as_mut().iter_mut() { windfall_core::leaf::advance::leaf_advance(&cx, &mut leaf); }
            let e = c.environment.clone();
            c.clock.advance(&e);
        }
        println!("cpu {:?} per leaf-step {:.2} ns", t.elapsed(), t.elapsed().as_secs_f64() * 1e9 / (steps / 4) as f64 / world.leaves.len() as f64);
        g.read_state(&mut out).unwrap();
        let (mut diff, mut ints, mut worst) = (0, 0, 0f32);
        for s in 0..out.leaves.len() {
            let (a, b) = (&out.leaves, &c.leaves);
            if a.place[s] != b.place[s] || a.drift[s] != b.drift[s] || a.attitude[s] != b.attitude[s] { diff += 1; }
            if a.place[s].bits != b.place[s].bits || a.drift[s].phase != b.drift[s].phase || a.course[s] != b.course[s] || a.identity[s] != b.identity[s] { ints += 1; }
            for k in 0..3 { worst = worst.max((a.place[s].position[k] - b.place[s].position[k]).abs()); }
        }
        println!("hash {:016x} {:016x} differing {diff} ints {ints} worst {worst} stats {}", out.state_hash(), c.state_hash(), g.stats().unwrap() == c.stats());
    }
    println!("{:?}", c.stats());
    }
}
