// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0

use windfall_core::Scene;
use windfall_core::leaf::Leaves;
use windfall_core::store::Store;

use super::*;

#[test]
fn options_imply_their_backend_or_contradict_it() {
    let kind = |backend, adapter: Option<&str>, threads| {
        BackendArguments { backend, adapter: adapter.map(str::to_owned), threads }.kind().ok()
    };
    let (cpu, wgpu) = (Some(BackendKind::Cpu), Some(BackendKind::Wgpu));
    assert_eq!(kind(None, None, None), Some(None), "left open");
    assert_eq!(kind(cpu, None, Some(2)), Some(cpu), "asked for");
    assert_eq!(kind(None, Some("a"), None), Some(wgpu), "implied by an adapter");
    assert_eq!(kind(None, None, Some(1)), Some(cpu), "implied by threads");
    assert_eq!(kind(cpu, Some("a"), None), None, "the processor is no adapter");
    assert_eq!(kind(wgpu, None, Some(1)), None, "an adapter has no threads of ours");
    assert_eq!(kind(None, Some("a"), Some(1)), None, "one or the other");
}

/// The bytes of a buffer.
fn read(gpu: &Gpu, buffer: &wgpu::Buffer) -> Vec<u8> {
    let staging = gpu.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: buffer.size(),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
    gpu.queue().submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |result| result.expect("mapped"));
    gpu.wait().expect("the device is there");
    staging.get_mapped_range(..).expect("mapped").to_vec()
}

#[test]
fn both_backends_lend_the_same_columns() {
    let world = World::build(&Scene::preset("six-motions").expect("a preset")).expect("valid");
    let gpu = Gpu::request(None).expect("a graphics adapter; software Vulkan will do");
    let mut now = world.clone();
    for device in [
        Device::Cpu(CpuOptions { threads: Some(1), ..CpuOptions::default() }),
        Device::Wgpu(Box::new(gpu.clone())),
    ] {
        let mut backend = device.simulator(&world).expect("six leaves fit");
        for _ in 0..2 {
            backend.step(30).expect("it steps");
            backend.read_state(&mut now).expect("readable");
            let columns = backend.columns(&gpu).expect("six leaves fit").leaves;
            assert_eq!(columns.leaf_count, 6, "all leaves");
            let buffers =
                [columns.place, columns.drift, columns.attitude, columns.schedule, columns.identity];
            let drawn =
                Leaves::COLUMNS.iter().zip(now.leaves.columns()).filter(|(column, _)| column.name != "air");
            for (buffer, (_, column)) in buffers.into_iter().zip(drawn) {
                assert_eq!(read(&gpu, buffer), column, "{device}: what is drawn is what is simulated");
            }
        }
    }
}

#[test]
fn the_mirror_is_renewed_only_after_a_change() {
    let world = World::build(&Scene::preset("six-motions").expect("a preset")).expect("valid");
    let gpu = Gpu::request(None).expect("a graphics adapter; software Vulkan will do");
    let mut backend = Device::Cpu(CpuOptions::default()).simulator(&world).expect("a simulator");
    let is_current = |backend: &Backend| match backend {
        Backend::Cpu(cpu) => cpu.is_current,
        Backend::Wgpu(_) => panic!("made on the processor"),
    };
    assert!(!is_current(&backend), "nothing is drawn yet");
    backend.columns(&gpu).expect("six leaves fit");
    backend.sync().expect("nothing to wait for");
    assert!(is_current(&backend), "uploaded, and as it was");
    backend.step(1).expect("it steps");
    assert!(!is_current(&backend), "old again");
}
