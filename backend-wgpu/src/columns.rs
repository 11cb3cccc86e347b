// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The stores of a world as GPU buffers.

use windfall_core::leaf::Leaves;
use windfall_core::particle::{HistoryStore, ParticleStore};
use windfall_core::store::{Store, StoreSize, check_sizes};
use windfall_core::tree::record::{BRANCH_BASE, BRANCH_POSE};
use windfall_core::{SimError, World};

use crate::gpu::Gpu;
use crate::readback::{Readback, Run, read_buffer};

/// Columns that share a buffer begin at a multiple of this many rows, so that each can be bound on any device.
const COLUMN_STEP: u64 = 16;

/// Place of the bed of litter among the stores of a world.
const BED: usize = 2;

/// Borrowed columns of a world, to be drawn on the device they were made on.
#[derive(Clone, Debug)]
pub struct WorldColumns<'a> {
    /// The leaves.
    pub leaves: LeafColumns<'a>,
    /// The segments of trees; `None` in a world without trees.
    pub branches: Option<BranchColumns<'a>>,
    /// The particles; `None` in a world without any.
    pub particles: Option<ParticleColumns<'a>>,
    /// The burning of leaves, `Burn` of 16 bytes slot by slot: `f32` heat in J/m², `f32` share of the way that the front had run when water put
    /// it out, `u32` step after the one in which it caught or 0, `u32` unused. `None` where none burn.
    pub burns: Option<&'a wgpu::Buffer>,
    /// The litter and the snow; `None` without either.
    pub bed: Option<BedColumn<'a>>,
}

/// Borrowed words of what lies on the ground (see `windfall_core::litter::Bed`).
#[derive(Clone, Copy, Debug)]
pub struct BedColumn<'a> {
    /// A buffer that holds them among other words.
    pub buffer: &'a wgpu::Buffer,
    /// Number of the first of them there.
    pub first_word: u32,
}

/// Borrowed leaf columns: one 16-byte record per leaf in each buffer (see `windfall_core::leaf`), usable as vertex
/// and storage buffers on the device they were made on.
#[derive(Clone, Copy, Debug)]
pub struct LeafColumns<'a> {
    /// `Place`: x, y, z in metres as `f32`; `u32` of state, blend, motion table and spin.
    pub place: &'a wgpu::Buffer,
    /// `Drift`: velocity x, y, z in m/s as `f32`; `u32` phase.
    pub drift: &'a wgpu::Buffer,
    /// `Attitude`: unit quaternion x, y, z, w as `f32`.
    pub attitude: &'a wgpu::Buffer,
    /// `Schedule`: four `u32`; the third's low half is the size relative to the species' in 2^-14.
    pub schedule: &'a wgpu::Buffer,
    /// `Identity`: four `u32`; the fourth holds tint (bits 0-15) and image variant (bits 16-23).
    pub identity: &'a wgpu::Buffer,
    /// Number of leaves.
    pub leaf_count: u32,
}

/// Borrowed columns of the segments of trees (see `windfall_core::tree`): one 16-byte record per row, usable as storage
/// buffers on the device they were made on.
#[derive(Clone, Debug)]
pub struct BranchColumns<'a> {
    /// Place of each segment's joint x, y, z in metres as `f32`; one unused.
    pub base: wgpu::BufferBinding<'a>,
    /// Orientation: unit quaternion x, y, z, w from the segment's frame, y along it, to the world's.
    pub pose: wgpu::BufferBinding<'a>,
    /// Number of segments.
    pub count: u32,
}

/// Borrowed columns of particles (see `windfall_core::particle`): one 16-byte record per slot in each buffer, population after
/// population, usable as vertex and storage buffers on the device they were made on.
#[derive(Clone, Copy, Debug)]
pub struct ParticleColumns<'a> {
    /// `ParticlePlace`: x, y, z in metres as `f32`; `u32` of state, population and hits.
    pub place: &'a wgpu::Buffer,
    /// `ParticleMotion`: velocity x, y, z in m/s as `f32`; `u32` step of birth, two's complement.
    pub motion: &'a wgpu::Buffer,
    /// `ParticleTraits`: `u32` number; `u32` life in steps (low half) and size in 2^-14 of the population's mean (high half); two
    /// numbers of its drag.
    pub traits: &'a wgpu::Buffer,
    /// Number of slots.
    pub count: u32,
    /// `HistorySample`: x, y, z in metres as `f32`; `u32` step before which it was there. The samples of all ways, as
    /// [`HistoryRun`](windfall_core::particle::HistoryRun) orders them; some that mean nothing if none are kept.
    pub history: &'a wgpu::Buffer,
}

/// Buffers for all columns of a store. Neighbouring columns of one record type share a buffer, one after another.
#[derive(Debug)]
pub struct StoreBuffers {
    size: StoreSize,
    columns: Vec<ColumnBuffer>,
}

/// Place of a column.
#[derive(Debug)]
struct ColumnBuffer {
    buffer: wgpu::Buffer,
    offset: u64,
    /// Rows from the start of this column to that of its neighbour.
    stride: u64,
    record_bytes: u64,
}

