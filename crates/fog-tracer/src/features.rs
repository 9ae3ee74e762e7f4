//! Guides for a denoiser: what each pixel shows apart from the light on it, without noise. Patchy fog counts as the even fog
//! that it is in the mean: its patches show in the picture alone.

use crate::truth::TRANSMITTANCE_NM;
use fog_core::Vec3A;
use fog_core::colour::Rgb;
use fog_core::math;
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;
use rayon::prelude::*;

/// Rays per pixel along each axis: as the picture's, edges are averages over the pixel.
const GRID: u32 = 4;

/// Albedo and normal of every pixel, row-major.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FeatureImages {
    /// In [0, 1]. What a surface is worth fades with the transmittance of the fog before it, towards the fog's own white; the
    /// sky is white.
    pub albedo: Vec<Rgb>,
    /// In the world, fading towards zero in the same way; zero for the sky.
    pub normal: Vec<[f32; 3]>,
}

/// The guides of a frame: means over 16 rays of each pixel.
#[must_use]
pub fn features(scene: &Scene, camera: &Camera) -> FeatureImages {
    let pixels: Vec<_> = (0..camera.width as usize * camera.height as usize)
        .into_par_iter()
        .map(|i| pixel(scene, camera, i))
        .collect();
    let (albedo, normal) = pixels.into_iter().unzip();
    FeatureImages { albedo, normal }
}

fn pixel(scene: &Scene, camera: &Camera, i: usize) -> (Rgb, [f32; 3]) {
    let corner = [i % camera.width as usize, i / camera.width as usize].map(|v| v as f64);
    let (mut albedo, mut normal) = ([0.0f32; 3], Vec3A::ZERO);
    for k in 0..GRID * GRID {
        let inside = [k % GRID, k / GRID].map(|v| (f64::from(v) + 0.5) / f64::from(GRID));
        // Where the lens sees nothing the features stay 0, like the picture.
        let Some(ray) = camera.ray(corner[0] + inside[0], corner[1] + inside[1]) else { continue };
        let Some(hit) = scene.intersect(ray.origin, ray.direction, f32::INFINITY) else {
            albedo = albedo.map(|sum| sum + 1.0);
            continue;
        };
        let seen = scene.features(&hit, ray.direction);
        let through = TRANSMITTANCE_NM.map(|nm| {
            let depth = scene.medium.as_ref().map_or(0.0, |medium| {
                let (y, dy) = (f64::from(ray.origin.y), f64::from(ray.direction.y));
                medium.profile().optical_depth_at(y, dy, f64::from(hit.t), nm)
            });
            math::f64::exp(-depth) as f32
        });
        for c in 0..3 {
            albedo[c] += through[c] * seen.albedo[c] + (1.0 - through[c]);
        }
        normal += seen.normal * through[1];
    }
    let mean = 1.0 / (GRID * GRID) as f32;
    (albedo.map(|sum| (sum * mean).min(1.0)), (normal * mean).to_array())
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::Vec3;
    use fog_core::phase::HenyeyGreenstein;
    use fog_core::profile::ExtinctionProfile;
    use fog_scene::camera::Pose;
    use fog_scene::medium::Medium;
    use fog_scene::phase::Phase;
    use fog_scene::{Geometry, LoadedScene, Material, Triangle};
    use std::sync::Arc;

    /// A wall to the north, 100 m away and up to eye height, that reflects little and emits some red.
    fn wall() -> Arc<LoadedScene> {
        let corner = |x: f32, y: f32| Vec3::new(x, y, -100.0);
        let [a, b, c, d] = [corner(-1e4, -1e4), corner(1e4, -1e4), corner(1e4, 10.0), corner(-1e4, 10.0)];
        let material =
            Material { base_color: [0.1, 0.2, 0.3, 1.0], emissive: [0.5, 0.0, 0.0], ..Material::default() };
        let geometry = Geometry::new(vec![Triangle::flat([a, b, c]), Triangle::flat([a, c, d])], Vec::new());
        Arc::new(LoadedScene { geometry, materials: vec![material], ..LoadedScene::default() })
    }

    fn close(found: [f32; 3], want: [f32; 3]) {
        let near = found.iter().zip(want).all(|(f, w)| (f - w).abs() < 2e-3);
        assert!(near, "{found:?} is not {want:?}");
    }

    #[test]
    fn surfaces_fade_into_the_white_of_fog_and_sky() {
        let pose = Pose::new(Vec3A::new(0.0, 10.0, 0.0), 0.0, 0.0, 0.0);
        // The middle row is half wall, half sky; the field is so narrow that every ray has 100 m to go.
        let camera = Camera::new(pose, 3, 3, 0.1);
        let clear = features(&Scene::new(wall(), None, None, None, false), &camera);
        close(clear.albedo[7], [0.1, 0.2, 0.3]);
        close(clear.normal[7], [0.0, 0.0, 1.0]);
        close(clear.albedo[4], [0.55, 0.6, 0.65]);
        close(clear.normal[4], [0.0, 0.0, 0.5]);
        close(clear.albedo[1], [1.0; 3]);
        close(clear.normal[1], [0.0; 3]);
        // Emission is its own colour; half of it is left behind fog of optical depth ln 2.
        let sigma = std::f64::consts::LN_2 / 100.0;
        let profile =
            ExtinctionProfile::new(0.0, vec![0.0, 50.0], vec![550.0], vec![sigma; 2], vec![1.0; 2]).unwrap();
        let phase = Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.8).unwrap());
        let medium = Some(Medium::new(profile, phase));
        let foggy = features(&Scene::new(wall(), medium, None, None, true), &camera);
        close(foggy.albedo[7], [0.75, 0.6, 0.65]);
        close(foggy.normal[7], [0.0, 0.0, 0.5]);
    }
}
