// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One file or folder per command, each with its options and what it does. Nothing but the command line imports them.

pub(crate) mod bench;
pub(crate) mod completions;
pub(crate) mod drift;
pub(crate) mod export;
pub(crate) mod flight;
pub(crate) mod info;
pub(crate) mod leaf;
pub(crate) mod litter;
pub(crate) mod man;
pub(crate) mod merge;
pub(crate) mod motions;
pub(crate) mod render;
pub(crate) mod simulate;
pub(crate) mod study;
pub(crate) mod tree;
pub(crate) mod view;
