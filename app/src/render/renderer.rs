// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Puts the passes together.

use glam::{Vec2, Vec3};
use windfall_core::Scene;
use windfall_core::scene::{Lens, Release, View};
use windfall_texgen::Atlas;
use windfall_wgpu::{BranchColumns, LeafColumns};

use super::RenderError;
use super::bark_mesh::StandMesh;
use super::bark_pass::BarkPass;
use super::branch_group::BranchGroup;
use super::cascades::SHADOW_SIZE;
use super::environment::{Environment, FrameUniform, Path};
use super::frame::FrameGroup;
use super::fruit_pass::FruitPass;
use super::grass_pass::GrassPass;
use super::ground_pass::GroundPass;
use super::leaf_crowd::LeafCrowd;
use super::leaf_cull::{CullPass, View as LeafView, ViewUniform};
use super::leaf_kinds::LeafKinds;
use super::leaf_pass::LeafPass;
use super::lens_group::Shot;
use super::light_group::LightGroup;
use super::litter::Litter;
use super::post::{Post, TimedPosts};
use super::scenery::{Park, Shedding, TreeInstance, plant};
use super::shadow_pass::{Casters, ShadowPass};
use super::sky_pass::SkyPass;
use super::stems::Stems;
use super::targets::Targets;
use super::tile::Tile;
use super::timing::GpuTimer;
use super::trail_pass::TrailPass;
use super::tree_pass::{ShadePass, TreePass, Trees};
use super::water_pass::WaterPass;
use crate::camera::{Camera, NEAR_M};
use crate::land::Land;
use crate::trees::Stand;

/// Passes that are timed, in order of drawing.
const TIMED_PASSES: [&str; 6] = ["shadows", "scene", "focus", "exposure", "glare", "tone map"];
/// Where those after the scene are among them.
const TIMED_POSTS: TimedPosts = TimedPosts { focus: 2, exposure: 3, glare: 4, tone_map: 5 };
/// Leaves of litter on a meadow in autumn.
const LITTER: u32 = 14_000;

/// Most pixels drawn at once by default: 4K UHD, whose multisampled targets take 400 MB.
const TILE_PX: u32 = 3840 * 2160;

/// Choices of a renderer that are no part of a scene.
#[derive(Clone, Copy, Debug)]
pub struct RendererOptions {
    /// Leaves strewn over the meadow before the scene begins, not simulated: 0 to 100000.
    pub litter_count: u32,
    /// Most pixels of a picture that are drawn at once, at least 1: larger pictures are drawn by tiles.
    pub tile_px: u32,
}

impl RendererOptions {
    /// A scene that has been going on since before time zero has leaves on its ground; one that only begins then has a
    /// clean one, on which its own leaves and their trails show.
    pub fn for_scene(scene: &Scene) -> Self {
        let began = |release| matches!(release, Release::Rate { from_s, .. } if from_s < 0.0);
        let has_past = scene.sources.iter().any(|source| began(source.release));
        // In summer there is none under the trees of a scene.
        let season = if scene.trees.is_empty() { 1.0 } else { (2.0 * scene.autumn).min(1.0) };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of a small number"
        )]
        let litter_count = (season * LITTER as f32) as u32;
        let litter_count = if has_past && scene.view.trail_s == 0.0 { litter_count } else { 0 };
        Self { litter_count, tile_px: TILE_PX }
    }
}

/// What a renderer draws.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its trees.
    pub stand: &'a Stand,
    /// The pictures of its species' leaves (see [`crate::leaves`]).
    pub atlas: &'a Atlas,
}

/// What changes from frame to frame besides the leaves.
#[derive(Clone, Copy, Debug)]
pub struct FrameInput {
    /// The camera.
    pub camera: Camera,
    /// Time of the simulation in seconds: moves clouds and grass, and ages trails.
    pub time_s: f64,
    /// Seconds since the frame before, for the lens to adapt to brightness; infinite adapts at once.
    pub since_s: f32,
    /// Where in the output the picture's upper left corner lies, in pixels; the picture must lie inside the output.
    pub origin: (u32, u32),
}

