// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes and materials of leaves.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use super::text;
use crate::export::foliage::Foliage;
use crate::export::leaf_mesh::LeafMesh;
use crate::export::plain::Plain;
use crate::files::WriteError;

/// Folder of the pictures beside the layers.
pub(super) const PICTURES: &str = "textures";
/// Decimal places of a leaf's corners in metres, and of places on pictures.
const PLACES: i32 = 5;
/// Decimal places of normals.
pub(super) const NORMAL_PLACES: i32 = 3;

/// Writes the prims that are instanced.
pub(super) fn write_meshes(out: &mut impl Write, foliage: &Foliage) -> io::Result<()> {
    writeln!(out, "def Scope \"Prototypes\"\n{{")?;
    for mesh in &foliage.meshes {
        write_mesh(out, mesh, &foliage.pictures[mesh.picture].name)?;
    }
    writeln!(out, "}}")
}

fn write_mesh(out: &mut impl Write, mesh: &LeafMesh, material: &str) -> io::Result<()> {
    let mut points = String::new();
    text::rounded(&mut points, mesh.positions_m.iter().copied(), PLACES);
    let mut normals = String::new();
    text::rounded(&mut normals, mesh.normals.iter().copied(), NORMAL_PLACES);
    let mut places = String::new();
    text::rounded(&mut places, mesh.texcoords.iter().map(|[u, v]| [*u, 1.0 - v]), PLACES);
    let mut indices = String::new();
    text::numbers(&mut indices, mesh.triangles.as_flattened());
    let mut counts = String::new();
    text::numbers(&mut counts, mesh.triangles.iter().map(|triangle| triangle.len()));
    let mut extent = String::new();
    text::vectors(&mut extent, extent_of(&mesh.positions_m));
    write!(
        out,
        "def Mesh \"{name}\" (\nprepend apiSchemas = [\"MaterialBindingAPI\"]\n)\n{{\nuniform bool doubleSided = 1\n\
        float3[] extent = {extent}\nint[] faceVertexCounts = {counts}\nint[] faceVertexIndices = {indices}\n\
        rel material:binding = </World/Materials/{material}>\nnormal3f[] normals = {normals} (\ninterpolation = \"vertex\"\n)\n\
        point3f[] points = {points}\ntexCoord2f[] primvars:st = {places} (\ninterpolation = \"vertex\"\n)\n\
        uniform token subdivisionScheme = \"none\"\n}}\n",
        name = mesh.name,
    )
}

/// Lowest and highest corner.
pub(super) fn extent_of(points: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let fold = |start: f32, pick: fn(f32, f32) -> f32| {
        points
            .iter()
            .fold([start; 3], |corner, point| std::array::from_fn(|axis| pick(corner[axis], point[axis])))
    };
    if points.is_empty() { [[0.0; 3]; 2] } else { [fold(f32::MAX, f32::min), fold(f32::MIN, f32::max)] }
}

/// A picture on a preview surface.
pub(super) struct Coat<'a> {
    /// Name of the material; its picture is `NAME.png`.
    pub(super) name: &'a str,
    /// True if the picture's alpha is its coverage.
    pub(super) is_cut_out: bool,
    /// From 0 to 1.
    pub(super) roughness: f32,
}

/// Writes a material.
pub(super) fn write_material(out: &mut impl Write, coat: &Coat<'_>) -> io::Result<()> {
    let Coat { name, is_cut_out, roughness } = coat;
    let path = format!("/World/Materials/{name}");
    let opacity = if *is_cut_out {
        format!(
            "float inputs:opacity.connect = <{path}/Picture.outputs:a>\nfloat inputs:opacityThreshold = 0.5\n"
        )
    } else {
        String::new()
    };
    let alpha = if *is_cut_out { "float outputs:a\n" } else { "" };
    write!(
        out,
        "def Material \"{name}\"\n{{\ntoken outputs:surface.connect = <{path}/Surface.outputs:surface>\n\
        def Shader \"Surface\"\n{{\nuniform token info:id = \"UsdPreviewSurface\"\n\
        color3f inputs:diffuseColor.connect = <{path}/Picture.outputs:rgb>\nfloat inputs:metallic = 0\n{opacity}\
        float inputs:roughness = {roughness}\ntoken outputs:surface\n}}\n\
        def Shader \"Picture\"\n{{\nuniform token info:id = \"UsdUVTexture\"\n\
        asset inputs:file = @./{PICTURES}/{name}.png@\ntoken inputs:sourceColorSpace = \"sRGB\"\n\
        float2 inputs:st.connect = <{path}/Place.outputs:result>\ntoken inputs:wrapS = \"repeat\"\n\
        token inputs:wrapT = \"repeat\"\n{alpha}float3 outputs:rgb\n}}\n\
        def Shader \"Place\"\n{{\nuniform token info:id = \"UsdPrimvarReader_float2\"\n\
        string inputs:varname = \"st\"\nfloat2 outputs:result\n}}\n}}\n"
    )
}

/// Writes a material of one colour.
pub(super) fn write_plain(out: &mut impl Write, plain: &Plain<'_>) -> io::Result<()> {
    let Plain { name, color: [r, g, b], roughness } = plain;
    write!(
        out,
        "def Material \"{name}\"\n{{\ntoken outputs:surface.connect = </World/Materials/{name}/Surface.outputs:surface>\n\
        def Shader \"Surface\"\n{{\nuniform token info:id = \"UsdPreviewSurface\"\n\
        color3f inputs:diffuseColor = ({r}, {g}, {b})\nfloat inputs:metallic = 0\n\
        float inputs:roughness = {roughness}\ntoken outputs:surface\n}}\n}}\n"
    )
}

/// Writes the pictures of all kinds of leaves; `destination` is the folder that errors name.
pub(super) fn write_pictures(folder: &Path, destination: &Path, foliage: &Foliage) -> anyhow::Result<()> {
    let folder = folder.join(PICTURES);
    // A run that ended while it wrote them may have left some.
    fs::create_dir_all(&folder).map_err(WriteError::at(destination))?;
    foliage.pictures.par_iter().try_for_each(|picture| {
        let saved = picture.image.save(folder.join(format!("{}.png", picture.name)));
        Ok(saved.map_err(|error| WriteError::at(destination)(io::Error::other(error)))?)
    })
}
