// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves in somebody else's wgpu program, which owns device, loop and shaders: the simulator runs on its device and lends
//! its buffers, from which a render pass of the program's own draws. Writes a picture, `embed.png` or the file named.
//! `cargo run --release --example embed`

use std::error::Error;

use windfall_core::{Scene, World};
use windfall_wgpu::{Gpu, WgpuOptions, WgpuSimulator, instance_descriptor, leaf_wgsl, wgpu};

/// Width and height in pixels; rows of 256 bytes need no padding.
const SIZE: (u32, u32) = (640, 360);
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const FRAMES: u32 = 120;

/// The program's own shader, behind the text of `leaf_wgsl`. Every leaf is an instance: its place and state, its orientation,
/// its identity.
const SHADER: &str = "
@group(0) @binding(0) var<storage, read> places: array<Place>;
@group(0) @binding(1) var<storage, read> attitudes: array<Attitude>;
@group(0) @binding(2) var<storage, read> identities: array<Identity>;

struct Seen { @builtin(position) at: vec4<f32>, @location(0) color: vec3<f32> }

fn turned(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

@vertex
fn vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) leaf: u32) -> Seen {
    let place = places[leaf];
    let attitude = attitudes[leaf].quaternion;
    // A blade lies in its x-z plane, its tip towards +z; drawn six times as large as it is.
    let kite = array(vec2(0.0, -0.25), vec2(-0.16, 0.0), vec2(0.16, 0.0), vec2(0.0, 0.3));
    let local = kite[corner];
    let world = place.position + turned(attitude, vec3(local.x, 0.0, local.y));
    // A camera 26 m away, 5 m up, that looks along -z.
    let view = world - vec3(0.0, 5.0, 26.0);
    let depth = -view.z;
    let focal = 2.2;
    var seen: Seen;
    seen.at = vec4(focal * view.x * 9.0 / 16.0, focal * view.y, depth * 0.5, depth);
    // What has not been let go yet is not drawn.
    if leaf_state(place.bits) == STATE_DORMANT { seen.at = vec4(0.0, 0.0, 2.0, 1.0); }
    let tint = f32(leaf_tint(identities[leaf].appearance)) / 65535.0;
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
    // Growing the trees of a park takes seconds; falling leaves alone need none of them.
    scene.trees.clear();
    let world = World::build(&scene)?;
    let mut simulator = WgpuSimulator::new(&gpu, &world, &WgpuOptions::default())?;

    let pipeline = pipeline(&device);
    let columns = columns(&device, &pipeline, &simulator);
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
        draw(&mut encoder, &pipeline, &columns, scene.leaf_count(), &picture_view, &depth_view);
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
    columns: &wgpu::BindGroup,
    leaf_count: u32,
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
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, columns, &[]);
    pass.draw(0..4, 0..leaf_count);
}

/// Three of the simulator's five columns, as the shader binds them.
fn columns(
    device: &wgpu::Device,
    pipeline: &wgpu::RenderPipeline,
    simulator: &WgpuSimulator,
) -> wgpu::BindGroup {
    let leaves = simulator.columns().leaves;
    let bound = [leaves.place, leaves.attitude, leaves.identity];
    let entries: Vec<_> = (0..)
        .zip(bound)
        .map(|(binding, column)| wgpu::BindGroupEntry { binding, resource: column.as_entire_binding() })
        .collect();
    let layout = pipeline.get_bind_group_layout(0);
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries })
}

/// A pipeline that reads a record of each column for each leaf.
fn pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl((leaf_wgsl() + SHADER).into()),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
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
