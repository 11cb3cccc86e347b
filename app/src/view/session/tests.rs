// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0

use super::*;
use windfall_core::scene::{MeanSpeed, Profile};

fn session(kind: BackendKind) -> Session {
    let mut scene = Scene::preset("autumn-park").expect("a preset");
    scene = scene.with_leaf_count("autumn-park", 500).expect("allowed");
    let gpu = Gpu::request(None).expect("an adapter; apt install mesa-vulkan-drivers");
    let device = match kind {
        BackendKind::Cpu => Device::Cpu(CpuOptions::default()),
        BackendKind::Wgpu => Device::Wgpu(Box::new(gpu.clone())),
    };
    let world = World::build(&scene).expect("valid");
    Session::new(scene, &world, &device, gpu).expect("the device takes it")
}

fn hash(session: &mut Session) -> u64 {
    session.world().expect("readable").state_hash()
}

/// The session's scene in a stronger wind, with leaves that fall faster.
fn windier(session: &Session) -> Arc<Scene> {
    let mut scene = Scene::clone(session.scene());
    scene.wind.speed = MeanSpeed::MetresPerSecond(6.0);
    scene.wind.profile = Profile::Uniform;
    scene.fall_speed = 1.3;
    scene.validate("windier").expect("allowed");
    Arc::new(scene)
}

/// The session's scene with another mean wind.
fn in_wind(session: &Session, m_s: f32) -> Arc<Scene> {
    let mut scene = Scene::clone(session.scene());
    scene.wind.speed = MeanSpeed::MetresPerSecond(m_s);
    Arc::new(scene)
}

#[test]
fn leaves_go_on_falling_when_the_backend_changes() {
    let mut plain = session(BackendKind::Cpu);
    let mut switched = session(BackendKind::Wgpu);
    for session in [&mut plain, &mut switched] {
        session.step(20).expect("it steps");
        session.take_over(windier(session), true).expect("allowed");
        session.step(20).expect("it steps");
    }
    let before = hash(&mut switched);
    switched.switch(BackendKind::Cpu).expect("the processor takes it");
    assert_eq!((switched.kind(), hash(&mut switched)), (BackendKind::Cpu, before), "not a bit is lost");
    switched.step(20).expect("it steps");
    switched.switch(BackendKind::Wgpu).expect("the device takes it");
    switched.step(20).expect("it steps");
    plain.step(40).expect("it steps");
    assert_eq!(hash(&mut plain), hash(&mut switched), "the wind is kept as well");
}

#[test]
fn what_is_only_looked_at_leaves_the_simulation_alone() {
    let mut plain = session(BackendKind::Cpu);
    let mut other = session(BackendKind::Cpu);
    let mut scene = Scene::clone(other.scene());
    scene.view.sun.elevation_deg = 5.0;
    other.take_over(Arc::new(scene), false).expect("allowed");
    for session in [&mut plain, &mut other] {
        session.step(20).expect("it steps");
    }
    assert_eq!(hash(&mut plain), hash(&mut other), "not a bit differs");
}

#[test]
fn another_world_begins_again_with_what_was_tuned() {
    let mut session = session(BackendKind::Wgpu);
    session.take_over(windier(&session), true).expect("allowed");
    session.step(5).expect("it steps");
    let scene = Arc::new(session.scene().with_leaf_count("autumn-park", 900).expect("allowed"));
    let world = World::build(&scene).expect("valid");
    let simulator = session.simulator_of(&world).expect("the device takes it");
    session.begin(Arc::clone(&scene), &world, simulator).expect("it begins");
    assert_eq!((session.leaf_count(), session.simulator().clock().step()), (900, 0), "anew");
    assert_eq!(session.scene().wind.speed, MeanSpeed::MetresPerSecond(6.0), "with the same wind");
    assert_eq!(session.stats().expect("counts").leaves.dormant, 0, "counted anew");
    session.step(5).expect("it steps");
    session.reset().expect("begins again");
    assert_eq!(session.simulator().clock().step(), 0, "at time zero");
}

