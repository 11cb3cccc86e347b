// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Hills: how they are made, and how kernels see them.

pub mod ground;
pub mod subdivision;
