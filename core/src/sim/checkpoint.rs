// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Saves a world and brings it back to the bit.
//!
//! A checkpoint is the eight bytes `WINDFALL`, a version, then the scene as RON text, number and count of the shard that it is, the clock with the particles born in each population, and of every store the
//! number of rows and the columns, all little-endian, and at the end the CRC-32 of everything before. It stands alone: the
//! scene travels inside (motion table files that a species names do not).

use std::io::{self, Write};

use super::world::World;
use crate::clock::Clock;
use crate::compile::{CompiledScene, Shard};
use crate::error::SceneError;
use crate::scene::{MAX_POPULATIONS, Scene};
use crate::store::{Store, StoreSize};

const MAGIC: &[u8; 8] = b"WINDFALL";
const VERSION: u32 = 11;

impl World {
    /// Writes a checkpoint.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn write_checkpoint(&self, out: &mut impl Write) -> io::Result<()> {
        let mut out = Checked { out, crc: crc32fast::Hasher::new() };
        let scene = self.compiled.scene().to_ron();
        out.write_all(MAGIC)?;
        out.write_all(&VERSION.to_le_bytes())?;
        out.write_all(&(scene.len() as u64).to_le_bytes())?;
        out.write_all(scene.as_bytes())?;
        let shard = self.compiled.shard();
        out.write_all(&shard.number().to_le_bytes())?;
        out.write_all(&shard.count().to_le_bytes())?;
        out.write_all(&self.clock.step().to_le_bytes())?;
        out.write_all(&self.clock.wind_travel_m().to_le_bytes())?;
        for born in &self.clock.born()[..self.compiled.scene().particles.len()] {
            out.write_all(&born.to_le_bytes())?;
        }
        write_stores(&mut out, &self.stores())?;
        let crc = out.crc.finalize();
        out.out.write_all(&crc.to_le_bytes())
    }

    /// Reads a checkpoint; `file` names it in errors. Its scene may name any file.
    ///
    /// # Errors
    /// [`SceneError::Checkpoint`] for bytes that are cut short, damaged, of another version or no checkpoint at all;
    /// scene errors for a scene inside that this version rejects.
    pub fn from_checkpoint(bytes: &[u8], file: &str) -> Result<Self, SceneError> {
        Self::from_checked_checkpoint(bytes, file, |_| Ok(()))
    }

    /// The same, once `check` allows the scene inside: before any file that it names is opened, and before memory is taken for it.
    ///
    /// # Errors
    /// Those of [`World::from_checkpoint`] and of `check`.
    pub fn from_checked_checkpoint(
        bytes: &[u8],
        file: &str,
        check: impl FnOnce(&Scene) -> Result<(), SceneError>,
    ) -> Result<Self, SceneError> {
        let reject = |reason: String| SceneError::Checkpoint { file: file.into(), reason };
        let mut rest = Reader { bytes, file };
        if bytes.len() < MAGIC.len() || rest.take(MAGIC.len() as u64)? != MAGIC {
            return Err(reject("it does not begin with WINDFALL".into()));
        }
        let version = u32::from_le_bytes(rest.array()?);
        if version != VERSION {
            return Err(reject(format!("version {version}; this program reads version {VERSION}")));
        }
        let Some((body, stored)) = bytes.split_last_chunk::<4>() else {
            return Err(reject("it is cut short".into()));
        };
        if crc32fast::hash(body) != u32::from_le_bytes(*stored) {
            return Err(reject("its checksum does not match: it is damaged or cut short".into()));
        }
        rest.bytes = &body[MAGIC.len() + size_of_val(&version)..];
        let length = u64::from_le_bytes(rest.array()?);
        let text =
            std::str::from_utf8(rest.take(length)?).map_err(|_| reject("its scene is not text".into()))?;
        let scene = Scene::from_ron(text, file)?;
        check(&scene)?;
        let (number, count) = (u32::from_le_bytes(rest.array()?), u32::from_le_bytes(rest.array()?));
        let shard = Shard::new(number, count).ok_or_else(|| {
            reject(format!("it is shard {number} of {count}: there is none of that number"))
        })?;
        let compiled = CompiledScene::compile_shard(&scene, shard)?;
        let step = u32::from_le_bytes(rest.array()?);
        let travel = f64::from_le_bytes(rest.array()?);
        let mut born = [0; MAX_POPULATIONS];
        for born in &mut born[..scene.particles.len()] {
            *born = u64::from_le_bytes(rest.array()?);
        }
        // Before the stores get their memory: a few bytes may hold a scene of millions of leaves.
        let (needed, found) = (compiled.state_bytes(), rest.bytes.len());
        if needed > found as u64 {
            let reason = format!("it is cut short: {found} bytes of state for a scene of {needed}");
            return Err(reject(reason));
        }
        let clock = Clock::at(step, scene.dt_s, travel).with_born(born);
        let mut world = Self::zeroed(compiled, clock);
        rest.bytes = read_stores(rest.bytes, file, &mut world.stores_mut())?;
        if !rest.bytes.is_empty() {
            return Err(reject(format!("it is longer than its stores by {} bytes", rest.bytes.len())));
        }
        Ok(world)
    }
}

