// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Interface for programs with a wgpu loop of their own: steps in their encoders, and readings that do not wait.

use windfall_core::{Simulator, World};
use windfall_tests::adapter;
use windfall_tests::compare::difference;
use windfall_tests::strategies::{flying_scene, wooded_scene};
use windfall_wgpu::{Gpu, Shaders, WgpuOptions, WgpuSimulator, leaf_wgsl, wgpu};

/// Trees, leaves on them, and bodies.
fn world() -> World {
    World::build(&flying_scene(12, 700, 5.0, 1.0 / 60.0)).expect("the flying scene is valid")
}

fn simulator(gpu: &Gpu, world: &World) -> WgpuSimulator {
    WgpuSimulator::new(gpu, world, &WgpuOptions::default()).expect("the device takes it")
}

fn encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
}

fn state(simulator: &mut WgpuSimulator, like: &World) -> World {
    let mut state = like.clone();
    simulator.read_state(&mut state).expect("the same size");
    state
}

#[test]
fn encoded_steps_are_steps_to_the_bit() {
    let world = world();
    for gpu in adapter::all() {
        let mut plain = simulator(&gpu, &world);
        let mut encoded = simulator(&gpu, &world);
        plain.step(1 + 40 + 2 + 3 + 5).expect("it steps");
        // Several calls in one encoder, more steps than a pass holds, encoders that are submitted together, and steps that
        // are submitted by the simulator itself in between.
        let mut first = encoder(&gpu);
        encoded.encode_steps(&mut first, 1).expect("encoded");
        encoded.encode_steps(&mut first, 40).expect("encoded");
        encoded.encode_steps(&mut first, 0).expect("nothing to do");
        gpu.queue().submit([first.finish()]);
        encoded.step(2).expect("it steps");
        let (mut second, mut third) = (encoder(&gpu), encoder(&gpu));
        encoded.encode_steps(&mut second, 3).expect("encoded");
        encoded.encode_steps(&mut third, 5).expect("encoded");
        gpu.queue().submit([second.finish(), third.finish()]);
        let (expected, found) = (state(&mut plain, &world), state(&mut encoded, &world));
        assert_eq!(found.clock, expected.clock, "clocks");
        let apart = difference(&expected, &found);
        assert!(apart.is_none(), "{}: {apart:?}", gpu.info().name);
        assert_eq!(found.state_hash(), expected.state_hash(), "{}", gpu.info().name);
    }
}

#[test]
fn readings_that_do_not_wait_equal_those_that_do() {
    let world = world();
    for gpu in adapter::all() {
        let mut simulator = simulator(&gpu, &world);
        simulator.step(30).expect("it steps");
        let (expected, counts) = (state(&mut simulator, &world), simulator.stats().expect("counted"));
        let asked = (simulator.request_state().expect("asked"), simulator.request_stats().expect("asked"));
        // Later steps do not change what was asked for.
        simulator.step(5).expect("it steps");
        let mut found = world.clone();
        let mut frames = 0;
        let found_counts = loop {
            let is_there = asked.0.poll(&mut found).expect("not lost");
            match asked.1.poll().expect("not lost") {
                Some(counts) if is_there => break counts,
                _ => frames += 1,
            }
            assert!(frames < 100_000, "it arrives some time");
            std::thread::sleep(std::time::Duration::from_micros(100));
        };
        assert_eq!(found.state_hash(), expected.state_hash(), "{}", gpu.info().name);
        assert!(difference(&expected, &found).is_none(), "{}", gpu.info().name);
        assert_eq!((found_counts, found.clock), (counts, expected.clock), "{}", gpu.info().name);
        let mut other = World::build(&wooded_scene(3, 50, 1.0, 1.0 / 60.0)).expect("valid");
        assert!(asked.0.poll(&mut other).is_err(), "a world of another size");
        // One after another they do not disturb each other.
        let both = [simulator.request_stats().expect("asked"), simulator.request_stats().expect("asked")];
        let last = simulator.stats().expect("counted");
        for request in both {
            assert_eq!(request.poll().expect("not lost"), Some(last), "the wait has brought all of them");
        }
    }
}

/// The text for shaders of others stands by itself, and its records have the bytes of the columns.
#[test]
fn the_text_for_other_shaders_is_whole() {
    let text = leaf_wgsl();
    let module =
        naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)));
    let flags = naga::valid::ValidationFlags::all();
    let valid = naga::valid::Validator::new(flags, naga::valid::Capabilities::all()).validate(&module);
    assert!(valid.is_ok(), "{valid:?}");
    // Nobody draws the air that a leaf meets.
    for column in windfall_core::leaf::Leaves::COLUMNS.iter().filter(|column| column.name != "air") {
        let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(column.record));
        let Some((_, naga::Type { inner: naga::TypeInner::Struct { members, span }, .. })) = found else {
            panic!("no struct {}", column.record);
        };
        assert_eq!(*span as usize, column.record_bytes, "bytes of {}", column.record);
        let names: Vec<_> = members.iter().filter_map(|member| member.name.as_deref()).collect();
        assert_eq!(
            names,
            column.fields.iter().map(|field| field.name).collect::<Vec<_>>(),
            "{}",
            column.record
        );
    }
    let accessors = Shaders::default().text("leaf/record").map(|text| text.matches("\nfn ").count());
    assert_eq!(Some(module.functions.len()), accessors, "every accessor");
    assert!(module.global_variables.is_empty(), "no bindings");
}
