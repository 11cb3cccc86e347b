// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 1: every device function gives the same results in Rust and in WGSL.

use std::cell::RefCell;

use glam::{Vec2, Vec3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use windfall_core::device::leaf::burn::fire_words;
use windfall_core::scene::{Burning, Litter, Plume, VortexProfile};
use windfall_core::{Contract, Scene, World};
use windfall_tests::adapter;
use windfall_tests::functions::{self, Function};
use windfall_tests::mutation::two_at_a_time;
use windfall_tests::runner::{FunctionRunner, Words, carriers_of};
use windfall_tests::strategies::{
    cases, flying_scene, hilly_scene, jet, obstructed_scene, particle_scene, plume, winding_scene,
};
use windfall_wgpu::{Gpu, Shaders};

/// Cases in one dispatch; not a multiple of the workgroup size.
const CASES: usize = 1234;
/// Dispatches for each function.
const ROUNDS: u32 = 6;

/// A bed of several layers.
fn bed() -> Litter {
    Litter { size_m: Vec2::splat(12.0), leaf_area_index: 3.0, adhesion_n_m2: 0.5, ..Litter::default() }
}

/// Populations of particles, for the functions that read one.
fn add_particles(scene: &mut Scene) {
    let with = particle_scene(7, 4.0, 1.0 / 60.0);
    (scene.particles, scene.forces, scene.weather) = (with.particles, with.forces, with.weather);
}

fn world(litter: Option<Litter>) -> World {
    let mut scene = hilly_scene(flying_scene(5, 300, 6.0, 1.0 / 60.0));
    scene.wind.jets = vec![jet()];
    scene.wind.plumes = vec![plume()];
    scene.ground.litter = litter;
    if litter.is_some() {
        scene.sources.iter_mut().for_each(|source| source.recycle_after_s = None);
        (scene.regrow_after_s, scene.species[0].burns) = (None, Some(Burning::default()));
        scene.wind.plumes.push(Plume {
            name: "fed".into(),
            fed_within_m: Some(3.0),
            keys: Vec::new(),
            ..plume()
        });
    }
    add_particles(&mut scene);
    let mut world = World::build(&scene).expect("the flying scene is valid on hills");
    for _ in 0..100 {
        world.compiled.advance(&mut world.clock);
    }
    if litter.is_some() {
        add_ridges(&mut world);
        let fires = world.bed.fires_mut(world.compiled.block());
        fires.iter_mut().for_each(|fire| *fire = fire_words(300_000, 900_000));
        let snow = world.bed.snow_mut(world.compiled.block());
        (0..)
            .zip(snow.depth)
            .for_each(|(cell, depth): (u32, _)| *depth = cell.wrapping_mul(0x9E37_79B9) >> 15);
    }
    world
}

/// Raises ridges of litter across the bed, a metre wide and a metre apart.
fn add_ridges(world: &mut World) {
    let block = &world.compiled.block().litter;
    let (line, count) = (block.columns as usize + 1, world.bed.heights(block).len());
    for (node, height) in world.bed.words[..count].iter_mut().enumerate() {
        *height += if node % line / 8 % 2 == 0 { 150_000 } else { 0 };
    }
}

/// The same with solid things, half a second after its start.
fn obstructed() -> World {
    let mut scene = hilly_scene(flying_scene(5, 300, 6.0, 1.0 / 60.0));
    let among = obstructed_scene(6, 300, 4.0, 1.0 / 60.0);
    scene.ground.litter = Some(bed());
    for vortex in &mut scene.wind.vortices {
        vortex.profile = VortexProfile::Compact { d: 0.5 };
        vortex.spline_m =
            (0..5u8).map(|point| vortex.center_m + Vec3::new(0.3, 1.0, 0.1) * f32::from(point)).collect();
        vortex.spline_m[2].x += 1.0;
    }
    (scene.objects, scene.walkers) = (among.objects, among.walkers);
    scene.wind.plumes = vec![plume()];
    scene = winding_scene(scene);
    add_particles(&mut scene);
    let mut world = World::build(&scene).expect("valid");
    for _ in 0..30 {
        world.compiled.advance(&mut world.clock);
    }
    world
}

/// Reason for which a case's results do not fit, if they do not.
fn mismatch(
    function: &Function,
    contract: Contract,
    input: &Words,
    cpu: &Words,
    gpu: &Words,
) -> Option<String> {
    if cpu == gpu {
        return None;
    }
    let floats = |words: &Words| words.map(f32::from_bits);
    if let (Contract::Tolerant, Some(tolerance)) = (contract, function.tolerance) {
        let largest = floats(input)
            .into_iter()
            .chain(floats(cpu))
            .filter(|x| x.is_finite() && x.abs() < 1e6)
            .fold(1f32, |largest, x| largest.max(x.abs()));
        let close = |(a, b): (f32, f32)| {
            let scale = largest.max(a.abs());
            (a - b).abs() <= tolerance * scale
        };
        if floats(cpu).into_iter().zip(floats(gpu)).all(close) {
            return None;
        }
    }
    Some(format!(
        "{}: input {input:x?}: cpu {cpu:x?} {:?}, gpu {gpu:x?} {:?}",
        function.name,
        floats(cpu),
        floats(gpu)
    ))
}

/// Runs one function on random cases in each of these worlds; the first case that does not fit, if any.
fn check<'a>(
    gpu: &Gpu,
    contract: Contract,
    shaders: &Shaders,
    function: &Function,
    worlds: impl IntoIterator<Item = &'a World>,
) -> Result<(), String> {
    let runner = FunctionRunner::new(gpu, contract, shaders, function)
        .map_err(|error| format!("{}: {error}", function.name))?;
    worlds.into_iter().try_for_each(|world| check_in(world, &runner, contract, function))
}

