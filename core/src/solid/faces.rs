// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Polyhedra and meshes of a scene, with what kernels need of them.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DVec3, Vec3};
use thiserror::Error;

use super::distance_grid::DistanceGrid;
use super::mesh_file::{self, MeshError};
use crate::hull::{Face, Hull, HullError};
use crate::scene::{ObjectShape, PLANE_REACH_M};
use crate::surface::{Surface, SurfaceError};

/// Depth in m down to which a plane is drawn.
const PLANE_DEPTH_M: f32 = 1.0;

/// A shape with faces.
#[derive(Clone, Debug)]
pub(crate) enum Faces {
    /// A convex one: its surface, and the planes that it is between.
    Convex(Arc<Surface>, Arc<[Face]>),
    /// Any other: its surface, and the distances from it.
    Mesh(Arc<Surface>, Arc<DistanceGrid>),
}

/// Meshes that have been read, by file and scale.
pub(super) type MeshesRead = HashMap<(String, u32), Faces>;

/// Faults of a shape with faces.
#[derive(Debug, Error)]
pub(super) enum FacesError {
    #[error(transparent)]
    Hull(#[from] HullError),
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl FacesError {
    /// Shapes that are allowed in place of the one with the fault.
    pub(super) fn allowed(&self) -> String {
        match self {
            Self::Hull(_) => "the corners of a convex polyhedron".into(),
            Self::Surface(error) => error.allowed(),
            Self::Mesh(error) => error.allowed(),
        }
    }
}

/// Surface and faces of the polyhedron between corners.
fn polyhedron(corners_m: &[Vec3]) -> Result<(Surface, Vec<Face>), FacesError> {
    let hull = Hull::around(corners_m)?;
    let corners_m: Vec<[f32; 3]> = corners_m.iter().map(Vec3::to_array).collect();
    Ok((Surface::new(&corners_m, &hull.triangles)?, hull.faces))
}

/// Corners of the slab below a plane.
fn slab() -> Vec<Vec3> {
    let sign = |corner: u32, bit: u32| if corner & bit == 0 { -PLANE_REACH_M } else { PLANE_REACH_M };
    let depth_m = |corner: u32| if corner & 4 == 0 { 0.0 } else { -PLANE_DEPTH_M };
    (0..8).map(|corner| Vec3::new(sign(corner, 1), depth_m(corner), sign(corner, 2))).collect()
}

impl Faces {
    /// The faces of a shape; `None` for round ones and boxes.
    pub(super) fn of(shape: &ObjectShape, read: &mut MeshesRead) -> Result<Option<Self>, FacesError> {
        match shape {
            ObjectShape::Plane => {
                let (surface, faces) = polyhedron(&slab())?;
                let top: Vec<Face> = faces.into_iter().filter(|face| face.normal.y > 0.5).collect();
                Ok(Some(Self::Convex(Arc::new(surface), top.into())))
            }
            ObjectShape::Polyhedron { corners_m } => {
                let (surface, faces) = polyhedron(corners_m)?;
                Ok(Some(Self::Convex(Arc::new(surface), faces.into())))
            }
            ObjectShape::Mesh { file, scale } => {
                let key = (file.clone(), scale.to_bits());
                if let Some(faces) = read.get(&key) {
                    return Ok(Some(faces.clone()));
                }
                let surface = mesh_file::read(file, *scale)?;
                let grid = DistanceGrid::of(&surface);
                let faces = Self::Mesh(Arc::new(surface), Arc::new(grid));
                read.insert(key, faces.clone());
                Ok(Some(faces))
            }
            _ => Ok(None),
        }
    }

    pub(super) fn surface(&self) -> &Arc<Surface> {
        match self {
            Self::Convex(surface, _) | Self::Mesh(surface, _) => surface,
        }
    }

    /// Distance in m from the origin to the farthest corner.
    pub(crate) fn bound_m(&self) -> f64 {
        self.surface().corners_m().iter().map(|corner| corner.length()).fold(0.0, f64::max)
    }

    /// Lowest and highest coordinates in m after a turn about the origin.
    pub(crate) fn turned_extent_m(&self, turn: glam::DQuat) -> [DVec3; 2] {
        let corners = || self.surface().corners_m().iter().map(|corner| turn * *corner);
        [corners().fold(DVec3::INFINITY, DVec3::min), corners().fold(DVec3::NEG_INFINITY, DVec3::max)]
    }
}