/// Writes the number of rows and the columns of every store.
///
/// # Errors
/// Errors of the writer.
pub fn write_stores(out: &mut impl Write, stores: &[&dyn Store]) -> io::Result<()> {
    for store in stores {
        out.write_all(&(store.rows() as u64).to_le_bytes())?;
        for column in store.columns() {
            out.write_all(column)?;
        }
    }
    Ok(())
}

/// Fills stores from what [`write_stores`] has written, and returns the bytes behind it; `file` names them in errors.
///
/// # Errors
/// [`SceneError::Checkpoint`] for bytes that are cut short or stores of other sizes.
pub fn read_stores<'a>(
    bytes: &'a [u8],
    file: &'a str,
    stores: &mut [&mut dyn Store],
) -> Result<&'a [u8], SceneError> {
    let mut rest = Reader { bytes, file };
    for store in stores {
        let rows = u64::from_le_bytes(rest.array()?);
        let StoreSize { store: name, rows: own } = store.size();
        if rows != own as u64 {
            let reason = format!("{rows} {name} for a scene of {own}");
            return Err(SceneError::Checkpoint { file: file.into(), reason });
        }
        for column in store.columns_mut() {
            column.copy_from_slice(rest.take(column.len() as u64)?);
        }
    }
    Ok(rest.bytes)
}

/// Passes bytes on and keeps their checksum.
struct Checked<'a, W> {
    out: &'a mut W,
    crc: crc32fast::Hasher,
}

impl<W: Write> Write for Checked<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.crc.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Takes a checkpoint apart from the front.
struct Reader<'a> {
    bytes: &'a [u8],
    file: &'a str,
}

impl<'a> Reader<'a> {
    fn take(&mut self, length: u64) -> Result<&'a [u8], SceneError> {
        let cut = usize::try_from(length).ok().and_then(|length| self.bytes.split_at_checked(length));
        let Some((front, rest)) = cut else {
            return Err(SceneError::Checkpoint { file: self.file.into(), reason: "it is cut short".into() });
        };
        self.bytes = rest;
        Ok(front)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], SceneError> {
        let bytes = self.take(N as u64)?;
        Ok(bytes.try_into().expect("take returns as many bytes as asked for"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Source;

    /// Some hundred bytes once took 23 gigabytes of memory before they were refused.
    #[test]
    fn a_scene_of_more_leaves_than_the_bytes_hold_gets_no_memory_for_them() {
        let scene =
            Scene { sources: vec![Source { count: 1 << 28, ..Source::default() }], ..Scene::default() };
        let text = scene.to_ron();
        let mut bytes =
            [MAGIC, &VERSION.to_le_bytes()[..], &(text.len() as u64).to_le_bytes(), text.as_bytes()].concat();
        // Shard, step and wind travel, and the number of leaves.
        bytes.extend([1, 0, 0, 0, 1, 0, 0, 0]);
        bytes.extend([0; 12]);
        bytes.extend((1u64 << 28).to_le_bytes());
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        let error = World::from_checkpoint(&bytes, "a.windfall").expect_err("no leaves follow").to_string();
        assert!(error.contains("cut short: 8 bytes of state for a scene of"), "{error}");
    }
}
