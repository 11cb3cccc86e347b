// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checksums and lengths set right after a change, so that readers look further than these.

/// Bytes of a checkpoint before the length of its scene: eight that name the kind, four of the version.
const CHECKPOINT_HEAD: usize = 12;
/// First bytes of a PNG file.
const PNG_HEAD: &[u8] = b"\x89PNG\r\n\x1a\n";

/// The scene's text and what comes behind it, without the checksum, of the bytes of a checkpoint.
pub fn checkpoint_parts(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (body, _) = bytes.split_last_chunk::<4>()?;
    let (length, rest) = body.get(CHECKPOINT_HEAD..)?.split_first_chunk::<8>()?;
    rest.split_at_checked(usize::try_from(u64::from_le_bytes(*length)).ok()?)
}

/// A checkpoint of the version that `head` has, with its length and checksum right.
pub fn checkpoint(head: &[u8], scene: &[u8], rest: &[u8]) -> Vec<u8> {
    let head = &head[..CHECKPOINT_HEAD.min(head.len())];
    let mut bytes = [head, &(scene.len() as u64).to_le_bytes(), scene, rest].concat();
    bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
    bytes
}

/// Sets the checksums of a PNG file's chunks right, as far as their lengths lead.
pub fn set_png(bytes: &mut [u8]) {
    let Some(mut rest) = bytes.get_mut(PNG_HEAD.len()..) else { return };
    while let Some(&length) = rest.first_chunk::<4>() {
        let Some(end) =
            usize::try_from(u32::from_be_bytes(length)).ok().and_then(|length| length.checked_add(8))
        else {
            return;
        };
        let Some((chunk, behind)) = rest.split_at_mut_checked(end) else { return };
        let Some((checksum, behind)) = behind.split_first_chunk_mut::<4>() else { return };
        *checksum = crc32fast::hash(&chunk[4..]).to_be_bytes();
        rest = behind;
    }
}

/// True for bytes that begin as a PNG file does.
pub fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(PNG_HEAD)
}
