// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drawing: all leaves of a fall as one mesh, whose vertex shader reads where they are from a buffer.

use std::ops::Range;
use std::sync::Arc;

use bevy::asset::{RenderAssetUsages, uuid_handle};
use bevy::camera::visibility::NoFrustumCulling;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::pbr::{ExtendedMaterial, MaterialExtension};
use bevy::prelude::*;
use bevy::render::render_resource::AsBindGroup;
use bevy::render::storage::ShaderBuffer;
use bevy::shader::{Shader, ShaderRef};
use bevy::tasks::futures::check_ready;
use bevy::tasks::{AsyncComputeTaskPool, Task};
use bytemuck::{Pod, Zeroable};
use windfall_core::device::leaf::burn::scene_species;
use windfall_core::device::leaf::record::{drawn_size, leaf_variant};
use windfall_core::leaf::LeafState;

use crate::leaves::Leaves;
use crate::pictures::Pictures;
use crate::plugin::WindfallSystems;

/// Most leaves of a fall that are drawn: those of the first slots.
const MOST_DRAWN: usize = 1 << 20;
/// Corners along each side of the grid that a leaf is drawn with. The shader states how many a leaf has.
const SIDE_CORNERS: u32 = 3;
/// Place of the picture in the word of a row.
const PICTURE_SHIFT: u32 = 16;
/// Mark of a leaf at rest there; stated in the shader as well.
const RESTING: u32 = 1 << 31;

const SHADER: Handle<Shader> = uuid_handle!("5b8f4f0e-3c1d-4d0f-9e55-0c9a6a1f7c2e");

/// Material of leaves: Bevy's own, lit like everything else, with the picture of each leaf. Its base may be changed: roughness, light that
/// passes through, a colour that all are multiplied by.
pub type LeafMaterial = ExtendedMaterial<StandardMaterial, LeafExtension>;

/// Buffers that the vertex shader of [`LeafMaterial`] reads.
#[derive(Asset, AsBindGroup, TypePath, Clone, Debug)]
pub struct LeafExtension {
    /// A [`LeafRow`] for every slot.
    #[storage(100, read_only, visibility(vertex))]
    pub rows: Handle<ShaderBuffer>,
    /// A row for every picture.
    #[storage(101, read_only, visibility(vertex))]
    pictures: Handle<ShaderBuffer>,
}

impl MaterialExtension for LeafExtension {
    fn vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn prepass_vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn deferred_vertex_shader() -> ShaderRef {
        SHADER.into()
    }
}

/// A leaf in the buffer that is drawn from, 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct LeafRow {
    /// Position in metres, in the frame of the fall.
    pub position: [f32; 3],
    /// Size relative to the species' in 2^-14 in the low half, 0 of what is not drawn; number of the picture above it; the highest bit of
    /// a leaf at rest.
    pub look: u32,
    /// Orientation as a quaternion x, y, z, w; zero of a leaf that nothing has turned yet.
    pub attitude: [f32; 4],
}

/// Pictures on their way.
#[derive(Component)]
struct Painting(Task<Pictures>);

/// A fall that is drawn.
#[derive(Component, Debug)]
struct Drawing {
    rows: Handle<ShaderBuffer>,
    /// Pictures of each species.
    of_species: Vec<Range<u32>>,
    /// Step that is in the buffer.
    drawn: Option<u32>,
}

/// Draws every fall.
pub(crate) struct DrawPlugin;

impl Plugin for DrawPlugin {
    fn build(&self, app: &mut App) {
        let shader = Shader::from_wgsl(include_str!("leaf.wgsl"), "bevy_windfall/leaf.wgsl");
        app.world_mut()
            .resource_mut::<Assets<Shader>>()
            .insert(&SHADER, shader)
            .expect("a handle with a name of its own takes every shader");
        app.add_plugins(MaterialPlugin::<LeafMaterial>::default())
            .add_observer(begin_painting)
            .add_systems(PostUpdate, (finish_painting, upload).chain().in_set(WindfallSystems::Draw));
    }
}

