// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Puts together what shards of a scene have written: reports, tables, USD stages.

pub(crate) mod reports;
pub(crate) mod shard_files;
pub(crate) mod stages;
pub(crate) mod tables;
