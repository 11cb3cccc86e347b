// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trouble with devices: errors, never panics.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use windfall_core::{CompiledScene, SimError, Simulator, World};
use windfall_tests::adapter;
use windfall_tests::strategies::{varied_scene, wooded_scene};
use windfall_wgpu::{Gpu, Shaders, WgpuOptions, WgpuSimulator, instance_descriptor, list_adapters, wgpu};

#[test]
fn a_lost_device_is_an_error() {
    let world = World::build(&varied_scene(1, 100, 2.0, 1.0 / 60.0)).expect("valid");
    for gpu in adapter::own() {
        let mut simulator =
            WgpuSimulator::new(&gpu, &world, &WgpuOptions::default()).expect("the device takes it");
        simulator.step(3).expect("it steps");
        simulator.sync().expect("it waits");
        gpu.device().destroy();
        let mut result = world.clone();
        let outcome = simulator.step(3).and_then(|()| simulator.read_state(&mut result));
        assert!(
            matches!(outcome, Err(SimError::DeviceLost { .. } | SimError::Device { .. })),
            "{}: {outcome:?}",
            gpu.info().name
        );
    }
}

/// More than a device can hold is refused with what is needed and what it allows.
#[test]
fn more_than_the_device_holds_is_refused_with_need_and_room() {
    let world = World::build(&varied_scene(1, 20_000, 2.0, 1.0 / 60.0)).expect("valid");
    let instance = wgpu::Instance::new(instance_descriptor());
    let adapter = list_adapters(&instance).remove(0);
    let allowed = 256 << 10;
    let required_limits = wgpu::Limits {
        max_buffer_size: allowed,
        max_storage_buffer_binding_size: allowed,
        max_uniform_buffer_binding_size: 16 << 10,
        ..adapter.limits()
    };
    let descriptor = wgpu::DeviceDescriptor { required_limits, ..Default::default() };
    let (device, queue) =
        pollster::block_on(adapter.request_device(&descriptor)).expect("the adapter gives a device");
    let gpu = Gpu::from_parts(adapter.get_info(), device, queue);
    let refused =
        WgpuSimulator::new(&gpu, &world, &WgpuOptions::default()).expect_err("20000 leaves of 16 bytes");
    let SimError::Capacity { rows, needed, allowed: most, .. } = &refused else { panic!("{refused}") };
    assert!(*rows == 20_000 && *needed >= 320_000 && *most == allowed, "{refused}");
    let line = refused.to_string();
    assert!(line.contains(&needed.to_string()) && line.contains(&allowed.to_string()), "{line}");
}

#[test]
fn an_unknown_adapter_is_an_error_that_names_what_is_there() {
    let Err(SimError::NoAdapter { reason }) = Gpu::request(Some("no such adapter")) else {
        panic!("an adapter of that name?");
    };
    assert!(reason.contains("no such adapter"), "{reason}");
    let name = adapter::all()[0].info().name.clone();
    assert!(reason.contains(&name), "{reason} does not name {name}");
}

#[test]
fn a_world_of_another_size_is_refused() {
    let small = World::build(&varied_scene(1, 100, 2.0, 1.0 / 60.0)).expect("valid");
    let mut large = World::build(&varied_scene(1, 200, 2.0, 1.0 / 60.0)).expect("valid");
    for gpu in adapter::all() {
        let mut simulator =
            WgpuSimulator::new(&gpu, &small, &WgpuOptions::default()).expect("the device takes it");
        assert!(matches!(simulator.write_state(&large), Err(SimError::Size { .. })), "write");
        assert!(matches!(simulator.read_state(&mut large), Err(SimError::Size { .. })), "read");
    }
}

/// Setting another wind between steps means the same on both backends.
#[test]
fn a_new_scene_takes_effect_alike() {
    let mut world = World::build(&varied_scene(9, 1000, 2.0, 1.0 / 60.0)).expect("valid");
    for gpu in adapter::all() {
        let mut candidate =
            WgpuSimulator::new(&gpu, &world, &WgpuOptions::default()).expect("the device takes it");
        let mut oracle = windfall_cpu::CpuSimulator::new(&world, windfall_cpu::CpuOptions::default())
            .expect("threads start");
        let mut scene = world.compiled.scene().clone();
        scene.wind.direction_deg = 200.0;
        scene.wind.speed = windfall_core::scene::MeanSpeed::MetresPerSecond(9.0);
        scene.wind.profile = windfall_core::scene::Profile::Uniform;
        scene.fall_speed = 1.7;
        let mut compiled = world.compiled.clone();
        compiled.retune(&scene);
        let mut hashes = Vec::new();
        for simulator in [&mut candidate as &mut dyn Simulator, &mut oracle] {
            simulator.step(50).expect("it steps");
            simulator.set_scene(&compiled).expect("it is set");
            simulator.step(50).expect("it steps");
            simulator.read_state(&mut world).expect("same size");
            hashes.push(world.state_hash());
        }
        assert_eq!(hashes[0], hashes[1], "{}", gpu.info().name);
        world = World::build(&varied_scene(9, 1000, 2.0, 1.0 / 60.0)).expect("valid");
    }
}

