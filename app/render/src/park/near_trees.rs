// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees of the park that stand too near to be painted: grown like those of a scene, and drawn by the same passes. They sway in its wind.

use glam::{Vec2, Vec3};
use windfall_core::device::leaf::record::{STATE_ATTACHED, STATE_DORMANT, leaf_state};
use windfall_core::leaf::Place;
use windfall_core::scene::{Ground, Tree, TreePreset, WindParameters};
use windfall_core::{CompiledScene, Scene, World};
use windfall_wgpu::LeafColumns;

use super::layout::TreeInstance;
use super::still_leaves::StillLeaves;
use super::sway::{MOST_TREES, Sway};
use super::tree_sprite::kind_of;
use crate::leaves::cull::CullPass;
use crate::leaves::visible::VisibleLeaves;
use crate::quality::Quality;
use crate::trees::SceneTrees;
use crate::trees::bark_mesh::BarkBuffers;
use crate::trees::branch_group::BranchGroup;
use crate::trees::records::TreeRecords;

/// Distance from the eye up to which trees are grown, in metres.
const REACH_M: f32 = 42.0;
/// Leaves of a tree, each for several.
const LEAVES: u32 = 1600;
/// Share of their autumn that has passed.
const AUTUMN: f32 = 0.5;
/// Different trees of a kind: others are the same ones turned.
const INDIVIDUALS: u32 = 3;

/// Least cosine of the angle between the view and a tree that is grown: far aside it is hardly looked at.
const IN_VIEW: f32 = 0.3;
/// Kinds that stand for those whose leaves no species of the scene has.
const COMMON: [TreePreset; 3] = [TreePreset::Maple, TreePreset::Birch, TreePreset::Oak];

/// Parts the trees of a park into those that are grown, nearest first, and those that are painted: what a camera at `eye_m` that looks along
/// `view`, a unit vector in the ground plane, has before it. All are painted where no species of the scene is that of a tree, and where it
/// snows: the bed has no room for snow on trees that are not the scene's.
pub(crate) fn part(
    scene: &Scene,
    trees: Vec<TreeInstance>,
    eye_m: Vec3,
    view: Vec2,
) -> (Vec<TreeInstance>, Vec<TreeInstance>) {
    let offset = |tree: &TreeInstance| Vec2::new(tree.foot_m.x - eye_m.x, tree.foot_m.z - eye_m.z);
    let is_near = |tree: &TreeInstance| {
        let distance_m = offset(tree).length();
        let is_ahead = offset(tree).dot(view) > IN_VIEW * distance_m;
        let is_snowless = scene.weather.is_none();
        is_snowless && is_ahead && distance_m < REACH_M && preset_of(scene, tree).is_some()
    };
    let (mut near, mut far): (Vec<_>, Vec<_>) = trees.into_iter().partition(is_near);
    near.sort_by(|a, b| offset(a).length().total_cmp(&offset(b).length()));
    far.extend(near.drain(MOST_TREES.min(near.len())..));
    (near, far)
}

/// The kind that a planted tree is grown as: its own, or one whose leaves the scene has; `None` without any, and for bushes.
fn preset_of(scene: &Scene, tree: &TreeInstance) -> Option<TreePreset> {
    let own = Some(kind_of(tree.kind)).filter(|&preset| preset != TreePreset::Bush)?;
    std::iter::once(own)
        .chain(COMMON)
        .find(|preset| scene.species.iter().any(|species| preset.leaf_shapes().contains(&species.shape)))
}

/// Grown trees with their leaves.
#[derive(Debug)]
pub(crate) struct NearTrees {
    pub(crate) bark: BarkBuffers,
    /// Their branches as they sway.
    pub(crate) branches: wgpu::BindGroup,
    pub(crate) records: TreeRecords,
    pub(crate) visible: VisibleLeaves,
    leaves: StillLeaves,
    sway: Sway,
    /// The wind that they stand in.
    compiled: CompiledScene,
}

impl NearTrees {
    /// The trees of `near`, which stand in the park of `scene`; `None` without any.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        cull: &CullPass,
        scene: &Scene,
        near: &[TreeInstance],
        (eye_m, quality): (Vec3, Quality),
    ) -> Option<Self> {
        let grove = grove(scene, near);
        // A scene whose trees cannot be grown has none near: scenery is not worth an error.
        let mut world = World::build(&grove).ok().filter(|world| !world.leaves.place.is_empty())?;
        hide_fallen(&mut world.leaves.place);
        let scene_trees = SceneTrees::of(&grove, world.compiled.forest());
        let columns = [
            bytemuck::cast_slice(&world.leaves.place),
            bytemuck::cast_slice(&world.leaves.attitude),
            bytemuck::cast_slice(&world.leaves.schedule),
            bytemuck::cast_slice(&world.leaves.identity),
        ];
        let count = u32::try_from(world.leaves.place.len()).ok()?;
        let records = TreeRecords::new(device, queue, &scene_trees);
        // Nobody counts the twigs of scenery.
        let detail = if quality == Quality::Full { Quality::Draft } else { quality };
        let group = BranchGroup::new(device, queue, &scene_trees);
        let leaves = StillLeaves::new(device, queue, columns, count);
        let sway = Sway::new(device, queue, &scene_trees, &leaves);
        Some(Self {
            bark: BarkBuffers::new(device, queue, &scene_trees, (eye_m, detail)),
            branches: group.bind(device, Some(&sway.branches()), &records, None),
            visible: VisibleLeaves::new(device, queue, cull, &scene_trees, count),
            leaves,
            records,
            sway,
            compiled: world.compiled,
        })
    }

    /// Moves the trees to a time in seconds; `grass_rad` is the phase of the grass.
    pub(crate) fn sway(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        (time_s, grass_rad): (f64, f32),
    ) {
        self.sway.run(queue, encoder, &self.compiled, (time_s, grass_rad));
    }

    /// Their leaves as columns.
    pub(crate) fn leaves(&self) -> LeafColumns<'_> {
        let Sway { leaf_place: place, leaf_attitude: attitude, .. } = &self.sway;
        LeafColumns { place, attitude, ..self.leaves.columns() }
    }
}

