// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Stores: the state of a world as columns of plain records, each store described once.
//!
//! [`columns!`](crate::columns) makes a store from a list of columns. What handles whole states loops over
//! [`World::stores`](crate::World::stores) and over the [`Column`]s of each: checkpoint, hash, copies to and from backends,
//! their buffers, comparison of backends. A further store is a field of `World` and a line in `World::stores`.

use std::fmt::Debug;
use std::ops::Range;

use bytemuck::Pod;

use crate::arith::hash::mix;
use crate::error::SimError;

/// Meaning of the words of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldKind {
    /// Integers, equal under every contract.
    Integer,
    /// Floats, equal to within rounding under the tolerant contract.
    Float,
}

/// Words of a record that belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name; empty if it is the whole record.
    pub name: &'static str,
    /// Number of words of four bytes.
    pub words: usize,
    /// Meaning of the words, unless the state of the row decides ([`Store::kind`]).
    pub kind: FieldKind,
}

impl Field {
    /// A field of that type.
    pub const fn of<T: FieldType>(name: &'static str) -> Self {
        Self { name, words: size_of::<T>() / 4, kind: T::KIND }
    }
}

/// A type of the fields of records, of words of four bytes.
pub trait FieldType: Pod {
    /// Meaning of the words.
    const KIND: FieldKind;
}

impl FieldType for u32 {
    const KIND: FieldKind = FieldKind::Integer;
}

impl FieldType for f32 {
    const KIND: FieldKind = FieldKind::Float;
}

impl<T: FieldType, const N: usize> FieldType for [T; N]
where
    [T; N]: Pod,
{
    const KIND: FieldKind = T::KIND;
}

/// A plain record of words of four bytes, as a column holds them.
pub trait Record: Pod + Default + Debug + PartialEq + Send + Sync {
    /// Name of the type.
    const NAME: &'static str;
    /// Its fields in order, without a gap.
    const FIELDS: &'static [Field];
}

impl Record for u32 {
    const NAME: &'static str = "u32";
    const FIELDS: &'static [Field] = &[Field::of::<Self>("")];
}

impl Record for f32 {
    const NAME: &'static str = "f32";
    const FIELDS: &'static [Field] = &[Field::of::<Self>("")];
}

impl Record for [u32; 2] {
    const NAME: &'static str = "vec2<u32>";
    const FIELDS: &'static [Field] = &[Field::of::<Self>("")];
}

impl Record for [f32; 4] {
    const NAME: &'static str = "vec4<f32>";
    const FIELDS: &'static [Field] = &[Field::of::<Self>("")];
}

/// Description of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name.
    pub name: &'static str,
    /// Name of the type of its records. Neighbouring columns of one type share a buffer on devices, one after another.
    pub record: &'static str,
    /// Bytes of a record.
    pub record_bytes: usize,
    /// Fields of a record.
    pub fields: &'static [Field],
}

impl Column {
    /// Description of a column of records of type `T`.
    pub const fn of<T: Record>(name: &'static str) -> Self {
        let mut words = 0;
        let mut index = 0;
        while index < T::FIELDS.len() {
            words += T::FIELDS[index].words;
            index += 1;
        }
        assert!(words * 4 == size_of::<T>(), "the fields of a record are all of its words");
        Self { name, record: T::NAME, record_bytes: size_of::<T>(), fields: T::FIELDS }
    }
}

/// Number of rows of a store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StoreSize {
    /// Name of the store.
    pub store: &'static str,
    /// Number of rows.
    pub rows: usize,
}

/// Columns of equal length, one record of each for every row.
pub trait Store: Debug + Send + Sync {
    /// Name of what the rows are, in the plural.
    fn name(&self) -> &'static str;

    /// Description of the columns, in order.
    fn description(&self) -> &'static [Column];

    /// Number of rows.
    fn rows(&self) -> usize;

    /// The columns as bytes, in order.
    fn columns(&self) -> Vec<&[u8]>;

    /// The columns as bytes to be filled, in order.
    fn columns_mut(&mut self) -> Vec<&mut [u8]>;

    /// Meaning of the words of a field in a row.
    fn kind(&self, row: usize, column: &Column, field: &Field) -> FieldKind;

