// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves in somebody else's wgpu program, which owns device, loop and shaders: the simulator runs on its device and lends
//! its buffers, from which a render pass of the program's own draws. Writes a picture, `embed.png` or the file named.
//! `cargo run --release --example embed`

use std::error::Error;

use windfall_core::{Scene, World};
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator, instance_descriptor, wgpu};

/// Width and height in pixels; rows of 256 bytes need no padding.
const SIZE: (u32, u32) = (640, 360);
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const FRAMES: u32 = 120;

/// The program's own shader. Every leaf is an instance: its place and state, its orientation, its identity.
const SHADER: &str = "
struct Seen { @builtin(position) at: vec4<f32>, @location(0) color: vec3<f32> }

fn turned(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

@vertex
fn vertex(
    @builtin(vertex_index) corner: u32,
    @location(0) place: vec3<f32>,
    @location(1) bits: u32,
    @location(2) attitude: vec4<f32>,
    @location(3) identity: vec4<u32>,
) -> Seen {
    // A blade lies in its x-z plane, its tip towards +z; drawn six times as large as it is.
    let kite = array(vec2(0.0, -0.25), vec2(-0.16, 0.0), vec2(0.16, 0.0), vec2(0.0, 0.3));
    let local = kite[corner];
    let world = place + turned(attitude, vec3(local.x, 0.0, local.y));
    // A camera 26 m away, 5 m up, that looks along -z.
    let view = world - vec3(0.0, 5.0, 26.0);
    let depth = -view.z;
    let focal = 2.2;
    var seen: Seen;
    seen.at = vec4(focal * view.x * 9.0 / 16.0, focal * view.y, depth * 0.5, depth);
    // The two lowest bits are the state; 0 has not been let go yet and is not drawn.
    if (bits & 3u) == 0u { seen.at = vec4(0.0, 0.0, 2.0, 1.0); }
    let tint = f32(identity.w & 0xffffu) / 65535.0;
    let light = 0.35 + 0.65 * abs(turned(attitude, vec3(0.0, 1.0, 0.0)).y);
    seen.color = mix(vec3(0.55, 0.10, 0.02), vec3(0.90, 0.55, 0.06), tint) * light;
    return seen;
}

@fragment
fn fragment(seen: Seen) -> @location(0) vec4<f32> {
    return vec4(seen.color, 1.0);
}
";

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "embed.png".into());
    run(FRAMES)?.save(&path)?;
    println!("{path}");
    Ok(())
}

/// The program: its device, its pipeline, its loop; returns the last frame.
pub(crate) fn run(frames: u32) -> Result<image::RgbaImage, Box<dyn Error>> {
    // The program makes its device as it likes. With `PASSTHROUGH_SHADERS` on Vulkan the leaves would move with the same
    // bits as on the processor; without, as here, they differ by rounding.
    let instance = wgpu::Instance::new(instance_descriptor());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let descriptor = wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))?;

    // The simulator borrows it.
    let gpu = Gpu::from_parts(adapter.get_info(), device.clone(), queue.clone());
    let mut scene = Scene::load("autumn-park")?;
    scene.trees.clear();
    let world = World::build(&scene)?;
    let mut simulator = WgpuSimulator::new(&gpu, &world, &WgpuOptions::default())?;

    let pipeline = pipeline(&device);
    let picture = texture(&device, FORMAT, wgpu::TextureUsages::COPY_SRC);
    let depth = texture(&device, wgpu::TextureFormat::Depth32Float, wgpu::TextureUsages::empty());
    let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
    let (picture_view, depth_view) = (view(&picture), view(&depth));
    let rows = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(SIZE.0 * SIZE.1 * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });

    for _ in 0..frames {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        // One step for each frame of the program's loop, in the program's own submission.
        simulator.encode_steps(&mut encoder, 1)?;
        draw(&mut encoder, &pipeline, &simulator, &picture_view, &depth_view);
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

/// The program's render pass: every leaf four corners, straight from the simulator's columns.
fn draw(
    encoder: &mut wgpu::CommandEncoder,
    pipeline: &wgpu::RenderPipeline,
    simulator: &WgpuSimulator,
    picture: &wgpu::TextureView,
    depth: &wgpu::TextureView,
) {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: picture,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color { r: 0.55, g: 0.68, b: 0.80, a: 1.0 }),
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(1.0),
                store: wgpu::StoreOp::Discard,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    let columns = simulator.columns().leaves;
    pass.set_pipeline(pipeline);
    pass.set_vertex_buffer(0, columns.place.slice(..));
    pass.set_vertex_buffer(1, columns.attitude.slice(..));
    pass.set_vertex_buffer(2, columns.identity.slice(..));
    pass.draw(0..4, 0..columns.leaf_count);
}

/// A pipeline that reads three of the five columns, a record for each leaf.
fn pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let place = wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32];
    let attitude = wgpu::vertex_attr_array![2 => Float32x4];
    let identity = wgpu::vertex_attr_array![3 => Uint32x4];
    let column = |attributes| {
        Some(wgpu::VertexBufferLayout {
            array_stride: 16,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes,
        })
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[column(&place), column(&attitude), column(&identity)],
        },
        primitive: wgpu::PrimitiveState {
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[Some(FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A texture of the picture's size to draw into.
fn texture(device: &wgpu::Device, format: wgpu::TextureFormat, usage: wgpu::TextureUsages) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: SIZE.0, height: SIZE.1, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}
