// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Both ends of every range, stated here once more: a changed limit must be meant.

use glam::Vec3;

use super::{failing_field, full};
use crate::scene::{
    Exposure, Focus, Litter, MeanSpeed, PhysicalSky, Profile, Release, RotationModel, Scene, Sky, SkyMap,
    SourceShape, Terrain, ToneMap, Water,
};

/// Path, smallest and largest allowed value, assignment.
type Row<T> = (&'static str, T, T, fn(&mut Scene, T));

fn disc(center_m: Vec3, radius_m: f32) -> SourceShape {
    SourceShape::Disc { center_m, radius_m }
}

/// Makes room for sources of any height: ground far below and a fast fall.
fn tall(scene: &mut Scene, shape: SourceShape) {
    scene.dt_s = 0.02;
    scene.ground.height_m = -4096.0;
    scene.species[0].motion.descent_m_s = Some(10.0);
    scene.sources[0].shape = shape;
}

/// The scene's hills.
fn hills(scene: &mut Scene) -> &mut Terrain {
    scene.ground.terrain.get_or_insert_default()
}

/// The scene's litter.
fn litter(scene: &mut Scene) -> &mut Litter {
    scene.ground.litter.get_or_insert_default()
}

#[rustfmt::skip]
const REALS: &[Row<f32>] = &[
    ("dt_s", 0.001, 0.05, |s, v| s.dt_s = v),
    ("fall_speed", 0.0, 3.0, |s, v| s.fall_speed = v),
    ("rotation_speed", 0.1, 3.0, |s, v| s.rotation_speed = v),
    ("gravity_m_s2", 0.5, 30.0, |s, v| s.gravity_m_s2 = v),
    ("species[0].season.0", 0.0, 1.0, |s, v| s.species[0].season.0 = v),
    ("species[0].season.1", 0.0, 1.0, |s, v| s.species[0].season.1 = v),
    ("species[0].size_m", 0.005, 0.5, |s, v| s.species[0].size_m = v),
    ("species[0].size_variation", 0.0, 0.5, |s, v| s.species[0].size_variation = v),
    ("species[0].speed_variation", 0.0, 0.5, |s, v| s.species[0].speed_variation = v),
    ("species[0].areal_density_kg_m2", 0.005, 2.0, |s, v| s.species[0].areal_density_kg_m2 = v),
    ("species[0].spin_rad_s", 0.0, 20.0, |s, v| s.species[0].spin_rad_s = v),
    ("species[0].rotation.friction_per_s", 0.1, 1000.0,
        |s, v| s.species[0].rotation = RotationModel::TanabeKaneko { friction_per_s: v }),
    ("species[0].motion.descent_m_s", 0.05, 10.0, |s, v| s.species[0].motion.descent_m_s = Some(v)),
    ("species[0].motion.horizontal_m_s", 0.0, 10.0, |s, v| s.species[0].motion.horizontal_m_s = Some(v)),
    ("species[0].motion.vertical_m_s", 0.0, 10.0, |s, v| s.species[0].motion.vertical_m_s = Some(v)),
    ("species[0].motion.flutter_rad_s", 0.5, 60.0, |s, v| s.species[0].motion.flutter_rad_s = Some(v)),
    ("species[0].motion.tumble_rad_s", 0.5, 120.0, |s, v| s.species[0].motion.tumble_rad_s = Some(v)),
    ("species[0].motion.tumble_wobble", 0.0, 0.49, |s, v| s.species[0].motion.tumble_wobble = Some(v)),
    ("species[0].motion.chaos_keep", 0.0, 1.0, |s, v| s.species[0].motion.chaos_keep = Some(v)),
    ("species[0].motion.chaos_jitter", 0.0, 0.5, |s, v| s.species[0].motion.chaos_jitter = Some(v)),
    ("species[0].motion.rose_radius_m", 0.0, 5.0, |s, v| s.species[0].motion.rose_radius_m = Some(v)),
    ("species[0].motion.rose_ellipticity", 0.0, 1.0, |s, v| s.species[0].motion.rose_ellipticity = Some(v)),
    ("species[0].motion.spiral_radius_m", 0.0, 5.0, |s, v| s.species[0].motion.spiral_radius_m = Some(v)),
    ("species[0].motion.spiral_rad_s", 0.5, 30.0, |s, v| s.species[0].motion.spiral_rad_s = Some(v)),
    ("species[0].motion.cone_radius_m", 0.0, 5.0, |s, v| s.species[0].motion.cone_radius_m = Some(v)),
    ("species[0].motion.cone_depth_m", 0.1, 100.0, |s, v| s.species[0].motion.cone_depth_m = Some(v)),
    ("species[0].motion.cone_rad_s", 0.5, 30.0, |s, v| s.species[0].motion.cone_rad_s = Some(v)),
    ("species[0].motion.cone_unevenness", 0.0, 0.9, |s, v| s.species[0].motion.cone_unevenness = Some(v)),
    ("species[0].motion.corner_swing_deg", 0.0, 80.0, |s, v| s.species[0].motion.corner_swing_deg = Some(v)),
    ("species[0].motion.corner_swing_rad_s", 0.5, 60.0, |s, v| s.species[0].motion.corner_swing_rad_s = Some(v)),
    ("species[0].motion.wander_m_s", 0.0, 2.0, |s, v| s.species[0].motion.wander_m_s = Some(v)),
    ("species[0].motion.wander_s", 0.05, 2.0, |s, v| s.species[0].motion.wander_s = Some(v)),
    ("sources[0].shape.center_m.x", -4096.0, 4096.0, |s, v| tall(s, disc(Vec3::ZERO.with_x(v), 1.0))),
    ("sources[0].shape.center_m.y", -4096.0, 4096.0, |s, v| tall(s, disc(Vec3::ZERO.with_y(v), 1.0))),
    ("sources[0].shape.center_m.z", -4096.0, 4096.0, |s, v| tall(s, disc(Vec3::ZERO.with_z(v), 1.0))),
    ("sources[0].shape.radius_m", 0.0, 4096.0, |s, v| tall(s, disc(Vec3::ZERO, v))),
    ("sources[0].shape.radius_m", 0.0, 4096.0,
        |s, v| tall(s, SourceShape::Sphere { center_m: Vec3::ZERO, radius_m: v })),
    ("sources[0].shape.center_m.x", -4096.0, 4096.0,
        |s, v| tall(s, SourceShape::Sphere { center_m: Vec3::ZERO.with_x(v), radius_m: 1.0 })),
    ("sources[0].shape.center_m.z", -4096.0, 4096.0,
        |s, v| tall(s, SourceShape::Box { center_m: Vec3::ZERO.with_z(v), half_extent_m: Vec3::ONE })),
    ("sources[0].shape.half_extent_m.x", 0.0, 4096.0,
        |s, v| tall(s, SourceShape::Box { center_m: Vec3::ZERO, half_extent_m: Vec3::ZERO.with_x(v) })),
    ("sources[0].shape.half_extent_m.y", 0.0, 4096.0,
        |s, v| tall(s, SourceShape::Box { center_m: Vec3::ZERO, half_extent_m: Vec3::ZERO.with_y(v) })),
    ("sources[0].shape.half_extent_m.z", 0.0, 4096.0,
        |s, v| tall(s, SourceShape::Box { center_m: Vec3::ZERO, half_extent_m: Vec3::ZERO.with_z(v) })),
    ("sources[0].release.at_s", 0.0, 86_400.0, |s, v| s.sources[0].release = Release::Burst { at_s: v }),
    ("sources[0].release.per_s", 0.001, 1e8,
        |s, v| s.sources[0].release = Release::Rate { per_s: v, from_s: 0.0 }),
    ("sources[0].release.from_s", -3600.0, 86_400.0,
        |s, v| s.sources[0].release = Release::Rate { per_s: 1.0, from_s: v }),
    ("sources[0].recycle_after_s", 0.1, 86_400.0, |s, v| s.sources[0].recycle_after_s = Some(v)),
    ("autumn", 0.0, 1.0, |s, v| s.autumn = v),
    ("regrow_after_s", 1.0, 86_400.0, |s, v| s.regrow_after_s = Some(v)),
    ("trees[0].at_m.0", -2048.0, 2048.0, |s, v| s.trees[0].at_m[0] = v),
    ("trees[0].at_m.1", -2048.0, 2048.0, |s, v| s.trees[0].at_m[1] = v),
    ("trees[0].height_m", 0.2, 60.0, |s, v| s.trees[0].height_m = Some(v)),
    ("trees[0].age", 0.05, 1.0, |s, v| s.trees[0].age = v),
    ("trees[0].heading_deg", -360.0, 360.0, |s, v| s.trees[0].heading_deg = v),
    ("tree_kinds[0].wood.youngs_modulus_gpa", 1e-6, 1000.0, |s, v| s.tree_kinds[0].wood.youngs_modulus_gpa = v),
    ("tree_kinds[0].wood.density_kg_m3", 100.0, 2000.0, |s, v| s.tree_kinds[0].wood.density_kg_m3 = v),
    ("tree_kinds[0].wood.damping", 0.0, 1.0, |s, v| s.tree_kinds[0].wood.damping = v),
    ("tree_kinds[0].wood.drag", 0.0, 3.0, |s, v| s.tree_kinds[0].wood.drag = v),
    ("tree_kinds[0].wood.anchorage", 0.01, 1e6, |s, v| s.tree_kinds[0].wood.anchorage = v),
    ("tree_kinds[0].foliage.areal_density_kg_m2", 0.01, 1.0,
        |s, v| s.tree_kinds[0].foliage.areal_density_kg_m2 = v),
    ("tree_kinds[0].foliage.leaf_area_index", 0.1, 12.0, |s, v| s.tree_kinds[0].foliage.leaf_area_index = v),
    ("tree_kinds[0].foliage.drag", 0.0, 2.0, |s, v| s.tree_kinds[0].foliage.drag = v),
    ("tree_kinds[0].foliage.yield_m_s", 1.0, 1000.0, |s, v| s.tree_kinds[0].foliage.yield_m_s = v),
    ("tree_kinds[0].foliage.strength_n", 0.01, 100.0, |s, v| s.tree_kinds[0].foliage.strength_n = v),
    ("ground.height_m", -4096.0, 4096.0, |s, v| {
        tall(s, disc(Vec3::Y * 4096.0, 1.0));
        s.ground.height_m = v;
    }),
    ("ground.friction", 0.05, 5.0, |s, v| s.ground.friction = v),
    ("ground.surface_roughness_m", 0.0001, 0.1, |s, v| s.ground.surface_roughness_m = v),
    ("ground.terrain.edge_m", 16.0, 4096.0, |s, v| hills(s).edge_m = v),
    ("ground.terrain.relief_m", 0.0, 500.0, |s, v| {
        hills(s).relief_m = v;
        // Steps long enough to come down from there.
        s.dt_s = 0.03;
    }),
    ("ground.terrain.noise", 0.0, 1.0, |s, v| hills(s).noise = v),
    ("ground.terrain.pulled", 0.0, 1.0, |s, v| hills(s).pulled = v),
    ("ground.water.height_m", -4096.0, 4096.0, |s, v| s.ground.water = Some(Water { height_m: v })),
    ("ground.litter.center_m.x", -4096.0, 4096.0, |s, v| litter(s).center_m.x = v),
    ("ground.litter.center_m.y", -4096.0, 4096.0, |s, v| litter(s).center_m.y = v),
    ("ground.litter.size_m.x", 1.0, 256.0, |s, v| litter(s).size_m.x = v),
    ("ground.litter.size_m.y", 1.0, 256.0, |s, v| litter(s).size_m.y = v),
    ("ground.litter.leaf_area_index", 0.0, 30.0, |s, v| litter(s).leaf_area_index = v),
    ("ground.litter.bulk_density_kg_m3", 1.0, 100.0, |s, v| litter(s).bulk_density_kg_m3 = v),
    ("ground.litter.friction", 0.05, 5.0, |s, v| litter(s).friction = v),
    ("ground.litter.raised_deg.0", 0.0, 60.0, |s, v| litter(s).raised_deg = (v, 60.0)),
    ("ground.litter.raised_deg.1", 0.0, 60.0, |s, v| litter(s).raised_deg = (0.0, v)),
    ("ground.litter.restitution", 0.0, 1.0, |s, v| litter(s).restitution = v),
    ("ground.litter.moisture", 0.0, 4.0, |s, v| litter(s).moisture = v),
    ("ground.litter.adhesion_n_m2", 0.0, 20.0, |s, v| litter(s).adhesion_n_m2 = v),
    ("ground.litter.float_hours", 0.001, 48.0, |s, v| litter(s).float_hours = v),
    ("wind.direction_deg", -360.0, 360.0, |s, v| s.wind.direction_deg = v),
    ("wind.speed", 0.0, 80.0, |s, v| s.wind.speed = MeanSpeed::MetresPerSecond(v)),
    ("wind.reference_height_m", 1.0, 100.0, |s, v| s.wind.reference_height_m = v),
    ("wind.profile.exponent", 0.0, 1.0, |s, v| s.wind.profile = Profile::Power { exponent: v }),
    ("wind.profile.roughness_m", 0.0001, 5.0,
        |s, v| s.wind.profile = Profile::Log { roughness_m: v, displacement_m: 0.0 }),
    ("wind.profile.displacement_m", 0.0, 9.0,
        |s, v| s.wind.profile = Profile::Log { roughness_m: 0.1, displacement_m: v }),
    ("wind.gusts.strength", 0.0, 2.0, |s, v| s.wind.gusts.strength = v),
    ("wind.gusts.interval_s", 0.5, 120.0, |s, v| s.wind.gusts.interval_s = v),
    ("wind.turbulence.intensity", 0.0, 1.0, |s, v| s.wind.turbulence.intensity = v),
    ("wind.turbulence.cell_m", 0.1, 20.0, |s, v| s.wind.turbulence.cell_m = v),
    ("wind.turbulence.calm_m_s", 0.0, 10.0, |s, v| s.wind.turbulence.calm_m_s = v),
    ("wind.vortices[0].center_m.x", -4096.0, 4096.0, |s, v| s.wind.vortices[0].center_m.x = v),
    ("wind.vortices[0].center_m.y", -4096.0, 4096.0, |s, v| s.wind.vortices[0].center_m.y = v),
    ("wind.vortices[0].center_m.z", -4096.0, 4096.0, |s, v| s.wind.vortices[0].center_m.z = v),
    ("wind.vortices[0].axis.x", -1000.0, 1000.0, |s, v| s.wind.vortices[0].axis.x = v),
    ("wind.vortices[0].axis.y", -1000.0, 1000.0, |s, v| s.wind.vortices[0].axis.y = v),
    ("wind.vortices[0].axis.z", -1000.0, 1000.0, |s, v| s.wind.vortices[0].axis.z = v),
    ("wind.vortices[0].circulation_m2_s", -1000.0, 1000.0, |s, v| s.wind.vortices[0].circulation_m2_s = v),
    ("wind.vortices[0].core_m", 0.05, 100.0, |s, v| s.wind.vortices[0].core_m = v),
    ("wind.vortices[0].axial_m_s", -50.0, 50.0, |s, v| s.wind.vortices[0].axial_m_s = v),
    ("wind.vortices[0].drift_m_s.x", -50.0, 50.0, |s, v| s.wind.vortices[0].drift_m_s.x = v),
    ("wind.vortices[0].drift_m_s.y", -50.0, 50.0, |s, v| s.wind.vortices[0].drift_m_s.y = v),
    ("wind.vortices[0].drift_m_s.z", -50.0, 50.0, |s, v| s.wind.vortices[0].drift_m_s.z = v),
    ("wind.jets[0].nozzle_m", 0.01, 20.0, |s, v| s.wind.jets[0].nozzle_m = v),
    ("wind.jets[0].keys[0].speed_m_s", 0.0, 300.0, |s, v| s.wind.jets[0].keys[0].speed_m_s = v),
    ("wind.jets[0].keys[0].at_m.x", -4096.0, 4096.0, |s, v| s.wind.jets[0].keys[0].at_m.x = v),
    ("wind.jets[0].keys[0].at_m.y", -4096.0, 4096.0, |s, v| s.wind.jets[0].keys[0].at_m.y = v),
    ("wind.jets[0].keys[0].at_m.z", -4096.0, 4096.0, |s, v| s.wind.jets[0].keys[0].at_m.z = v),
    ("wind.jets[0].keys[0].toward_m.x", -4096.0, 4096.0, |s, v| s.wind.jets[0].keys[0].toward_m.x = v),
    ("wind.jets[0].keys[0].toward_m.y", -4096.0, 4096.0, |s, v| s.wind.jets[0].keys[0].toward_m.y = v),
    ("wind.jets[0].keys[0].toward_m.z", -4096.0, 4096.0, |s, v| s.wind.jets[0].keys[0].toward_m.z = v),
    ("wind.plumes[0].base_radius_m", 0.05, 20.0, |s, v| s.wind.plumes[0].base_radius_m = v),
    ("wind.plumes[0].keys[0].power_kw", 0.0, 10_000.0, |s, v| s.wind.plumes[0].keys[0].power_kw = v),
    ("wind.plumes[0].at_m.x", -4096.0, 4096.0, |s, v| s.wind.plumes[0].at_m.x = v),
    ("wind.plumes[0].at_m.y", -4096.0, 4096.0, |s, v| s.wind.plumes[0].at_m.y = v),
    ("wind.plumes[0].at_m.z", -4096.0, 4096.0, |s, v| s.wind.plumes[0].at_m.z = v),
    ("view.camera.eye_m.x", -1e5, 1e5, |s, v| s.view.camera.eye_m.x = v),
    ("view.camera.eye_m.y", -1e5, 1e5, |s, v| s.view.camera.eye_m.y = v),
    ("view.camera.eye_m.z", -1e5, 1e5, |s, v| s.view.camera.eye_m.z = v),
    ("view.camera.target_m.x", -1e5, 1e5, |s, v| s.view.camera.target_m.x = v),
    ("view.camera.target_m.y", -1e5, 1e5, |s, v| s.view.camera.target_m.y = v),
    ("view.camera.target_m.z", -1e5, 1e5, |s, v| s.view.camera.target_m.z = v),
    ("view.camera.vertical_fov_deg", 5.0, 120.0, |s, v| s.view.camera.vertical_fov_deg = v),
    ("view.sun.azimuth_deg", -360.0, 360.0, |s, v| s.view.sun.azimuth_deg = v),
    ("view.sun.elevation_deg", -6.0, 90.0, |s, v| s.view.sun.elevation_deg = v),
    ("view.sky.aerosol", 0.0, 1.0,
        |s, v| s.view.sky = Sky::Physical(PhysicalSky { aerosol: v, ..PhysicalSky::default() })),
    ("view.sky.cloud_cover", 0.0, 1.0,
        |s, v| s.view.sky = Sky::Physical(PhysicalSky { cloud_cover: v, ..PhysicalSky::default() })),
    ("view.sky.rotation_deg", -360.0, 360.0,
        |s, v| s.view.sky = Sky::Map(SkyMap { rotation_deg: v, ..SkyMap::new("a.hdr".into()) })),
    ("view.sky.intensity_kcd_m2", 0.001, 1000.0,
        |s, v| s.view.sky = Sky::Map(SkyMap { intensity_kcd_m2: v, ..SkyMap::new("a.hdr".into()) })),
    ("view.haze.visibility_m", 20.0, 100_000.0, |s, v| s.view.haze.visibility_m = v),
    ("view.haze.depth_m", 1.0, 10_000.0, |s, v| s.view.haze.depth_m = v),
    ("view.trail_s", 0.0, 30.0, |s, v| s.view.trail_s = v),
    ("view.path[0].time_s", 0.0, 86_400.0, |s, v| {
        s.view.path.truncate(1);
        s.view.path[0].time_s = v;
    }),
    ("view.path[0].eye_m.x", -1e5, 1e5, |s, v| s.view.path[0].eye_m.x = v),
    ("view.path[0].eye_m.y", -1e5, 1e5, |s, v| s.view.path[0].eye_m.y = v),
    ("view.path[0].eye_m.z", -1e5, 1e5, |s, v| s.view.path[0].eye_m.z = v),
    ("view.path[0].target_m.x", -1e5, 1e5, |s, v| s.view.path[0].target_m.x = v),
    ("view.path[0].target_m.y", -1e5, 1e5, |s, v| s.view.path[0].target_m.y = v),
    ("view.path[0].target_m.z", -1e5, 1e5, |s, v| s.view.path[0].target_m.z = v),
    ("view.path[0].vertical_fov_deg", 5.0, 120.0, |s, v| s.view.path[0].vertical_fov_deg = v),
    ("view.lens.exposure.ev100", -6.0, 24.0, |s, v| s.view.lens.exposure = Exposure::Manual { ev100: v }),
    ("view.lens.exposure.compensation_ev", -8.0, 8.0,
        |s, v| s.view.lens.exposure = Exposure::Auto { compensation_ev: v, adaptation_s: 1.0 }),
    ("view.lens.exposure.adaptation_s", 0.0, 60.0,
        |s, v| s.view.lens.exposure = Exposure::Auto { compensation_ev: 0.0, adaptation_s: v }),
    ("view.lens.tone_map.gamma", 1.0, 4.0, |s, v| s.view.lens.tone_map = ToneMap::Linear { gamma: v }),
    ("view.lens.tone_map.white", 1.0, 1000.0, |s, v| s.view.lens.tone_map = ToneMap::Reinhard { white: v }),
    ("view.lens.glare.threshold", 0.0, 0.99, |s, v| s.view.lens.glare.threshold = v),
    ("view.lens.glare.strength", 0.0, 1.0, |s, v| s.view.lens.glare.strength = v),
    ("view.lens.focus.distance_m", 0.1, 10_000.0,
        |s, v| s.view.lens.focus = Some(Focus { distance_m: v, f_number: 4.0 })),
    ("view.lens.focus.f_number", 0.5, 64.0,
        |s, v| s.view.lens.focus = Some(Focus { distance_m: 4.0, f_number: v })),
    ("view.lens.shutter_s", 0.0, 0.1, |s, v| s.view.lens.shutter_s = v),
    ("view.lens.saturation", 0.0, 2.0, |s, v| s.view.lens.saturation = v),
    ("view.lens.vignette", 0.0, 1.0, |s, v| s.view.lens.vignette = v),
];

#[rustfmt::skip]
const COUNTS: &[Row<u32>] = &[
    ("ground.terrain.levels", 2, 9, |s, v| hills(s).levels = v),
    ("ground.terrain.smoothing", 0, 8, |s, v| hills(s).smoothing = v),
    ("species[0].motion.rose_swings", 2, 12, |s, v| s.species[0].motion.rose_swings = Some(v)),
    ("species[0].transitions[0]", 1, 65_535, |s, v| s.species[0].transitions.0[0] = [v, 0, 0, 0, 0, 0]),
    ("sources[0].count", 1, 1 << 30, |s, v| {
        s.trees.clear();
        s.sources[0].release = Release::Burst { at_s: 0.0 };
        s.sources[0].count = v;
    }),
    ("sources[0].species[0].weight", 1, 1000, |s, v| s.sources[0].species[0].weight = v),
];

/// Assigns `value` in an otherwise valid scene.
fn field_with<T>(&(_, _, _, set): &Row<T>, value: T) -> Option<String> {
    let mut scene = full();
    set(&mut scene, value);
    failing_field(&scene)
}

#[test]
fn ranges_end_where_they_should() {
    for row in REALS {
        let &(path, low, high, _) = row;
        for inside in [low, low.next_up(), high.next_down(), high] {
            assert_eq!(field_with(row, inside), None, "{path}: {inside:?} is allowed");
        }
        for outside in [low.next_down(), high.next_up(), f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(field_with(row, outside).as_deref(), Some(path), "{path}: {outside:?} is not allowed");
        }
    }
    for row in COUNTS {
        let &(path, low, high, _) = row;
        for inside in [low, high] {
            assert_eq!(field_with(row, inside), None, "{path}: {inside} is allowed");
        }
        for outside in [low.wrapping_sub(1), high + 1, u32::MAX] {
            assert_eq!(field_with(row, outside).as_deref(), Some(path), "{path}: {outside} is not allowed");
        }
    }
}

#[test]
fn beaufort_numbers_end_at_twelve() {
    let with = |number| {
        let mut scene = full();
        scene.wind.speed = MeanSpeed::Beaufort(number);
        failing_field(&scene)
    };
    assert_eq!((with(0), with(12)), (None, None), "the scale");
    assert_eq!(with(13).as_deref(), Some("wind.speed"), "beyond the scale");
}
