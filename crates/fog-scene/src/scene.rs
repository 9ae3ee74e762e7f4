//! Everything that one frame's paths can meet, immutable and shared by all threads.

use crate::bsdf::Bsdf;
use crate::bvh::Hit;
use crate::emitters::{EmitterTriangle, Emitters};
use crate::gltf_load::LoadedScene;
use crate::light::{Environment, Sun};
use crate::medium::Medium;
use crate::triangle::SurfacePoint;
use fog_core::colour::{Rgb, upsample};
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, warp};
use glam::Mat3A;
use std::sync::Arc;

/// Geometry and materials (shared between frames), the fog and the lights of one frame.
#[derive(Clone, Debug)]
pub struct Scene {
    loaded: Arc<LoadedScene>,
    /// The fog, if any.
    pub medium: Option<Medium>,
    /// Uniform environment, if any.
    pub environment: Option<Environment>,
    /// Sun, if any.
    pub sun: Option<Sun>,
    emitters: Emitters,
}

/// A surface point seen from a ray, ready for shading.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// The point: position, plane normal, material.
    pub point: SurfacePoint,
    /// Unit normal of the triangle on the side that the ray came from.
    pub normal: Vec3A,
    /// World from shading frame (z = shading normal on that side).
    pub world_from_shading: Mat3A,
    /// Reflection; `None` on the back of a single-sided material, which is black.
    pub bsdf: Option<Bsdf>,
    /// Relative radiance emitted towards the ray's origin.
    pub emission: Spectrum,
}

/// Points per triangle edge at which a textured emission is averaged to get the triangle's power.
const POWER_GRID: u32 = 12;

impl Scene {
    /// Puts a frame's scene together; `scene_emitters` switches the emission of all materials.
    #[must_use]
    pub fn new(
        loaded: Arc<LoadedScene>,
        medium: Option<Medium>,
        environment: Option<Environment>,
        sun: Option<Sun>,
        scene_emitters: bool,
    ) -> Self {
        let emitters = if scene_emitters { find_emitters(&loaded) } else { Emitters::default() };
        Self { loaded, medium, environment, sun, emitters }
    }

    /// Geometry, materials and objects.
    #[must_use]
    pub fn loaded(&self) -> &LoadedScene {
        &self.loaded
    }

    /// The emitting triangles; empty when they are switched off.
    #[must_use]
    pub fn emitters(&self) -> &Emitters {
        &self.emitters
    }

    /// Closest surface along a ray before `t_max`.
    #[inline]
    #[must_use]
    pub fn intersect(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> Option<Hit> {
        self.loaded.geometry.intersect(origin, direction, t_max)
    }

    /// True if any surface lies on the ray before `t_max`.
    #[inline]
    #[must_use]
    pub fn occluded(&self, origin: Vec3A, direction: Vec3A, t_max: f32) -> bool {
        self.loaded.geometry.occluded(origin, direction, t_max)
    }

    /// Shading data of a hit seen along `direction`, at the wavelengths whose colour basis is `basis`.
    #[must_use]
    pub fn surface(&self, hit: &Hit, direction: Vec3A, basis: &[Spectrum; 3]) -> Surface {
        let point = self.loaded.geometry.surface(hit);
        let material = &self.loaded.materials[point.material as usize];
        let front = point.geometric_normal.dot(direction) < 0.0;
        let side = if front { 1.0 } else { -1.0 };
        let visible = front || material.double_sided;
        let values = visible.then(|| material.evaluate(&self.loaded.textures, &point.uv));
        let emission = values.filter(|_| !self.emitters.is_empty()).map_or([0.0; 3], |v| v.emission);
        Surface {
            point,
            normal: point.geometric_normal * side,
            world_from_shading: warp::frame(point.shading_normal * side),
            bsdf: values.map(|v| Bsdf::new(&v, basis)),
            emission: upsample(emission, basis),
        }
    }

    /// Relative radiance that a point of an emitting triangle sends towards `-direction` (the ray's origin).
    #[must_use]
    pub fn emission_towards(&self, hit: &Hit, direction: Vec3A) -> (Rgb, Vec3A) {
        let point = self.loaded.geometry.surface(hit);
        let material = &self.loaded.materials[point.material as usize];
        let front = point.geometric_normal.dot(direction) < 0.0;
        let rgb = if front || material.double_sided {
            material.emission(&self.loaded.textures, &point.uv)
        } else {
            [0.0; 3]
        };
        (rgb, point.geometric_normal)
    }
}

/// All triangles whose material emits, with their power up to a common factor.
fn find_emitters(loaded: &LoadedScene) -> Emitters {
    let all = loaded.geometry.triangles();
    let mut triangles = Vec::new();
    for (id, triangle) in all.iter().enumerate() {
        let material = &loaded.materials[triangle.material as usize];
        if !material.is_emissive() {
            continue;
        }
        // Mean emission over an even grid of points; red, green and blue count alike, for all must be found.
        let mut sum = 0.0;
        for i in 0..POWER_GRID {
            for j in 0..POWER_GRID - i {
                let at = |k: u32| (k as f32 + 1.0 / 3.0) / POWER_GRID as f32;
                let rgb = material.emission(&loaded.textures, &triangle.uv_at(at(i), at(j)));
                sum += f64::from(rgb.iter().sum::<f32>());
            }
        }
        let sides = if material.double_sided { 2.0 } else { 1.0 };
        triangles.push(EmitterTriangle {
            triangle: id as u32,
            corners: triangle.positions.map(Vec3A::from),
            power: sum * sides * f64::from(triangle.area()),
        });
    }
    Emitters::new(triangles, all.len())
}
