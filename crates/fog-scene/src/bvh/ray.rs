//! What a ray needs for every box and triangle, computed once.

use glam::{Vec3A, Vec4};

/// A ray whose direction is longest along axis `Z` (0, 1 or 2).
pub(super) struct Ray<const Z: usize> {
    pub(super) origin: [Vec4; 3],
    /// 1 / direction; components below 1e-18 count as 1e-18, so that no box test meets 0 · ∞.
    pub(super) inverse: [Vec4; 3],
    /// 1 where the direction is negative: the far side of a box is then its lower one.
    pub(super) negative: [usize; 3],
    /// Shear that turns the ray into +Z from the origin (Woop et al. 2013), for the axes after `Z` and `Z` itself.
    pub(super) shear: [Vec4; 3],
}

impl<const Z: usize> Ray<Z> {
    #[inline(always)]
    pub(super) fn new(origin: Vec3A, direction: Vec3A) -> Self {
        let d = direction.to_array();
        let scale = 1.0 / d[Z];
        Self {
            origin: origin.to_array().map(Vec4::splat),
            inverse: d.map(|d| Vec4::splat(1.0 / if d.abs() < 1e-18 { 1e-18f32.copysign(d) } else { d })),
            negative: d.map(|d| usize::from(d.is_sign_negative())),
            shear: [d[(Z + 1) % 3] * scale, d[(Z + 2) % 3] * scale, scale].map(Vec4::splat),
        }
    }
}

/// The axis along which a direction is longest.
#[inline(always)]
pub(super) fn longest_axis(direction: Vec3A) -> usize {
    let d = direction.abs();
    if d.x >= d.y && d.x >= d.z {
        0
    } else if d.y >= d.z {
        1
    } else {
        2
    }
}
