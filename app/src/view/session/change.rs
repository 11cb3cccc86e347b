// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Changes from one scene to another: nothing, other numbers, or something that is built anew.

use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::{Ground, Litter, Look, Object, Particles, Share, SourceShape, Species, View};
use windfall_render::RendererOptions;
use windfall_render::land::is_paved;

/// Changes that follow when one scene takes the place of another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Change {
    /// The simulator goes on with other numbers.
    pub(crate) retune: bool,
    /// The renderer takes over another sun, sky, haze or length of trails.
    pub(crate) view: bool,
    /// The renderer takes over another lens.
    pub(crate) lens: bool,
    /// The scene's camera stands elsewhere.
    pub(crate) camera: bool,
    /// The world begins again at time zero.
    pub(crate) world: bool,
    /// The renderer is made anew.
    pub(crate) picture: bool,
    /// Names of the parts for whose sake something is made anew.
    pub(crate) parts: Vec<&'static str>,
}

impl Change {
    /// Changes that lead from one scene to another.
    pub(crate) fn between(old: &Scene, new: &Scene) -> Self {
        let mut change = Self::default();
        // Every field is named, so that a new one has to be sorted in.
        let Scene {
            name: _,
            seed,
            dt_s,
            fall_speed,
            rotation_speed,
            gravity_m_s2,
            species,
            sources,
            tree_kinds,
            trees,
            sway,
            sway_every,
            autumn,
            regrow_after_s,
            wind,
            ground,
            weather,
            objects,
            walkers,
            particles,
            forces,
            view,
        } = new;
        change.retune = *fall_speed != old.fall_speed
            || *rotation_speed != old.rotation_speed
            || *wind != old.wind
            || *sway != old.sway
            || *sway_every != old.sway_every;
        change.rebuild("seed", *seed != old.seed, true, true);
        change.rebuild("gravity", *gravity_m_s2 != old.gravity_m_s2, true, false);
        change.rebuild("step length", *dt_s != old.dt_s, true, false);
        change.rebuild("species", *species != old.species, true, looks(species) != looks(&old.species));
        change.rebuild("sources", *sources != old.sources, true, crowns(new) != crowns(old));
        change.rebuild("trees", *trees != old.trees || *tree_kinds != old.tree_kinds, true, true);
        change.rebuild("regrowth", *regrow_after_s != old.regrow_after_s, true, false);
        change.rebuild("season", *autumn != old.autumn, false, true);
        change.retune |= *autumn != old.autumn;
        change.ground(&old.ground, ground);
        change.rebuild("weather", *weather != old.weather, true, weather.is_some() != old.weather.is_some());
        change.rebuild(
            "objects",
            *objects != old.objects,
            uncolored(objects) != uncolored(&old.objects),
            true,
        );
        change.rebuild("walkers", *walkers != old.walkers, true, true);
        let moves = unpainted(particles) != unpainted(&old.particles) || *forces != old.forces;
        change.rebuild("particles", moves || *particles != old.particles, moves, true);
        change.view(&old.view, view);
        let litter = |scene| RendererOptions::for_scene(scene).litter_count;
        if litter(old) != litter(new) {
            change.picture = true;
            if change.parts.is_empty() {
                change.parts.push("litter");
            }
        }
        // A new world or renderer takes in everything else on its way.
        change.retune &= !change.world;
        change.view &= !change.picture;
        change.lens &= !change.picture && !change.view;
        change
    }

    /// Returns true if it is quick enough to follow a slider that is being dragged.
    pub(crate) fn is_live(&self) -> bool {
        !self.world && !self.picture
    }

    /// Message to the user afterwards, if there is any.
    pub(crate) fn message(&self) -> Option<String> {
        let parts = self.parts.join(", ");
        match (self.world, self.picture) {
            (true, _) => Some(format!("Rebuilt: {parts}. Time begins again at zero; the camera stays.")),
            (false, true) => Some(format!("Drawn anew: {parts}.")),
            (false, false) => None,
        }
    }

    fn rebuild(&mut self, part: &'static str, differs: bool, world: bool, picture: bool) {
        if differs {
            self.world |= world;
            self.picture |= picture;
            self.parts.push(part);
        }
    }

    fn ground(&mut self, old: &Ground, new: &Ground) {
        let Ground { height_m, friction, surface_roughness_m, terrain, water, litter } = *new;
        self.retune |= (friction, surface_roughness_m) != (old.friction, old.surface_roughness_m);
        self.rebuild("ground", height_m != old.height_m, true, true);
        self.rebuild("hills", terrain != old.terrain, true, true);
        self.rebuild("water", water != old.water, false, true);
        let is_laid_anew = match (old.litter, litter) {
            (Some(old), Some(new)) => old.retuned(Some(new)) != new,
            (old, new) => old != new,
        };
        // Painted leaves lie around the bed, and stones under it.
        let bed = |litter: Option<Litter>| litter.map(|bed| (bed.center_m, bed.size_m, bed.leaf_area_index));
        self.rebuild("litter", is_laid_anew, true, bed(old.litter) != bed(litter));
        let is_bared = old.litter.is_some() && litter.is_some() && is_paved(old) != is_paved(new);
        self.rebuild("paving", is_bared, false, true);
        self.retune |= litter != old.litter;
        self.retune |= water != old.water;
    }

    fn view(&mut self, old: &View, new: &View) {
        let View { camera, path: _, lens, sun, sky, haze, trail_s } = new;
        self.lens = *lens != old.lens;
        self.view = *sun != old.sun || *sky != old.sky || *haze != old.haze || *trail_s != old.trail_s;
        self.camera = *camera != old.camera;
        // The park is laid out around what it sees.
        self.rebuild("park", self.camera, false, true);
    }
}

/// Fields of species that the renderer uses.
fn looks(species: &[Species]) -> Vec<Species> {
    let look = |species: &Species| Species {
        name: species.name.clone(),
        shape: species.shape,
        season: species.season,
        size_m: species.size_m,
        flight: species.flight,
        leaves: species.leaves.clone(),
        ..Species::default()
    };
    species.iter().map(look).collect()
}

/// Objects but for what only the renderer uses.
fn uncolored(objects: &[Object]) -> Vec<Object> {
    objects.iter().map(|object| Object { color: Vec3::ZERO, ..object.clone() }).collect()
}

/// Particles but for what only the renderer uses.
fn unpainted(particles: &[Particles]) -> Vec<Particles> {
    particles.iter().map(|one| Particles { look: Look::default(), ..one.clone() }).collect()
}

/// The sources that the renderer shows a tree for: balls of leaves, where the scene has no trees.
fn crowns(scene: &Scene) -> Vec<(SourceShape, &[Share])> {
    let balls = scene.sources.iter().filter(|source| matches!(source.shape, SourceShape::Sphere { .. }));
    balls.filter(|_| scene.trees.is_empty()).map(|ball| (ball.shape, &*ball.species)).collect()
}

#[cfg(test)]
mod tests;