/// Goes to a step, however many frames it takes.
fn go_to(session: &mut Session, step: u32) -> u64 {
    session.seek(step);
    while session.is_seeking() {
        session.pursue().expect("it steps");
    }
    assert_eq!(session.simulator().clock().step(), step, "arrived");
    hash(session)
}

#[test]
fn every_step_comes_back_with_the_same_bits() {
    for (kind, steps) in [
        (BackendKind::Cpu, [90, 12, 49, 69, 50, 51, 99, 0].as_slice()),
        (BackendKind::Wgpu, [49, 51, 0].as_slice()),
    ] {
        let mut straight = session(kind);
        let mut hashes = vec![0; 100];
        for step in 0..100 {
            if step == 50 {
                straight.take_over(in_wind(&straight, 7.0), true).expect("allowed");
            }
            if steps.contains(&step) || [30, 80].contains(&step) {
                hashes[step as usize] = hash(&mut straight);
            }
            straight.step(1).expect("it steps");
        }
        // The way there goes in strides that no change respects.
        let mut scrubbed = session(kind);
        scrubbed.step(50).expect("it steps");
        scrubbed.take_over(in_wind(&scrubbed, 7.0), true).expect("allowed");
        scrubbed.step(50).expect("it steps");
        for &step in steps {
            assert_eq!(go_to(&mut scrubbed, step), hashes[step as usize], "{kind:?}, step {step}");
            let is_tuned = scrubbed.scene().wind.speed == MeanSpeed::MetresPerSecond(7.0);
            assert_eq!(is_tuned, step >= 50, "the panel shows the wind of step {step}");
        }
        assert_eq!(go_to(&mut scrubbed, 30), hashes[30], "{kind:?}: on the way");
        scrubbed.step(50).expect("it steps");
        assert_eq!(hash(&mut scrubbed), hashes[80], "{kind:?}: the wind changes again when time goes on");
        go_to(&mut scrubbed, 30);
        scrubbed.take_over(in_wind(&scrubbed, 7.0), true).expect("allowed");
        assert_eq!(scrubbed.timeline().range, (0, 30), "{kind:?}: another wind is another future");
        assert_eq!(go_to(&mut scrubbed, 0), hashes[0], "{kind:?}: the past is still there");
    }
}

#[test]
fn moments_are_kept_along_the_way() {
    let mut session = session(BackendKind::Cpu);
    for _ in 0..12 {
        session.step(40).expect("it steps");
        std::thread::sleep(Duration::from_millis(2));
    }
    let before = hash(&mut session);
    let Timeline { range, kept, .. } = session.timeline();
    assert_eq!(range, (0, 480), "all of it can be reached");
    assert!(kept.len() >= 3 && kept.is_sorted() && kept[0] == 0, "moments are kept: {kept:?}");
    go_to(&mut session, 475);
    assert_eq!(go_to(&mut session, 9999.min(range.1)), before, "there and back");
}

#[test]
fn both_backends_stay_together_through_everything() {
    let mut session = session(BackendKind::Cpu);
    session.step(7).expect("it steps");
    session.set_comparing(true).expect("the device takes it");
    session.step(20).expect("it steps");
    session.take_over(in_wind(&session, 6.0), true).expect("allowed");
    session.step(20).expect("it steps");
    go_to(&mut session, 12);
    session.switch(BackendKind::Wgpu).expect("the device takes it");
    session.step(20).expect("it steps");
    let found = session.difference().expect("both are readable").expect("they are compared");
    assert_eq!((found.step, found.is_equal), (32, true), "the same bits: {found:?}");
    // What one backend alone is changed by, the other does not know.
    session.twin = None;
    session.set_comparing(true).expect("the processor takes it");
    session.backend.step(1).expect("it steps");
    let found = session.difference().expect("both are readable").expect("they are compared");
    assert!(!found.is_equal && found.farthest_m > 0.0, "a step apart: {found:?}");
    session.set_comparing(false).expect("nothing to do");
    assert_eq!(session.difference().expect("nothing to ask"), None, "no longer compared");
}
