//! Values at the corners of some of a scene's triangles: what few triangles have takes no memory in the others.

use crate::bvh::Hit;

/// Corner values of the triangles that have any.
#[derive(Clone, Debug, Default)]
pub struct CornerValues {
    /// One more than the index into `values`, by triangle; 0, or beyond the end, for triangles without.
    slots: Vec<u32>,
    values: Vec<[[f32; 4]; 3]>,
}

impl CornerValues {
    /// Gives a triangle values at its corners; triangles come in ascending order, each at most once.
    pub fn push(&mut self, triangle: u32, corners: [[f32; 4]; 3]) {
        self.values.push(corners);
        self.slots.resize(triangle as usize, 0);
        self.slots.push(self.values.len() as u32);
    }

    /// True if no triangle has values.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Values at the corners of a triangle, if it has any.
    #[inline]
    #[must_use]
    pub fn corners(&self, triangle: u32) -> Option<&[[f32; 4]; 3]> {
        let slot = *self.slots.get(triangle as usize)?;
        self.values.get((slot as usize).checked_sub(1)?)
    }

    /// The interpolated value at a hit.
    #[inline]
    #[must_use]
    pub fn at(&self, hit: &Hit) -> Option<[f32; 4]> {
        let [a, b, c] = self.corners(hit.triangle)?;
        Some(core::array::from_fn(|i| a[i] + (b[i] - a[i]) * hit.u + (c[i] - a[i]) * hit.v))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_triangles_have_values() {
        let mut values = CornerValues::default();
        assert!(values.is_empty() && values.corners(0).is_none());
        values.push(2, [[0.0; 4], [1.0, 0.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0]]);
        values.push(5, [[7.0; 4]; 3]);
        let at = |triangle| values.at(&Hit { t: 1.0, triangle, u: 0.5, v: 0.25 });
        assert_eq!(at(2), Some([0.5, 0.5, 0.0, 0.0]));
        assert_eq!(at(5), Some([7.0; 4]));
        assert!([0, 1, 3, 4, 6, u32::MAX].iter().all(|&t| at(t).is_none()));
    }
}
