// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Largest differences between two states.

use std::fmt;

use windfall_core::World;
use windfall_core::leaf::Leaves;
use windfall_core::store::{FieldKind, Store};
use windfall_core::tree::Branches;

/// Largest difference of positions after a thousand smooth steps under the tolerant contract, in metres: twice and a half the largest that an NVIDIA
/// H200 was seen to differ by (0.41 mm; lavapipe: 0.12 mm).
pub const LONG_POSITION_M: f32 = 1e-3;
/// One in so many leaves may then have landed a step earlier or later, or have begun another motion, and gone another way.
pub const LONG_OTHERS: u32 = 1000;
/// Largest difference of quaternion components after a thousand smooth steps under the tolerant contract.
pub const LONG_QUATERNION: f32 = 1e-5;
/// Units in the last place of the largest operand that one step may differ by under the tolerant contract.
pub const STEP_ULPS: f32 = 4.0;
/// Largest difference of a segment's place in metres, and of the components of its orientation, after one step under the
/// tolerant contract. On hills the height above the ground that the wind grows with has its own rounding: 1.05e-5 was seen.
pub const STEP_SEGMENT: f32 = 2e-5;

/// Differences between the stores of two worlds.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference(Vec<StoreDifference>);

/// Differences between two stores.
#[derive(Clone, PartialEq)]
pub struct StoreDifference {
    /// Name of what the rows are.
    pub store: &'static str,
    /// Rows with any integer that differs.
    pub integer_rows: usize,
    /// Rows with any bit that differs.
    pub bit_rows: usize,
    /// Column and field, and the largest difference of its floats in rows whose integers are the same: infinite in any where one is not a number and the
    /// other another.
    fields: Vec<(String, f32)>,
    /// First field that differs in any bit, with its row and its words in hexadecimal.
    first: Option<String>,
}

impl Difference {
    /// Returns true if every bit is the same.
    pub fn is_none(&self) -> bool {
        self.0.iter().all(|store| store.bit_rows == 0)
    }

    /// Returns true if no float is infinitely far from its twin.
    pub fn is_finite(&self) -> bool {
        self.0.iter().flat_map(|store| &store.fields).all(|(_, largest)| largest.is_finite())
    }

    /// Differences between the stores of this name.
    ///
    /// # Panics
    /// If the worlds have none.
    pub fn of(&self, store: &str) -> &StoreDifference {
        let found = self.0.iter().find(|found| found.store == store);
        found.unwrap_or_else(|| panic!("no {store} in a world"))
    }

    /// The leaves'.
    pub fn leaves(&self) -> &StoreDifference {
        self.of(Leaves::NAME)
    }

    /// The segments'.
    pub fn segments(&self) -> &StoreDifference {
        self.of(Branches::NAME)
    }
}

impl StoreDifference {
    /// Largest difference of the floats of a field in rows whose integers are the same, named as `column.field`, or as `column` if the records have but one.
    ///
    /// # Panics
    /// If there is no such field.
    pub fn largest(&self, name: &str) -> f32 {
        let found = self.fields.iter().find(|(field, _)| field == name);
        found.unwrap_or_else(|| panic!("{} have no {name}", self.store)).1
    }
}

impl fmt::Debug for StoreDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { store, integer_rows, bit_rows, fields, first: _ } = self;
        write!(f, "{bit_rows} {store} differ, {integer_rows} in integers")?;
        let apart = fields.iter().filter(|(_, largest)| *largest > 0.0);
        apart.clone().try_for_each(|(name, largest)| write!(f, ", {name} by {largest:e}"))?;
        self.first.iter().try_for_each(|first| write!(f, "; first {first}"))
    }
}

/// Compares all stores of two worlds, row by row.
pub fn difference(a: &World, b: &World) -> Difference {
    difference_of(&a.stores(), &b.stores())
}

/// Compares stores with others of the same kinds and sizes, row by row.
///
/// # Panics
/// If they are of other sizes.
pub fn difference_of(a: &[&dyn Store], b: &[&dyn Store]) -> Difference {
    assert_eq!(a.len(), b.len(), "the same stores");
    Difference(a.iter().zip(b).map(|(a, b)| compare(*a, *b)).collect())
}

fn compare(a: &dyn Store, b: &dyn Store) -> StoreDifference {
    assert_eq!(a.size(), b.size(), "the same store");
    let description = a.description();
    let names = description.iter().flat_map(|column| {
        column.fields.iter().map(|field| match field.name {
            "" => column.name.to_owned(),
            name => format!("{}.{name}", column.name),
        })
    });
    let mut fields: Vec<_> = names.map(|name| (name, 0f32)).collect();
    let (columns_a, columns_b) = (a.columns(), b.columns());
    let mut distances = vec![0f32; fields.len()];
    let (mut integer_rows, mut bit_rows) = (0, 0);
    let mut first = None;
    for row in 0..a.rows() {
        let (mut same_bits, mut same_integers) = (true, true);
        distances.fill(0.0);
        let mut place = 0;
        for (index, column) in description.iter().enumerate() {
            let record = row * column.record_bytes..(row + 1) * column.record_bytes;
            let (record_a, record_b) = (&columns_a[index][record.clone()], &columns_b[index][record]);
            let places = place..place + column.fields.len();
            place = places.end;
            if record_a == record_b {
                continue;
            }
            same_bits = false;
            let mut start = 0;
            for (field, number) in column.fields.iter().zip(places) {
                let bytes = start..start + 4 * field.words;
                start = bytes.end;
                let (field_a, field_b) = (&record_a[bytes.clone()], &record_b[bytes]);
                if field_a != field_b && first.is_none() {
                    let name = &fields[number].0;
                    first = Some(format!("{name} of {row}: {:x?} and {:x?}", words(field_a), words(field_b)));
                }
                let is_float = [a, b].iter().any(|store| store.kind(row, column, field) == FieldKind::Float);
                if is_float {
                    distances[number] = distance(field_a, field_b);
                } else {
                    same_integers &= field_a == field_b;
                }
            }
        }
        for ((_, largest), distance) in fields.iter_mut().zip(&distances) {
            if same_integers || distance.is_infinite() {
                *largest = largest.max(*distance);
            }
        }
        integer_rows += usize::from(!same_integers);
        bit_rows += usize::from(!same_bits);
    }
    StoreDifference { store: a.name(), integer_rows, bit_rows, fields, first }
}

fn words(field: &[u8]) -> Vec<u32> {
    field.as_chunks::<4>().0.iter().map(|word| u32::from_ne_bytes(*word)).collect()
}

/// Largest difference of floats that differ in any bit; infinite if it is not a number.
fn distance(a: &[u8], b: &[u8]) -> f32 {
    let floats = |bytes: &[u8]| -> Vec<f32> {
        bytes.as_chunks::<4>().0.iter().map(|word| f32::from_ne_bytes(*word)).collect()
    };
    let apart = |(a, b): (f32, f32)| {
        let distance = if a.to_bits() == b.to_bits() { 0.0 } else { (a - b).abs() };
        if distance.is_nan() { f32::INFINITY } else { distance }
    };
    floats(a).into_iter().zip(floats(b)).map(apart).fold(0.0, f32::max)
}

/// Size of a unit in the last place of `x`.
pub fn ulp(x: f32) -> f32 {
    let a = x.abs().max(f32::MIN_POSITIVE);
    f32::from_bits(a.to_bits() + 1) - a
}
