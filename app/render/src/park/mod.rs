// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The park around the leaves: far trees and litter, painted and planted once on the CPU, with no effect on the simulation.

pub(crate) mod far_trees;
pub(crate) mod layout;
mod leaf_grid;
pub(crate) mod litter;
pub(crate) mod near_trees;
pub(crate) mod park_trees;
pub(crate) mod still_leaves;
pub(crate) mod sway;
mod tree_canvas;
mod tree_sprite;

use crate::gpu::shaders::{Shaders, declarations, wgsl_files};

/// Shader modules of this room and of those below.
pub(crate) fn shaders() -> Shaders {
    let mut shaders = crate::frame::shaders();
    shaders.extend([(
        "park/structs",
        declarations([tree_sprite::wgsl_constants()])
            + &layout::TreeInstance::declaration()
            + &sway::wgsl_declarations(),
    )]);
    shaders.extend(wgsl_files!("park": "far_trees", "sway"));
    shaders
}
