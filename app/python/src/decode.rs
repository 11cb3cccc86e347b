// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Columns of a world: those of its stores by name, and leaves decoded into plain numbers.

use windfall_core::World;
use windfall_core::device::flight::regime::REGIME_NAMES;
use windfall_core::motion::Primitive;
use windfall_core::store::Column as Description;

/// A decoded column: name, type as numpy writes it, numbers of a row, bytes.
pub(crate) type Decoded = (&'static str, &'static str, usize, Vec<u8>);

/// Stores and columns with their names: `place` of leaves, `particles.place` of others.
pub(crate) fn named(world: &World) -> Vec<(String, usize, usize, &'static Description)> {
    let stores = world.stores().into_iter().zip(world.column_names()).enumerate();
    let columns = stores.flat_map(|(at, (store, names))| {
        let columns = names.into_iter().zip(store.description()).enumerate();
        columns.map(move |(number, (name, column))| (name, at, number, column))
    });
    columns.collect()
}

/// All leaves, in the order of their slots.
pub(crate) fn leaves(world: &World) -> Vec<Decoded> {
    let count = world.leaves.len();
    let (mut id, mut state, mut species) = (Vec::new(), Vec::new(), Vec::new());
    let (mut position, mut velocity, mut quaternion, mut size) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut release_s, mut motion) = (Vec::new(), Vec::new());
    let step = world.step_block();
    let cx = world.context(&step);
    for slot in 0..count {
        let leaf = world.leaves.view(&cx, slot);
        id.push(leaf.id);
        state.push(leaf.state as u8);
        species.push(u8::try_from(leaf.species).unwrap_or(u8::MAX));
        position.push(leaf.position.to_array());
        velocity.push(leaf.velocity.to_array());
        quaternion.push(leaf.attitude.to_array());
        size.push(leaf.size * world.compiled.scene().species[leaf.species].size_m);
        release_s.push(f64::from(leaf.release) * f64::from(world.clock.dt_s()));
        // Among [`motions`].
        motion.push(u8::try_from(leaf.motion_number()).unwrap_or(u8::MAX));
    }
    vec![
        ("id", "<u4", 1, bytemuck::cast_slice(&id).to_vec()),
        ("state", "|u1", 1, state),
        ("motion", "|u1", 1, motion),
        ("species", "|u1", 1, species),
        ("position", "<f4", 3, bytemuck::cast_slice(&position).to_vec()),
        ("velocity", "<f4", 3, bytemuck::cast_slice(&velocity).to_vec()),
        ("quaternion", "<f4", 4, bytemuck::cast_slice(&quaternion).to_vec()),
        ("size_m", "<f4", 1, bytemuck::cast_slice(&size).to_vec()),
        ("release_s", "<f8", 1, bytemuck::cast_slice(&release_s).to_vec()),
    ]
}

/// Names of motions by their numbers: none, then codes of the primitive motions, then regimes of bodies.
pub(crate) fn motions() -> Vec<&'static str> {
    [""].into_iter().chain(Primitive::ALL.map(Primitive::code)).chain(REGIME_NAMES).collect()
}
