// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Motion tables and trajectory features, as leaves read them.

pub mod feature;
pub mod lookup;
