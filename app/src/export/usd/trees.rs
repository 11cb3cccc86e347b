// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees as skinned bark: joints are the segments, so a frame takes a quaternion for each of them and not a place and a
//! normal for every corner, of which there are twenty times as many.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use glam::{Mat4, Quat, Vec3};
use windfall_core::tree::BarkMesh;
use windfall_render::trees::{SceneTrees, StandingTree};

use super::prototypes::{Coat, NORMAL_PLACES, PICTURES, extent_of, write_material, write_plain};
use super::samples::{Handle, Samples};
use super::text;
use crate::export::fruit::{SKIN, fruit};
use crate::export::wood::{
    Joint, at_rest, at_rest_above, bark, bark_name, bark_picture, barks, joints, rotations,
};
use crate::export::{Frame, Job};
use crate::files::WriteError;

/// Decimal places of corners in metres.
const PLACES: i32 = 4;

/// The joints of all trees.
#[derive(Debug)]
pub(super) struct TreeSamples {
    trees: Vec<(Handle, Vec<Joint>)>,
}

impl TreeSamples {
    pub(super) fn declare(samples: &mut Samples, job: &Job<'_>) -> Self {
        let trees = numbered(job).map(|(number, tree)| {
            let prim = format!("World/Trees/Tree_{number}/Sway");
            (samples.declare(&prim, "quatf[] rotations"), joints(tree))
        });
        Self { trees: trees.collect() }
    }

    pub(super) fn add(&self, samples: &mut Samples, frame: &Frame<'_>) {
        let pose = &frame.world.branches.pose;
        for (handle, joints) in &self.trees {
            samples.add(*handle, frame.number, |out| text::quaternions(out, rotations(joints, pose)));
        }
    }
}

/// The trees of a job's shard with their numbers.
fn numbered<'a>(job: &Job<'a>) -> impl Iterator<Item = (usize, &'a StandingTree)> {
    let own = job.shard_rows.trees.clone();
    own.clone().zip(&job.scene_trees.trees[own])
}

/// Writes the trees.
pub(super) fn write_trees(out: &mut impl Write, job: &Job<'_>) -> io::Result<()> {
    if job.shard_rows.trees.is_empty() {
        return Ok(());
    }
    writeln!(out, "def Scope \"Trees\"\n{{")?;
    for (number, tree) in numbered(job) {
        write_tree(out, job.scene_trees, tree, &format!("Tree_{number}"))?;
    }
    writeln!(out, "}}")
}

fn write_tree(
    out: &mut impl Write,
    scene_trees: &SceneTrees,
    tree: &StandingTree,
    name: &str,
) -> io::Result<()> {
    let path = format!("/World/Trees/{name}");
    let joints = joints(tree);
    let mut names: Vec<String> = Vec::with_capacity(joints.len());
    for (number, segment) in tree.skeleton.segments.iter().enumerate() {
        let own = format!("s{number}");
        names.push(match segment.parent {
            Some(parent) => format!("{}/{own}", names[parent as usize]),
            None => own,
        });
    }
    let rest = joints.iter().map(|&joint| at_rest_above(scene_trees, joint));
    let rest: Vec<(Vec3, Quat)> = rest.collect();
    let mut list = String::new();
    text::texts(&mut list, names);
    let mut bind = String::new();
    text::matrices(
        &mut bind,
        joints.iter().map(|&(row, _)| {
            let (at, turn) = at_rest(scene_trees, row);
            Mat4::from_rotation_translation(turn, at)
        }),
    );
    let mut resting = String::new();
    text::matrices(&mut resting, rest.iter().map(|&(at, turn)| Mat4::from_rotation_translation(turn, at)));
    let mut translations = String::new();
    text::vectors(&mut translations, rest.iter().map(|(at, _)| at.to_array()));
    let mut scales = String::new();
    text::vectors(&mut scales, rest.iter().map(|_| [1.0; 3]));
    write!(
        out,
        "def SkelRoot \"{name}\" (\nprepend apiSchemas = [\"SkelBindingAPI\"]\n)\n{{\nrel skel:skeleton = <{path}/Segments>\n\
        def Skeleton \"Segments\" (\nprepend apiSchemas = [\"SkelBindingAPI\"]\n)\n{{\n\
        uniform token[] joints = {list}\nuniform matrix4d[] bindTransforms = {bind}\n\
        uniform matrix4d[] restTransforms = {resting}\nrel skel:animationSource = <{path}/Sway>\n}}\n\
        def SkelAnimation \"Sway\"\n{{\nuniform token[] joints = {list}\nquatf[] rotations\n\
        half3[] scales = {scales}\nfloat3[] translations = {translations}\n}}\n"
    )?;
    write_skin(out, &bark(tree), "Bark", bark_name(tree.look.bark), &path)?;
    if let Some(fruit) = fruit(tree) {
        write_skin(out, &fruit, "Fruit", SKIN.name, &path)?;
    }
    writeln!(out, "}}")
}

