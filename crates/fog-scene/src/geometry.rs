//! All triangles of a scene, and rays through them.

use crate::attributes::CornerValues;
use crate::bvh::{Bvh, Hit};
use crate::material::Opacity;
use crate::triangle::{SurfacePoint, Triangle};
use fog_core::random::mix64;
use glam::Vec3A;
use std::cell::Cell;

/// The triangles of a scene with their hierarchy: immutable, shared by all threads.
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    triangles: Vec<Triangle>,
    colors: CornerValues,
    tangents: CornerValues,
    opacities: Vec<Option<Opacity>>,
    partial: bool,
    bvh: Bvh,
    bounds: Option<[Vec3A; 2]>,
}

/// Coverage from which on a surface counts as being there, where chance must not decide.
const HALF_COVERED: f32 = 0.5;

impl Geometry {
    /// Builds the hierarchy over `triangles` (finite corners, fewer than 2³¹). `opacities[material]` tells where rays pass
    /// a material; materials beyond its end stop all rays.
    #[must_use]
    pub fn new(triangles: Vec<Triangle>, opacities: Vec<Option<Opacity>>) -> Self {
        let bvh =
            Bvh::new(&triangles, |material| opacities.get(material as usize).is_some_and(Option::is_some));
        let corners = || triangles.iter().flat_map(|t| t.positions.map(Vec3A::from));
        let bounds = (!triangles.is_empty()).then(|| {
            [corners().fold(Vec3A::INFINITY, Vec3A::min), corners().fold(Vec3A::NEG_INFINITY, Vec3A::max)]
        });
        let partial = opacities.iter().flatten().any(Opacity::is_partial);
        let (colors, tangents) = Default::default();
        Self { triangles, colors, tangents, opacities, partial, bvh, bounds }
    }

    /// Adds vertex colours (linear RGBA that multiplies the base colour) and tangents (unit vector in the world, and the
    /// sign of the bitangent normal × tangent).
    #[must_use]
    pub fn with_attributes(self, colors: CornerValues, tangents: CornerValues) -> Self {
        Self { colors, tangents, ..self }
    }

    /// Some of the triangles, in the order given, with their colours: for rays that are to meet nothing else.
    ///
    /// # Panics
    /// If there is no such triangle.
    #[must_use]
    pub fn part(&self, triangles: &[u32]) -> Self {
        let copies = triangles.iter().map(|&triangle| self.triangles[triangle as usize]).collect();
        let mut colors = CornerValues::default();
        for (&triangle, own) in triangles.iter().zip(0u32..) {
            if let Some(corners) = self.colors.corners(triangle) {
                colors.push(own, *corners);
            }
        }
        Self::new(copies, self.opacities.clone()).with_attributes(colors, CornerValues::default())
    }

    /// Nearest hit at 0 < t < `t_max`, t in lengths of `direction` (which need not be of unit length). Of several at one
    /// t the lowest triangle: the answer does not depend on the shape of the hierarchy. Cut-out texels are passed, and
    /// those of blended materials that cover less than half; glass is hit.
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

    /// True if some materials stop rays only by chance: where [`Geometry::intersect_by_chance`] needs its key.
    #[inline]
    #[must_use]
    pub fn has_partial_opacity(&self) -> bool {
        self.partial
    }

    /// As [`Geometry::intersect`], but blended surfaces stop the ray with the probability of their coverage, and smooth
    /// glass with that of not letting light straight through ([`crate::SurfaceParameters::clear_share`]). `key` are random
    /// bits of the ray: with the same key the answer is the same.
    #[inline]
    #[must_use]
    pub fn intersect_by_chance(&self, origin: Vec3A, direction: Vec3A, t_max: f32, key: u64) -> Option<Hit> {
        if !self.partial {
            return self.intersect(origin, direction, t_max);
        }
        self.bvh
            .nearest(origin, direction, t_max, |triangle, u, v| self.stops(triangle, u, v, direction, key))
    }

    /// `intersect_by_chance(..).is_some()`, sooner.
    #[inline]
    #[must_use]
    pub fn occluded_by_chance(&self, origin: Vec3A, direction: Vec3A, t_max: f32, key: u64) -> bool {
        if !self.partial {
            return self.occluded(origin, direction, t_max);
        }
        self.bvh.any(origin, direction, t_max, |triangle, u, v| self.stops(triangle, u, v, direction, key))
    }

    /// Share of light in [0, 1] that passes all surfaces at 0 < t < `t_max`: the probability that
    /// [`Geometry::occluded_by_chance`] is false.
    #[must_use]
    pub fn clear_share(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> f32 {
        if !self.partial {
            return if self.occluded(origin, direction, t_max) { 0.0 } else { 1.0 };
        }
        let share = Cell::new(1.0f32);
        let blocked = self.bvh.any(origin, direction, t_max, |triangle, u, v| {
            share.set(share.get() * (1.0 - self.stop_probability(triangle, u, v, direction)));
            share.get() <= 0.0
        });
        if blocked { 0.0 } else { share.get() }
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

    /// Vertex colours; triangles without them are white.
    #[must_use]
    pub fn colors(&self) -> &CornerValues {
        &self.colors
    }

    /// Tangents of the triangles with normal maps.
    #[must_use]
    pub fn tangents(&self) -> &CornerValues {
        &self.tangents
    }

    /// Lowest and highest corner of the box around all triangles, in metres; `None` without triangles.
    #[must_use]
    pub fn bounds(&self) -> Option<[Vec3A; 2]> {
        self.bounds
    }

    /// False if the material of a triangle is cut out, or covers less than half, at barycentric weights (1 − u − v, u, v).
    #[must_use]
    pub fn is_solid(&self, triangle: u32, u: f32, v: f32) -> bool {
        let Some(opacity) = self.opacity(triangle) else { return true };
        let uv = self.triangles[triangle as usize].uv_at(u, v);
        opacity.coverage(&uv, self.color_at(triangle, u, v)) >= HALF_COVERED
    }

    fn opacity(&self, triangle: u32) -> Option<&Opacity> {
        let material = self.triangles[triangle as usize].material;
        self.opacities.get(material as usize).and_then(Option::as_ref)
    }

    fn color_at(&self, triangle: u32, u: f32, v: f32) -> [f32; 4] {
        self.colors.at(&Hit { t: 0.0, triangle, u, v }).unwrap_or([1.0; 4])
    }

    /// True if the triangle stops the ray of `key`.
    fn stops(&self, triangle: u32, u: f32, v: f32, direction: Vec3A, key: u64) -> bool {
        let probability = self.stop_probability(triangle, u, v, direction);
        let number = || (mix64(key ^ mix64(u64::from(triangle) + 1)) >> 40) as f32 * (1.0 / 16_777_216.0);
        probability >= 1.0 || number() < probability
    }

    /// Probability that the triangle stops a ray there.
    fn stop_probability(&self, triangle: u32, u: f32, v: f32, direction: Vec3A) -> f32 {
        let Some(opacity) = self.opacity(triangle) else { return 1.0 };
        let here = &self.triangles[triangle as usize];
        let cos = || here.surface(u, v).shading_normal.dot(direction.normalize()).abs();
        opacity.stop_probability(&here.uv_at(u, v), self.color_at(triangle, u, v), cos)
    }
}
