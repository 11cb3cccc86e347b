// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binary glTF files, taken apart and put together.

const MAGIC: &[u8] = b"glTF";

/// The text and the binary chunk of a file.
pub fn parts(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let rest = bytes.strip_prefix(MAGIC)?.get(8..)?;
    let (text, rest) = chunk(rest)?;
    let binary = chunk(rest).map_or(&[][..], |(binary, _)| binary);
    Some((text, binary))
}

/// A file of these chunks.
pub fn whole(text: &[u8], binary: &[u8]) -> Vec<u8> {
    let mut bytes = [MAGIC, &2u32.to_le_bytes(), &[0; 4]].concat();
    for (kind, padding, chunk) in [(b"JSON", b' ', text), (b"BIN\0", 0, binary)] {
        let length = chunk.len().next_multiple_of(4);
        bytes.extend(u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
        bytes.resize(bytes.len() + length - chunk.len(), padding);
    }
    let length = u32::try_from(bytes.len()).unwrap_or(u32::MAX);
    bytes[8..12].copy_from_slice(&length.to_le_bytes());
    bytes
}

/// A chunk's bytes and those behind it.
fn chunk(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk::<4>()?;
    rest.get(4..)?.split_at_checked(usize::try_from(u32::from_le_bytes(*length)).ok()?)
}
