// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies of leaves from a folder, by its manifest.

use std::path::Path;

use windfall_core::Scene;
use windfall_core::scene::{Aerodynamics, FlightModel, NamedFiles, PetioleRod, Planform, Species, limits};
use windfall_texgen::{BodyFacts, LeafFacts, Manifest, PetioleFacts};

use super::in_season;

/// The scene that a preset's name or a file's path stands for, its bodies fitted to their folders.
///
/// # Errors
/// A scene or a folder that cannot be used, files outside the scene's folder unless `allowed`, or leaves of sizes and masses that no scene may
/// have.
pub fn load_scene(name: &str, allowed: NamedFiles) -> anyhow::Result<Scene> {
    let mut scene = Scene::load_naming(name, allowed)?;
    if fit_bodies(&mut scene)? {
        scene.validate(name)?;
    }
    Ok(scene)
}

/// Gives every species that flies as a body, names a folder and states no planform the build of the folder's leaves
/// of its season: mean area and mass, how the area lies, their petioles and, if the leaves have meshes, how hollow they are. What the
/// scene says of its moisture and its petiole comes on top. A planform in the scene keeps all of the scene's own numbers. Whether
/// there was such a species.
///
/// # Errors
/// A folder whose manifest cannot be used.
pub fn fit_bodies(scene: &mut Scene) -> anyhow::Result<bool> {
    let mut is_any = false;
    for species in &mut scene.species {
        if let (FlightModel::Aerodynamic(body), Some(path)) = (species.flight, &species.leaves)
            && body.planform.is_none()
        {
            let manifest = Manifest::load(path.as_ref())?;
            fit(species, &in_season(&manifest.leaves, species.season));
            is_any = true;
        }
    }
    Ok(is_any)
}

/// Body of the leaves in a folder. Numbers that the folder does not have are those of the kind that its leaves are named after.
///
/// # Errors
/// A folder whose manifest cannot be used.
pub(crate) fn species_of_folder(path: &Path) -> anyhow::Result<Species> {
    let manifest = Manifest::load(path)?;
    let leaves: Vec<&LeafFacts> = manifest.leaves.iter().collect();
    let kind = leaves.first().and_then(|leaf| leaf.name.rsplit_once('-')).map(|(kind, _)| kind);
    let dry = Aerodynamics { moisture: 0.0, ..Aerodynamics::default() };
    let plain = || Species { flight: FlightModel::Aerodynamic(dry), ..Species::default() };
    let mut species = kind.and_then(Species::preset).unwrap_or_else(plain);
    fit(&mut species, &leaves);
    Ok(species)
}

/// Fits one species to leaves, at least one.
fn fit(species: &mut Species, leaves: &[&LeafFacts]) {
    let mean = |value: &dyn Fn(&LeafFacts) -> f32| {
        leaves.iter().map(|leaf| value(leaf)).sum::<f32>() / leaves.len() as f32
    };
    let (area, mass) = (mean(&|leaf| leaf.area_m2), mean(&|leaf| leaf.mass_kg));
    species.size_m = (area / std::f32::consts::FRAC_PI_4).sqrt();
    species.areal_density_kg_m2 = mass / area;
    let FlightModel::Aerodynamic(body) = &mut species.flight else { return };
    let bodies: Vec<BodyFacts> = leaves.iter().filter_map(|leaf| leaf.body).collect();
    if bodies.is_empty() {
        return;
    }
    let mean = |value: fn(&BodyFacts) -> f32| bodies.iter().map(value).sum::<f32>() / bodies.len() as f32;
    body.planform = Some(Planform {
        aspect: mean(|body| body.aspect),
        // Pixels may fall a hair short of what any area must reach.
        extent: mean(|body| body.extent).max(limits::EXTENT.low),
    });
    body.petiole = body.petiole.or_else(|| mean_petiole(&bodies)).or_else(|| species.shape.petiole());
    if leaves.iter().any(|leaf| leaf.has_mesh) {
        body.curl = mean(|body| body.curl);
    }
}

/// Mean of the petioles that a folder states.
fn mean_petiole(bodies: &[BodyFacts]) -> Option<PetioleRod> {
    let stated: Vec<PetioleFacts> = bodies.iter().filter_map(|body| body.petiole).collect();
    let mean = |value: fn(&PetioleFacts) -> f32| stated.iter().map(value).sum::<f32>() / stated.len() as f32;
    (!stated.is_empty()).then(|| PetioleRod {
        base: mean(|petiole| petiole.base),
        length: mean(|petiole| petiole.length),
        mass: mean(|petiole| petiole.mass),
        droop_deg: mean(|petiole| petiole.droop_deg),
    })
}
