// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A wind of the caller's own in place of the turbulence.

use glam::DVec3;

use super::CompiledScene;
use crate::convert::single;
use crate::device::wind::turbulence::{
    TURBULENCE_NODES, TURBULENCE_UNIT, TURBULENCE_X, TURBULENCE_Y, TURBULENCE_Z, turbulence_rows,
};

impl CompiledScene {
    /// Replaces the turbulence by a wind of the caller's, which comes on top of mean wind, gusts, vortices, jets and plumes: both
    /// backends read it as they read turbulence, with the same bits, once it has been handed to them
    /// ([`Simulator::set_scene`](crate::Simulator::set_scene)) or a world with it has.
    ///
    /// `velocity` is asked for the velocity in m/s at places in metres. Both are in the wind's frame: x along the mean
    /// wind, y up from the ground's height, z across to the right of it; with `direction_deg: 0.0` these are the scene's
    /// axes. It is sampled at the nodes of a box of 64 x 32 x 32 cells, [`CompiledScene::wind_cell_m`] large each, from
    /// the origin on; between nodes it is interpolated, beyond the box it repeats, and the mean wind carries it along: in a
    /// scene without mean wind it stays. A component is stored in 16 bits of its largest value.
    ///
    /// For a wind that changes with time, call this every few steps. [`CompiledScene::retune`] and checkpoints go
    /// back to the scene's own turbulence.
    pub fn set_wind_field(&mut self, velocity: impl Fn(DVec3) -> DVec3) {
        let cell_m = self.wind_cell_m();
        let count = TURBULENCE_NODES as usize;
        let (x, y) = (TURBULENCE_X as usize, TURBULENCE_Y as usize);
        let place =
            |node: usize| DVec3::new((node % x) as f64, (node / x % y) as f64, (node / (x * y)) as f64);
        debug_assert_eq!(count, x * y * TURBULENCE_Z as usize, "a box of nodes");
        let field: Vec<DVec3> = (0..count).map(|node| velocity(place(node) * cell_m)).collect();
        let largest = field.iter().fold(DVec3::ZERO, |most, velocity| most.max(velocity.abs()));
        // What a packed component of one stands for; never zero, for that would say that there is no field.
        let full = f64::from(TURBULENCE_UNIT) * 32767.0;
        let unit = (largest / full).max(DVec3::splat(1e-9)).to_array().map(single);
        let nodes: Vec<[f32; 3]> = field
            .iter()
            .map(|velocity| {
                let parts = velocity.to_array();
                std::array::from_fn(|axis| single(parts[axis] / f64::from(unit[axis])))
            })
            .collect();
        self.replace_rows(self.block.wind.first_turbulence_row, &turbulence_rows(&nodes));
        self.block.wind.deviation_m_s = unit;
    }

    /// Size of a cell of the box that [`CompiledScene::set_wind_field`] samples, in metres: along the wind
    /// `wind.turbulence.cell_m`, upwards 0.5 and across 0.8 of it.
    pub fn wind_cell_m(&self) -> DVec3 {
        glam::Vec3::from(self.block.wind.cells_per_m).as_dvec3().recip()
    }
}