/// Hides leaves that hang on no twig: those that have been shed before belong to the scene's own litter and wind.
fn hide_fallen(places: &mut [Place]) {
    for place in places.iter_mut().filter(|place| leaf_state(place.bits) != STATE_ATTACHED) {
        place.bits = STATE_DORMANT;
    }
}

/// A scene of nothing but the near trees.
fn grove(scene: &Scene, near: &[TreeInstance]) -> Scene {
    let tree = |(number, tree): (u32, &TreeInstance)| Tree {
        kind: preset_of(scene, tree).unwrap_or(TreePreset::Maple).name().to_owned(),
        at_m: [tree.foot_m.x, tree.foot_m.z],
        height_m: Some(tree.height_m),
        heading_deg: tree.turn_rad.to_degrees(),
        number: 100 + number % INDIVIDUALS,
        leaves: LEAVES,
        ..Tree::default()
    };
    let ground = Ground { litter: None, ..scene.ground };
    Scene {
        species: scene.species.clone(),
        trees: (0..).zip(near).map(tree).collect(),
        autumn: AUTUMN,
        ground,
        seed: scene.seed,
        dt_s: scene.dt_s,
        wind: WindParameters {
            vortices: Vec::new(),
            jets: Vec::new(),
            plumes: Vec::new(),
            ..scene.wind.clone()
        },
        ..Scene::default()
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::{LeafShape, Species, Weather};

    use super::*;
    use crate::park::tree_sprite::TREE_COUNT;

    fn scene(shape: LeafShape) -> Scene {
        Scene { species: vec![Species { shape, ..Species::default() }], ..Scene::default() }
    }

    /// Trees of every kind in a row along the view, from 10 metres on, and one behind the eye.
    fn row() -> Vec<TreeInstance> {
        let tree = |kind: u32, along_m: f32| TreeInstance {
            foot_m: Vec3::new(0.0, 0.0, -along_m),
            height_m: 12.0,
            width: 1.0,
            kind,
            turn_rad: 1.0,
            cut: 0.0,
            hue: 0.5,
            brightness: 1.0,
        };
        (0..10)
            .map(|number| tree(number % TREE_COUNT, 55.0 - 5.0 * number as f32))
            .chain([tree(0, -12.0)])
            .collect()
    }

    #[test]
    fn the_nearest_trees_in_view_are_grown() {
        let (near, far) = part(&scene(LeafShape::Maple), row(), Vec3::ZERO, Vec2::NEG_Y);
        assert_eq!((near.len(), far.len()), (MOST_TREES, 11 - MOST_TREES), "as many as there may be");
        assert!(near.windows(2).all(|pair| pair[0].foot_m.z > pair[1].foot_m.z), "nearest first: {near:?}");
        assert!(near.iter().all(|tree| kind_of(tree.kind) != TreePreset::Bush), "no bushes");
        assert!(far.iter().any(|tree| tree.foot_m.z > 0.0), "not behind the eye");
        let grove = grove(&scene(LeafShape::Maple), &near);
        assert!(
            grove.trees.iter().all(|tree| tree.kind == "maple"),
            "of the leaves there are: {:?}",
            grove.trees
        );
        let mut world = World::build(&grove).expect("a scene of trees");
        hide_fallen(&mut world.leaves.place);
        let with_state =
            |state| world.leaves.place.iter().filter(|place| leaf_state(place.bits) == state).count();
        let (hanging, hidden) = (with_state(STATE_ATTACHED), with_state(STATE_DORMANT));
        assert!(hanging > 500 * near.len(), "with leaves: {hanging}");
        assert_eq!(hanging + hidden, world.leaves.place.len(), "none in the air or on the ground");
    }

    #[test]
    fn without_leaves_of_trees_all_are_painted() {
        let (near, far) = part(&scene(LeafShape::Feather), row(), Vec3::ZERO, Vec2::NEG_Y);
        assert_eq!((near.len(), far.len()), (0, 11), "feathers grow on no tree");
        let snowy = Scene { weather: Some(Weather::default()), ..scene(LeafShape::Maple) };
        let (near, _) = part(&snowy, row(), Vec3::ZERO, Vec2::NEG_Y);
        assert!(near.is_empty(), "snow would lie on none of them");
    }
}