    /// Name and number of rows.
    fn size(&self) -> StoreSize {
        StoreSize { store: self.name(), rows: self.rows() }
    }
}

/// Bytes of all columns of stores.
pub fn state_bytes(stores: &[&dyn Store]) -> usize {
    stores.iter().flat_map(|store| store.columns()).map(<[u8]>::len).sum()
}

/// Checks that stores of one list are as large as those of another.
///
/// # Errors
/// [`SimError::Size`] for the first that is not; one that the other list lacks has no rows there.
pub fn check_sizes(world: &[StoreSize], simulator: &[StoreSize]) -> Result<(), SimError> {
    let rows = |sizes: &[StoreSize], index: usize| sizes.get(index).map_or(0, |size| size.rows);
    for (index, StoreSize { store, .. }) in longer(world, simulator).iter().enumerate() {
        let (world, simulator) = (rows(world, index), rows(simulator, index));
        if world != simulator {
            return Err(SimError::Size { store, world, simulator });
        }
    }
    Ok(())
}

fn longer<'a>(a: &'a [StoreSize], b: &'a [StoreSize]) -> &'a [StoreSize] {
    if a.len() < b.len() { b } else { a }
}

/// Copies the rows of stores into others of the same kinds and sizes.
///
/// # Panics
/// If they are not as many, or of other sizes.
pub fn copy_stores(from: &[&dyn Store], to: &mut [&mut dyn Store]) {
    assert_eq!(from.len(), to.len(), "the same stores");
    for (from, to) in from.iter().zip(to) {
        for (from, to) in from.columns().into_iter().zip(to.columns_mut()) {
            to.copy_from_slice(from);
        }
    }
}

/// Rows whose hashes are computed together, column by column.
const HASH_ROWS: usize = 512;

/// A fingerprint of rows of stores: a sum over rows, so that it can be taken in any order. `rows` says which rows of a store, and which number
/// the first of them goes by.
pub fn hash_stores(stores: &[&dyn Store], rows: impl Fn(&dyn Store) -> (Range<usize>, u64)) -> u64 {
    (0..).zip(stores).fold(0u64, |sum, (index, store)| {
        let (rows, number) = rows(*store);
        sum.wrapping_add(hash_store(*store, rows, number, salt(index)))
    })
}

/// Salt that distinguishes the rows of one store of a world from those of another.
fn salt(index: u64) -> u64 {
    match index {
        0 => 0,
        1 => u64::MAX,
        _ => mix(0, index),
    }
}

/// Sum over rows of a store, the first of which goes by a number, of a hash of number and words: columns of single words first, then the others.
fn hash_store(store: &dyn Store, rows: Range<usize>, number: u64, salt: u64) -> u64 {
    let columns: Vec<_> =
        store.description().iter().map(|column| column.record_bytes).zip(store.columns()).collect();
    let is_narrow = |bytes: usize| bytes < size_of::<u64>();
    let narrow = columns.iter().filter(|column| is_narrow(column.0));
    let order: Vec<_> = narrow.chain(columns.iter().filter(|column| !is_narrow(column.0))).collect();
    let mut sum = 0u64;
    for first in rows.clone().step_by(HASH_ROWS) {
        let last = rows.end.min(first + HASH_ROWS);
        let mut hashes = [0; HASH_ROWS];
        let hashes = &mut hashes[..last - first];
        for (row, hash) in (number + (first - rows.start) as u64..).zip(hashes.iter_mut()) {
            *hash = row ^ salt;
        }
        for (bytes, column) in &order {
            for (hash, record) in
                hashes.iter_mut().zip(column[first * bytes..last * bytes].chunks_exact(*bytes))
            {
                let (words, rest) = record.as_chunks::<8>();
                *hash = words.iter().fold(*hash, |hash, word| mix(hash, u64::from_ne_bytes(*word)));
                if let Some(word) = rest.first_chunk::<4>() {
                    *hash = mix(*hash, u64::from(u32::from_ne_bytes(*word)));
                }
            }
        }
        sum = hashes.iter().fold(sum, |sum, hash| sum.wrapping_add(*hash));
    }
    sum
}

