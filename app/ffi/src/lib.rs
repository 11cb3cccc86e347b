// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Falling leaves from C: worlds by number, stepped, counted, lent and saved. `include/windfall.h` is made of this file.
//!
//! Every function returns a status, and keeps a line about what went wrong for its thread ([`windfall_last_error`]). None of them unwinds.
//! A world may be used from any thread; calls for one world wait for each other.
#![expect(unsafe_code, reason = "functions that C calls take pointers, and have names that C knows")]

mod error;
mod pointers;
mod worlds;

use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

use windfall_core::leaf::LeafView;
use windfall_core::{Scene, World};

pub use error::WindfallStatus;
use error::{Failure, last_error, note};
use pointers::{backend_of, give, text_of, wanted};
use worlds::{Held, built, column_names, free, keep, with};

/// Version of this interface. It changes when a function or a struct does.
pub const WINDFALL_ABI_VERSION: u32 = 1;

/// A world, by a number that is never used again; 0 is none.
pub type WindfallWorld = u64;

/// Time of a world.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct WindfallClock {
    /// Seconds since the scene began.
    pub seconds: f64,
    /// Steps since then.
    pub step: u32,
    /// Length of a step in s.
    pub dt_s: f32,
}

/// A column of a world: records of equal size, one for each row, not to be written. It stays where it is until it is given back.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct WindfallColumn {
    /// The first row.
    pub data: *const u8,
    /// Number of rows.
    pub rows: usize,
    /// Bytes of a row.
    pub row_bytes: usize,
}

/// A leaf, decoded.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct WindfallLeaf {
    /// Position in m; y points upwards.
    pub position_m: [f32; 3],
    /// Length in m.
    pub size_m: f32,
    /// Orientation: x, y, z, w. The blade lies in its own x-z plane, its upper side to +y, its tip towards +z.
    pub quaternion: [f32; 4],
    /// Velocity in m/s.
    pub velocity_m_s: [f32; 3],
    /// Time of its release in s.
    pub release_s: f32,
    /// Number that it keeps until it is let go again.
    pub id: u32,
    /// Place of its species in the scene.
    pub species: u32,
    /// 0 not let go yet, 1 on a branch, 2 in the air, 3 at rest.
    pub state: u32,
    /// 0 none, then the primitive motions in their order, then the regimes of bodies: steady, flutter, tumble, chaotic, helical, spiral, autorotation.
    pub motion: u32,
}

/// Counts of a world's leaves.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct WindfallCounts {
    /// All of them.
    pub leaves: u64,
    /// Not let go yet.
    pub dormant: u32,
    /// On branches.
    pub attached: u32,
    /// In the air.
    pub falling: u32,
    /// At rest.
    pub resting: u32,
}

/// Does what a call asks for, and notes how it went.
fn call(work: impl FnOnce() -> Result<(), Failure>) -> WindfallStatus {
    note(catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(Failure::of_panic(panic.as_ref()))))
}

/// `WINDFALL_ABI_VERSION` of the library: compare it with that of the header.
#[unsafe(no_mangle)]
pub extern "C" fn windfall_abi_version() -> u32 {
    WINDFALL_ABI_VERSION
}

/// Version of the library. The string stays for good.
#[unsafe(no_mangle)]
pub extern "C" fn windfall_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// A line about what went wrong in the latest call of this thread, empty if nothing did. It stays until the thread's next call.
#[unsafe(no_mangle)]
pub extern "C" fn windfall_last_error() -> *const c_char {
    last_error()
}

/// Builds the world of a preset or of a scene file. `backend` is "auto" (or NULL), "cpu" or "wgpu".
///
/// # Safety
/// `scene` and `backend` are null or strings that end with a zero; `world` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_world_open(
    scene: *const c_char,
    backend: *const c_char,
    world: *mut WindfallWorld,
) -> WindfallStatus {
    call(|| {
        wanted(world, "world")?;
        // SAFETY: the caller vouches for both strings.
        let (scene, backend) = unsafe { (text_of(scene, "scene")?, backend_of(backend)?) };
        let held = Held::new(built(&Scene::load(scene)?, scene)?, backend)?;
        // SAFETY: the caller vouches for it.
        unsafe { give(world, "world", keep(held)) }
    })
}

