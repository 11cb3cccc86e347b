// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A whole scene (trees, meadow, sky, leaves) in somebody else's wgpu program, which owns device, loop, encoder and texture.
//! Writes a picture, `draw_scene.png` or the file named. `cargo run --release -p windfall-render --example draw_scene`

use std::error::Error;

use windfall_core::{Scene, World};
use windfall_render::camera::Camera;
use windfall_render::trees::SceneTrees;
use windfall_render::{FrameInput, LensMoment, RenderScene, Renderer, RendererOptions};
use windfall_texgen::{Assortment, Atlas, Layer, Shape, TexgenError};
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator, instance_descriptor, wgpu};

/// Width and height in pixels; rows of 256 bytes need no padding.
const SIZE: (u32, u32) = (640, 360);
/// Format of the program's texture: the renderer draws into any that can be drawn to.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const FRAMES: u32 = 60;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "draw_scene.png".into());
    run(FRAMES)?.save(&path)?;
    println!("{path}");
    Ok(())
}

/// The program: its device, its texture, its loop; returns the last frame.
pub(crate) fn run(frames: u32) -> Result<image::RgbaImage, Box<dyn Error>> {
    // The program makes its device and its texture as it likes.
    let instance = wgpu::Instance::new(instance_descriptor());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let descriptor = wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))?;
    let picture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("the program's picture"),
        size: wgpu::Extent3d { width: SIZE.0, height: SIZE.1, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = picture.create_view(&wgpu::TextureViewDescriptor::default());

    // A simulator and a renderer of the same scene, both on the program's device.
    let scene = Scene::load("autumn-park")?;
    let world = World::build(&scene)?;
    let gpu = Gpu::from_parts(adapter.get_info(), device.clone(), queue.clone());
    let mut simulator = WgpuSimulator::new(&gpu, &world, &WgpuOptions::default())?;
    let (trees, atlas) = (SceneTrees::of(&scene, world.compiled.forest()), leaf_pictures(&scene)?);
    let subject = RenderScene {
        scene: &scene,
        solids: world.compiled.solids(),
        burns: &world.compiled.block().burns,
        snow: None,
        trees: &trees,
        atlas: &atlas,
    };
    let options = RendererOptions::for_scene(&scene);
    let mut renderer = Renderer::new(&device, &queue, subject, FORMAT, SIZE, options)?;

    let rows = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(SIZE.0 * SIZE.1 * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    for frame in 1..=frames {
        // A step and a frame in the program's own submission, among whatever else it does.
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        simulator.encode_steps(&mut encoder, 1)?;
        let input = FrameInput {
            camera: Camera::from(&scene.view.camera),
            time_s: f64::from(frame) * f64::from(scene.dt_s),
            moment: LensMoment::of_frame(frame - 1, scene.dt_s.into()),
            origin: (0, 0),
        };
        renderer.draw(&mut encoder, &view, &simulator.columns(), &input);
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(SIZE.0 * 4), rows_per_image: None };
        let to = wgpu::TexelCopyBufferInfo { buffer: &rows, layout };
        encoder.copy_texture_to_buffer(picture.as_image_copy(), to, picture.size());
        queue.submit([encoder.finish()]);
    }
    let mut pixels = vec![0; (SIZE.0 * SIZE.1 * 4) as usize];
    gpu.read(&rows, &mut pixels)?;
    image::RgbaImage::from_raw(SIZE.0, SIZE.1, pixels).ok_or_else(|| "fewer bytes than pixels".into())
}

/// Pictures and meshes of leaves for every species, here small maples for all of them. They may as well come from a folder
/// (`LeafFolder`).
fn leaf_pictures(scene: &Scene) -> Result<Atlas, TexgenError> {
    const SIZE_PX: u32 = 128;
    const VARIANTS: u32 = 2;
    let mut layers = Vec::new();
    for species in &scene.species {
        let assortment = Assortment {
            shape: Shape::Maple,
            season: species.season,
            count: VARIANTS,
            size_px: SIZE_PX,
            seed: 1,
        };
        layers.extend(assortment.make(|| {})?.leaves.iter().map(|leaf| Layer::of_leaf(leaf, SIZE_PX)));
    }
    Ok(Atlas { size_px: SIZE_PX, variants: VARIANTS, layers })
}
