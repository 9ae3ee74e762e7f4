//! All triangles of a scene, and rays through them.

use crate::bvh::{Bvh, Hit};
use crate::material::AlphaMask;
use crate::triangle::{SurfacePoint, Triangle};
use glam::Vec3A;

/// The triangles of a scene with their hierarchy: immutable, shared by all threads.
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    triangles: Vec<Triangle>,
    masks: Vec<Option<AlphaMask>>,
    bvh: Bvh,
    bounds: Option<[Vec3A; 2]>,
}

impl Geometry {
    /// Builds the hierarchy over `triangles` (finite corners, fewer than 2³¹). `masks[material]` tells where a material
    /// has holes; materials beyond its end have none.
    #[must_use]
    pub fn new(triangles: Vec<Triangle>, masks: Vec<Option<AlphaMask>>) -> Self {
        let bvh = Bvh::new(&triangles, |material| masks.get(material as usize).is_some_and(Option::is_some));
        let corners = || triangles.iter().flat_map(|t| t.positions.map(Vec3A::from));
        let bounds = (!triangles.is_empty()).then(|| {
            [corners().fold(Vec3A::INFINITY, Vec3A::min), corners().fold(Vec3A::NEG_INFINITY, Vec3A::max)]
        });
        Self { triangles, masks, bvh, bounds }
    }

    /// Nearest hit at 0 < t < `t_max`, t in lengths of `direction` (which need not be of unit length). Of several at one
    /// t the lowest triangle: the answer does not depend on the shape of the hierarchy. Cut-out texels are passed.
    #[inline]
    #[must_use]
    pub fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<Hit> {
        self.bvh.nearest(origin, direction, t_max, |triangle, u, v| self.is_solid(triangle, u, v))
    }

    /// True if anything is hit at 0 < t < `t_max`: `intersect(..).is_some()`, sooner.
    #[inline]
    #[must_use]
    pub fn occluded(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> bool {
        self.bvh.any(origin, direction, t_max, |triangle, u, v| self.is_solid(triangle, u, v))
    }

    /// The surface at a hit of this geometry.
    ///
    /// # Panics
    /// If the hit is of another geometry with more triangles.
    #[inline]
    #[must_use]
    pub fn surface(&self, hit: &Hit) -> SurfacePoint {
        self.triangles[hit.triangle as usize].surface(hit.u, hit.v)
    }

    /// All triangles; [`Hit::triangle`] is an index of them.
    #[must_use]
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// Lowest and highest corner of the box around all triangles, in metres; `None` without triangles.
    #[must_use]
    pub fn bounds(&self) -> Option<[Vec3A; 2]> {
        self.bounds
    }

    /// False if the material of a triangle is cut out at barycentric weights (1 − u − v, u, v).
    #[must_use]
    pub fn is_solid(&self, triangle: u32, u: f32, v: f32) -> bool {
        let triangle = &self.triangles[triangle as usize];
        let mask = self.masks.get(triangle.material as usize).and_then(Option::as_ref);
        mask.is_none_or(|mask| mask.is_solid(&triangle.uv_at(u, v)))
    }
}
