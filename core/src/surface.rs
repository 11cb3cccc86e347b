// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Closed surfaces of triangles.

use std::collections::HashMap;

use glam::DVec3;
use thiserror::Error;

/// Most triangles of a surface.
pub const MAX_TRIANGLES: usize = 1 << 17;

/// A surface of triangles without a rim, which has an inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    corners_m: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// Faults of triangles as the surface of a solid thing.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SurfaceError {
    /// More triangles than are taken.
    #[error("has {found} triangles")]
    Triangles {
        /// Number of triangles.
        found: usize,
    },
    /// An edge with one side only.
    #[error("is open: the edge from {from_m:?} to {to_m:?} (m) has one side only")]
    Open {
        /// One end in m.
        from_m: [f32; 3],
        /// The other.
        to_m: [f32; 3],
    },
    /// An edge along which more than two triangles meet, or two that face opposite ways.
    #[error(
        "is folded: at the edge from {from_m:?} to {to_m:?} (m) it is not two triangles that meet and face the same way"
    )]
    Folded {
        /// One end in m.
        from_m: [f32; 3],
        /// The other.
        to_m: [f32; 3],
    },
    /// Triangles that enclose nothing, or face inwards.
    #[error("encloses {volume_m3} m³")]
    Empty {
        /// Volume in m³, below zero where triangles face inwards.
        volume_m3: f64,
    },
}

impl SurfaceError {
    /// Surfaces that are allowed in place of the one with the fault.
    pub fn allowed(&self) -> String {
        match self {
            Self::Triangles { .. } => format!("up to {MAX_TRIANGLES} triangles"),
            Self::Open { .. } | Self::Folded { .. } => "a closed surface".into(),
            Self::Empty { .. } => "more than 0 m³, with triangles counter-clockwise from outside".into(),
        }
    }
}

impl Surface {
    /// The surface of triangles, whose corners are counter-clockwise from outside. Corners at the same place become one, and triangles
    /// without area go.
    ///
    /// # Errors
    /// [`SurfaceError`].
    pub fn new(corners_m: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Self, SurfaceError> {
        if triangles.len() > MAX_TRIANGLES {
            return Err(SurfaceError::Triangles { found: triangles.len() });
        }
        let mut own = Vec::new();
        let mut numbers = HashMap::new();
        // Zeros of either sign are one place.
        let place = |corner: [f32; 3]| corner.map(|number| (number + 0.0).to_bits());
        let joined: Vec<u32> = corners_m
            .iter()
            .map(|&corner| {
                *numbers.entry(place(corner)).or_insert_with(|| {
                    own.push(DVec3::from(corner.map(f64::from)));
                    crate::convert::len32(own.len() - 1)
                })
            })
            .collect();
        let triangles: Vec<[u32; 3]> = triangles
            .iter()
            .map(|triangle| triangle.map(|corner| joined[corner as usize]))
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect();
        let surface = Self { corners_m: own, triangles };
        surface.check()?;
        Ok(surface)
    }

    fn check(&self) -> Result<(), SurfaceError> {
        let mut edges: HashMap<[u32; 2], u32> = HashMap::new();
        for edge in self.directed_edges() {
            *edges.entry(edge).or_default() += 1;
        }
        for edge @ [from, to] in self.directed_edges() {
            let ends = || [from, to].map(|corner| self.corners_m[corner as usize].as_vec3().to_array());
            match (edges[&edge], edges.get(&[to, from])) {
                (1, Some(1)) => {}
                (1, None) => {
                    let [from_m, to_m] = ends();
                    return Err(SurfaceError::Open { from_m, to_m });
                }
                _ => {
                    let [from_m, to_m] = ends();
                    return Err(SurfaceError::Folded { from_m, to_m });
                }
            }
        }
        let volume_m3 = self.volume_m3();
        if volume_m3 > 0.0 { Ok(()) } else { Err(SurfaceError::Empty { volume_m3 }) }
    }

    fn directed_edges(&self) -> impl Iterator<Item = [u32; 2]> {
        self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
    }

    /// Its corners in m.
    pub fn corners_m(&self) -> &[DVec3] {
        &self.corners_m
    }

    /// Numbers of the corners of every triangle, counter-clockwise from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Corners of every triangle in m.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = [DVec3; 3]> {
        self.triangles.iter().map(|triangle| triangle.map(|corner| self.corners_m[corner as usize]))
    }

    /// Lowest and highest coordinates in m.
    pub fn extent_m(&self) -> [DVec3; 2] {
        let all = |fold: fn(DVec3, DVec3) -> DVec3| self.corners_m.iter().copied().reduce(fold);
        // A surface that encloses something has corners.
        [all(DVec3::min).unwrap_or_default(), all(DVec3::max).unwrap_or_default()]
    }

    /// Volume that it encloses in m³.
    pub fn volume_m3(&self) -> f64 {
        self.faces().map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    /// Area in m² of what it hides when seen from a direction: of a convex one exactly, of others at most.
    pub(crate) fn shadow_m2(&self, toward: DVec3) -> f64 {
        self.faces().map(|[a, b, c]| (b - a).cross(c - a).dot(toward).abs()).sum::<f64>() / 4.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS_M: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

    #[test]
    fn a_tetrahedron_encloses_a_sixth() {
        let surface = Surface::new(&CORNERS_M, &FACES).expect("closed");
        assert!((surface.volume_m3() - 1.0 / 6.0).abs() < 1e-12, "{} m³", surface.volume_m3());
        assert_eq!(surface.extent_m(), [DVec3::ZERO, DVec3::ONE], "extent");
        assert!((surface.shadow_m2(DVec3::Y) - 0.5).abs() < 1e-12, "{} m²", surface.shadow_m2(DVec3::Y));
    }

    #[test]
    fn corners_at_one_place_are_one() {
        let corners: Vec<[f32; 3]> = FACES.as_flattened().iter().map(|&at| CORNERS_M[at as usize]).collect();
        let faces: Vec<[u32; 3]> = (0..4).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
        let surface = Surface::new(&corners, &faces).expect("closed");
        assert_eq!(surface, Surface::new(&corners, &faces).expect("the same"), "in the same order");
        assert_eq!(surface.corners_m().len(), 4, "corners");
    }

    #[test]
    fn faults_are_named() {
        let fault = |faces: &[[u32; 3]]| Surface::new(&CORNERS_M, faces).expect_err("a fault");
        assert!(matches!(fault(&FACES[..3]), SurfaceError::Open { .. }), "a face less");
        assert!(
            matches!(fault(&[FACES[0], FACES[1], FACES[2], [1, 3, 2]]), SurfaceError::Folded { .. }),
            "turned"
        );
        let inwards = FACES.map(|[a, b, c]| [a, c, b]);
        assert!(matches!(fault(&inwards), SurfaceError::Empty { .. }), "inwards");
        assert!(matches!(fault(&[]), SurfaceError::Empty { .. }), "nothing");
    }
}
