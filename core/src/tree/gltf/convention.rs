// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Our conventions beyond plain glTF, stated once for reading and writing.

use serde::{Deserialize, Serialize};

/// Vertex attribute of attachment points, a `VEC3` of floats: unit vector from the base of the petiole to the tip of the
/// leaf. Beside it `NORMAL` is the unit vector that the upper side faces and `JOINTS_0` names the segment.
pub const DIRECTION: &str = "_DIRECTION";

/// Vertex attribute of attachment points, a `SCALAR` float: 0 for a leaf, 1 for a fruit.
pub const BEARING: &str = "_BEARING";

/// Vertex attribute of the bark, a `VEC4` of floats from 0 to 1, for shaders that bend a tree without joints:
///
/// | component | meaning | 0 | 1 |
/// |---|---|---|---|
/// | x | sway of the whole tree: height over that of the tree, squared | at the foot | at the top |
/// | y | phase of the branch: the same for a branch of the trunk and all that grows on it | the trunk | – |
/// | z | bending of the branch: way from the trunk over the longest such way | on the trunk | at the farthest tip |
/// | w | flutter: how thin the wood is, against the trunk | from a tenth of its radius | below a hundredth |
///
/// On request the same numbers stand in `COLOR_0` too, red to alpha, where engines look for them.
pub const WIND_WEIGHT: &str = "_WINDWEIGHT";

/// Numbers of a segment that the `extras` of its joint's node may give.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct JointExtras {
    /// Length in metres from the joint along its y axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) length_m: Option<f32>,
    /// Radius at the lower and the upper end in metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) radius_m: Option<[f32; 2]>,
    /// Branches passed on the way from the foot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) order: Option<u32>,
}
