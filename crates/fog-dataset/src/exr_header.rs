//! One order for the attributes of an EXR header.
//!
//! The `exr` crate keeps custom attributes in a hash map with random keys, so two of them come out in another order in
//! every run. The format allows any order; sorting by name (as OpenEXR itself does) gives the same bytes always. The
//! header keeps its length, so the offsets after it stay right.

use std::ops::Range;

const MAGIC_AND_VERSION: usize = 8;

/// Sorts the attributes of a single-part EXR file in memory by name; `None` when the bytes are no such file.
pub(crate) fn sort_attributes(file: &mut [u8]) -> Option<()> {
    let mut attributes: Vec<(Range<usize>, Range<usize>)> = Vec::new();
    let mut at = MAGIC_AND_VERSION;
    while *file.get(at)? != 0 {
        let name = text(file, at)?;
        let kind = text(file, name.end + 1)?;
        let size_at = kind.end + 1;
        let size = i32::from_le_bytes(file.get(size_at..size_at + 4)?.try_into().ok()?);
        let end = (size_at + 4).checked_add(usize::try_from(size).ok()?)?;
        attributes.push((name, at..end));
        at = end;
    }
    attributes.sort_by(|(a, _), (b, _)| file[a.clone()].cmp(&file[b.clone()]));
    let sorted: Vec<u8> = attributes.iter().flat_map(|(_, whole)| &file[whole.clone()]).copied().collect();
    file[MAGIC_AND_VERSION..at].copy_from_slice(&sorted);
    Some(())
}

/// The null-terminated text at a position, without its null.
fn text(file: &[u8], start: usize) -> Option<Range<usize>> {
    let length = file.get(start..)?.iter().position(|&b| b == 0)?;
    Some(start..start + length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorts_and_refuses_garbage() {
        let attribute = |name: &str, value: &[u8]| {
            let mut a = name.as_bytes().to_vec();
            a.extend(b"\0int\0");
            a.extend((value.len() as i32).to_le_bytes());
            a.extend(value);
            a
        };
        let head = [0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
        let (b, a) = (attribute("b", b"1234"), attribute("a", b"56"));
        let mut file = [&head[..], &b, &a, b"\0pixels"].concat();
        sort_attributes(&mut file).expect("a header");
        assert_eq!(file, [&head[..], &a, &b, b"\0pixels"].concat());
        for length in 0..head.len() + 12 {
            assert!(sort_attributes(&mut file[..length]).is_none(), "{length}");
        }
    }
}
