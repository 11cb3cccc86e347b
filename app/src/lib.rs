// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The application as a library: camera, renderer, writers of pictures and the commands that use them, none of which
//! needs a window.

pub mod backend;
pub mod baseline;
pub mod camera;
pub mod cli;
pub mod commands;
pub mod drawing;
pub mod export;
pub mod frame;
pub mod interrupt;
pub mod land;
pub mod leaves;
pub mod light;
pub mod output;
pub mod render;
pub mod studio;
pub mod study;
pub mod terminal;
pub mod trees;
pub mod viewer;
