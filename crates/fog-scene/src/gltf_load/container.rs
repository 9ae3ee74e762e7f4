//! The two chunks of a binary glTF file.

use crate::error::SceneErrorKind;

/// The JSON text and the binary chunk, if any.
pub(super) struct Parts<'a> {
    pub(super) json: &'a [u8],
    pub(super) blob: Option<&'a [u8]>,
}

const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

/// Splits a GLB; a file that does not begin as one is JSON as a whole.
pub(super) fn split(bytes: &[u8]) -> Result<Parts<'_>, SceneErrorKind> {
    if !bytes.starts_with(b"glTF") {
        let first = bytes.iter().find(|b| !b.is_ascii_whitespace());
        return match first {
            Some(b'{') => Ok(Parts { json: bytes, blob: None }),
            _ => Err(SceneErrorKind::NotGltf),
        };
    }
    let truncated = |what, need: u64| SceneErrorKind::Truncated { what, need, have: bytes.len() as u64 };
    let (Some(version), Some(length)) = (word(bytes, 4), word(bytes, 8)) else {
        return Err(truncated("the GLB header", HEADER as u64));
    };
    if version != 2 {
        return Err(SceneErrorKind::Container(format!("its version is {version}, this program reads 2")));
    }
    if (length as usize) > bytes.len() {
        return Err(truncated("the GLB", u64::from(length)));
    }
    let body = &bytes[..length as usize];
    let (kind, json, next) = chunk(body, HEADER)?;
    if kind != *b"JSON" {
        return Err(SceneErrorKind::Container("its first chunk is not JSON".into()));
    }
    let blob = if next < body.len() { Some(chunk(body, next)?) } else { None };
    // Later chunks of unknown kind are to be ignored.
    Ok(Parts { json, blob: blob.filter(|(kind, ..)| kind == b"BIN\0").map(|(_, bytes, _)| bytes) })
}

/// Kind and contents of the chunk at `start`, and where the next one starts.
fn chunk(body: &[u8], start: usize) -> Result<([u8; 4], &[u8], usize), SceneErrorKind> {
    let what = "a GLB chunk";
    let have = body.len() as u64;
    let first = start + CHUNK_HEADER;
    let (Some(length), Some(kind)) = (word(body, start), body.get(start + 4..first)) else {
        return Err(SceneErrorKind::Truncated { what, need: first as u64, have });
    };
    let need = first as u64 + u64::from(length);
    let contents = body.get(first..).and_then(|rest| rest.get(..length as usize));
    let contents = contents.ok_or(SceneErrorKind::Truncated { what, need, have })?;
    let kind = [kind[0], kind[1], kind[2], kind[3]];
    Ok((kind, contents, (first + length as usize).next_multiple_of(4)))
}
