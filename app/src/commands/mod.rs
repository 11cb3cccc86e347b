// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One file per command, each with its options and what it does; and what several of them share.

pub mod bench;
pub mod export;
pub(crate) mod figure;
pub mod flight;
pub mod info;
pub mod leaf;
pub mod motions;
pub mod output_file;
pub(crate) mod output_folder;
pub mod render;
pub mod report;
pub mod scene;
pub mod simulate;
pub mod sky;
pub mod stepping;
pub mod study;
pub mod swaying;
pub mod tracks;
pub mod tree;
pub mod view;