/// Unpacks pictures for leaves that have just been built. Nothing is drawn meanwhile: the mesh of earlier leaves has another size.
fn begin_painting(built: On<Insert, Leaves>, mut commands: Commands, falls: Query<&Leaves>) {
    let Ok(leaves) = falls.get(built.entity) else { return };
    let scene = Arc::new(leaves.world().compiled.scene().clone());
    let paint = async move { Pictures::of(&scene) };
    commands
        .entity(built.entity)
        .remove::<(Drawing, Mesh3d, MeshMaterial3d<LeafMaterial>)>()
        .insert(Painting(AsyncComputeTaskPool::get().spawn(paint)));
}

/// Makes mesh and material of leaves whose pictures are ready.
fn finish_painting(
    mut commands: Commands,
    mut falls: Query<(Entity, &mut Painting, &Leaves)>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut images: ResMut<Assets<Image>>,
    mut buffers: ResMut<Assets<ShaderBuffer>>,
    mut materials: ResMut<Assets<LeafMaterial>>,
) {
    for (fall, mut painting, leaves) in &mut falls {
        let Some(pictures) = check_ready(&mut painting.0) else { continue };
        let drawing = Drawing {
            rows: buffers
                .add(ShaderBuffer::new(&rows(leaves, &pictures.of_species), RenderAssetUsages::RENDER_WORLD)),
            of_species: pictures.of_species,
            drawn: Some(leaves.steps()),
        };
        let material = LeafMaterial {
            base: StandardMaterial {
                base_color_texture: Some(images.add(pictures.image)),
                alpha_mode: AlphaMode::Mask(0.5),
                double_sided: true,
                cull_mode: None,
                perceptual_roughness: 0.6,
                reflectance: 0.3,
                diffuse_transmission: 0.35,
                ..default()
            },
            extension: LeafExtension {
                rows: drawing.rows.clone(),
                pictures: buffers.add(ShaderBuffer::new(
                    bytemuck::cast_slice(&pictures.rows),
                    RenderAssetUsages::RENDER_WORLD,
                )),
            },
        };
        commands.entity(fall).remove::<Painting>().insert((
            drawing,
            Mesh3d(meshes.add(mesh(leaves.len().min(MOST_DRAWN)))),
            MeshMaterial3d(materials.add(material)),
            // The mesh says nothing of where leaves are.
            NoFrustumCulling,
        ));
    }
}

/// Hands the leaves of this step to the renderer, which writes them into the buffer that it has.
fn upload(mut falls: Query<(&Leaves, &mut Drawing)>, mut buffers: ResMut<Assets<ShaderBuffer>>) {
    for (leaves, mut drawing) in &mut falls {
        if drawing.drawn == Some(leaves.steps()) {
            continue;
        }
        if let Some(mut buffer) = buffers.get_mut(&drawing.rows) {
            buffer.data = Some(rows(leaves, &drawing.of_species));
            drawing.drawn = Some(leaves.steps());
        }
    }
}

/// Bytes of a [`LeafRow`] for every leaf that is drawn.
fn rows(leaves: &Leaves, of_species: &[Range<u32>]) -> Vec<u8> {
    let context = leaves.context();
    let store = &leaves.world().leaves;
    let columns = store.place.iter().zip(&store.attitude).zip(&store.schedule).zip(&store.identity);
    let mut bytes = Vec::with_capacity(leaves.len().min(MOST_DRAWN) * size_of::<LeafRow>());
    for (((place, attitude), schedule), identity) in columns.take(MOST_DRAWN) {
        let state = place.state();
        let mut row = LeafRow { position: place.position, look: 0, attitude: attitude.quaternion };
        if state != LeafState::Dormant {
            let pictures = &of_species[scene_species(&context, place.bits) as usize];
            let picture =
                pictures.start + leaf_variant(identity.appearance) % (pictures.end - pictures.start).max(1);
            row.look = drawn_size(schedule.size) | picture << PICTURE_SHIFT;
            row.look |= if state == LeafState::Resting { RESTING } else { 0 };
        }
        bytes.extend_from_slice(bytemuck::bytes_of(&row));
    }
    bytes
}