/// Trees go on as they stand when a scene is compiled anew, and other trees are refused.
#[test]
fn trees_stand_through_a_new_scene() {
    let scene = wooded_scene(3, 300, 9.0, 1.0 / 60.0);
    let mut world = World::build(&scene).expect("valid");
    let mut windy = scene.clone();
    windy.wind.speed = windfall_core::scene::MeanSpeed::MetresPerSecond(15.0);
    let anew = CompiledScene::compile(&windy).expect("valid");
    let mut other = scene.clone();
    other.trees[0].age = 0.4;
    let other = CompiledScene::compile(&other).expect("valid");
    assert_eq!(other.scene().leaf_count(), world.compiled.scene().leaf_count());
    assert_ne!(other.forest().len(), world.compiled.forest().len());
    for gpu in adapter::all() {
        let mut candidate =
            WgpuSimulator::new(&gpu, &world, &WgpuOptions::default()).expect("the device takes it");
        let mut oracle = windfall_cpu::CpuSimulator::new(&world, windfall_cpu::CpuOptions::default())
            .expect("threads start");
        let mut hashes = Vec::new();
        for simulator in [&mut candidate as &mut dyn Simulator, &mut oracle] {
            simulator.step(40).expect("it steps");
            simulator.set_scene(&anew).expect("it is set");
            simulator.step(40).expect("it steps");
            let refused = simulator.set_scene(&other);
            assert!(matches!(refused, Err(SimError::Size { store: "segments", .. })), "{refused:?}");
            let mut after = world.clone();
            simulator.read_state(&mut after).expect("same size");
            hashes.push(after.state_hash());
        }
        assert_eq!(hashes[0], hashes[1], "{}", gpu.info().name);
        world = World::build(&scene).expect("valid");
    }
}

/// A device of another program, with callbacks of its own: errors that it caught, and losses.
fn foreign() -> (Gpu, Arc<AtomicUsize>, Arc<AtomicUsize>) {
    let instance = wgpu::Instance::new(instance_descriptor());
    let adapter = list_adapters(&instance).remove(0);
    let descriptor = wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() };
    let (device, queue) =
        pollster::block_on(adapter.request_device(&descriptor)).expect("the adapter gives a device");
    let (errors, losses) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
    let (caught, lost) = (Arc::clone(&errors), Arc::clone(&losses));
    device.on_uncaptured_error(Arc::new(move |_: wgpu::Error| {
        caught.fetch_add(1, Ordering::Relaxed);
    }));
    device.set_device_lost_callback(move |_, _| {
        lost.fetch_add(1, Ordering::Relaxed);
    });
    (Gpu::from_parts(adapter.get_info(), device, queue), errors, losses)
}

#[test]
fn the_callbacks_of_another_program_stay_its_own() {
    let world = World::build(&wooded_scene(1, 100, 2.0, 1.0 / 60.0)).expect("valid");
    let (gpu, errors, losses) = foreign();
    let mut simulator =
        WgpuSimulator::new(&gpu, &world, &WgpuOptions::default()).expect("the device takes it");
    simulator.step(3).expect("it steps");
    // A mistake of the program is the program's to hear of.
    let _ = gpu.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::MAX,
        usage: wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    });
    assert_eq!(errors.load(Ordering::Relaxed), 1, "the program's handler");
    simulator.step(1).expect("the simulator goes on");
    simulator.sync().expect("and waits");
    // A mistake of ours is not.
    let shaders = Shaders::default().edited("kernels/measure", "fn measure(", "fn measure() {} fn other(");
    let options = WgpuOptions { shaders: Some(shaders.expect("it is there")), ..WgpuOptions::default() };
    let broken = foreign().0;
    let refused = WgpuSimulator::new(&broken, &world, &options);
    assert!(matches!(refused, Err(SimError::Device { .. })), "{refused:?}");
    assert_eq!(errors.load(Ordering::Relaxed), 1, "nothing more");
    // The loss of the device both hear of.
    gpu.device().destroy();
    let mut result = world.clone();
    let outcome = simulator.step(1).and_then(|()| simulator.read_state(&mut result));
    assert!(matches!(outcome, Err(SimError::DeviceLost { .. })), "{outcome:?}");
    let _ = gpu.device().poll(wgpu::PollType::Poll);
    assert_eq!(losses.load(Ordering::Relaxed), 1, "the program's callback");
}
