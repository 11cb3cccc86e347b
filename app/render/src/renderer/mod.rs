// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Puts the passes together.

mod changes;
mod drawing;
pub(crate) mod scene;
mod scene_pass;
mod timed;

use glam::{Vec2, Vec3};
use windfall_core::scene::Lens;
use windfall_wgpu::{LeafColumns, WorldColumns};

use self::scene::{RenderScene, RendererOptions};
use self::timed::TIMED_PASSES;
use crate::camera::Camera;
use crate::error::RenderError;
use crate::frame::cascades::shadow_size;
use crate::frame::group::{FrameGroup, Standing};
use crate::frame::light_group::LightGroup;
use crate::frame::sunlit_air;
use crate::frame::surroundings::{Path, Surroundings};
use crate::gpu::targets::Targets;
use crate::gpu::timing::GpuTimer;
use crate::land::Land;
use crate::leaves::burning::BurningPass;
use crate::leaves::contact_pass::ContactPass;
use crate::leaves::cull::CullPass;
use crate::leaves::leaf_pass::LeafPass;
use crate::leaves::motion_pass::MotionPass;
use crate::leaves::species_table::SpeciesTable;
use crate::leaves::visible::VisibleLeaves;
use crate::lens::motion::Motion;
use crate::lens::post::Post;
use crate::marks::landing_pass::LandingPass;
use crate::marks::paint_pass::PaintPass;
use crate::marks::shelter_pass::{ShelterBuffers, ShelterPass};
use crate::marks::trail_pass::TrailPass;
use crate::objects::motion_pass::ObjectMotionPass;
use crate::objects::object_pass::ObjectPass;
use crate::objects::records::ObjectBuffers;
use crate::park::far_trees::{ShadePass, TreePass, Trees};
use crate::park::layout::{Park, plant};
use crate::park::litter::strew;
use crate::park::near_trees::{NearTrees, part};
use crate::park::park_trees::{own_trees, shedding};
use crate::park::still_leaves::StillLeaves;
use crate::particles::flames::light_count;
use crate::particles::particle_pass::ParticlePass;
use crate::quality::Quality;
use crate::scenery::grass_pass::GrassPass;
use crate::scenery::ground_pass::GroundPass;
use crate::scenery::sky_pass::SkyPass;
use crate::scenery::snow_map::SnowMap;
use crate::scenery::snow_pass::SnowPass;
use crate::scenery::water_pass::WaterPass;
use crate::shadows::ShadowPass;
use crate::shadows::sun_shafts::SunShafts;
use crate::trees::SceneTrees;
use crate::trees::bark_mesh::BarkBuffers;
use crate::trees::bark_pass::BarkPass;
use crate::trees::branch_group::BranchGroup;
use crate::trees::fruit_pass::FruitPass;
use crate::trees::records::TreeRecords;

/// Draws a scene's leaves in their park.
///
/// One `draw` per submission: the uniforms of a frame are written through the queue.
#[derive(Debug)]
pub struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    surroundings: Surroundings,
    land: Land,
    leaf_count: u32,
    dt_s: f32,
    targets: Targets,
    tile_px: u32,
    quality: Quality,
    frame: FrameGroup,
    light: LightGroup,
    species_table: SpeciesTable,
    trees: Trees,
    litter: Option<StillLeaves>,
    near_trees: Option<NearTrees>,
    visible_litter: VisibleLeaves,
    visible_leaves: VisibleLeaves,
    tree_records: TreeRecords,
    cull: CullPass,
    bark: BarkBuffers,
    branches: BranchGroup,
    objects: Option<(ObjectBuffers, ObjectPass)>,
    shadow_pass: ShadowPass,
    sun_shafts: Option<SunShafts>,
    shade_pass: ShadePass,
    shade_is_old: bool,
    bark_pass: BarkPass,
    leaf_pass: LeafPass,
    contact_pass: Option<ContactPass>,
    /// Marks the leaves that burn.
    burning: Option<BurningPass>,
    /// Passes for the time that the shutter is open.
    moving: Option<Moving>,
    fruit_pass: FruitPass,
    grass_pass: GrassPass,
    ground_pass: GroundPass,
    snow_map: SnowMap,
    snow_pass: Option<SnowPass>,
    water_pass: Option<WaterPass>,
    tree_pass: TreePass,
    sky_pass: SkyPass,
    particle_pass: Option<ParticlePass>,
    trail_pass: Option<TrailPass>,
    paint_pass: Option<PaintPass>,
    landing_pass: Option<LandingPass>,
    shelter: ShelterBuffers,
    shelter_pass: Option<ShelterPass>,
    post: Post,
    timer: Option<GpuTimer>,
    /// Each part of the scene has a pass of its own, to be timed.
    has_split_scene: bool,
    /// Beginning and length in seconds of a round that scenery repeats.
    round: Option<(f64, f64)>,
}