/// A grid for every leaf. Corners only say where on the picture they are; the shader finds their leaf by their number.
fn mesh(leaf_count: usize) -> Mesh {
    let leaf_count = u32::try_from(leaf_count).expect("at most the leaves that are drawn");
    let corners = (0..SIDE_CORNERS).flat_map(|y| (0..SIDE_CORNERS).map(move |x| UVec2::new(x, y)));
    let corners: Vec<[f32; 2]> =
        corners.map(|corner| (corner.as_vec2() / (SIDE_CORNERS - 1) as f32).to_array()).collect();
    let uvs: Vec<[f32; 2]> = (0..leaf_count).flat_map(|_| corners.iter().copied()).collect();
    let cells = (0..SIDE_CORNERS - 1).flat_map(|y| (0..SIDE_CORNERS - 1).map(move |x| x + y * SIDE_CORNERS));
    let triangles: Vec<u32> = cells
        .flat_map(|at| [0, SIDE_CORNERS, 1, 1, SIDE_CORNERS, SIDE_CORNERS + 1].map(|corner| at + corner))
        .collect();
    let first_corners = (0..leaf_count).map(|leaf| leaf * SIDE_CORNERS.pow(2));
    let indices =
        first_corners.flat_map(|first| triangles.iter().map(move |corner| first + corner)).collect();
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::RENDER_WORLD)
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, uvs)
        .with_inserted_indices(Indices::U32(indices))
}

#[cfg(test)]
mod tests {
    use windfall_core::Scene;

    use super::*;

    #[test]
    fn every_leaf_has_a_row_and_a_grid() {
        let scene = Scene::preset("six-motions").expect("a preset");
        let leaves = Leaves::build(&scene, Some(1)).expect("it builds");
        let pictures = Pictures::of(&scene);
        let rows = rows(&leaves, &pictures.of_species);
        assert_eq!(rows.len(), 32 * leaves.len(), "32 bytes a leaf");
        for (slot, row) in rows.chunks_exact(32).enumerate() {
            let row: LeafRow = bytemuck::pod_read_unaligned(row);
            let leaf = leaves.leaf(slot);
            assert_eq!(
                row.look == 0,
                leaf.state == LeafState::Dormant,
                "slot {slot} is drawn unless dormant"
            );
            if row.look != 0 {
                let picture = (row.look & !RESTING) >> PICTURE_SHIFT;
                assert!(pictures.of_species[leaf.species].contains(&picture), "a picture of its species");
                assert_eq!(Vec3::from(row.position), leaf.position, "where it is");
            }
        }
        let mesh = mesh(leaves.len());
        assert_eq!(mesh.count_vertices(), 9 * leaves.len(), "nine corners a leaf");
        let last = mesh.indices().expect("triangles").iter().max();
        assert_eq!(last, Some(mesh.count_vertices() - 1), "triangles reach the last corner");
    }

    #[test]
    fn the_shader_states_the_same_constants() {
        let shader = include_str!("leaf.wgsl");
        let corners = format!("const LEAF_CORNERS: u32 = {}u;", SIDE_CORNERS.pow(2));
        let resting = format!("const RESTING: u32 = {RESTING:#x}u;");
        assert!(shader.contains(&corners) && shader.contains(&resting), "{corners} {resting}");
        assert!(shader.contains(&format!(">> {PICTURE_SHIFT}u")), "and where the picture is");
    }

    #[test]
    fn the_texture_has_every_picture_at_every_level() {
        let scene = Scene::preset("flight-lab").expect("a preset");
        let Pictures { image, rows, of_species } = Pictures::of(&scene);
        assert_eq!(of_species.len(), scene.species.len(), "pictures of every species");
        assert!(of_species.iter().all(|pictures| !pictures.is_empty()), "at least one each");
        let levels = image.texture_descriptor.mip_level_count;
        let size = image.texture_descriptor.size;
        let texels: u32 = (0..levels).map(|level| (size.width >> level) * (size.height >> level)).sum();
        let bytes = image.data.expect("texels");
        assert_eq!(bytes.len(), 4 * texels as usize, "all levels");
        assert!(
            size.width * size.height >= 128 * 128 * u32::try_from(rows.len()).expect("few"),
            "room for all"
        );
    }
}