/// The same in one world.
fn check_in(
    world: &World,
    runner: &FunctionRunner,
    contract: Contract,
    function: &Function,
) -> Result<(), String> {
    let context = runner.context(world);
    let step = world.compiled.step_block(&world.clock);
    let carriers = carriers_of(world);
    let cx = world.context(&step).with_carriers(&carriers);
    let failure = RefCell::new(None);
    let mut proptest = TestRunner::new(Config {
        cases: ROUNDS,
        max_shrink_iters: 0,
        failure_persistence: None,
        ..Config::default()
    });
    let outcome = proptest.run(&cases(function.inputs, CASES), |inputs| {
        let results = runner.run(&context, &inputs).expect("the device is there");
        for (input, gpu_words) in inputs.iter().zip(&results) {
            let cpu_words = (function.rust)(&cx, input);
            if let Some(message) = mismatch(function, contract, input, &cpu_words, gpu_words) {
                failure.replace(Some(message));
                return Err(TestCaseError::fail("mismatch"));
            }
        }
        Ok(())
    });
    match failure.into_inner() {
        Some(message) => Err(message),
        None => outcome.map_err(|error| format!("{}: {error}", function.name)),
    }
}

/// Functions that rounding decides about under the looser contract, and those that do so where there is litter.
const STRIKES: [&str; 5] =
    ["ground_strike", "bent_share", "wedged_velocity", "particle_contact", "particle_push"];
const TOUCHES: [&str; 8] = [
    "flight_advance",
    "flight_contact",
    "strike_solids",
    "solid_footing",
    "solids_cell",
    "may_meet_solids_within",
    "own_sums",
    "collisions_of",
];

#[test]
fn functions_agree_on_every_adapter() {
    let worlds = [world(None), world(Some(bed())), obstructed()];
    let mut failures = Vec::new();
    for (gpu, contract) in adapter::contracts() {
        for function in functions::all() {
            // Rounding decides about a strike, and if a body touches: after that it goes another way.
            let is_decided = |world: &&World| {
                contract == Contract::Exact
                    || !STRIKES.contains(&function.name)
                        && (world.bed.is_empty() || !TOUCHES.contains(&function.name))
            };
            let worlds = worlds.iter().filter(is_decided);
            if let Err(message) = check(&gpu, contract, &Shaders::default(), function, worlds) {
                failures.push(format!("{} {contract}: {message}", gpu.info().name));
            }
        }
    }
    assert!(failures.is_empty(), "{} of the functions differ:\n{}", failures.len(), failures.join("\n"));
}