/// Writes what the segments of the tree at `path` move.
fn write_skin(
    out: &mut impl Write,
    mesh: &BarkMesh,
    name: &str,
    material: &str,
    path: &str,
) -> io::Result<()> {
    let mut extent = String::new();
    text::vectors(&mut extent, extent_of(&mesh.positions_m));
    let mut places = String::new();
    text::rounded(&mut places, mesh.positions_m.iter().copied(), PLACES);
    let mut normals = String::new();
    text::rounded(&mut normals, mesh.normals.iter().copied(), NORMAL_PLACES);
    let mut texcoords = String::new();
    if !mesh.texcoords.is_empty() {
        texcoords += "texCoord2f[] primvars:st = ";
        text::rounded(&mut texcoords, mesh.texcoords.iter().copied(), PLACES);
        texcoords += " (\ninterpolation = \"vertex\"\n)\n";
    }
    let mut counts = String::new();
    text::numbers(&mut counts, (0..mesh.triangle_count()).map(|_| 3));
    let mut indices = String::new();
    text::numbers(&mut indices, &mesh.indices);
    let mut joints = String::new();
    text::numbers(&mut joints, mesh.joints.as_flattened());
    let mut weights = String::new();
    text::numbers(&mut weights, mesh.weights.as_flattened());
    write!(
        out,
        "def Mesh \"{name}\" (\nprepend apiSchemas = [\"MaterialBindingAPI\", \"SkelBindingAPI\"]\n)\n{{\n\
        float3[] extent = {extent}\nint[] faceVertexCounts = {counts}\nint[] faceVertexIndices = {indices}\n\
        rel material:binding = </World/Materials/{material}>\nnormal3f[] normals = {normals} (\ninterpolation = \"vertex\"\n)\n\
        point3f[] points = {places}\nmatrix4d primvars:skel:geomBindTransform = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))\n\
        int[] primvars:skel:jointIndices = {joints} (\nelementSize = 4\ninterpolation = \"vertex\"\n)\n\
        float[] primvars:skel:jointWeights = {weights} (\nelementSize = 4\ninterpolation = \"vertex\"\n)\n\
        {texcoords}rel skel:skeleton = <{path}/Segments>\n\
        uniform token subdivisionScheme = \"none\"\n}}\n"
    )
}

/// Writes the materials of all barks, and of berries.
pub(super) fn write_materials(out: &mut impl Write, scene_trees: &SceneTrees) -> io::Result<()> {
    barks(scene_trees).try_for_each(|kind| {
        write_material(out, &Coat { name: bark_name(kind), is_cut_out: false, roughness: 0.9 })
    })?;
    let has_fruit = scene_trees.trees.iter().any(|tree| fruit(tree).is_some());
    if has_fruit { write_plain(out, &SKIN) } else { Ok(()) }
}

/// Writes the pictures of all barks into the folder that is there; `destination` is the folder that errors name.
pub(super) fn write_pictures(
    folder: &Path,
    destination: &Path,
    scene_trees: &SceneTrees,
) -> anyhow::Result<()> {
    let folder = folder.join(PICTURES);
    fs::create_dir_all(&folder).map_err(WriteError::at(destination))?;
    for kind in barks(scene_trees) {
        let saved = bark_picture(kind).save(folder.join(format!("{}.png", bark_name(kind))));
        saved.map_err(|error| WriteError::at(destination)(io::Error::other(error)))?;
    }
    Ok(())
}
