// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The wind for other systems.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;

use crate::leaves::Leaves;

/// The wind that leaves feel, for cloth, grass, smoke and sound: a parameter of systems.
#[derive(SystemParam)]
pub struct Wind<'w, 's> {
    falls: Query<'w, 's, (&'static Leaves, &'static GlobalTransform)>,
}

impl Wind<'_, '_> {
    /// Velocity of the air in m/s at a point of the world in metres. Where there are several falls it is that of the nearest; without any
    /// the air stands still.
    pub fn at(&self, point: Vec3) -> Vec3 {
        let distance = |frame: &GlobalTransform| frame.translation().distance_squared(point);
        let nearest = self.falls.iter().min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
        nearest.map_or(Vec3::ZERO, |(leaves, frame)| {
            let (_, rotation, _) = frame.to_scale_rotation_translation();
            let local = frame.affine().inverse().transform_point3(point);
            rotation * leaves.wind_at(local)
        })
    }
}
