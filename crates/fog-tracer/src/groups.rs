//! The light of one path by groups of lights, and by fogs.

use crate::watch::{Step, Watch};
use fog_core::spectrum::Spectrum;
use fog_scene::light_groups::LightSource;
use fog_scene::scene::Scene;

/// Sums of what a path saw of each group of lights, in each fog.
pub(crate) struct GroupLight<'a> {
    scene: &'a Scene,
    fogs: usize,
    /// Group by group, fog by fog.
    found: Vec<Spectrum>,
    /// What is airlight whatever the path's first event was.
    glow: Vec<Spectrum>,
    /// True if the path's first event was a scattering in the fog.
    pub(crate) airlight: bool,
}

impl<'a> GroupLight<'a> {
    /// Nothing seen so far of so many groups in so many fogs.
    pub(crate) fn new(scene: &'a Scene, groups: usize, fogs: usize) -> Self {
        let dark = vec![Spectrum::ZERO; groups * fogs];
        Self { scene, fogs, found: dark.clone(), glow: dark, airlight: false }
    }

    /// Forgets a path.
    pub(crate) fn clear(&mut self) {
        self.found.fill(Spectrum::ZERO);
        self.glow.fill(Spectrum::ZERO);
        self.airlight = false;
    }

    /// Adds light that was found in a fog.
    #[inline]
    pub(crate) fn add(&mut self, fog: usize, source: LightSource, light: Spectrum) {
        if !light.is_zero() {
            self.found[self.scene.light_group(source) * self.fogs + fog] += light;
        }
    }

    /// Direct light and airlight as relative radiance, group by group, fog by fog.
    pub(crate) fn parts(&self) -> impl Iterator<Item = [Spectrum; 2]> {
        let split = |(&found, &glow)| {
            if self.airlight { [Spectrum::ZERO, found + glow] } else { [found, glow] }
        };
        self.found.iter().zip(&self.glow).map(split)
    }
}

impl Watch for GroupLight<'_> {
    #[inline(always)]
    fn see(&mut self, _: impl FnOnce() -> Step) {}

    #[inline]
    fn light(&mut self, source: LightSource, light: Spectrum, glow: bool) {
        if glow {
            self.glow[self.scene.light_group(source) * self.fogs] += light;
        } else {
            self.add(0, source, light);
        }
    }
}
