// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Saves a world and brings it back to the bit.
//!
//! A checkpoint is the eight bytes `WINDFALL`, a version, then the scene as RON text, the clock, the five leaf
//! columns, the trees' six columns and the leaves that hang on each of their segments, all little-endian, and at the end the CRC-32 of everything before. It stands alone: the scene travels
//! inside (motion table files that a species names do not).

use std::io::{self, Write};

use crate::clock::Clock;
use crate::environment::Environment;
use crate::error::SceneError;
use crate::leaf::Leaves;
use crate::scene::Scene;
use crate::tree::Branches;
use crate::world::World;

const MAGIC: &[u8; 8] = b"WINDFALL";
const VERSION: u32 = 3;

impl World {
    /// Writes a checkpoint.
    ///
    /// # Errors
    /// What the writer reports.
    pub fn write_checkpoint(&self, out: &mut impl Write) -> io::Result<()> {
        let mut out = Checked { out, crc: crc32fast::Hasher::new() };
        let scene = self.environment.scene().to_ron();
        out.write_all(MAGIC)?;
        out.write_all(&VERSION.to_le_bytes())?;
        out.write_all(&(scene.len() as u64).to_le_bytes())?;
        out.write_all(scene.as_bytes())?;
        out.write_all(&self.clock.step().to_le_bytes())?;
        out.write_all(&self.clock.wind_travel_m().to_le_bytes())?;
        out.write_all(&(self.leaves.len() as u64).to_le_bytes())?;
        for column in self.leaves.columns() {
            out.write_all(column)?;
        }
        out.write_all(&(self.branches.len() as u64).to_le_bytes())?;
        for column in self.branches.columns() {
            out.write_all(bytemuck::cast_slice(column))?;
        }
        out.write_all(bytemuck::cast_slice(&self.branches.bearing))?;
        let crc = out.crc.finalize();
        out.out.write_all(&crc.to_le_bytes())
    }

    /// Reads a checkpoint; `file` names it in errors.
    ///
    /// # Errors
    /// [`SceneError::Checkpoint`] for bytes that are cut short, damaged, of another version or no checkpoint at all;
    /// scene errors for a scene inside that this version rejects.
    pub fn from_checkpoint(bytes: &[u8], file: &str) -> Result<Self, SceneError> {
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
        let environment = Environment::compile(&scene)?;
        let step = u32::from_le_bytes(rest.array()?);
        let travel = f64::from_le_bytes(rest.array()?);
        let count = u64::from_le_bytes(rest.array()?);
        if count != u64::from(scene.leaf_count()) {
            return Err(reject(format!("{count} leaves for a scene of {}", scene.leaf_count())));
        }
        let mut leaves = Leaves::zeroed(scene.leaf_count() as usize);
        for column in leaves.columns_mut() {
            column.copy_from_slice(rest.take(column.len() as u64)?);
        }
        let segments = u64::from_le_bytes(rest.array()?);
        let mut branches = Branches::zeroed(environment.forest().len());
        if segments != branches.len() as u64 {
            return Err(reject(format!("{segments} segments for trees of {}", branches.len())));
        }
        for column in branches.columns_mut() {
            let column: &mut [u8] = bytemuck::cast_slice_mut(column);
            column.copy_from_slice(rest.take(column.len() as u64)?);
        }
        let bearing: &mut [u8] = bytemuck::cast_slice_mut(&mut branches.bearing);
        bearing.copy_from_slice(rest.take(bearing.len() as u64)?);
        if !rest.bytes.is_empty() {
            return Err(reject(format!(
                "it is longer than its {count} leaves by {} bytes",
                rest.bytes.len()
            )));
        }
        Ok(Self { environment, clock: Clock::at(step, scene.dt_s, travel), leaves, branches })
    }
}

/// Passes bytes on and keeps their checksum.
struct Checked<'a, W> {
    out: &'a mut W,
    crc: crc32fast::Hasher,
}

impl<W: Write> Checked<'_, W> {
    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.crc.update(bytes);
        self.out.write_all(bytes)
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
