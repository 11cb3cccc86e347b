// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow that lies: a `Mesh` prim with other corners and faces in every frame, through which the ground shows where it is thin.

use std::io::{self, Write};

use windfall_core::Scene;

use super::particles::EMPTY;
use super::prototypes::{NORMAL_PLACES, extent_of};
use super::samples::{Handle, Samples};
use super::text;
use crate::export::Frame;
use crate::export::plain::Plain;
use crate::export::snow_mesh::{SNOW, SnowMesh, cover};

/// Decimal places of corners and depths in metres.
const PLACES: i32 = 4;
/// Decimal places of the opacity.
const OPACITY_PLACES: i32 = 2;

/// The attributes of the mesh; none in a scene without weather.
#[derive(Debug)]
pub(super) struct SnowSamples(Option<SnowAttributes>);

#[derive(Debug)]
struct SnowAttributes {
    points: Handle,
    normals: Handle,
    depths: Handle,
    opacities: Handle,
    counts: Handle,
    indices: Handle,
    extent: Handle,
}

impl SnowSamples {
    pub(super) fn declare(samples: &mut Samples, scene: &Scene) -> Self {
        let mut declare = |declaration| samples.declare("World/Snow", declaration);
        Self(scene.weather.is_some().then(|| SnowAttributes {
            points: declare("point3f[] points"),
            normals: declare("normal3f[] normals"),
            depths: declare("float[] primvars:windfall:snow_depth"),
            opacities: declare("float[] primvars:displayOpacity"),
            counts: declare("int[] faceVertexCounts"),
            indices: declare("int[] faceVertexIndices"),
            extent: declare("float3[] extent"),
        }))
    }

    pub(super) fn add(&self, samples: &mut Samples, frame: &Frame<'_>) {
        let Some(attributes) = &self.0 else { return };
        let (number, mesh) = (frame.number, SnowMesh::of(frame.world));
        let points = &mesh.positions_m;
        samples.add(attributes.points, number, |out| text::rounded(out, points.iter().copied(), PLACES));
        let normals = mesh.normals.iter().copied();
        samples.add(attributes.normals, number, |out| text::rounded(out, normals, NORMAL_PLACES));
        let depths = mesh.depths_m.iter().copied();
        samples.add(attributes.depths, number, |out| text::rounded_numbers(out, depths.clone(), PLACES));
        let opacities = depths.clone().map(cover);
        samples
            .add(attributes.opacities, number, |out| text::rounded_numbers(out, opacities, OPACITY_PLACES));
        let counts = mesh.triangles.iter().map(|triangle| triangle.len());
        samples.add(attributes.counts, number, |out| text::numbers(out, counts));
        let indices = mesh.triangles.as_flattened();
        samples.add(attributes.indices, number, |out| text::numbers(out, indices));
        let extent =
            if points.is_empty() { EMPTY.map(|corner| corner.to_array()) } else { extent_of(points) };
        samples.add(attributes.extent, number, |out| text::rounded(out, extent, PLACES));
    }
}

/// Writes the material, whose opacity is that of the mesh.
pub(super) fn write_material(out: &mut impl Write, scene: &Scene) -> io::Result<()> {
    if scene.weather.is_none() {
        return Ok(());
    }
    let Plain { name, color: [r, g, b], roughness } = SNOW;
    let path = format!("/World/Materials/{name}");
    write!(
        out,
        "def Material \"{name}\"\n{{\ntoken outputs:surface.connect = <{path}/Surface.outputs:surface>\n\
        def Shader \"Surface\"\n{{\nuniform token info:id = \"UsdPreviewSurface\"\n\
        color3f inputs:diffuseColor = ({r}, {g}, {b})\nfloat inputs:metallic = 0\n\
        float inputs:opacity.connect = <{path}/Cover.outputs:result>\n\
        float inputs:roughness = {roughness}\ntoken outputs:surface\n}}\n\
        def Shader \"Cover\"\n{{\nuniform token info:id = \"UsdPrimvarReader_float\"\n\
        float inputs:fallback = 1\nstring inputs:varname = \"displayOpacity\"\nfloat outputs:result\n}}\n}}\n"
    )
}

/// Writes the prim.
pub(super) fn write_snow(out: &mut impl Write, scene: &Scene) -> io::Result<()> {
    if scene.weather.is_none() {
        return Ok(());
    }
    let Plain { name, color: [r, g, b], .. } = SNOW;
    write!(
        out,
        "def Mesh \"Snow\" (\nprepend apiSchemas = [\"MaterialBindingAPI\"]\n)\n{{\n\
        rel material:binding = </World/Materials/{name}>\nnormal3f[] normals (\ninterpolation = \"vertex\"\n)\n\
        color3f[] primvars:displayColor = [({r}, {g}, {b})] (\ninterpolation = \"constant\"\n)\n\
        float[] primvars:displayOpacity (\ninterpolation = \"vertex\"\n)\n\
        float[] primvars:windfall:snow_depth (\ninterpolation = \"vertex\"\n)\n\
        uniform token subdivisionScheme = \"none\"\n}}\n"
    )
}
