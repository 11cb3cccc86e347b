// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Windows of steps, for which the GPU lists the leaves that can change: whatever wakes a leaf within one, the bits are the CPU's.

use windfall_core::leaf::LeafState;
use windfall_core::{Contract, Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_tests::compare::difference;
use windfall_tests::strategies::{flying_scene, hilly_scene, varied_scene, wooded_scene};
use windfall_wgpu::{Gpu, Shaders, WgpuOptions, WgpuSimulator};

use crate::stepped::exact_adapters;

/// Steps of a window. With another number the tests still hold, but may meet less.
const WINDOW: u32 = 32;

fn build(scene: &Scene) -> World {
    World::build(scene).expect("the scene is valid")
}

/// Trees in a storm, which sheds leaves, and in a season in which they come back to their twigs.
fn stormy_wood(leaves: u32) -> World {
    let mut scene = wooded_scene(11, leaves, 16.0, 1.0 / 60.0);
    scene.regrow_after_s = Some(1.0);
    scene.trees.iter_mut().for_each(|tree| tree.leaves *= 2);
    build(&scene)
}

/// Both backends with the same world.
struct Pair {
    oracle: CpuSimulator,
    candidate: WgpuSimulator,
    world: World,
}

impl Pair {
    fn new(gpu: &Gpu, world: &World, page_leaves: Option<u32>) -> Self {
        let options = WgpuOptions { contract: Some(Contract::Exact), page_leaves, ..WgpuOptions::default() };
        Self {
            oracle: CpuSimulator::new(world, CpuOptions::default()).expect("threads start"),
            candidate: WgpuSimulator::new(gpu, world, &options).expect("the device takes the world"),
            world: world.clone(),
        }
    }

    fn both(&mut self, act: impl Fn(&mut dyn Simulator)) {
        act(&mut self.oracle);
        act(&mut self.candidate);
    }

    fn step(&mut self, count: u32) {
        self.both(|simulator| simulator.step(count).expect("it steps"));
    }

    /// The state of both.
    fn agreed(&mut self, when: &str) -> World {
        let mut states = [self.world.clone(), self.world.clone()];
        self.oracle.read_state(&mut states[0]).expect("same size");
        self.candidate.read_state(&mut states[1]).expect("same size");
        let found = difference(&states[0], &states[1]);
        assert!(found.is_none(), "{when}: {found:?}");
        let [oracle, candidate] = states;
        assert_eq!(oracle.state_hash(), candidate.state_hash(), "{when}");
        oracle
    }
}

/// Leaves of trees that come off in the middle of a window, and those of them that had come back to their twig within it.
fn let_go_within_windows(world: &World, steps: u32) -> (usize, usize) {
    let mut simulator = CpuSimulator::new(world, CpuOptions::default()).expect("threads start");
    let count = world.compiled.scene().tree_leaf_count() as usize;
    let mut state = world.clone();
    let mut came_back = vec![false; count];
    let (mut let_go, mut twice) = (0, 0);
    for step in 0..steps {
        if step % WINDOW == 0 {
            came_back.fill(false);
        }
        let before: Vec<_> = state.leaves.place[..count].iter().map(|place| place.state()).collect();
        simulator.step(1).expect("the CPU steps");
        simulator.read_state(&mut state).expect("same size");
        for (slot, before) in before.into_iter().enumerate() {
            let after = state.leaves.place[slot].state();
            came_back[slot] |= before != LeafState::Attached && after == LeafState::Attached;
            if step % WINDOW != 0 && before == LeafState::Attached && after == LeafState::Falling {
                let_go += 1;
                twice += usize::from(came_back[slot]);
            }
        }
    }
    (let_go, twice)
}

#[test]
fn petioles_that_break_within_a_window_let_their_leaves_go() {
    const STEPS: u32 = 10 * WINDOW;
    let world = stormy_wood(600);
    let (let_go, twice) = let_go_within_windows(&world, STEPS);
    assert!(let_go > 500, "{let_go} leaves come off within windows");
    assert!(twice > 10, "{twice} of them had come back within the same window");
    for gpu in exact_adapters() {
        let mut pair = Pair::new(&gpu, &world, None);
        // In the middle of a window, at its end, and windows later.
        for (count, when) in [(20, "20 steps"), (12, "a window"), (STEPS - WINDOW, "all steps")] {
            pair.step(count);
            pair.agreed(when);
        }
    }
}

#[test]
fn pages_of_trees_list_their_own_leaves() {
    let world = stormy_wood(6000);
    let trees = world.compiled.scene().tree_leaf_count() as usize;
    assert!(trees > 4096 && world.leaves.len() > 2 * 4096, "trees reach into the second page of three");
    for gpu in exact_adapters() {
        let mut pair = Pair::new(&gpu, &world, Some(4096));
        assert_eq!(pair.candidate.page_count(), 3, "pages");
        pair.step(3 * WINDOW + 5);
        pair.agreed("in pages");
    }
}

#[test]
fn portions_of_steps_change_nothing_across_the_ends_of_windows() {
    let world = build(&hilly_scene(flying_scene(5, 900, 9.0, 1.0 / 60.0)));
    for gpu in exact_adapters() {
        let mut pair = Pair::new(&gpu, &world, None);
        pair.step(3 * WINDOW);
        let expected = pair.agreed("at once").state_hash();
        for portion in [1, 7, WINDOW - 1, WINDOW + 1] {
            let mut pair = Pair::new(&gpu, &world, None);
            let mut left = 3 * WINDOW;
            while left > 0 {
                pair.candidate.step(portion.min(left)).expect("it steps");
                left -= portion.min(left);
            }
            let mut state = world.clone();
            pair.candidate.read_state(&mut state).expect("same size");
            assert_eq!(state.state_hash(), expected, "portions of {portion}");
        }
    }
}

/// A state written within a window is stepped on, though other leaves fall in it.
#[test]
fn a_state_written_within_a_window_is_listed_anew() {
    let early = build(&varied_scene(8, 3000, 4.0, 1.0 / 60.0));
    for gpu in exact_adapters() {
        let mut pair = Pair::new(&gpu, &early, None);
        pair.step(700 + 10);
        let late = pair.agreed("late");
        let falls = |world: &World, slot: usize| world.leaves.place[slot].state() == LeafState::Falling;
        let woken = (0..early.leaves.len()).filter(|&slot| falls(&early, slot) && !falls(&late, slot));
        assert!(woken.count() > 500, "leaves that lie fall again");
        pair.both(|simulator| simulator.write_state(&early).expect("same size"));
        pair.step(WINDOW / 2);
        pair.agreed("early again");
    }
}

/// An edit of the scene within a window wakes leaves that lie, and changes how many lists there are.
#[test]
fn a_scene_edited_within_a_window_is_listed_anew() {
    let calm = varied_scene(8, 3000, 1.0, 1.0 / 60.0);
    let mut still = calm.clone();
    still.wind.vortices.clear();
    let stormy = varied_scene(8, 3000, 25.0, 1.0 / 60.0);
    // In finer steps a leaf lies down in more of them.
    let fine = varied_scene(8, 3000, 1.0, 1.0 / 240.0);
    let [still, stormy, fine] = [still, stormy, fine].map(|scene| build(&scene));
    let turns = |world: &World| world.compiled.block().wind.interval_steps;
    assert!(turns(&still) != turns(&stormy), "{} and {} turns", turns(&still), turns(&stormy));
    for gpu in exact_adapters() {
        let mut pair = Pair::new(&gpu, &still, None);
        pair.step(400 + 5);
        for (scene, name) in [(&stormy, "storm"), (&fine, "fine steps"), (&still, "still air")] {
            let before = pair.agreed(name);
            let lying = |world: &World| {
                let settled = scene.compiled.block().settle_steps;
                let is_lying = |slot: usize| world.leaves.place[slot].state() == LeafState::Resting;
                (0..world.leaves.len())
                    .filter(|&slot| is_lying(slot) && world.leaves.drift[slot].phase < settled)
                    .count()
            };
            assert!(name != "fine steps" || lying(&before) > 100, "leaves that lie are woken");
            pair.both(|simulator| simulator.set_scene(&scene.compiled).expect("same sizes"));
            pair.step(WINDOW / 2 + 3);
            pair.agreed(name);
        }
    }
}

/// Mutation test: each line of the lists that is changed shows within a few windows.
#[test]
fn a_changed_list_is_noticed() {
    const STEPS: u32 = 6 * WINDOW;
    let edits = [
        ("kernels/list_active", "select(WINDOW_STEPS,", "select(WINDOW_STEPS / 2u,"),
        ("kernels/list_active", "state == STATE_FALLING ||", "false ||"),
        ("kernels/list_active", "&& leaf_is_settling(leaf)", "&& false"),
        ("kernels/list_active", "select(0u, 1u, is_active)", "0u"),
        ("kernels/carry", "schedules[leaf].event == step_block.index + 1u", "false"),
        ("lists/append_active", "active_list.leaves[mark] == 0u", "true"),
        ("lists/append_active", "list_start(turn) + place", "place"),
        ("lists/append_active", "count_groups(place + 1u);", ""),
    ];
    let world = stormy_wood(600);
    let mut oracle = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    oracle.step(STEPS).expect("the CPU steps");
    let mut expected = world.clone();
    oracle.read_state(&mut expected).expect("same size");
    for (module, old, new) in edits {
        let Some(gpu) = exact_adapters().pop() else { return };
        let shaders = Shaders::default().edited(module, old, new).expect("the edited text is there");
        let options = WgpuOptions { shaders: Some(shaders), ..WgpuOptions::default() };
        let mut candidate = WgpuSimulator::new(&gpu, &world, &options).expect("the device takes the world");
        candidate.step(STEPS).expect("it steps");
        let mut found = world.clone();
        candidate.read_state(&mut found).expect("same size");
        assert_ne!(expected.state_hash(), found.state_hash(), "nobody noticed '{new}' in {module}");
    }
}
