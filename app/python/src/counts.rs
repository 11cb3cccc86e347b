// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Counts over a world as dictionaries, with the names that the JSON of `windfall simulate` has.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use windfall_core::litter::LitterStats;
use windfall_core::particle::ParticleStats;
use windfall_core::{LeafStats, World};

/// Counts over a world.
pub(crate) struct Counts {
    leaves: LeafStats,
    litter: Option<LitterStats>,
    particles: Vec<ParticleStats>,
}

impl Counts {
    /// Those of a world as it is.
    pub(crate) fn of(world: &World) -> Self {
        let (litter, particles) = (world.litter_stats(), world.particle_stats());
        Self { leaves: world.stats().leaves, litter, particles }
    }

    /// The same for Python.
    pub(crate) fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        all.set_item("leaves", leaf_dict(py, &self.leaves)?)?;
        all.set_item("litter", self.litter.map(|litter| litter_dict(py, &litter)).transpose()?)?;
        let populations = self.particles.iter().map(|population| particle_dict(py, population));
        all.set_item("particles", populations.collect::<PyResult<Vec<_>>>()?)?;
        Ok(all)
    }
}

fn leaf_dict<'py>(py: Python<'py>, stats: &LeafStats) -> PyResult<Bound<'py, PyDict>> {
    let LeafStats { attached, falling, resting, dormant, .. } = stats;
    let dict = PyDict::new(py);
    dict.set_item("total", stats.total())?;
    for (name, count) in
        [("attached", attached), ("falling", falling), ("resting", resting), ("dormant", dormant)]
    {
        dict.set_item(name, count)?;
    }
    Ok(dict)
}

fn litter_dict<'py>(py: Python<'py>, stats: &LitterStats) -> PyResult<Bound<'py, PyDict>> {
    let LitterStats { lying, held, afloat, sunk, awake, woken, deepest_m, volume_m3, mass_kg } = stats;
    let dict = PyDict::new(py);
    for (name, count) in [
        ("lying", lying),
        ("held", held),
        ("afloat", afloat),
        ("sunk", sunk),
        ("awake", awake),
        ("woken", woken),
    ] {
        dict.set_item(name, count)?;
    }
    for (name, number) in [("deepest_m", deepest_m), ("volume_m3", volume_m3), ("mass_kg", mass_kg)] {
        dict.set_item(name, number)?;
    }
    Ok(dict)
}

fn particle_dict<'py>(py: Python<'py>, stats: &ParticleStats) -> PyResult<Bound<'py, PyDict>> {
    let ParticleStats { name, slots, alive, born, died, hits, stopped, cut_short } = stats;
    let dict = PyDict::new(py);
    dict.set_item("name", name)?;
    for (name, count) in [
        ("slots", slots),
        ("alive", alive),
        ("born", born),
        ("died", died),
        ("hits", hits),
        ("stopped", stopped),
        ("cut_short", cut_short),
    ] {
        dict.set_item(name, count)?;
    }
    Ok(dict)
}
