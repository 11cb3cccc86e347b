// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws a made-up cloud of leaves without simulating anything: `render_synthetic [OUT] [LEAVES] [FRAMES] [WIDTHxHEIGHT]`.
//!
//! The environment may set YAW, PITCH (radians), ZOOM, SUN_AZIMUTH, SUN_ELEVATION (degrees), TRAIL (seconds) and SCENE (a preset).

use std::f32::consts::{PI, TAU};
use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result};
use glam::{Quat, Vec3};
use windfall::camera::Camera;
use windfall::output::Output;
use windfall::render::{FrameInput, LeafColumns, PictureTarget, Renderer, RendererOptions, atlas_request};
use windfall_core::Scene;
use windfall_core::scene::{LeafShape, Species};
use windfall_texgen::Atlas;

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| "target/synthetic.png".into());
    let leaf_count: u32 = arguments.next().map_or(Ok(1600), |text| text.parse())?;
    let frames: u32 = arguments.next().map_or(Ok(3), |text| text.parse())?;
    let size = arguments.next().unwrap_or_else(|| "1280x720".into());
    let (width, height) = size.split_once('x').context("a size such as 1280x720")?;
    let size: (u32, u32) = (width.parse()?, height.parse()?);
    let (device, queue) = pollster::block_on(open_device())?;
    let mut scene = match std::env::var("SCENE") {
        Ok(name) => Scene::preset(&name).context("no such preset")?,
        Err(_) => three_species(),
    };
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<f32>().ok());
    if let Some(degrees) = number("SUN_AZIMUTH") {
        scene.view.sun.azimuth_deg = degrees;
    }
    if let Some(degrees) = number("SUN_ELEVATION") {
        scene.view.sun.elevation_deg = degrees;
    }
    scene.view.trail_s = number("TRAIL").unwrap_or(scene.view.trail_s);
    let made = Instant::now();
    let atlas = Atlas::generate(&atlas_request(&scene))?;
    println!("atlas made in {:.0} ms", made.elapsed().as_secs_f64() * 1e3);
    let made = Instant::now();
    let options = RendererOptions::default();
    let mut renderer = Renderer::new(&device, &queue, &scene, &atlas, PictureTarget::FORMAT, size, options)?;
    println!("renderer made in {:.0} ms", made.elapsed().as_secs_f64() * 1e3);
    let target = PictureTarget::new(&device, size)?;
    let mut camera = Camera::from(&scene.view.camera);
    camera.orbit(number("YAW").unwrap_or(0.0), number("PITCH").unwrap_or(0.0));
    camera.zoom(number("ZOOM").unwrap_or(1.0));
    let mut writer = Output::from_path(Path::new(&path))?.start(size, 60.0)?;
    for frame in 0..frames {
        let time_s = f64::from(frame) / 60.0;
        let buffers = synthetic_columns(&device, &queue, leaf_count, frame as f32 / 60.0);
        let [position, orientation, course, identity] = &buffers;
        let leaves = LeafColumns { position, orientation, course, identity, leaf_count };
        let begun = Instant::now();
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        renderer.draw(&mut encoder, &target.view(), &leaves, &FrameInput { camera, time_s });
        let picture = target.submit_and_read(&device, &queue, encoder)?;
        let spent = begun.elapsed().as_secs_f64() * 1e3;
        renderer.timings();
        println!("frame {frame}: {spent:.0} ms {:.0?}", renderer.timings());
        writer.push(&picture)?;
    }
    println!("{}", writer.finish()?.display());
    Ok(())
}

fn three_species() -> Scene {
    let shapes =
        [("maple", LeafShape::Maple, 0.10), ("beech", LeafShape::Beech, 0.06), ("oak", LeafShape::Oak, 0.08)];
    let species = shapes
        .map(|(name, shape, size_m)| Species { name: name.into(), shape, size_m, ..Species::default() })
        .to_vec();
    Scene { species, ..Scene::default() }
}

async fn open_device() -> Result<(wgpu::Device, wgpu::Queue)> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    descriptor.backends = wgpu::Backends::VULKAN;
    let instance = wgpu::Instance::new(descriptor);
    let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await?;
    println!("{}", adapter.get_info().name);
    let descriptor = wgpu::DeviceDescriptor {
        required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
        required_limits: adapter.limits(),
        ..Default::default()
    };
    Ok(adapter.request_device(&descriptor).await?)
}

fn hash(seed: u32) -> u32 {
    let state = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// Two thirds falling, turned at random, one third lying on the ground.
fn synthetic_columns(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    count: u32,
    time_s: f32,
) -> [wgpu::Buffer; 4] {
    let mut columns: [Vec<[u32; 4]>; 4] = Default::default();
    let bits = |v: [f32; 4]| v.map(f32::to_bits);
    for leaf in 0..count {
        let word = |draw: u32| hash(leaf.wrapping_mul(31).wrapping_add(draw));
        let random = |draw: u32| (word(draw) >> 8) as f32 / 16_777_216.0;
        let resting = leaf % 3 == 2;
        let species = (leaf % 3) ^ (leaf / 3 % 3);
        let place = Vec3::new(random(0) * 16.0 - 8.0, random(1) * 9.0, random(2) * 15.0 - 9.0);
        let fall = Vec3::new((time_s * 3.0 + leaf as f32).sin() * 0.3, -time_s, 0.0);
        let (place, state) = if resting { (Vec3::new(place.x, 0.0, place.z), 3) } else { (place + fall, 2) };
        let species = species.min(2);
        columns[0].push([place.x.to_bits(), place.y.to_bits(), place.z.to_bits(), state | species << 9]);
        let turn = if resting {
            Quat::from_rotation_y(random(3) * TAU)
                * Quat::from_rotation_z(if random(4) < 0.5 { 0.0 } else { PI })
        } else {
            Quat::from_euler(glam::EulerRot::YXZ, random(3) * TAU, random(4) * TAU, random(5) * TAU)
        };
        columns[1].push(bits(turn.to_array()));
        columns[2].push([0, 0, 13_107 + word(6) % 6_554, 0]);
        columns[3].push([0, 0, 0, word(7) & 0x00ff_ffff]);
    }
    columns.map(|column| {
        let bytes: &[u8] = bytemuck::cast_slice(&column);
        let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes.len().max(16) as u64,
            usage,
            mapped_at_creation: false,
        });
        queue.write_buffer(&buffer, 0, bytes);
        buffer
    })
}