/// Builds the world of a scene's text in RON. `file` is the name that errors give it.
///
/// # Safety
/// `ron`, `file` and `backend` are null or strings that end with a zero; `world` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_world_from_ron(
    ron: *const c_char,
    file: *const c_char,
    backend: *const c_char,
    world: *mut WindfallWorld,
) -> WindfallStatus {
    call(|| {
        wanted(world, "world")?;
        // SAFETY: the caller vouches for the strings.
        let (ron, file, backend) =
            unsafe { (text_of(ron, "ron")?, text_of(file, "file")?, backend_of(backend)?) };
        let held = Held::new(built(&Scene::from_ron(ron, file)?, file)?, backend)?;
        // SAFETY: the caller vouches for it.
        unsafe { give(world, "world", keep(held)) }
    })
}

/// Goes on from the bytes of a checkpoint, which `windfall simulate --checkpoint` and `windfall_world_save` write.
///
/// # Safety
/// `bytes` is null or `length` bytes may be read from there on; `backend` is null or a string that ends with a zero; `world` is null or may
/// be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_world_from_checkpoint(
    bytes: *const u8,
    length: usize,
    backend: *const c_char,
    world: *mut WindfallWorld,
) -> WindfallStatus {
    call(|| {
        wanted(world, "world")?;
        wanted(bytes, "bytes")?;
        // SAFETY: it is not null, and the caller vouches for the rest.
        let (bytes, backend) = unsafe { (std::slice::from_raw_parts(bytes, length), backend_of(backend)?) };
        let held = Held::new(World::from_checkpoint(bytes, "<bytes>")?, backend)?;
        // SAFETY: the caller vouches for it.
        unsafe { give(world, "world", keep(held)) }
    })
}

/// Frees a world. Its number is refused from then on.
#[unsafe(no_mangle)]
pub extern "C" fn windfall_world_free(world: WindfallWorld) -> WindfallStatus {
    call(|| free(world))
}

/// Steps a world so many times. Refused while columns of it are lent.
#[unsafe(no_mangle)]
pub extern "C" fn windfall_world_step(world: WindfallWorld, count: u32) -> WindfallStatus {
    call(|| with(world, |held| held.step(count)))
}

/// Time of a world.
///
/// # Safety
/// `clock` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_world_clock(
    world: WindfallWorld,
    clock: *mut WindfallClock,
) -> WindfallStatus {
    call(|| {
        let now = with(world, |held| Ok(held.clock()))?;
        let answer = WindfallClock { seconds: now.seconds(), step: now.step(), dt_s: now.dt_s() };
        // SAFETY: the caller vouches for it.
        unsafe { give(clock, "clock", answer) }
    })
}

/// Hash of the whole state: that of `windfall simulate`, and equal on every backend that keeps the exact contract.
///
/// # Safety
/// `hash` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_world_hash(world: WindfallWorld, hash: *mut u64) -> WindfallStatus {
    call(|| {
        let answer = with(world, |held| Ok(held.world()?.state_hash()))?;
        // SAFETY: the caller vouches for it.
        unsafe { give(hash, "hash", answer) }
    })
}

/// Counts of a world's leaves.
///
/// # Safety
/// `counts` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_world_counts(
    world: WindfallWorld,
    counts: *mut WindfallCounts,
) -> WindfallStatus {
    call(|| {
        let answer = with(world, |held| {
            let world = held.world()?;
            let stats = world.stats().leaves;
            Ok(WindfallCounts {
                leaves: world.leaves.len() as u64,
                dormant: stats.dormant,
                attached: stats.attached,
                falling: stats.falling,
                resting: stats.resting,
            })
        })?;
        // SAFETY: the caller vouches for it.
        unsafe { give(counts, "counts", answer) }
    })
}

