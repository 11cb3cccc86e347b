// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes, leaf stores and the physics of falling leaves as pure functions.

pub mod error;
pub mod motion;
pub mod scene;

pub use error::{SceneError, SimError};
pub use scene::Scene;
