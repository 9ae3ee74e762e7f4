//! What the fog leaves of the light of broad emitters, by the altitude at which it arrives.
//!
//! High above lit streets, emitters fill little of the view and paths hardly run into them, but hardly any of their light gets
//! there either: connections from there cost a fifth of the time of the night street of `docs/performance.md`, and doing
//! without them adds 0.3 % to its error.

use fog_core::math;
use fog_scene::emitters::Breadth;
use fog_scene::scene::Scene;

/// Steps of even height through the fog.
const STEPS: usize = 128;

/// Square of the mean over the emitters' area of the transmittance straight up or down from their altitudes, at 550 nm: what a
/// connection does against noise goes with the square of what it brings.
#[derive(Clone, Debug, Default)]
pub(super) struct Haze {
    base_y: f32,
    steps_per_m: f32,
    /// At the middle of each step; empty for 1 everywhere.
    left: Vec<f32>,
}

impl Haze {
    pub(super) fn new(scene: &Scene) -> Self {
        let Some(medium) = scene.medium.as_ref().filter(|_| scene.emitters().has(Breadth::Broad)) else {
            return Self::default();
        };
        let profile = medium.profile();
        let (base, height) = (profile.base_y(), profile.top_y() - profile.base_y());
        let mut haze = Self {
            base_y: base as f32,
            steps_per_m: STEPS as f32 / height as f32,
            left: Vec::with_capacity(STEPS),
        };
        let mut area = [0.0f32; STEPS];
        for (y, own) in scene.emitters().heights(Breadth::Broad) {
            area[haze.step(y)] += own;
        }
        let total: f32 = area.iter().sum();
        let depth = |step: usize| {
            profile.optical_depth_at(base, 1.0, height * (step as f64 + 0.5) / STEPS as f64, 550.0) as f32
        };
        let depths: [f32; STEPS] = std::array::from_fn(depth);
        for here in depths {
            let through = |(own, there): (&f32, f32)| own * math::fast_exp(-(here - there).abs());
            let mean = area.iter().zip(depths).map(through).sum::<f32>() / total;
            haze.left.push((mean * mean).min(1.0));
        }
        haze
    }

    fn step(&self, y: f32) -> usize {
        (((y - self.base_y) * self.steps_per_m).max(0.0) as usize).min(STEPS - 1)
    }

    /// In [0, 1], at world y; beyond the fog as at its edge.
    #[inline]
    pub(super) fn at(&self, y: f32) -> f32 {
        self.left.get(self.step(y)).copied().unwrap_or(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::Vec3;
    use fog_core::phase::HenyeyGreenstein;
    use fog_core::profile::ExtinctionProfile;
    use fog_scene::medium::Medium;
    use fog_scene::phase::Phase;
    use fog_scene::{Geometry, LoadedScene, Material, Triangle};
    use std::sync::Arc;

    #[test]
    fn light_fades_with_the_way_to_the_emitters() {
        let profile = ExtinctionProfile::new(0.0, vec![0.0, 100.0], vec![550.0], vec![0.02; 2], vec![1.0; 2]);
        let phase = Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.8).expect("g"));
        let medium = Medium::new(profile.expect("profile"), phase);
        // A floor of 200 m² at y = 10.2, in the middle of a step.
        let corners = [Vec3::new(0.0, 10.2, 0.0), Vec3::new(0.0, 10.2, 20.0), Vec3::new(20.0, 10.2, 0.0)];
        let geometry = Geometry::new(vec![Triangle::flat(corners)], Vec::new());
        let materials = vec![Material { emissive: [1.0; 3], ..Material::default() }];
        let floor = Arc::new(LoadedScene { geometry, materials, ..LoadedScene::default() });
        let haze = Haze::new(&Scene::new(floor, Some(medium), None, None, true));
        for (y, away) in [(10.2, 0.0), (80.0, 69.8), (5.0, 5.2), (500.0, 89.4)] {
            let want = math::f32::exp(-0.04 * away);
            assert!((haze.at(y) - want).abs() < 0.03 * want, "{y}: {} for {want}", haze.at(y));
        }
        assert_eq!(Haze::default().at(3.0), 1.0);
    }
}