/// Decodes all leaves, in the order of their slots, as far as there is room; `count` takes how many there are. `leaves` may be null if
/// `capacity` is 0.
///
/// # Safety
/// `leaves` is null or `capacity` leaves may be written there; `count` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_world_leaves(
    world: WindfallWorld,
    leaves: *mut WindfallLeaf,
    capacity: usize,
    count: *mut usize,
) -> WindfallStatus {
    call(|| {
        if capacity > 0 {
            wanted(leaves, "leaves")?;
        }
        let there = with(world, |held| {
            let world = held.world()?;
            let there = world.leaves.len();
            let step = world.step_block();
            let cx = world.context(&step);
            for slot in 0..there.min(capacity) {
                let leaf = decoded(world, &world.leaves.view(&cx, slot));
                // SAFETY: `slot` is below the capacity, and the caller vouches for the rest.
                unsafe { leaves.add(slot).write(leaf) };
            }
            Ok(there)
        })?;
        // SAFETY: the caller vouches for it.
        unsafe { give(count, "count", there) }
    })
}

/// Name of a column by its number, NULL past the last: "place" of leaves, "particles.place" of other stores. The string stays for good.
#[unsafe(no_mangle)]
pub extern "C" fn windfall_column_name(number: usize) -> *const c_char {
    let names = catch_unwind(column_names).unwrap_or_default();
    names.get(number).map_or(std::ptr::null(), |name| name.as_ptr())
}

/// Lends a column of a world by name, without a copy. Give it back by `windfall_column_release`, after which it may move; until then the
/// world neither steps nor is freed.
///
/// # Safety
/// `name` is null or a string that ends with a zero; `column` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_column_lend(
    world: WindfallWorld,
    name: *const c_char,
    column: *mut WindfallColumn,
) -> WindfallStatus {
    call(|| {
        wanted(column, "column")?;
        // SAFETY: the caller vouches for it.
        let name = unsafe { text_of(name, "name")? };
        let answer = with(world, |held| {
            let (bytes, row_bytes) = held.lend(name)?;
            Ok(WindfallColumn { data: bytes.as_ptr(), rows: bytes.len() / row_bytes, row_bytes })
        })?;
        // SAFETY: the caller vouches for it.
        unsafe { give(column, "column", answer) }
    })
}

/// Gives back a column of a world.
#[unsafe(no_mangle)]
pub extern "C" fn windfall_column_release(world: WindfallWorld) -> WindfallStatus {
    call(|| with(world, Held::take_back))
}

/// Writes the state as a checkpoint, with its scene; `length` takes how many bytes it has. Refused if there is too little room; `bytes` may be
/// null if `capacity` is 0.
///
/// # Safety
/// `bytes` is null or `capacity` bytes may be written there; `length` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windfall_world_save(
    world: WindfallWorld,
    bytes: *mut u8,
    capacity: usize,
    length: *mut usize,
) -> WindfallStatus {
    call(|| {
        let written = with(world, |held| {
            let mut written = Vec::new();
            let saved = held.world()?.write_checkpoint(&mut written);
            saved.map_err(|error| Failure::Fault(error.to_string()))?;
            Ok(written)
        })?;
        // SAFETY: the caller vouches for it.
        unsafe { give(length, "length", written.len())? };
        if capacity == 0 {
            return Ok(());
        }
        wanted(bytes, "bytes")?;
        if capacity < written.len() {
            let needed = written.len();
            return Err(Failure::Argument(format!(
                "capacity is {capacity}; allowed: 0, or {needed} or more"
            )));
        }
        // SAFETY: there is room, which the caller vouches for, and the bytes of a vector of ours are elsewhere.
        unsafe { bytes.copy_from_nonoverlapping(written.as_ptr(), written.len()) };
        Ok(())
    })
}

/// A leaf of a world.
fn decoded(world: &World, leaf: &LeafView) -> WindfallLeaf {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a few species and motions; seconds as single precision"
    )]
    WindfallLeaf {
        position_m: leaf.position.to_array(),
        size_m: leaf.size * world.compiled.scene().species[leaf.species].size_m,
        quaternion: leaf.attitude.to_array(),
        velocity_m_s: leaf.velocity.to_array(),
        release_s: (f64::from(leaf.release) * f64::from(world.clock.dt_s())) as f32,
        id: leaf.id,
        species: leaf.species as u32,
        state: leaf.state as u32,
        motion: leaf.motion_number() as u32,
    }
}
