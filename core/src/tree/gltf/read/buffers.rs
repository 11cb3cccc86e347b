// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bytes that a file holds, embeds or names.

use std::path::{Component, Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::Gltf;
use gltf::buffer;

use super::{GltfError, MAX_FILE_BYTES};
use crate::regular_file::{lies_below, read_regular_file};

/// The bytes of every buffer.
///
/// # Errors
/// [`GltfError::Buffer`] for one that is not there or too short, [`GltfError::Size`] for too many bytes.
pub(super) fn load(gltf: &Gltf, path: &Path) -> Result<Vec<Vec<u8>>, GltfError> {
    let file = path.display().to_string();
    let mut left = MAX_FILE_BYTES;
    let mut buffers = Vec::with_capacity(gltf.document.buffers().len());
    for buffer in gltf.document.buffers() {
        let fail = |reason: String| GltfError::Buffer { file: file.clone(), buffer: buffer.index(), reason };
        let bytes = match buffer.source() {
            buffer::Source::Bin => match (&gltf.blob, buffer.index()) {
                (Some(blob), 0) => blob.clone(),
                _ => return Err(fail("it names no file, and there is no binary chunk for it".into())),
            },
            buffer::Source::Uri(uri) => match uri.strip_prefix("data:") {
                Some(data) => embedded(data).map_err(fail)?,
                None => {
                    let beside = beside(path, uri).map_err(fail)?;
                    read_regular_file(&beside, left).map_err(|error| match error.kind() {
                        std::io::ErrorKind::FileTooLarge => GltfError::Size { file: file.clone() },
                        _ => fail(format!("{}: {error}", beside.display())),
                    })?
                }
            },
        };
        if bytes.len() < buffer.length() {
            return Err(fail(format!("it has {} bytes; needed are {}", bytes.len(), buffer.length())));
        }
        let size = bytes.len() as u64;
        left = left.checked_sub(size).ok_or_else(|| GltfError::Size { file: file.clone() })?;
        buffers.push(bytes);
    }
    Ok(buffers)
}

/// The bytes of a data URI, after `data:`.
fn embedded(data: &str) -> Result<Vec<u8>, String> {
    let (kind, text) = data.split_once(',').ok_or("its data URI has no comma")?;
    if !kind.ends_with(";base64") {
        return Err("its data URI is not base64".into());
    }
    STANDARD.decode(text).map_err(|error| format!("its data URI is not base64: {error}"))
}

/// The file that a relative URI names, in the folder of the file that names it or below.
fn beside(path: &Path, uri: &str) -> Result<PathBuf, String> {
    let reject = || format!("'{}' is not a file beside it", uri.escape_debug());
    let name = PathBuf::from(decoded(uri).ok_or_else(reject)?);
    let is_below = name.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if !is_below || uri.is_empty() || uri.split('/').next().is_some_and(|first| first.contains(':')) {
        return Err(reject());
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let there = folder.join(name);
    // A link may lead elsewhere.
    if lies_below(folder, &there) { Ok(there) } else { Err(reject()) }
}

/// A URI without its percent signs.
fn decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        if first != b'%' {
            bytes.push(first);
            continue;
        }
        let digits = std::str::from_utf8(rest.get(..2)?).ok()?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        rest = &rest[2..];
    }
    String::from_utf8(bytes).ok().filter(|name| !name.contains('\0'))
}
