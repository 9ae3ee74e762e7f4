//! Arrays of f32 in NumPy's file format, version 1.0 (numpy.lib.format, NumPy's reference manual), for stored images.

use std::path::Path;

const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";

/// An array of shape \[height\]\[width\]\[channels\], row-major.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Height, width and channels.
    pub shape: [usize; 3],
    /// height · width · channels values.
    pub values: Vec<f32>,
}

impl Array {
    /// Writes the file.
    ///
    /// # Panics
    /// If it cannot be written.
    pub fn write(&self, path: &Path) {
        let [h, w, c] = self.shape;
        let mut header =
            format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({h}, {w}, {c}), }}").into_bytes();
        // Data begin at a multiple of 64 bytes; the header ends in a line feed.
        while !(MAGIC.len() + 2 + header.len() + 1).is_multiple_of(64) {
            header.push(b' ');
        }
        header.push(b'\n');
        let mut bytes = MAGIC.to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header);
        bytes.extend(self.values.iter().flat_map(|v| v.to_le_bytes()));
        std::fs::write(path, bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    }

    /// Reads a file that [`Array::write`] has written.
    ///
    /// # Panics
    /// If it cannot be read, or is of another type or shape.
    #[must_use]
    pub fn read(path: &Path, shape: [usize; 3]) -> Self {
        let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert!(bytes.starts_with(MAGIC), "{}: not version 1.0 of the format", path.display());
        let data = MAGIC.len() + 2 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let header = String::from_utf8_lossy(&bytes[10..data]);
        let [h, w, c] = shape;
        let want = format!("'shape': ({h}, {w}, {c})");
        assert!(header.contains("'<f4'") && header.contains(&want), "{}: {header}", path.display());
        let values: Vec<f32> =
            bytes[data..].chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        assert_eq!(values.len(), h * w * c, "{}: cut off", path.display());
        Self { shape, values }
    }
}
