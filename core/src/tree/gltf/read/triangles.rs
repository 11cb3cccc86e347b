// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! All triangles of a file, where its nodes put them.

use glam::{DMat4, Vec3};
use gltf::mesh::{Mode, Primitive};
use gltf::{Document, Semantic};

use super::accessor::Source;
use super::nodes::Nodes;
use super::{GltfError, MAX_VERTICES};

/// Triangles at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GltfTriangles {
    /// Places of their corners in m.
    pub positions_m: Vec<[f32; 3]>,
    /// Numbers of the corners of each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl GltfTriangles {
    /// The triangles of a document.
    ///
    /// # Errors
    /// [`GltfError::NoTriangles`] if there are none, [`GltfError::Accessor`] for data that cannot be used, [`GltfError::Vertices`] for
    /// too many vertices.
    pub(super) fn of(source: &Source<'_>, document: &Document) -> Result<Self, GltfError> {
        let nodes = Nodes::of(document, source.file)?;
        let mut all = Self::default();
        for node in document.nodes() {
            let primitives = node.mesh().into_iter().flat_map(|mesh| mesh.primitives());
            for primitive in primitives.filter(|primitive| primitive.mode() == Mode::Triangles) {
                all.add(source, &primitive, nodes.world[node.index()])?;
            }
        }
        if all.triangles.is_empty() {
            return Err(GltfError::NoTriangles { file: source.file.into() });
        }
        Ok(all)
    }

    fn add(&mut self, source: &Source<'_>, primitive: &Primitive<'_>, world: DMat4) -> Result<(), GltfError> {
        let Some(accessor) = primitive.get(&Semantic::Positions) else { return Ok(()) };
        let own = source.floats::<3>(&accessor, "POSITION")?;
        let (first, count) = (self.positions_m.len(), own.len());
        if first + count > MAX_VERTICES {
            return Err(GltfError::Vertices { file: source.file.into(), found: first + count });
        }
        for (at, place) in own.into_iter().enumerate() {
            let place = world.transform_point3(Vec3::from_array(place).as_dvec3()).as_vec3();
            if !place.is_finite() {
                let reason = format!("element {at} is moved to {place}; allowed: finite places");
                return Err(source.reject(&accessor, "POSITION", reason));
            }
            self.positions_m.push(place.to_array());
        }
        let indices = match primitive.indices() {
            Some(accessor) => source.indices(&accessor, count)?,
            None => (0..).take(count).collect(),
        };
        // A node that mirrors turns triangles round.
        let is_mirrored = world.determinant() < 0.0;
        let number = |index: u32| u32::try_from(first).unwrap_or(u32::MAX) + index;
        let (triangles, _) = indices.as_chunks::<3>();
        self.triangles.extend(triangles.iter().map(|&[a, b, c]| {
            let [b, c] = if is_mirrored { [c, b] } else { [b, c] };
            [a, b, c].map(number)
        }));
        Ok(())
    }
}