impl StoreBuffers {
    /// Buffers for the columns of a store, of zeros.
    ///
    /// # Errors
    /// [`SimError::Capacity`] if one is larger than the device's largest buffer.
    pub fn new(gpu: &Gpu, store: &dyn Store) -> Result<Self, SimError> {
        let size = store.size();
        let rows = size.rows.max(1) as u64;
        let mut columns = Vec::new();
        for group in store.description().chunk_by(|a, b| a.record == b.record) {
            let stride = if group.len() == 1 { rows } else { rows.next_multiple_of(COLUMN_STEP) };
            let record_bytes = group[0].record_bytes as u64;
            let needed = stride * record_bytes * group.len() as u64;
            let allowed = gpu.device().limits().max_buffer_size;
            if needed > allowed {
                let device = gpu.info().name.clone();
                return Err(SimError::Capacity {
                    store: size.store,
                    rows: size.rows,
                    needed,
                    allowed,
                    device,
                });
            }
            let names: Vec<_> = group.iter().map(|column| column.name).collect();
            let descriptor = wgpu::BufferDescriptor {
                label: Some(&format!("{} {}", size.store, names.join(" "))),
                size: needed,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::VERTEX
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            };
            let buffer = gpu.scoped(|| gpu.device().create_buffer(&descriptor))?;
            let places = (0..group.len() as u64).map(|index| index * stride * record_bytes);
            columns.extend(places.map(|offset| ColumnBuffer {
                buffer: buffer.clone(),
                offset,
                stride,
                record_bytes,
            }));
        }
        Ok(Self { size, columns })
    }

    /// Columns of single words within a buffer of another's.
    fn within(size: StoreSize, buffer: &wgpu::Buffer, offset: u64) -> Self {
        let column =
            ColumnBuffer { buffer: buffer.clone(), offset, stride: size.rows as u64, record_bytes: 4 };
        Self { size, columns: vec![column] }
    }

    /// Replaces all columns.
    ///
    /// # Errors
    /// [`SimError::Size`] if the store is of another size; a lost device.
    pub fn write(&self, gpu: &Gpu, store: &dyn Store) -> Result<(), SimError> {
        check_sizes(&[store.size()], &[self.size])?;
        gpu.scoped(|| {
            for (column, bytes) in self.columns.iter().zip(store.columns()) {
                gpu.queue().write_buffer(&column.buffer, column.offset, bytes);
            }
        })
    }

    /// Copies all columns out, after everything submitted before.
    ///
    /// # Errors
    /// [`SimError::Size`] if the store is of another size; a lost device.
    pub fn read(&self, gpu: &Gpu, store: &mut dyn Store) -> Result<(), SimError> {
        check_sizes(&[store.size()], &[self.size])?;
        for (column, bytes) in self.columns.iter().zip(store.columns_mut()) {
            read_buffer(gpu, &column.buffer, column.offset, bytes)?;
        }
        Ok(())
    }

    /// The bytes of every column that hold rows.
    fn runs(&self) -> impl Iterator<Item = Run<'_>> {
        self.columns.iter().map(|ColumnBuffer { buffer, offset, record_bytes, .. }| Run {
            buffer,
            offset: *offset,
            size: self.size.rows as u64 * record_bytes,
        })
    }

    /// Name and number of rows.
    pub fn size(&self) -> StoreSize {
        self.size
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> u32 {
        u32::try_from(self.size.rows).expect("rows are counted in words")
    }

    /// The buffer of a column, which it shares with its neighbours of the same record type.
    pub(crate) fn buffer(&self, column: usize) -> &wgpu::Buffer {
        &self.columns[column].buffer
    }

    /// The words of a bed.
    fn bed(&self) -> BedColumn<'_> {
        let column = &self.columns[0];
        let first_word = u32::try_from(column.offset / 4).expect("devices have fewer words");
        BedColumn { buffer: &column.buffer, first_word }
    }

    /// Rows from the start of a column to that of its neighbour in the same buffer.
    pub(crate) fn stride(&self, column: usize) -> u32 {
        u32::try_from(self.columns[column].stride).expect("rows are counted in words")
    }

    /// A run of rows of a column, the window that a page of a large store is bound in.
    pub fn window(&self, column: usize, first: u32, rows: u32) -> wgpu::BufferBinding<'_> {
        let ColumnBuffer { buffer, offset, record_bytes, .. } = &self.columns[column];
        wgpu::BufferBinding {
            buffer,
            offset: offset + u64::from(first) * record_bytes,
            size: wgpu::BufferSize::new(u64::from(rows) * record_bytes),
        }
    }

    /// All windows of a run of rows, in the order of the columns.
    pub(crate) fn windows(&self, first: u32, rows: u32) -> impl Iterator<Item = wgpu::BindingResource<'_>> {
        (0..self.columns.len())
            .map(move |column| wgpu::BindingResource::Buffer(self.window(column, first, rows)))
    }
}