/// Draws a scene's leaves in their park.
///
/// One `draw` per submission: the uniforms of a frame are written through the queue.
#[derive(Debug)]
pub struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    environment: Environment,
    land: Land,
    leaf_count: u32,
    targets: Targets,
    tile_px: u32,
    frame: FrameGroup,
    light: LightGroup,
    kinds: LeafKinds,
    trees: Trees,
    litter: Option<Litter>,
    litter_crowd: LeafCrowd,
    leaf_crowd: LeafCrowd,
    stems: Stems,
    cull: CullPass,
    bark: StandMesh,
    branches: BranchGroup,
    shadow_pass: ShadowPass,
    shade_pass: ShadePass,
    shade_is_old: bool,
    bark_pass: BarkPass,
    leaf_pass: LeafPass,
    fruit_pass: FruitPass,
    grass_pass: GrassPass,
    ground_pass: GroundPass,
    water_pass: Option<WaterPass>,
    tree_pass: TreePass,
    sky_pass: SkyPass,
    trail_pass: Option<TrailPass>,
    post: Post,
    timer: Option<GpuTimer>,
}

impl Renderer {
    /// A renderer of `subject` into textures of `output_format` and `size` pixels. The picture is gamma encoded by the renderer unless the format does so.
    ///
    /// # Errors
    /// A size or a number of images beyond the device's limits, or images that do not fit the scene.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        subject: Subject<'_>,
        output_format: wgpu::TextureFormat,
        size: (u32, u32),
        options: RendererOptions,
    ) -> Result<Self, RenderError> {
        let Subject { scene, stand, atlas } = subject;
        let camera = Camera::from(&scene.view.camera);
        let forward = camera.forward();
        let level = Vec2::new(forward.x, forward.z).normalize_or(Vec2::NEG_Y);
        let land = Land::of(&scene.ground);
        let Vec3 { x, z, .. } = camera.target_m;
        let center = Vec3::new(x, land.ground_m(x, z), z);
        let Park { trees: planted, leaves, path_phase } = plant(scene, &land, center, level);

        let targets = Targets::new(device, size, options.tile_px)?;
        let frame = FrameGroup::new(device, queue, &land);
        let kinds = LeafKinds::new(device, queue, scene, atlas)?;
        let own = own_trees(stand, scene.autumn > 0.0);
        let trees = Trees::new(device, queue, (&planted, leaves), &own);
        let branches = BranchGroup::new(device, queue, stand);
        let cull = CullPass::new(device, &kinds);
        let shadow_pass = ShadowPass::new(device, &frame, &kinds, &cull, &branches);
        let shade_pass = ShadePass::new(device, &frame, &trees);
        let environment = Environment::new(&scene.view, center, Path { lead: level, phase: path_phase })?;
        let light = LightGroup::new(device, queue, &shadow_pass.maps, &shade_pass.map, &environment.daylight);
        let eye_m = camera.eye_m();
        let shedding = shedding(&planted, stand);
        let species_count = u32::try_from(scene.species.len()).unwrap_or(1);
        let mut renderer = Self {
            device: device.clone(),
            queue: queue.clone(),
            environment,
            leaf_count: scene.leaf_count(),
            litter: Litter::new(device, queue, options.litter_count, species_count, &land, center, &shedding),
            litter_crowd: LeafCrowd::new(device, queue, &cull, &Stand::default(), options.litter_count),
            leaf_crowd: LeafCrowd::new(device, queue, &cull, stand, scene.leaf_count()),
            stems: Stems::new(device, queue, stand),
            bark: StandMesh::new(device, queue, stand, eye_m),
            bark_pass: BarkPass::new(device, &frame, &light, &branches),
            leaf_pass: LeafPass::new(device, &frame, &light, &kinds, &cull),
            fruit_pass: FruitPass::new(device, queue, &frame, &light, &branches, stand),
            grass_pass: GrassPass::new(device, &frame, &light),
            ground_pass: GroundPass::new(device, queue, &frame, &light, &land),
            water_pass: WaterPass::new(device, &frame, &light, &land),
            tree_pass: TreePass::new(device, &frame, &light, &trees),
            sky_pass: SkyPass::new(device, &frame, &light),
            post: Post::new(device, queue, &targets, output_format, scene.view.lens),
            timer: GpuTimer::new(device, queue, &TIMED_PASSES),
            trail_pass: None,
            shade_is_old: true,
            targets,
            land,
            tile_px: options.tile_px,
            frame,
            light,
            kinds,
            cull,
            trees,
            branches,
            shadow_pass,
            shade_pass,
        };
        renderer.make_trails(scene.view.trail_s);
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

    /// Draws pictures of another size from now on.
    ///
    /// # Errors
    /// A size beyond the device's limits; the renderer keeps its size.
    pub fn resize(&mut self, size: (u32, u32)) -> Result<(), RenderError> {
        if size != self.targets.size {
            self.targets = Targets::new(&self.device, size, self.tile_px)?;
            self.post.rebind(&self.device, &self.queue, &self.targets);
        }
        Ok(())
    }

    /// Takes over another sun, sky, lens and length of trails; the park stays where it is.
    ///
    /// # Errors
    /// A picture of a sky that cannot be used; the renderer keeps its own.
    pub fn update_scene_view(&mut self, view: &View) -> Result<(), RenderError> {
        let Environment { park_center, path, .. } = self.environment;
        self.environment = Environment::new(view, park_center, path)?;
        self.light.set_sky(&self.device, &self.queue, &self.environment.daylight);
        self.set_lens(view.lens);
        self.shade_is_old = true;
        let drawn = self.trail_pass.as_ref().map_or(0.0, TrailPass::trail_s);
        if drawn != view.trail_s {
            self.make_trails(view.trail_s);
        }
        Ok(())
    }

    /// Draws at most so many pixels at once from now on.
    #[cfg(test)]
    pub(super) fn set_tile_px(&mut self, tile_px: u32) -> Result<(), RenderError> {
        self.tile_px = tile_px;
        self.targets = Targets::new(&self.device, self.targets.size, tile_px)?;
        self.post.rebind(&self.device, &self.queue, &self.targets);
        Ok(())
    }

    /// Takes over another lens.
    pub fn set_lens(&mut self, lens: Lens) {
        self.post.set_lens(&self.device, &self.queue, &self.targets, lens);
    }

    /// Takes over another number of leaves, with the same trees bearing other shares of them.
    pub fn update_leaves(&mut self, stand: &Stand, leaf_count: u32) {
        self.leaf_count = leaf_count;
        self.stems = Stems::new(&self.device, &self.queue, stand);
        self.leaf_crowd = LeafCrowd::new(&self.device, &self.queue, &self.cull, stand, leaf_count);
        self.make_trails(self.trail_pass.as_ref().map_or(0.0, TrailPass::trail_s));
    }

    fn make_trails(&mut self, trail_s: f32) {
        let (device, leaf_count) = (&self.device, self.leaf_count);
        self.trail_pass =
            (trail_s > 0.0).then(|| TrailPass::new(device, &self.frame, &self.light, trail_s, leaf_count));
    }

    /// Encodes one frame of `leaves` and `branches` into `output`, a view of a texture of this renderer's format. What
    /// lies outside of the picture becomes black. Without branches the trees stand at rest.
    pub fn draw(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        output: &wgpu::TextureView,
        leaves: &LeafColumns<'_>,
        branches: Option<&BranchColumns<'_>>,
        input: &FrameInput,
    ) {
        let (width, height) = self.targets.size;
        let camera = input.camera.fitted(width as f32 / height as f32);
        let input = &FrameInput { camera, ..*input };
        let shot = Shot {
            size: self.targets.size,
            origin: input.origin,
            since_s: input.since_s,
            vertical_fov_rad: camera.vertical_fov_rad,
            near_m: NEAR_M,
        };
        self.post.begin(&self.queue, &shot);
        let mut is_first = true;
        for tile in self.targets.tiles() {
            // Every tile has uniforms of its own, which are written when its commands are submitted.
            let mut own = (tile.left > 0).then(|| self.device.create_command_encoder(&Default::default()));
            let encoder = own.as_mut().unwrap_or(encoder);
            if std::mem::take(&mut is_first) {
                self.observe(encoder, leaves, input.time_s);
            }
            self.draw_tile(encoder, leaves, branches, input, &tile);
            if let Some(own) = own {
                self.queue.submit([own.finish()]);
            }
        }
        let timer = self.timer.as_ref().map(|timer| (timer, TIMED_POSTS));
        self.post.draw(encoder, timer, output, &shot);
        if let Some(timer) = &self.timer {
            // An earlier frame may still be on its way; the next one will do.
            let _ = timer.resolve(encoder);
        }
    }

    /// Encodes light and depth of a part of the picture.
    fn draw_tile(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        leaves: &LeafColumns<'_>,
        branches: Option<&BranchColumns<'_>>,
        input: &FrameInput,
        tile: &Tile,
    ) {
        #[expect(clippy::cast_possible_truncation, reason = "wraps long before f32 seconds grow coarse")]
        let time_s = input.time_s.rem_euclid(3600.0) as f32;
        let frame = self.environment.frame(input, time_s, self.targets.size, tile);
        self.frame.write(&self.queue, &frame);
        if let Some(water) = &mut self.water_pass {
            water.prepare(&self.device, &self.queue, frame, self.targets.tile_size);
        }
        self.write_views(&frame, &input.camera);
        self.grass_pass.prepare(&self.queue, &input.camera, self.targets.size, &self.land);
        if self.shade_is_old {
            self.shade_pass.draw(encoder, &self.frame, &self.trees);
            self.shade_is_old = false;
        }
        let crowds = [&self.leaf_crowd, &self.litter_crowd];
        let group = self.branches.bind(&self.device, branches);
        let casters = Casters { kinds: &self.kinds, crowds: &crowds, bark: &self.bark, branches: &group };
        // The last tile is timed: its commands are those that are resolved.
        let timer = self.timer.as_ref().filter(|_| tile.left == 0);
        let writes = |pass| timer.map(|timer| timer.render_writes(pass));
        let shadow_writes = timer.map(|timer| timer.split_writes(0));
        let cull_for = |encoder: &mut wgpu::CommandEncoder, cascade| {
            self.cull_leaves(encoder, leaves, LeafView::Shadow(cascade));
        };
        self.shadow_pass.draw(encoder, shadow_writes, &self.frame, &casters, &cull_for);
        if self.water_pass.is_some() {
            self.cull_leaves(encoder, leaves, LeafView::Mirror);
        }
        self.draw_mirror(encoder, &group);
        self.cull_leaves(encoder, leaves, LeafView::Camera);
        self.draw_scene(encoder, writes(1), leaves.leaf_count, &group);
        self.targets.place(encoder, tile);
        self.post.take_tile(&self.queue, encoder, tile);
    }

    /// Whether leaves draw trails.
    pub fn has_trails(&self) -> bool {
        self.trail_pass.is_some()
    }

    /// Notes where `leaves` are at `time_s` for their trails, without drawing; nothing to do in a scene without trails.
    pub fn observe(&mut self, encoder: &mut wgpu::CommandEncoder, leaves: &LeafColumns<'_>, time_s: f64) {
        if let Some(trails) = &mut self.trail_pass {
            trails.sample(&self.device, &self.queue, encoder, leaves, time_s);
        }
    }

    /// Milliseconds the device last spent on each pass, where it can tell; call it after submitting a frame.
    pub fn timings(&mut self) -> Vec<(&'static str, f32)> {
        self.timer.as_mut().map_or_else(Vec::new, |timer| timer.collect(&self.device).to_vec())
    }

    /// Draws what the water mirrors; grass is too low to be seen in it.
    fn draw_mirror(&self, encoder: &mut wgpu::CommandEncoder, branches: &wgpu::BindGroup) {
        let Some(water) = &self.water_pass else { return };
        let Some(targets) = water.targets() else { return };
        let mut pass = begin_scene(encoder, targets, None);
        pass.set_bind_group(0, &water.frame.group, &[]);
        pass.set_bind_group(1, &self.light.group, &[]);
        self.draw_stand(&mut pass, branches);
        self.ground_pass.draw(&mut pass);
        self.tree_pass.draw(&mut pass, &self.trees);
        self.sky_pass.draw(&mut pass);
    }

    /// Draws the scene's own trees and all leaves; bind groups 0 and 1 are set.
    fn draw_stand(&self, pass: &mut wgpu::RenderPass<'_>, branches: &wgpu::BindGroup) {
        self.bark_pass.draw(pass, branches, &self.bark, &self.stems);
        self.leaf_pass.draw(pass, &self.kinds, [&self.leaf_crowd, &self.litter_crowd].into_iter());
        self.fruit_pass.draw(pass, branches);
    }

    /// Tells the culling what each view of a frame sees.
    fn write_views(&self, uniform: &FrameUniform, camera: &Camera) {
        let height_px = self.targets.size.1 as f32;
        let pixels_per_m = 0.5 * height_px / (0.5 * camera.vertical_fov_rad).tan();
        let seen =
            |frame: &FrameUniform| ViewUniform::perspective(frame.view_projection, frame.eye, pixels_per_m);
        self.cull.write(&self.queue, LeafView::Camera, &seen(uniform));
        if let Some(water) = &self.water_pass {
            self.cull.write(&self.queue, LeafView::Mirror, &seen(&water.mirrored(*uniform)));
        }
        for (cascade, clip) in uniform.shadows.into_iter().enumerate() {
            // The projection is parallel: half a map's edge is one in clip space.
            let scale = Vec3::new(clip[0][0], clip[1][0], clip[2][0]).length();
            let seen = ViewUniform::parallel(clip, 0.5 * SHADOW_SIZE as f32 * scale);
            self.cull.write(&self.queue, LeafView::Shadow(cascade), &seen);
        }
    }

    /// Chooses the leaves of the world and of the litter that a view shows.
    fn cull_leaves(&self, encoder: &mut wgpu::CommandEncoder, leaves: &LeafColumns<'_>, view: LeafView) {
        let (device, cull) = (&self.device, &self.cull);
        self.leaf_crowd.cull(device, encoder, cull, (leaves, &self.stems), view);
        if let Some(litter) = &self.litter {
            self.litter_crowd.cull(device, encoder, cull, (&litter.columns(), &self.stems), view);
        }
    }

    /// Near things first, so that what they hide is not shaded.
    fn draw_scene(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        leaf_count: u32,
        branches: &wgpu::BindGroup,
    ) {
        let mut pass = begin_scene(encoder, &self.targets, timestamps);
        pass.set_bind_group(0, &self.frame.group, &[]);
        pass.set_bind_group(1, &self.light.group, &[]);
        self.draw_stand(&mut pass, branches);
        self.grass_pass.draw(&mut pass);
        self.ground_pass.draw(&mut pass);
        if let Some(water) = &self.water_pass {
            water.draw(&mut pass);
        }
        self.tree_pass.draw(&mut pass, &self.trees);
        self.sky_pass.draw(&mut pass);
        if let Some(trails) = &self.trail_pass {
            trails.draw(&mut pass, leaf_count);
        }
    }
}