/// The bytes of a column.
pub fn column_bytes<T: Record>(column: &[T]) -> &[u8] {
    bytemuck::cast_slice(column)
}

/// The bytes of a column, to be filled.
pub fn column_bytes_mut<T: Record>(column: &mut [T]) -> &mut [u8] {
    bytemuck::cast_slice_mut(column)
}

/// Declares a [`Store`](crate::store::Store): a struct of columns, the records of one of its rows, and a run of its rows
/// that can be split among threads.
///
/// `kinds` names a function of a row's number, a column and a field for words whose meaning depends on the row.
#[macro_export]
macro_rules! columns {
    (
        $(#[$store_meta:meta])*
        pub struct $store:ident($name:literal) {
            $($(#[$meta:meta])* pub $column:ident: $record:ty,)+
        }
        $(#[$row_meta:meta])*
        row $row:ident;
        $(#[$run_meta:meta])*
        run $run:ident;
        $(kinds $kinds:path;)?
    ) => {
        $(#[$store_meta])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $store {
            $($(#[$meta])* pub $column: Vec<$record>,)+
        }

        impl $store {
            /// Name of what the rows are.
            pub const NAME: &'static str = $name;

            /// Description of the columns.
            pub const COLUMNS: &'static [$crate::store::Column] =
                &[$($crate::store::Column::of::<$record>(stringify!($column)),)+];

            /// Bytes of a row, over all columns.
            pub const ROW_BYTES: usize = 0 $(+ size_of::<$record>())+;

            /// A store of `count` rows of zeros.
            pub fn zeroed(count: usize) -> Self {
                Self { $($column: vec![<$record>::default(); count],)+ }
            }

            /// Number of rows.
            pub fn len(&self) -> usize {
                [$(self.$column.len(),)+][0]
            }

            /// Returns true if there are no rows.
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// All rows, to be split among threads.
            pub fn as_mut(&mut self) -> $run<'_> {
                $run { $($column: &mut self.$column,)+ }
            }
        }

        impl $crate::store::Store for $store {
            fn name(&self) -> &'static str {
                Self::NAME
            }

            fn description(&self) -> &'static [$crate::store::Column] {
                Self::COLUMNS
            }

            fn rows(&self) -> usize {
                self.len()
            }

            fn columns(&self) -> Vec<&[u8]> {
                vec![$($crate::store::column_bytes(&self.$column),)+]
            }

            fn columns_mut(&mut self) -> Vec<&mut [u8]> {
                vec![$($crate::store::column_bytes_mut(&mut self.$column),)+]
            }

            #[allow(unused_variables, unreachable_code, reason = "stores without words of changing meaning")]
            fn kind(
                &self,
                row: usize,
                column: &$crate::store::Column,
                field: &$crate::store::Field,
            ) -> $crate::store::FieldKind {
                $(return $kinds(self, row, column, field);)?
                field.kind
            }
        }

        $(#[$row_meta])*
        #[derive(Debug)]
        pub struct $row<'a> {
            $($(#[$meta])* pub $column: &'a mut $record,)+
        }

        $(#[$run_meta])*
        #[derive(Debug)]
        pub struct $run<'a> {
            $($(#[$meta])* pub $column: &'a mut [$record],)+
        }

        impl<'a> $run<'a> {
            /// Number of rows.
            pub fn len(&self) -> usize {
                [$(self.$column.len(),)+][0]
            }

            /// Returns true if there are no rows.
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// The first `count` rows and the others.
            pub fn split_at(self, count: usize) -> (Self, Self) {
                $(let $column = self.$column.split_at_mut(count);)+
                (Self { $($column: $column.0,)+ }, Self { $($column: $column.1,)+ })
            }

            /// The records of one row.
            pub fn row_mut(&mut self, row: usize) -> $row<'_> {
                $row { $($column: &mut self.$column[row],)+ }
            }

            /// Row after row.
            pub fn iter_mut(&mut self) -> impl Iterator<Item = $row<'_>> {
                $(let mut $column = self.$column.iter_mut();)+
                core::iter::from_fn(move || Some($row { $($column: $column.next()?,)+ }))
            }
        }
    };
}
