// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A tree at rest: straight segments from the foot to the twigs, and the places where leaves and fruit grow.
//!
//! Either source, an L-system or a file, gives the same structure. The tree's frame has its origin at the foot of the
//! trunk, y up, lengths in metres.

use glam::Vec3;
use thiserror::Error;

/// Most segments that one tree may have.
pub const MAX_SEGMENTS: usize = 65_536;
/// Most leaves and fruit that one tree may have.
pub const MAX_ATTACHMENTS: usize = 1 << 20;
/// Shortest segment in metres.
pub const MIN_LENGTH_M: f32 = 1e-4;

/// A straight piece of wood between two joints, a truncated cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// The segment that this one grows from, an earlier one; `None` for the trunk's first.
    pub parent: Option<u32>,
    /// Lower end in metres, on the parent.
    pub start_m: Vec3,
    /// Upper end in metres.
    pub end_m: Vec3,
    /// Radius at the lower end in metres.
    pub start_radius_m: f32,
    /// Radius at the upper end in metres.
    pub end_radius_m: f32,
    /// Branches passed on the way here: 0 on the trunk.
    pub order: u32,
}

impl Segment {
    /// Length in metres.
    pub fn length_m(&self) -> f32 {
        self.start_m.distance(self.end_m)
    }

    /// Unit vector from the lower to the upper end.
    pub fn direction(&self) -> Vec3 {
        (self.end_m - self.start_m).normalize_or(Vec3::Y)
    }
}

/// Organ at an attachment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AttachmentKind {
    /// A leaf.
    Leaf,
    /// A fruit.
    Fruit,
}

/// A place where a leaf or a fruit grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// Segment that it grows on.
    pub segment: u32,
    /// Organ that grows there.
    pub kind: AttachmentKind,
    /// Base of the petiole in metres, on the bark.
    pub at_m: Vec3,
    /// Unit vector from the base of the petiole to the tip of the leaf.
    pub direction: Vec3,
    /// Unit vector that the upper side faces, at a right angle to `direction`.
    pub normal: Vec3,
}

/// A tree at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// Segments, each after its parent.
    pub segments: Vec<Segment>,
    /// Leaves and fruit at full crown.
    pub attachments: Vec<Attachment>,
}

/// A skeleton that no tree can have.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SkeletonError {
    /// No segment at all.
    #[error("the tree has no segments")]
    Empty,
    /// Too many segments.
    #[error("the tree has {found} segments; allowed are up to {MAX_SEGMENTS}")]
    Segments {
        /// Number of segments.
        found: usize,
    },
    /// Too many attachments.
    #[error("the tree bears {found} leaves and fruit; allowed are up to {MAX_ATTACHMENTS}")]
    Attachments {
        /// Number of attachments.
        found: usize,
    },
    /// A segment that is not after its parent, or a second trunk.
    #[error("segment {segment} grows from {parent}; allowed is an earlier one, and none for segment 0 alone")]
    Parent {
        /// Index of the segment.
        segment: usize,
        /// Parent that it names.
        parent: String,
    },
    /// A segment whose ends are too close together, or not numbers.
    #[error("segment {segment} is {length_m} m long; allowed are {MIN_LENGTH_M} m and more")]
    Length {
        /// Index of the segment.
        segment: usize,
        /// Its length in metres.
        length_m: f32,
    },
    /// A radius that is not a positive number.
    #[error("segment {segment} has a radius of {radius_m} m; allowed are numbers above 0")]
    Radius {
        /// Index of the segment.
        segment: usize,
        /// The radius in metres.
        radius_m: f32,
    },
    /// An attachment to no segment, or with numbers that are none.
    #[error("attachment {attachment}: {reason}")]
    Attachment {
        /// Index of the attachment.
        attachment: usize,
        /// Fault.
        reason: String,
    },
}

impl Skeleton {
    /// Checks what the rest of the engine relies on.
    ///
    /// # Errors
    /// [`SkeletonError`] for the first thing that is not allowed.
    pub fn validate(&self) -> Result<(), SkeletonError> {
        if self.segments.is_empty() {
            return Err(SkeletonError::Empty);
        }
        if self.segments.len() > MAX_SEGMENTS {
            return Err(SkeletonError::Segments { found: self.segments.len() });
        }
        if self.attachments.len() > MAX_ATTACHMENTS {
            return Err(SkeletonError::Attachments { found: self.attachments.len() });
        }
        for (index, segment) in self.segments.iter().enumerate() {
            let is_after = match segment.parent {
                None => index == 0,
                Some(parent) => (parent as usize) < index,
            };
            if !is_after {
                let parent = segment.parent.map_or_else(|| "nothing".into(), |parent| parent.to_string());
                return Err(SkeletonError::Parent { segment: index, parent });
            }
            let length_m = segment.length_m();
            if !(length_m >= MIN_LENGTH_M && length_m.is_finite()) {
                return Err(SkeletonError::Length { segment: index, length_m });
            }
            for radius_m in [segment.start_radius_m, segment.end_radius_m] {
                if !(radius_m > 0.0 && radius_m.is_finite()) {
                    return Err(SkeletonError::Radius { segment: index, radius_m });
                }
            }
        }
        for (index, attachment) in self.attachments.iter().enumerate() {
            let reject =
                |reason: &str| SkeletonError::Attachment { attachment: index, reason: reason.into() };
            if attachment.segment as usize >= self.segments.len() {
                return Err(reject("it names a segment that is not there"));
            }
            if !attachment.at_m.is_finite() {
                return Err(reject("its place is not a number"));
            }
            let is_frame = attachment.direction.is_normalized()
                && attachment.normal.is_normalized()
                && attachment.direction.dot(attachment.normal).abs() < 1e-3;
            if !is_frame {
                return Err(reject("direction and normal are not unit vectors at a right angle"));
            }
        }
        Ok(())
    }

    /// Height of the highest point in metres.
    pub fn height_m(&self) -> f32 {
        self.segments.iter().map(|segment| segment.end_m.y).fold(0.0, f32::max)
    }

    /// Most segments from the foot to a tip.
    pub fn depth(&self) -> u32 {
        let mut depths: Vec<u32> = Vec::with_capacity(self.segments.len());
        for segment in &self.segments {
            depths.push(segment.parent.map_or(1, |parent| depths[parent as usize] + 1));
        }
        depths.into_iter().max().unwrap_or(0)
    }
}
