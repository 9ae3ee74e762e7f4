//! A table's block of 8-byte words: its own, or borrowed from bytes that many processes map.

use std::sync::Arc;

/// Bytes that outlive the table: a memory map, or a vector.
pub type SharedBytes = Arc<dyn AsRef<[u8]> + Send + Sync>;

/// The words; cheap to clone.
#[derive(Clone)]
pub(crate) enum SharedWords {
    Owned(Arc<Vec<u64>>),
    Shared { bytes: SharedBytes, offset: usize },
}

impl SharedWords {
    /// The words as they are in memory.
    ///
    /// # Panics
    /// If shared bytes are not aligned or not whole words ([`aligned`] says so before).
    pub(crate) fn get(&self) -> &[u64] {
        match self {
            Self::Owned(words) => words,
            Self::Shared { bytes, offset } => bytemuck::cast_slice(&(**bytes).as_ref()[*offset..]),
        }
    }
}

/// True if `data` can be read as words in place.
pub(crate) fn aligned(data: &[u8]) -> bool {
    bytemuck::try_cast_slice::<u8, u64>(data).is_ok()
}

/// The first `N` words of `data`, if it has as many.
pub(crate) fn header<const N: usize>(data: &[u8]) -> Option<[u64; N]> {
    let bytes = data.get(..N * 8)?;
    Some(core::array::from_fn(|i| {
        u64::from_le_bytes(bytes[i * 8..i * 8 + 8].try_into().expect("eight bytes"))
    }))
}
