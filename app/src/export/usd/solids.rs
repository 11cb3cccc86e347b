// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Objects and limbs of walkers: meshes with a transform, which has samples if they move.

use std::io::{self, Write};

use glam::{Mat4, Quat, Vec3};
use windfall_core::solid::Solid;

use super::prototypes::{NORMAL_PLACES, extent_of, write_plain};
use super::samples::{Handle, Samples};
use super::text;
use crate::export::Frame;
use crate::export::solids::{SolidPaint, SolidPart, solid_parts};

/// Decimal places of corners in metres.
const PLACES: i32 = 4;

/// The parts that move.
#[derive(Debug)]
pub(super) struct SolidSamples {
    moving: Vec<(Handle, SolidPart)>,
}

impl SolidSamples {
    pub(super) fn declare(samples: &mut Samples, solids: &[Solid]) -> Self {
        let (parts, _) = solid_parts(solids);
        let moving = parts.into_iter().filter(SolidPart::moves).map(|part| {
            let prim = format!("World/Objects/{}", part.name);
            (samples.declare(&prim, "matrix4d xformOp:transform"), part)
        });
        Self { moving: moving.collect() }
    }

    pub(super) fn add(&self, samples: &mut Samples, frame: &Frame<'_>) {
        for (handle, part) in &self.moving {
            samples.add(*handle, frame.number, |out| text::matrix(out, transform(part.pose(frame))));
        }
    }
}

fn transform((at, turn): (Vec3, Quat)) -> Mat4 {
    Mat4::from_rotation_translation(turn, at)
}

/// Writes the materials of all parts.
pub(super) fn write_materials(out: &mut impl Write, paints: &[SolidPaint]) -> io::Result<()> {
    paints.iter().try_for_each(|paint| write_plain(out, &paint.plain()))
}

/// Writes all parts.
pub(super) fn write_parts(
    out: &mut impl Write,
    parts: &[SolidPart],
    paints: &[SolidPaint],
) -> io::Result<()> {
    if parts.is_empty() {
        return Ok(());
    }
    writeln!(out, "def Scope \"Objects\"\n{{")?;
    parts.iter().try_for_each(|part| write_part(out, part, &paints[part.material]))?;
    writeln!(out, "}}")
}

fn write_part(out: &mut impl Write, part: &SolidPart, paint: &SolidPaint) -> io::Result<()> {
    let mut place = String::new();
    if !part.moves() {
        place += " = ";
        text::matrix(&mut place, transform(part.still_pose()));
    }
    let mut extent = String::new();
    text::vectors(&mut extent, extent_of(&part.positions_m));
    let mut counts = String::new();
    text::numbers(&mut counts, part.triangles.iter().map(|triangle| triangle.len()));
    let mut indices = String::new();
    text::numbers(&mut indices, part.triangles.as_flattened());
    let mut normals = String::new();
    text::rounded(&mut normals, part.normals.iter().copied(), NORMAL_PLACES);
    let mut points = String::new();
    text::rounded(&mut points, part.positions_m.iter().copied(), PLACES);
    write!(
        out,
        "def Mesh \"{}\" (\nprepend apiSchemas = [\"MaterialBindingAPI\"]\n)\n{{\nfloat3[] extent = {extent}\n\
        int[] faceVertexCounts = {counts}\nint[] faceVertexIndices = {indices}\n\
        rel material:binding = </World/Materials/{}>\nnormal3f[] normals = {normals} (\ninterpolation = \"vertex\"\n)\n\
        point3f[] points = {points}\nuniform token subdivisionScheme = \"none\"\n\
        matrix4d xformOp:transform{place}\nuniform token[] xformOpOrder = [\"xformOp:transform\"]\n}}\n",
        part.name,
        paint.plain().name,
    )
}
