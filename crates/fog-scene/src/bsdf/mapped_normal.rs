//! Normal maps: the material is evaluated about the mapped normal, as glTF says, but every path stays above the surface.
//!
//! A mapped normal p tilts the hemisphere about it: a part of it reaches below the surface, and a viewer above the surface
//! may be below it. Leaving these directions out would lose up to half of the light and turn such points black. Here
//!
//! - a viewer behind p is mirrored in the plane of p (the cosine counts by its size);
//! - light that would come from below the surface is mirrored in the surface, and adds to that from above.
//!
//! So the albedo is that of the material about p, at every angle and tilt: nothing is lost and nothing is gained. As with
//! every shading normal the sum is not reciprocal (Veach 1997, "Robust Monte Carlo methods for light transport
//! simulation", sec. 5.3), which paths that start at the camera do not need.

use super::metallic_roughness::MetallicRoughness;
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, warp};
use glam::Mat3A;

/// A mapped normal in the shading frame, whose z axis is the surface's own normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct MappedNormal {
    p: Vec3A,
}

impl MappedNormal {
    /// `normal` is of unit length. One that is not above the surface, which normal maps must not have, is turned up to it.
    pub(super) fn new(normal: Vec3A) -> Self {
        let above = Vec3A::new(normal.x, normal.y, normal.z.max(0.0));
        Self { p: above.try_normalize().unwrap_or(Vec3A::Z) }
    }

    /// Shading frame from a frame whose z is p.
    #[inline]
    fn frame(&self) -> Mat3A {
        warp::frame(self.p)
    }

    /// The viewer in the frame of p, mirrored if p faces away.
    #[inline]
    fn viewer(inverse: Mat3A, wo: Vec3A) -> Vec3A {
        let w = inverse * wo;
        Vec3A::new(w.x, w.y, w.z.abs().max(1e-6))
    }

    /// Value × |cos θi| (1/sr) and density (1/sr) of `base` about p; both directions are above the surface.
    pub(super) fn eval(&self, base: &MetallicRoughness, wo: Vec3A, wi: Vec3A) -> (Spectrum, f32) {
        let inverse = self.frame().transpose();
        let viewer = Self::viewer(inverse, wo);
        let (value, pdf) = base.eval(viewer, inverse * wi);
        let (mirrored, pdf_mirrored) = base.eval(viewer, inverse * Vec3A::new(wi.x, wi.y, -wi.z));
        (value + mirrored, pdf + pdf_mirrored)
    }

    /// Direction of the light; it may be below the surface where none is reflected.
    pub(super) fn sample(&self, base: &MetallicRoughness, wo: Vec3A, pick: f32, u: [f32; 2]) -> Vec3A {
        let frame = self.frame();
        let local = base.sample(Self::viewer(frame.transpose(), wo), pick, u);
        if local.z <= 0.0 {
            return Vec3A::NEG_Z;
        }
        let wi = frame * local;
        Vec3A::new(wi.x, wi.y, wi.z.abs())
    }
}