/// Mutation test: one constant or operator changed in one twin is noticed by the function that uses it.
#[test]
fn a_changed_twin_is_noticed() {
    let edits = [
        ("arith/math", "0.5 * r2", "0.4999 * r2", "sin_cos_turns"),
        ("arith/rng", "high1 ^ c.y", "high1 ^ c.z", "philox"),
        ("prelude", "const TABLE_ROWS: u32 = 513u", "const TABLE_ROWS: u32 = 512u", "motion_displacement"),
        ("wind/packed", "words.x << 21u", "words.x << 20u", "wind_unpack"),
        ("leaf/settle", "came.x - slope.x * pull", "came.x + slope.x * pull", "slide"),
        ("leaf/settle", "flatten(quat_multiply(back, q), kept)", "flatten(q, kept)", "flatten_on"),
        (
            "terrain/ground",
            "max(ground_relief(x, z), scene.water_relief_m)",
            "ground_relief(x, z)",
            "ground_relief",
        ),
        ("particle/fly", "air.y * lag", "air.y * way", "particle_fly"),
        ("particle/birth", "among < step_block.births", "among + 1u < step_block.births", "birth_number"),
        ("particle/birth", "max(max(a, b), c)", "max(a, b)", "shape_point"),
        ("particle/draw", "131070", "131072", "spread_draw"),
        (
            "particle/force",
            "squared = max(vec3_dot(toward, toward) + numbers.y",
            "squared = max(vec3_dot(toward, toward)",
            "force_pull",
        ),
        (
            "particle/force",
            "half, force_vector(first + 3u)",
            "turned, force_vector(first + 3u)",
            "force_turn",
        ),
        (
            "particle/strike",
            "leaving, closing * restitution, leaving",
            "leaving, -closing * restitution, leaving",
            "struck_velocity",
        ),
        ("particle/strike", "turn < MOST_STRIKES", "turn + 1u < MOST_STRIKES", "particle_contact"),
        ("particle/strike", "(bend * 4.0) * height", "(bend * 2.0) * height", "bent_share"),
        ("particle/nest", "let group = place / fan", "let group = place / (fan + 1u)", "nest_place"),
        ("particle/nest", "first != 0u && age", "age", "nest_events"),
        ("particle/nest", "turn = turn + first", "turn = turn + count", "nest_events"),
        (
            "particle/nest",
            "/ steps;\n        let is_alive",
            "/ steps + 1u;\n        let is_alive",
            "nest_events",
        ),
        (
            "particle/nest",
            "parent.position - parent.velocity",
            "parent.position + parent.velocity",
            "nest_start",
        ),
        ("particle/nest", "event * NEST_SPACING", "event", "nest_place"),
        (
            "particle/local_space",
            "flight.velocity - frame.start.velocity",
            "flight.velocity",
            "carried_flight",
        ),
        ("particle/local_space", "birth - motion.birth) >= 0", "birth - motion.birth) > 0", "carried_flight"),
        ("particle/local_space", "cross(cross, across) *", "cross(across, cross) *", "frame_turn"),
        ("particle/history", "/ run.every_steps;", "/ (run.every_steps + 1u);", "history_row"),
        ("particle/history", "among * run.samples", "among", "history_row"),
        ("terrain/snow", "words.x), cell.water)", "words.y), cell.water)", "snow_age"),
        (
            "leaf/own",
            "sin_cos_half(heading_angle(heading))",
            "sin_cos_half(heading >> 15u)",
            "own_orientation",
        ),
        ("motion/lookup", "after << 16u", "after << 15u", "motion_displacement"),
        (
            "leaf/record",
            "with_primitive(bits, 0u), is_spiral",
            "with_primitive(bits, 1u), is_spiral",
            "cone_offset",
        ),
        (
            "leaf/cone_spiral",
            "heading_angle(heading) * SWING",
            "heading_angle(heading) + SWING",
            "cone_offset",
        ),
        ("leaf/cone_spiral", "-(turn.x * radius)", "turn.x * radius", "cone_offset"),
        ("leaf/cone_spiral", "inverse * 0.5, cone", "inverse * 0.6, cone", "cone_velocity"),
        ("leaf/cone_spiral", "(cosine + 1.0) * 0.5", "(cosine + 1.0) * 0.4", "cone_velocity"),
        ("leaf/own", "select(1.0, 0.0, end < start)", "1.0", "table_phase"),
        ("leaf/own", "(outer - inner)", "(inner - outer)", "table_phase"),
        ("leaf/fall", "vec3<u32>(SLOWEST_DRIFT_TWICE)", "vec3<u32>(2u * SLOWEST_DRIFT_TWICE)", "felt_drift"),
        ("wind/gust", "row.y - row.x", "row.x - row.y", "wind_gust"),
        ("wind/shelter", "word >> 16u", "word >> 15u", "wind_shelter"),
        ("wind/shelter", "kw * shelter.cells_z", "kw * shelter.cells_x", "wind_shelter"),
        ("leaf/settle", "0.5 * seconds", "0.51 * seconds", "slide"),
        ("terrain/ground", "corners.w - corners.z)", "corners.z - corners.w)", "ground_relief"),
        ("terrain/ground", "<< shift", "<< (shift - 1u)", "ground_relief"),
        ("terrain/ground", "1.0 + up)", "2.0 - up)", "flatten_on"),
        ("terrain/ground", "let west = corners.z", "let west = corners.w", "ground_slope"),
        ("leaf/release", "<< 17u, extent", "<< 16u, extent", "release_place"),
        ("arith/matrix", "a.off - b.off", "a.off + b.off", "sym3_sums"),
        ("arith/matrix", "a.diagonal.z * PIVOT_SHARE", "a.diagonal.y * PIVOT_SHARE", "sym3_inverse"),
        ("arith/matrix", "a.x.z + a.z.x", "a.x.z + a.x.z", "mat3_times"),
        ("arith/quaternion", "y + y", "y + x", "quat_rotate_back"),
        ("arith/quaternion", "TURN_ASIN_11 + TURN_ASIN_9", "TURN_ASIN_11 + TURN_ASIN_11", "quat_of_turn"),
        ("tree/sway/load", "wind, axis)", "wind, wind)", "segment_drag"),
        ("tree/sway/load", "inertia_along - across", "inertia_along + across", "segment_load"),
        ("tree/sway/inward", "ahead + STOP_DAMPING", "ahead - STOP_DAMPING", "joint_spring"),
        ("tree/sway/inward", "body.base - parent.base", "body.base + parent.base", "velocity_products"),
        ("tree/sway/inward", "share, whole.coupling", "share, sym3_rows(spring)", "joint_response"),
        ("tree/sway/twig", "mass_across - lever", "mass_across + lever", "twig_response"),
        ("tree/sway/twig", "- vec3_cross(axis, carried", "+ vec3_cross(axis, carried", "twig_acceleration"),
        ("tree/sway/inward", "cross(arm, body.force)", "cross(body.force, arm)", "articulated_shift"),
        ("tree/sway/outward", "- mat3_times", "+ mat3_times", "joint_acceleration"),
        ("tree/sway/outward", "inverse * JOINT_LIMIT", "inverse * JOINT_LIMIT_COSINE", "joint_step"),
        ("tree/sway/outward", "cross(parent.spin, arm)", "cross(arm, parent.spin)", "segment_place"),
        ("flight/body", "(y - z) * inv_inertia.x", "(y + z) * inv_inertia.x", "body_of"),
        ("flight/rates", "q * (DRAG_RISE - q", "q * (DRAG_RISE + q", "flight_rates"),
        (
            "flight/rates",
            "added_momentum * turn.x);\n    let munk",
            "added_momentum * turn.y);\n    let munk",
            "flight_rates",
        ),
        ("flight/runge_kutta", "flight_sum(middle, middle)", "middle", "flight_step"),
        ("flight/regime", "2u < octants_apart", "3u < octants_apart", "regime_after"),
        ("leaf/fly", "substeps.share * scene", "substeps.count * scene", "flight_advance"),
        ("terrain/litter", "column - 1u <", "column <", "litter_shares"),
        ("terrain/litter", "right * near", "left * near", "litter_shares"),
        ("terrain/litter", "corners.w - corners.z", "corners.w - corners.y", "litter_height"),
        ("terrain/litter", "2.0 - above_ground", "2.1 - above_ground", "litter_height"),
        ("terrain/ground", "direction.y * reach", "direction.x * reach", "ground_gradient"),
        ("flight/contact", "(along * along) * normal.z", "(along * across) * normal.z", "support"),
        ("flight/contact", "drag * -1.0", "drag * -0.9", "flight_contact"),
        ("flight/contact", "push < weight + weight", "push < weight", "flight_contact"),
        ("flight/contact", "above * up - ", "above - ", "flight_contact"),
        ("solid/shape", "beyond_z, 0.0)", "beyond_y, 0.0)", "solid_distance"),
        ("solid/distance", "place - solid.center)", "solid.center - place)", "solid_distance"),
        ("solid/hull", "farthest.distance_m < distance", "farthest.distance_m < -distance", "solid_distance"),
        ("solid/grid", "y.node) * counts.x", "y.node) * counts.y", "solid_distance"),
        ("solid/grid", "rise_near + (rise_far", "rise_far + (rise_far", "solid_distance"),
        ("solid/near", "line * scene", "column * scene", "solids_cell"),
        ("solid/near", "bound * bound", "bound * reach", "may_meet_solids_within"),
        ("flight/strike", "motion.velocity - along", "motion.velocity", "strike_solids"),
        ("flight/strike", "radius * reach_share", "radius", "first_strike"),
        ("leaf/strike", "-(normal.x * inverse)", "-(normal.z * inverse)", "solid_footing"),
        ("wind/pile_shadow", "upwind - (here", "upwind - 2.0 * (here", "wind_behind_piles"),
        ("wind/plume", "growth * 0.5 + widening", "growth + widening", "wind_plume"),
        ("wind/plume", "1.0 - off * 4.0", "1.0 - off * 3.0", "plume_puff"),
        ("wind/plume", "passing * (along * across)", "passing * (along * along)", "wind_plume"),
        ("wind/plume", "* inverse_cube * PLUME_ABOVE_K", "* PLUME_ABOVE_K", "plume_warmth"),
        ("wind/plume", "bitcast<f32>(words.z)", "bitcast<f32>(words.y)", "plume_warmth"),
        (
            "tree/branch_snow",
            "units + (line % CROWN_CELLS)",
            "units + 1u + (line % CROWN_CELLS)",
            "crown_part",
        ),
        ("tree/branch_snow", "held - shed + caught", "held - shed", "branch_round"),
        ("terrain/snow", "inner + u32(inner == 0u)", "inner + u32(inner == 4u)", "snow_cell"),
        ("terrain/snow", "column + kind - 2u", "column + kind - 1u", "snow_pair"),
        ("terrain/snow", "way_m * snow_repose", "way_m + snow_repose", "snow_slide"),
        ("terrain/snow", "cell.water - min(round_at_random", "cell.depth - min(round_at_random", "snow_age"),
        ("terrain/snow", "speed * speed - lifts", "speed - lifts", "snow_drift"),
        ("terrain/snow", "snow.z * (far - near)", "snow.x * (far - near)", "snow_height"),
        (
            "particle/step",
            "select(none, width, high < place)",
            "select(none, width, place < high)",
            "is_outside",
        ),
        ("arith/math", "1.2 - (fifth * r2)", "1.2 - (fifth * r1)", "inverse_fifth_root"),
        ("leaf/burn", "way * (1.0 - way)", "way * way", "leaf_rise"),
        ("leaf/burn", "heat - scene.burns", "heat + scene.burns", "leaf_rise"),
        ("leaf/burn", "place.y, place.z + wind.z", "place.y, place.z - wind.z", "leaf_heat_release"),
        ("leaf/burn", ">> FIRE_FOLLOWS", ">> FIRE_WORDS", "fire_words"),
        ("wind/slipstream", "1.0 - inverse * stream.drag_m2", "1.0 - stream.drag_m2", "wind_slipstream"),
        ("leaf/air_cell", "layer * 19349663u", "layer * 19349661u", "own_sums"),
        ("leaf/collide", "number + 0.5", "number", "own_sums"),
        ("leaf/collide", "energy - vec3_dot(velocity, velocity)", "energy", "collisions_of"),
        ("leaf/collide", "leaves * reciprocal(others)", "others * reciprocal(leaves)", "collisions_of"),
        ("flight/rates", "munk * flow.z, lever.y + twist", "munk * flow.x, lever.y + twist", "still_load"),
        ("leaf/at_rest", "lift + lever", "lift - lever", "wake_square"),
        ("leaf/lie", "raise_spread + 1u", "raise_spread + 9u", "lying_tilt"),
        ("leaf/fly", "touch_steps(bits) >=", "touch_steps(bits) >", "flight_ends"),
        ("leaf/launch", "share * inverse_sqrt", "rest * inverse_sqrt", "hold_pose"),
        ("leaf/carry", "SHED_SPEEDS - 1u", "SHED_SPEEDS - 9u", "shed_chance"),
        ("leaf/carry", "still, vec3<f32>(0.0", "still, vec3<f32>(0.1", "leaf_twig_pose"),
        ("leaf/carry", "0u - (step_block", "1u - (step_block", "leaf_hangs"),
        ("leaf/carry", "- velocity;\n    let squared", "+ velocity;\n    let squared", "leaf_sample_air"),
    ];
    let worlds = [world(None), world(Some(bed())), obstructed()];
    for (gpu, contract) in adapter::contracts() {
        two_at_a_time(&gpu, edits.into_iter(), |gpu, (module, old, new, name)| {
            let shaders = Shaders::default().edited(module, old, new).expect("the edited text is there");
            let function =
                functions::all().find(|function| function.name == name).expect("a function of the table");
            let noticed = check(gpu, contract, &shaders, function, &worlds);
            let noticed = noticed.err().unwrap_or_else(|| panic!("{module}: '{new}' goes unnoticed"));
            assert!(noticed.contains(": input "), "{name} differs on {}: {noticed}", gpu.info().name);
        });
    }
}