/// Passes that draw ways over the picture.
#[derive(Debug)]
struct Moving {
    motion: Motion,
    leaves: MotionPass,
    objects: Option<ObjectMotionPass>,
}

impl Renderer {
    /// A renderer of `subject` into textures of `output_format` and `size` pixels. The picture is gamma encoded by the renderer unless the format does so.
    ///
    /// # Errors
    /// A size or a number of images beyond the device's limits, or images that do not fit the scene.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        subject: RenderScene<'_>,
        output_format: wgpu::TextureFormat,
        size: (u32, u32),
        options: RendererOptions,
    ) -> Result<Self, RenderError> {
        let RenderScene { scene, solids, burns, snow, trees: scene_trees, atlas } = subject;
        let camera = Camera::from(&scene.view.camera);
        let forward = camera.forward();
        let level = Vec2::new(forward.x, forward.z).normalize_or(Vec2::NEG_Y);
        let land = Land::of(&scene.ground);
        let Vec3 { x, z, .. } = camera.target_m;
        let center = Vec3::new(x, land.ground_m(x, z), z);
        let Park { trees: planted, leaves, path_phase } = plant(scene, &land, center, level);
        let eye_m = camera.eye_m();
        let shedding = shedding(&planted, center, scene_trees);
        let (near, planted) = if options.quality.has_fine_parts() {
            part(scene, planted, eye_m, level)
        } else {
            (Vec::new(), planted)
        };

        let targets = Targets::new(
            device,
            size,
            (options.tile_px, options.quality.shading_px()),
            is_moving(&scene.view.lens),
        )?;
        let objects = ObjectBuffers::new(device, queue, solids);
        let standing = Standing {
            trees: !scene_trees.trees.is_empty(),
            objects: objects.is_some(),
            fire_lights: light_count(scene),
            snow: snow.is_some(),
        };
        let frame = FrameGroup::new(device, queue, &land, standing, options.quality);
        let species_table = SpeciesTable::new(device, queue, scene, atlas, burns)?;
        let own = [near.clone(), own_trees(scene_trees, scene.autumn > 0.0)].concat();
        let trees = Trees::new(device, queue, (&planted, leaves), &own);
        let branches = BranchGroup::new(device, queue, scene_trees);
        let cull = CullPass::new(device, &species_table, false);
        let shadow_pass = ShadowPass::new(
            device,
            &frame,
            &species_table,
            &cull,
            &branches,
            objects.as_ref(),
            (shadow_size(targets.shaded_size().1, options.quality), options.quality.first_shadow_map()),
        );
        let shade_pass = ShadePass::new(device, &frame, &trees);
        let surroundings = Surroundings::new(&scene.view, center, Path { lead: level, phase: path_phase })?;
        frame.set_sun(queue, &land, surroundings.daylight.sun.direction);
        let snow_map = SnowMap::new(device, queue, snow);
        let from_above = [&shade_pass.map, &snow_map.view];
        let sunlit_air = sunlit_air::grid(device, options.quality.has_shafts());
        let from_sun = [&shadow_pass.maps, &sunlit_air];
        let light = LightGroup::new(device, queue, from_sun, from_above, &surroundings.daylight);
        let sun_shafts =
            options.quality.has_shafts().then(|| SunShafts::new(device, &frame, &light, &sunlit_air));
        let objects = objects.map(|objects| {
            let pass = ObjectPass::new(device, &frame, &light, &objects);
            (objects, pass)
        });
        let near_trees = (!near.is_empty())
            .then(|| NearTrees::new(device, queue, &cull, scene, &near, (eye_m, options.quality)))
            .flatten();
        let mut renderer = Self {
            device: device.clone(),
            queue: queue.clone(),
            surroundings,
            leaf_count: scene.leaf_count(),
            dt_s: scene.dt_s,
            litter: strew(device, queue, options.litter_count, scene, &land, center, &shedding),
            near_trees,
            visible_litter: VisibleLeaves::new(
                device,
                queue,
                &cull,
                &SceneTrees::default(),
                options.litter_count,
            ),
            visible_leaves: VisibleLeaves::new(device, queue, &cull, scene_trees, scene.leaf_count()),
            tree_records: TreeRecords::new(device, queue, scene_trees),
            bark: BarkBuffers::new(device, queue, scene_trees, (eye_m, options.quality)),
            bark_pass: BarkPass::new(device, &frame, &light, &branches, options.quality),
            burning: BurningPass::new(device, &species_table),
            leaf_pass: LeafPass::new(device, &frame, &light, &species_table, &cull),
            contact_pass: options
                .quality
                .has_fine_parts()
                .then(|| ContactPass::new(device, &frame, &light, &species_table, &cull)),
            fruit_pass: FruitPass::new(device, queue, &frame, &light, &branches, scene_trees),
            grass_pass: GrassPass::new(device, &frame, &light),
            ground_pass: GroundPass::new(device, queue, &frame, &light, &land),
            snow_map,
            snow_pass: snow.map(|compiled| SnowPass::new(device, queue, &frame, &light, compiled)),
            water_pass: WaterPass::new(device, &frame, &light, &land),
            tree_pass: TreePass::new(device, &frame, &light, &trees),
            sky_pass: SkyPass::new(device, &frame, &light),
            particle_pass: ParticlePass::new(device, queue, &frame, &light, scene),
            post: Post::new(
                device,
                queue,
                &targets,
                output_format,
                lens_of(scene.view.lens, options.quality),
            ),
            timer: GpuTimer::new(device, queue, &TIMED_PASSES),
            has_split_scene: false,
            round: None,
            trail_pass: None,
            moving: None,
            paint_pass: None,
            landing_pass: None,
            shelter: ShelterBuffers::new(device, queue, None, 1.0),
            shelter_pass: None,
            shade_is_old: true,
            targets,
            land,
            tile_px: options.tile_px,
            quality: options.quality,
            frame,
            light,
            species_table,
            cull,
            trees,
            branches,
            objects,
            shadow_pass,
            sun_shafts,
            shade_pass,
        };
        renderer.make_trails(scene.view.trail_s);
        renderer.moving = is_moving(&scene.view.lens).then(|| renderer.new_motion());
        Ok(renderer)
    }

    /// Size of the pictures in pixels.
    pub fn size(&self) -> (u32, u32) {
        self.targets.size
    }

    /// The land that is drawn.
    pub fn land(&self) -> &Land {
        &self.land
    }

    /// True if leaves draw trails.
    pub fn has_trails(&self) -> bool {
        self.trail_pass.is_some()
    }

    /// Notes where the leaves of `world` are at `time_s` for their trails and for the motion until the next frame, without
    /// drawing; nothing to do in a scene without either.
    pub fn observe(&mut self, encoder: &mut wgpu::CommandEncoder, world: &WorldColumns<'_>, time_s: f64) {
        self.sample_trails(encoder, &world.leaves, time_s);
        self.note_motion(encoder, &world.leaves, time_s);
    }

    fn note_motion(&mut self, encoder: &mut wgpu::CommandEncoder, leaves: &LeafColumns<'_>, time_s: f64) {
        if let Some(moving) = &mut self.moving {
            moving.leaves.past.note(encoder, leaves, time_s);
        }
    }

    fn sample_trails(&mut self, encoder: &mut wgpu::CommandEncoder, leaves: &LeafColumns<'_>, time_s: f64) {
        if let Some(trails) = &mut self.trail_pass {
            trails.sample(&self.device, &self.queue, encoder, leaves, time_s);
        }
    }

    /// Milliseconds the device last spent on each pass, where timestamps are supported; call it after submitting a frame.
    pub fn timings(&mut self) -> Vec<(&'static str, f32)> {
        self.timer.as_mut().map_or_else(Vec::new, |timer| timer.collect(&self.device).to_vec())
    }
}

/// The lens of a scene with what a quality leaves of it.
fn lens_of(mut lens: Lens, quality: Quality) -> Lens {
    if !quality.has_fine_parts() {
        lens.glare.strength = 0.0;
    }
    lens
}

/// Returns true if what moves is drawn longer than it is.
fn is_moving(lens: &Lens) -> bool {
    lens.shutter_s > 0.0
}
