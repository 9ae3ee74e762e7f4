//! How much of a ray a material stops, for the ray test.

use super::{AlphaMode, Material};
use crate::texture::Texture;
use std::sync::Arc;

/// A material that lets rays pass somewhere: by holes, by partial coverage, or as clear glass.
#[derive(Clone, Debug)]
pub struct Opacity {
    material: Material,
    textures: Arc<[Texture]>,
}

impl Opacity {
    /// `None` if the material stops every ray.
    #[must_use]
    pub fn new(material: &Material, textures: &Arc<[Texture]>) -> Option<Self> {
        let passes = material.alpha_mode != AlphaMode::Opaque || material.transmission > 0.0;
        passes.then(|| Self { material: material.clone(), textures: Arc::clone(textures) })
    }

    /// False if every point either stops a ray or does not.
    #[must_use]
    pub fn is_partial(&self) -> bool {
        self.material.alpha_mode == AlphaMode::Blend || self.material.transmission > 0.0
    }

    /// Share of the surface that is there, in [0, 1]: 0 or 1 unless the mode is [`AlphaMode::Blend`].
    #[must_use]
    pub fn coverage(&self, uv: &[[f32; 2]; 2], vertex_color: [f32; 4]) -> f32 {
        self.material.coverage(&self.textures, uv, vertex_color[3])
    }

    /// Probability in [0, 1] that the surface stops a ray which meets it at the angle whose cosine is `cos()`.
    #[must_use]
    pub fn stop_probability(
        &self,
        uv: &[[f32; 2]; 2],
        vertex_color: [f32; 4],
        cos: impl FnOnce() -> f32,
    ) -> f32 {
        let coverage = self.coverage(uv, vertex_color);
        if self.material.transmission == 0.0 || coverage == 0.0 {
            return coverage;
        }
        let values = self.material.evaluate(&self.textures, uv).tinted(vertex_color);
        coverage * (1.0 - values.clear_share(cos()))
    }
}
