//! Numbers out of buffers, every index checked.

use super::files::Files;
use crate::error::{Failure, SceneErrorKind};
use gltf::accessor::{DataType, Dimensions};
use gltf::{Accessor, Document, buffer};

/// The bytes of all buffers.
pub(super) struct Buffers(Vec<Vec<u8>>);

impl Buffers {
    /// Reads every buffer: the GLB's own chunk, data URIs, files.
    pub(super) fn load(document: &Document, blob: Option<&[u8]>, files: &mut Files) -> Result<Self, Failure> {
        let mut all = Vec::new();
        for buffer in document.buffers() {
            let place = || format!("buffer {}", buffer.index());
            let bytes = match buffer.source() {
                buffer::Source::Uri(uri) => files.fetch(uri).map_err(|e| e.at(place))?,
                buffer::Source::Bin => {
                    let blob = blob.filter(|_| buffer.index() == 0);
                    let text = "has no URI, and the file has no binary chunk for it";
                    blob.ok_or_else(|| SceneErrorKind::Accessor(text.into()).at(place))?.to_vec()
                }
            };
            if bytes.len() < buffer.length() {
                let text = format!("is cut off: {} of {} bytes are there", bytes.len(), buffer.length());
                return Err(SceneErrorKind::Accessor(text).at(place));
            }
            all.push(bytes);
        }
        Ok(Self(all))
    }

    /// Bytes of a buffer view.
    pub(super) fn view(&self, view: &buffer::View<'_>) -> Result<&[u8], String> {
        let range = view.offset().checked_add(view.length()).map(|end| view.offset()..end);
        let bytes = self.0.get(view.buffer().index()).zip(range).and_then(|(bytes, range)| bytes.get(range));
        bytes.ok_or_else(|| format!("buffer view {} reaches beyond its buffer", view.index()))
    }

    /// Vectors of N floats; integers count as normalised if the accessor says so.
    pub(super) fn floats<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
        most: usize,
    ) -> Result<Vec<[f32; N]>, String> {
        let expected = [Dimensions::Scalar, Dimensions::Vec2, Dimensions::Vec3, Dimensions::Vec4];
        if expected.get(N.wrapping_sub(1)) != Some(&accessor.dimensions()) {
            return Err(format!("is not a vector of {N} numbers"));
        }
        let read: fn(&[u8]) -> f32 = match (accessor.data_type(), accessor.normalized()) {
            (DataType::F32, _) => |b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            (DataType::U8, true) => |b| f32::from(b[0]) / 255.0,
            (DataType::U16, true) => |b| f32::from(u16::from_le_bytes([b[0], b[1]])) / 65535.0,
            (DataType::I8, true) => |b| (f32::from(b[0].cast_signed()) / 127.0).max(-1.0),
            (DataType::I16, true) => |b| (f32::from(i16::from_le_bytes([b[0], b[1]])) / 32767.0).max(-1.0),
            (other, _) => return Err(format!("has components of type {other:?}, which are not supported")),
        };
        let size = accessor.data_type().size();
        let bytes = self.gather(accessor, most)?;
        let vector = |v: &[u8]| core::array::from_fn(|i| read(&v[i * size..(i + 1) * size]));
        Ok(bytes.chunks_exact(N * size).map(vector).collect())
    }

    /// Indices of 8, 16 or 32 bits.
    pub(super) fn indices(&self, accessor: &Accessor<'_>, most: usize) -> Result<Vec<u32>, String> {
        if accessor.dimensions() != Dimensions::Scalar {
            return Err("are not single numbers".into());
        }
        let size = match accessor.data_type() {
            kind @ (DataType::U8 | DataType::U16 | DataType::U32) => kind.size(),
            other => return Err(format!("are of type {other:?}, not unsigned integers")),
        };
        Ok(self.gather(accessor, most)?.chunks_exact(size).map(little_endian).collect())
    }

    /// An accessor's elements without gaps, sparse replacements done.
    fn gather(&self, accessor: &Accessor<'_>, most: usize) -> Result<Vec<u8>, String> {
        let (count, size) = (accessor.count(), accessor.size());
        if count > most {
            return Err(format!("has {count} elements; the limit on triangles allows {most}"));
        }
        let mut out = match accessor.view() {
            Some(view) => {
                let stride = view.stride().unwrap_or(size);
                self.strided(&view, accessor.offset(), stride, count, size)?
            }
            None => vec![0; count.checked_mul(size).ok_or("is too large")?],
        };
        if let Some(sparse) = accessor.sparse() {
            let (indices, values) = (sparse.indices(), sparse.values());
            let width = match indices.index_type() {
                gltf::accessor::sparse::IndexType::U8 => 1,
                gltf::accessor::sparse::IndexType::U16 => 2,
                gltf::accessor::sparse::IndexType::U32 => 4,
            };
            let at = self.strided(&indices.view(), indices.offset(), width, sparse.count(), width)?;
            let with = self.strided(&values.view(), values.offset(), size, sparse.count(), size)?;
            for (index, value) in at.chunks_exact(width).map(little_endian).zip(with.chunks_exact(size)) {
                let first = index as usize * size;
                let target = out.get_mut(first..first + size);
                target.ok_or("replaces elements that it does not have")?.copy_from_slice(value);
            }
        }
        Ok(out)
    }

    fn strided(
        &self,
        view: &buffer::View<'_>,
        offset: usize,
        stride: usize,
        count: usize,
        size: usize,
    ) -> Result<Vec<u8>, String> {
        if stride < size {
            return Err(format!("has elements of {size} bytes at distances of {stride}"));
        }
        let bytes = self.view(view)?;
        let end = count
            .checked_sub(1)
            .map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size))
            .and_then(|length| length.checked_add(offset))
            .filter(|&end| end <= bytes.len());
        if end.is_none() {
            let have = bytes.len();
            return Err(format!("reaches beyond buffer view {} of {have} bytes", view.index()));
        }
        let mut out = Vec::with_capacity(count * size);
        for i in 0..count {
            let first = offset + i * stride;
            out.extend_from_slice(&bytes[first..first + size]);
        }
        Ok(out)
    }
}

/// An unsigned number of at most four bytes.
fn little_endian(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |n, &b| n << 8 | u32::from(b))
}
