// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A leaf that is drawn, and the draws of a page: written by the culling, read by vertex shaders.

use windfall_core::layout::Float4;
use windfall_core::leaf::Place;
use windfall_core::{shared_constants, shared_struct};

/// Bytes of a record of a column.
pub(crate) const COLUMN_BYTES: u64 = size_of::<Place>() as u64;

shared_constants! {
    /// Place of the slot within its page in [`LeafRecord::layer_slot`].
    pub(crate) const SLOT_SHIFT: u32 = 12;
    /// Mask of the layer there.
    const LAYER_MASK: u32 = 0xfff;
    /// Height of the lowest point of a leaf at rest, on the leaves below it, above the ground in metres.
    const LITTER_M: f32 = 0.005;
    /// Edge of a picture in diameters of the disc with the leaf's area, roughly.
    pub(crate) const PICTURE_EDGE: f32 = 1.6;
    /// Place of the level of detail above the bits of the copies that are kept.
    const LEVEL_SHIFT: u32 = 30;
    /// A listed leaf is its slot, and from here on which copy it is.
    const COPY_SHIFT: u32 = 20;
    /// Slots that one thread of the culling goes through, in order.
    pub(crate) const SLOTS_PER_THREAD: u32 = 32;
    /// Invocations per workgroup of the culling.
    pub(crate) const CULL_GROUP_SIZE: u32 = 64;
}

shared_struct! {
    /// A leaf of a view, ready for its corners.
    pub(crate) struct LeafRecord {
        /// Middle of the blade.
        pub(crate) center_m: [f32; 3],
        /// Edge of its picture, negative if the picture is mirrored.
        pub(crate) edge_m: f32,
        /// Attitude, x and y.
        pub(crate) attitude_xy: u32,
        /// Attitude, z and w.
        pub(crate) attitude_zw: u32,
        /// Stage of drying, and fold.
        stage_fold: u32,
        /// Bend, and twist.
        bend_twist: u32,
        /// Layer, and slot within the page.
        pub(crate) layer_slot: u32,
        /// Factors on red and green.
        red_green: u32,
        /// Factor on blue, and share of open sky.
        blue_open: u32,
        /// Direction out of the crown, as far as the leaf is one of its surface, and how far it has come to rest.
        pub(crate) outward_settled: u32,
    }
}

shared_struct! {
    /// Arguments of an indirect draw, and what its vertices ask for.
    pub(crate) struct LeafDraw {
        vertex_count: u32,
        pub(crate) instance_count: u32,
        first_vertex: u32,
        first_instance: u32,
        /// First record of the level.
        pub(crate) first_record: u32,
        /// Level of detail.
        pub(crate) level: u32,
        unused: [u32; 2],
    }
}

shared_struct! {
    /// Light on a leaf of a few pixels, in halves.
    pub(crate) struct LeafLight {
        /// On the side that is seen: red and green.
        front_rg: u32,
        /// Its blue, and red on the other side.
        front_b_back_r: u32,
        /// Green and blue on the other side.
        back_gb: u32,
        /// Mirrored by the wax: red and green.
        mirrored_rg: u32,
        /// Its blue, and clearness of the blade, negative if its lower side is seen.
        mirrored_b_clear: u32,
        /// Light of the air before it: red and green.
        air_rg: u32,
        /// Its blue, and share that the air lets through.
        air_ba: u32,
        /// Shares in bytes: of light that other leaves send back, settled, wet, of snow.
        shares: u32,
    }
}

shared_struct! {
    /// Slots that are culled together.
    pub(crate) struct PageUniform {
        /// First slot.
        pub(crate) first: u32,
        /// Most slots.
        pub(crate) count: u32,
        /// Threads that go through them.
        pub(crate) threads: u32,
        /// Records of trees, with that of no tree.
        pub(crate) trees: u32,
    }
}

shared_struct! {
    /// Sides and scale of a view, by which leaves are culled.
    pub(crate) struct ViewUniform, padding 8 {
        /// Inward unit normals of the view's sides, and their distances from the origin.
        pub(crate) sides: [Float4; 6],
        /// Camera; anything in a parallel projection.
        pub(crate) eye_m: [f32; 3],
        /// Pixels of a metre at a distance of a metre, or anywhere in a parallel projection.
        pub(crate) pixels_per_m: f32,
        /// Least edge in pixels of pictures of leaves that are drawn as coarse meshes.
        pub(crate) coarse_px: f32,
        /// The same of medium meshes.
        pub(crate) medium_px: f32,
        /// The same of fine meshes.
        pub(crate) fine_px: f32,
        /// Edge in pixels below which leaves are thinned out.
        pub(crate) thin_px: f32,
        /// Least share of leaves that are kept.
        pub(crate) least_share: f32,
        /// 1 if the projection is parallel, else 0.
        pub(crate) is_parallel: u32,
    }
}
