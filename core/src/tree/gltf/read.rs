// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trees from glTF files with a skin, and triangles from any.

mod accessor;
mod attachments;
mod buffers;
mod measure;
mod nodes;
mod rig;
mod skinned;
mod triangles;
mod vertices;

use std::io::{self, ErrorKind};
use std::path::Path;

use gltf::json::validation::Checked;
use gltf::{Document, Gltf, Semantic, Skin};

use self::accessor::Source;
use self::nodes::Nodes;
use self::rig::Rig;
use self::skinned::Skinned;
pub use self::triangles::GltfTriangles;
use super::GltfError;
use crate::read_regular_file;
use crate::tree::skeleton::MAX_SEGMENTS;
use crate::tree::{BarkMesh, Skeleton};

/// Largest file in bytes, and largest sum of the buffers that a file names.
pub const MAX_FILE_BYTES: u64 = 256 << 20;
/// Most vertices on the skin.
pub const MAX_VERTICES: usize = 1 << 23;

/// A tree from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct RiggedTree {
    /// Its segments, and the attachments if the file has such points.
    pub skeleton: Skeleton,
    /// The file's own mesh at rest, moved by the segments of the skeleton. Of materials with cut-out or blended
    /// transparency, which are foliage, nothing is kept.
    pub mesh: BarkMesh,
}

/// Reads a `.gltf` file, with its buffers in it or beside it, or a `.glb` file.
///
/// If there are several skins, the one with the most joints is the tree. A segment goes from a joint to its thickest
/// child; the others are branches. Joints at the tips that move no vertex only mark where a segment
/// ends. The root joint is put at the origin.
///
/// # Errors
/// [`GltfError`] for whatever keeps the file from being a tree.
pub fn read(path: &Path) -> Result<RiggedTree, GltfError> {
    let bytes = read_regular_file(path, MAX_FILE_BYTES).map_err(|source| too_large(path, source))?;
    read_bytes(&bytes, path)
}

/// Reads the bytes of a file; `path` is the name that errors give, and buffers are looked for beside it.
///
/// # Errors
/// Those of [`read`].
pub fn read_bytes(bytes: &[u8], path: &Path) -> Result<RiggedTree, GltfError> {
    let file = path.display().to_string();
    let gltf =
        parse(bytes).map_err(|reason| GltfError::Format { file: file.clone(), reason: one_line(&reason) })?;
    let buffers = buffers::load(&gltf, path)?;
    let source = Source { file: &file, buffers };
    let skin = chosen(&gltf.document, &file)?;
    let nodes = Nodes::of(&gltf.document, &file)?;
    let rig = Rig::of(&source, &nodes, &skin)?;
    let skinned = Skinned::of(&source, &gltf.document, &rig, &skin)?;
    let (mut skeleton, segments) = measure::skeleton(&rig, &skinned, &file)?;
    skeleton.attachments = attachments::of(&source, &gltf.document, &rig, &skin, &segments)?;
    let origin_m = skeleton.segments[0].start_m;
    for segment in &mut skeleton.segments {
        segment.start_m -= origin_m;
        segment.end_m -= origin_m;
    }
    for attachment in &mut skeleton.attachments {
        attachment.at_m -= origin_m;
    }
    skeleton.validate().map_err(|source| GltfError::Skeleton { file: file.clone(), source })?;
    let mesh = skinned.into_mesh(origin_m, &segments);
    Ok(RiggedTree { skeleton, mesh })
}

/// Reads all triangles of a file of either kind, skinned or not, as they are at rest.
///
/// # Errors
/// [`GltfError`] for whatever keeps the file from having any.
pub fn read_triangles(path: &Path) -> Result<GltfTriangles, GltfError> {
    let bytes = read_regular_file(path, MAX_FILE_BYTES).map_err(|source| too_large(path, source))?;
    let file = path.display().to_string();
    let gltf = parse(&bytes)
        .map_err(|reason| GltfError::Format { file: file.clone(), reason: one_line(&reason) })?;
    let source = Source { file: &file, buffers: buffers::load(&gltf, path)? };
    GltfTriangles::of(&source, &gltf.document)
}

/// The document of a file, with all its references checked.
fn parse(bytes: &[u8]) -> Result<Gltf, String> {
    // The parser takes two things for granted: a length in the head that counts the head, and the index of an accessor
    // with places.
    if let Some(head) = bytes.strip_prefix(b"glTF") {
        let length = head.get(4..8).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        if length.is_none_or(|length| length < 12) {
            return Err("its head is cut off".into());
        }
    }
    let gltf = Gltf::from_slice_without_validation(bytes).map_err(|error| error.to_string())?;
    let root = gltf.document.as_json();
    for primitive in root.meshes.iter().flat_map(|mesh| &mesh.primitives) {
        let places = primitive.attributes.get(&Checked::Valid(Semantic::Positions));
        if let Some(index) = places.filter(|index| index.value() >= root.accessors.len()) {
            return Err(format!("there is no accessors[{}] for POSITION", index.value()));
        }
    }
    let Gltf { document, blob } = gltf;
    let document = Document::from_json(document.into_json()).map_err(|error| error.to_string())?;
    Ok(Gltf { document, blob })
}

/// The skin with the most joints.
fn chosen<'a>(document: &'a Document, file: &str) -> Result<Skin<'a>, GltfError> {
    let joints = |skin: &Skin<'_>| skin.joints().len();
    let most = document.skins().map(|skin| joints(&skin)).max();
    let skin = document.skins().find(|skin| Some(joints(skin)) == most && most != Some(0));
    let skin = skin.ok_or_else(|| GltfError::NoSkin { file: file.into() })?;
    if joints(&skin) > MAX_SEGMENTS {
        return Err(GltfError::Joints { file: file.into(), skin: skin.index(), found: joints(&skin) });
    }
    Ok(skin)
}

fn too_large(path: &Path, source: io::Error) -> GltfError {
    let file = path.display().to_string();
    match source.kind() {
        ErrorKind::FileTooLarge => GltfError::Size { file },
        _ => GltfError::Read { file, source },
    }
}

/// The beginning of a message, in one line.
fn one_line(text: &str) -> String {
    const MOST: usize = 300;
    let words: Vec<&str> = text.split_whitespace().collect();
    let line = words.join(" ");
    match line.char_indices().nth(MOST) {
        Some((end, _)) => format!("{} …", &line[..end]),
        None => line.trim_end_matches(';').to_owned(),
    }
}