impl<'a> LeafColumns<'a> {
    /// The columns of a store of leaves.
    pub fn of(leaves: &'a StoreBuffers) -> Self {
        debug_assert_eq!(leaves.size.store, Leaves::NAME, "buffers of leaves");
        let [place, drift, attitude, schedule, _air, identity] =
            [0, 1, 2, 3, 4, 5].map(|column| leaves.buffer(column));
        Self { place, drift, attitude, schedule, identity, leaf_count: leaves.rows() }
    }
}

impl<'a> ParticleColumns<'a> {
    /// The columns of a store of particles, and of the samples of their ways; `None` without particles.
    pub fn of(particles: &'a StoreBuffers, history: &'a StoreBuffers) -> Option<Self> {
        debug_assert_eq!(particles.size.store, ParticleStore::NAME, "buffers of particles");
        let [place, motion, traits] = [0, 1, 2].map(|column| particles.buffer(column));
        debug_assert_eq!(history.size.store, HistoryStore::NAME, "buffers of samples");
        let (count, history) = (particles.rows(), history.buffer(0));
        (count > 0).then_some(Self { place, motion, traits, count, history })
    }
}

/// Buffers for all stores of a world.
#[derive(Debug)]
pub struct WorldBuffers {
    stores: Vec<StoreBuffers>,
}

impl WorldBuffers {
    /// Buffers for worlds of this size, of zeros.
    ///
    /// # Errors
    /// [`SimError::Capacity`] if a buffer is larger than the device's largest.
    pub fn new(gpu: &Gpu, world: &World) -> Result<Self, SimError> {
        let stores = world.stores().into_iter().map(|store| StoreBuffers::new(gpu, store));
        Ok(Self { stores: stores.collect::<Result<_, _>>()? })
    }

    /// Replaces the state.
    ///
    /// # Errors
    /// [`SimError::Size`] if the world is of another size; a lost device.
    pub fn write(&self, gpu: &Gpu, world: &World) -> Result<(), SimError> {
        check_sizes(&world.sizes(), &self.sizes())?;
        self.stores.iter().zip(world.stores()).try_for_each(|(buffers, store)| buffers.write(gpu, store))
    }

    /// Copies the state out, after everything submitted before.
    ///
    /// # Errors
    /// [`SimError::Size`] if the world is of another size; a lost device.
    pub fn read(&self, gpu: &Gpu, world: &mut World) -> Result<(), SimError> {
        check_sizes(&world.sizes(), &self.sizes())?;
        self.stores.iter().zip(world.stores_mut()).try_for_each(|(buffers, store)| buffers.read(gpu, store))
    }

    /// Starts to copy the state out, after everything submitted before.
    pub(crate) fn request(&self, gpu: &Gpu) -> Result<Readback, SimError> {
        Readback::new(gpu, self.stores.iter().flat_map(StoreBuffers::runs))
    }

    /// Number of rows of each store.
    pub fn sizes(&self) -> Vec<StoreSize> {
        self.stores.iter().map(StoreBuffers::size).collect()
    }

    /// The columns, to draw from.
    pub fn columns(&self) -> WorldColumns<'_> {
        let count = self.branches().rows();
        let column = |column: u32| self.branches().window(column as usize, 0, count);
        let branches = || BranchColumns { base: column(BRANCH_BASE), pose: column(BRANCH_POSE), count };
        WorldColumns {
            leaves: LeafColumns::of(self.leaves()),
            branches: (count > 0).then(branches),
            particles: ParticleColumns::of(self.particles(), self.history()),
            burns: (self.burns().rows() > 0).then(|| self.burns().buffer(0)),
            bed: (self.stores[BED].rows() > 0).then(|| self.stores[BED].bed()),
        }
    }

    /// Keeps the bed of litter within a buffer from an offset on, where kernels find it.
    pub(crate) fn keep_bed_in(&mut self, buffer: &wgpu::Buffer, offset: u64) {
        let size = self.stores[BED].size;
        if size.rows > 0 {
            self.stores[BED] = StoreBuffers::within(size, buffer, offset);
        }
    }

    /// Bytes of the bed of litter.
    pub(crate) fn bed_bytes(&self) -> u64 {
        self.stores[BED].size.rows as u64 * 4
    }

    /// The leaves, the first store of a world.
    pub(crate) fn leaves(&self) -> &StoreBuffers {
        &self.stores[0]
    }

    /// The particles, the fourth store of a world.
    pub(crate) fn particles(&self) -> &StoreBuffers {
        &self.stores[3]
    }

    /// The counts of what has happened to particles, the fifth store of a world.
    pub(crate) fn tallies(&self) -> &StoreBuffers {
        &self.stores[4]
    }

    /// The samples of the ways of particles, the sixth store of a world.
    pub(crate) fn history(&self) -> &StoreBuffers {
        &self.stores[5]
    }

    /// The burning of leaves, the seventh store of a world.
    pub(crate) fn burns(&self) -> &StoreBuffers {
        &self.stores[6]
    }

    /// The segments of trees, the second store of a world.
    pub(crate) fn branches(&self) -> &StoreBuffers {
        &self.stores[1]
    }
}
