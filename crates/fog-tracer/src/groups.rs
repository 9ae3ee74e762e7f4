//! The light of one path by groups of lights.

use crate::watch::{Step, Watch};
use fog_core::spectrum::Spectrum;
use fog_scene::light_groups::LightSource;
use fog_scene::scene::Scene;

/// Sums of what a path saw of each group of lights.
pub(crate) struct GroupLight<'a> {
    scene: &'a Scene,
    sums: Vec<Spectrum>,
}

impl<'a> GroupLight<'a> {
    /// Nothing seen so far of so many groups.
    pub(crate) fn new(scene: &'a Scene, count: usize) -> Self {
        Self { scene, sums: vec![Spectrum::ZERO; count] }
    }

    /// Forgets a path.
    pub(crate) fn clear(&mut self) {
        self.sums.fill(Spectrum::ZERO);
    }

    /// Relative radiance by group, direct light and airlight together.
    pub(crate) fn groups(&self) -> &[Spectrum] {
        &self.sums
    }
}

impl Watch for GroupLight<'_> {
    #[inline(always)]
    fn see(&mut self, _: impl FnOnce() -> Step) {}

    #[inline]
    fn light(&mut self, source: LightSource, light: Spectrum) {
        if !light.is_zero() {
            self.sums[self.scene.light_group(source)] += light;
        }
    }
}
