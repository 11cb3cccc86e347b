// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A simulation without a window: `cargo run --release --example headless`.

use windfall_core::leaf::LeafState;
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    run(600).map(|height_m| println!("the mean leaf in the air is {height_m:.2} m above the ground"))
}

/// Simulates the park and returns the mean height of leaves in the air, in metres.
pub(crate) fn run(steps: u32) -> Result<f32, Box<dyn std::error::Error>> {
    // A scene is plain data, here changed a little; `Scene::load` reads a file.
    let mut scene = Scene::load("autumn-park")?;
    // Growing the trees of a park takes seconds; falling leaves alone need none of them.
    scene.trees.clear();
    scene.seed = 7;
    // The world is the exchange type: it fills a simulator, and takes back what has become of it.
    let mut world = World::build(&scene)?;
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default())?;
    simulator.step(steps)?;
    simulator.read_state(&mut world)?;
    println!("{:?}", world.stats());
    // Columns of 16-byte records, one entry for each leaf.
    let falling = world.leaves.place.iter().filter(|place| place.state() == LeafState::Falling);
    let heights: Vec<f32> = falling.map(|place| place.position[1]).collect();
    Ok(heights.iter().sum::<f32>() / heights.len() as f32)
}
