//! What a surface looks like apart from the light on it: guides for a denoiser.

use crate::bvh::Hit;
use crate::scene::Scene;
use fog_core::Vec3A;
use fog_core::colour::Rgb;

/// Colour and orientation of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Features {
    /// Base colour in [0, 1]; of light that the surface emits, if that is more, its colour clipped to 1.
    pub albedo: Rgb,
    /// Unit shading normal on the side that the ray came from, in the world.
    pub normal: Vec3A,
}

impl Scene {
    /// Features of a hit seen along `direction`. Glass has those of the pane, black backs are black.
    #[must_use]
    pub fn features(&self, hit: &Hit, direction: Vec3A) -> Features {
        let base = self.base_features(hit, direction);
        let emission =
            if self.emitters().is_empty() { [0.0; 3] } else { self.emission_towards(hit, direction).0 };
        let albedo = [0, 1, 2].map(|c: usize| base.albedo[c].max(emission[c].clamp(0.0, 1.0)));
        Features { albedo, ..base }
    }

    /// The same without the light that the surface emits: the albedo is the base colour alone.
    #[must_use]
    pub fn base_features(&self, hit: &Hit, direction: Vec3A) -> Features {
        let loaded = self.loaded();
        let point = loaded.geometry.surface(hit);
        let material = &loaded.materials[point.material as usize];
        let front = point.geometric_normal.dot(direction) < 0.0;
        let normal = if front { point.shading_normal } else { -point.shading_normal };
        if !(front || material.double_sided || material.transmission > 0.0) {
            return Features { albedo: [0.0; 3], normal };
        }
        let mut values = material.evaluate(&loaded.textures, &point.uv);
        if let Some(color) = loaded.geometry.colors().at(hit) {
            values = values.tinted(color);
        }
        let albedo = [0, 1, 2].map(|c: usize| values.base_color[c].clamp(0.0, 1.0));
        Features { albedo, normal }
    }
}
