// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes of solid parts: those that all parts of a kind share, and those of polyhedra and meshes of a scene.

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;
use windfall_core::solid::{Solid, Surface};

use super::solid_mesh::{SolidMesh, SolidSize, SolidVertex};
use super::surface_mesh::surface_mesh;

/// Size of what is drawn as large as its vertices have it.
pub(super) const OWN_SIZE: SolidSize = SolidSize { inner_m: Vec3::ONE, rounding_m: 0.0 };

/// Size of a part in terms of its mesh.
pub(crate) fn mesh_size(solid: &Solid) -> SolidSize {
    SolidMesh::of(&solid.shape).map_or(OWN_SIZE, |(_, size)| size)
}

/// Vertices and triangles of a part, and its size in terms of these.
pub fn mesh_of(solid: &Solid) -> (Vec<SolidVertex>, Vec<u32>, SolidSize) {
    let (vertices, indices) = match (SolidMesh::of(&solid.shape), solid.surface()) {
        (None, Some(surface)) => surface_mesh(surface),
        (Some((mesh, _)), _) => mesh.build(),
        (None, None) => Default::default(),
    };
    (vertices, indices, mesh_size(solid))
}

/// Meshes in one vertex and one index list.
#[derive(Debug, Default)]
pub(crate) struct SolidMeshes {
    pub(crate) vertices: Vec<SolidVertex>,
    pub(crate) indices: Vec<u32>,
    /// Indices of each: the shared ones, then those of the surfaces.
    ranges: Vec<Range<u32>>,
    surfaces: Vec<Arc<Surface>>,
}

impl SolidMeshes {
    /// The shared ones, and those of parts with surfaces of their own.
    pub(crate) fn of<'a>(solids: impl Iterator<Item = &'a Solid>) -> Self {
        let mut meshes = Self::default();
        SolidMesh::ALL.iter().for_each(|mesh| meshes.add(mesh.build()));
        for surface in solids.filter_map(Solid::surface) {
            if !meshes.surfaces.iter().any(|known| Arc::ptr_eq(known, surface)) {
                meshes.surfaces.push(surface.clone());
                meshes.add(surface_mesh(surface));
            }
        }
        meshes
    }

    fn add(&mut self, (vertices, indices): (Vec<SolidVertex>, Vec<u32>)) {
        let count = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
        let (base, first) = (count(self.vertices.len()), count(self.indices.len()));
        self.vertices.extend(vertices);
        self.indices.extend(indices.iter().map(|index| base + index));
        self.ranges.push(first..count(self.indices.len()));
    }

    /// Number of the mesh of a part.
    pub(crate) fn number_of(&self, solid: &Solid) -> usize {
        let own = |surface| self.surfaces.iter().position(|known| Arc::ptr_eq(known, surface));
        match SolidMesh::of(&solid.shape) {
            Some((mesh, _)) => mesh as usize,
            None => solid.surface().and_then(own).map_or(0, |at| SolidMesh::ALL.len() + at),
        }
    }

    /// Indices of a mesh by its number.
    pub(crate) fn range(&self, number: usize) -> Range<u32> {
        self.ranges[number].clone()
    }
}