/// Begins a pass that draws the scene into `targets`.
fn begin_scene<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    targets: &Targets,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("scene"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &targets.color,
            depth_slice: None,
            resolve_target: Some(targets.resolve()),
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Discard,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// The trees of a stand as those that hide the sky from the meadow and may strew litter on it.
fn own_trees(stand: &Stand, strew: bool) -> Vec<TreeInstance> {
    let tree = |tree: &crate::trees::StandingTree| TreeInstance {
        foot_m: tree.foot_m,
        height_m: tree.skeleton.height_m(),
        width: 1.0,
        sprite: 0,
        hue: 0.0,
        brightness: f32::from(u8::from(strew)),
    };
    stand.trees.iter().filter(|tree| !tree.look.is_low).map(tree).collect()
}

/// All trees that have shed leaves before the scene begins.
fn shedding(planted: &[TreeInstance], stand: &Stand) -> Vec<Shedding> {
    let far = planted.iter();
    let far = far.map(|tree| Shedding { foot_m: tree.foot_m, height_m: tree.height_m, species: None });
    let own = stand.trees.iter().filter(|tree| !tree.look.is_low).map(|tree| Shedding {
        foot_m: tree.foot_m,
        height_m: tree.skeleton.height_m(),
        species: tree.species,
    });
    far.chain(own).collect()
}