/// Functions that only a kernel can call, as they read or write records of leaves and segments.
const RECORDS: [&str; 17] = [
    "places",
    "drifts",
    "attitudes",
    "schedules",
    "identities",
    "burns",
    "segments",
    "branch_rows",
    "work_rows",
    "leaf_counts",
    "carrier_rows",
    "carried",
    "particle_places",
    "particle_motions",
    "particle_traits",
    "particle_tallies",
    "carrier_run",
];

/// Names and bodies of the functions of a WGSL text.
fn bodies(text: &str) -> Vec<(&str, &str)> {
    let pieces = text.split("\nfn ").skip(1);
    pieces.filter_map(|piece| Some((piece.split_once('(')?.0, piece.split_once("\n}")?.0))).collect()
}

/// Returns true if a text says this word, as `is_call` a call.
fn says(text: &str, word: &str, is_call: bool) -> bool {
    let is_part = |character: char| character.is_alphanumeric() || character == '_';
    text.match_indices(word).any(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + word.len()..]);
        !before.ends_with(is_part) && !after.starts_with(is_part) && (!is_call || after.starts_with('('))
    })
}

/// Every device function that works on numbers alone is in the table, or called by one that is. Lists only order the work, and have
/// tests of their own.
#[test]
fn the_table_reaches_every_function_of_numbers() {
    let shaders = Shaders::default();
    let is_of_state = |name: &&str| !name.starts_with("kernels/") && !name.starts_with("lists/");
    let names: Vec<_> = shaders.names().filter(is_of_state).collect();
    let all: Vec<_> =
        names.iter().flat_map(|name| bodies(shaders.text(name).expect("a module of this name"))).collect();
    assert!(all.len() > 80, "only {} functions found", all.len());
    let mut reached: Vec<bool> = all
        .iter()
        .map(|(name, _)| functions::all().any(|function| says(function.wgsl, name, true)))
        .collect();
    let mut on_records: Vec<bool> =
        all.iter().map(|(_, body)| RECORDS.iter().any(|record| says(body, record, false))).collect();
    let calls: Vec<(usize, usize)> = (0..all.len())
        .flat_map(|caller| (0..all.len()).map(move |callee| (caller, callee)))
        .filter(|&(caller, callee)| caller != callee && says(all[caller].1, all[callee].0, true))
        .collect();
    // Calls go at most as deep as there are functions.
    for _ in 0..all.len() {
        for &(caller, callee) in &calls {
            reached[callee] |= reached[caller];
            on_records[caller] |= on_records[callee];
        }
    }
    let missing: Vec<_> =
        (0..all.len()).filter(|&i| !reached[i] && !on_records[i]).map(|i| all[i].0).collect();
    assert!(missing.is_empty(), "no case calls {missing:?}");
    let of_records = on_records.iter().filter(|&&is| is).count();
    assert!(
        2 * of_records < all.len(),
        "most functions are of numbers alone, all but {of_records} of {}",
        all.len()
    );
}
