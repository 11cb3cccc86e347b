// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Stepping to the present, and landings.

use bevy::prelude::*;
use windfall_core::device::leaf::burn::scene_species;

use crate::fall::FallError;
use crate::leaves::Leaves;
use crate::plugin::WindfallSettings;

/// A leaf has come to rest in this frame. One that the wind takes up again lands again.
#[derive(Message, Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// Entity of the [`Fall`](crate::Fall).
    pub fall: Entity,
    /// Slot of the leaf, for [`Leaves::leaf`].
    pub slot: usize,
    /// Index of its species in the scene.
    pub species: usize,
    /// Place in the world in metres.
    pub position: Vec3,
}

/// Steps every fall by the time that has passed.
///
/// Time is that of the schedule, Bevy's virtual time, so leaves stop and slow down with it. What is less than a step waits for the next frame.
pub(crate) fn step(
    mut commands: Commands,
    mut falls: Query<(Entity, &GlobalTransform, &mut Leaves)>,
    mut landings: MessageWriter<Landing>,
    time: Res<Time>,
    settings: Res<WindfallSettings>,
) {
    for (fall, frame, mut leaves) in &mut falls {
        let step_s = f64::from(leaves.step_s());
        let owed_s = leaves.owed_s + time.delta_secs_f64();
        let most = settings.most_steps_per_frame.max(1);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped before")]
        let steps = (owed_s / step_s).floor().clamp(0.0, f64::from(most)) as u32;
        leaves.owed_s = (owed_s - f64::from(steps) * step_s).min(step_s);
        if steps == 0 {
            continue;
        }
        if let Err(error) = leaves.advance(steps) {
            error!("{error}");
            commands.entity(fall).remove::<Leaves>().insert(FallError::Simulator(error));
            continue;
        }
        let landed = leaves.landed();
        let context = leaves.context();
        landings.write_batch(landed.into_iter().map(|slot| {
            let place = leaves.place()[slot];
            Landing {
                fall,
                slot,
                species: scene_species(&context, place.bits) as usize,
                position: frame.transform_point(place.position.into()),
            }
        }));
    }
}
