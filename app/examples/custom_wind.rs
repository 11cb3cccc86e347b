// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A wind of one's own: an updraught over a warm spot, read by both backends with the same bits.
//! `cargo run --release --example custom_wind`

use glam::DVec3;
use windfall_core::scene::{MeanSpeed, Release, Source, SourceShape, Turbulence, WindParameters};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator};

/// Middle of the warm spot in metres.
const MIDDLE: DVec3 = DVec3::new(12.0, 0.0, 9.0);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let world = run(600)?;
    let above = world.leaves.place.iter().filter(|place| place.position[1] > 10.0).count();
    println!("{above} of {} leaves are higher than where they were let go", world.leaves.len());
    Ok(())
}

/// The air in m/s at a place in metres: it rises in the middle, streams in below and out above.
fn updraught(place: DVec3) -> DVec3 {
    let from_middle = (place - MIDDLE).with_y(0.0);
    let near = (-from_middle.length_squared() / 18.0).exp();
    let rise = (std::f64::consts::PI * place.y / 12.0).clamp(0.0, std::f64::consts::PI);
    DVec3::Y * (2.5 * near * rise.sin()) - from_middle * (0.35 * near * rise.cos())
}

/// Simulates leaves in the updraught, on the processor and on a graphics adapter, and compares.
pub(crate) fn run(steps: u32) -> Result<World, Box<dyn std::error::Error>> {
    let scene = Scene {
        // No mean wind: the field stays where it is. The cell sets how large its box is and how fine.
        wind: WindParameters {
            speed: MeanSpeed::MetresPerSecond(0.0),
            direction_deg: 0.0,
            turbulence: Turbulence { cell_m: 0.8, ..Turbulence::default() },
            ..WindParameters::default()
        },
        sources: vec![Source {
            shape: SourceShape::Disc { center_m: glam::Vec3::new(12.0, 9.0, 9.0), radius_m: 4.0 },
            count: 500,
            release: Release::Burst { at_s: 0.0 },
            recycle_after_s: None,
            species: Vec::new(),
        }],
        ..Scene::default()
    };
    let mut world = World::build(&scene)?;
    world.compiled.set_wind_field(updraught);

    let mut on_cpu = CpuSimulator::new(&world, CpuOptions::default())?;
    let mut on_gpu = WgpuSimulator::new(&Gpu::request(None)?, &world, &WgpuOptions::default())?;
    let (mut here, mut there) = (world.clone(), world);
    on_cpu.step(steps)?;
    on_gpu.step(steps)?;
    on_cpu.read_state(&mut here)?;
    on_gpu.read_state(&mut there)?;
    println!(
        "{} and {}: same bits: {}",
        on_cpu.info().backend,
        on_gpu.info().adapter,
        here.state_hash() == there.state_hash()
    );
    Ok(here)
}
