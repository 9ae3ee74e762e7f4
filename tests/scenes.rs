//! Small scenes that several suites render.

use fog_core::optics_table::{OpticsTable, OpticsTableParts};
use fog_core::phase::HenyeyGreenstein;
use fog_core::phase_grid;
use fog_core::profile::ExtinctionProfile;
use fog_core::{Vec3, Vec3A, colour::Observer};
use fog_film::Frame;
use fog_scene::camera::{Camera, Pose};
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;
use fog_scene::{Geometry, Limits, LoadedScene, Material, Triangle};
use fog_tracer::settings::Settings;
use std::sync::Arc;

/// A table of Henyey–Greenstein functions whose g, and whose cross sections, vary with altitude and wavelength.
#[must_use]
pub fn small_table() -> OpticsTable {
    let nodes = phase_grid::nodes();
    let mut phase = Vec::new();
    let mut c_ext_m2 = Vec::new();
    let mut g_all = Vec::new();
    for z in 0..2 {
        for l in 0..2 {
            let g = 0.6 + 0.2 * f64::from(z) + 0.1 * f64::from(l);
            g_all.push(g);
            c_ext_m2.push(1e-10 * (1.0 + 0.3 * f64::from(l)));
            let hg = HenyeyGreenstein::new(g).expect("valid g");
            phase.extend(nodes.iter().map(|&m| hg.eval(m)));
        }
    }
    OpticsTable::new(&OpticsTableParts {
        zeta: vec![0.0, 1.0],
        wavelengths_nm: vec![400.0, 700.0],
        c_sca_m2: c_ext_m2.clone(),
        c_ext_m2,
        g: g_all,
        phase,
    })
    .expect("valid table")
}

/// Grey fog whose extinction is given at even altitudes from 0 to `height_m`.
#[must_use]
pub fn grey_profile(height_m: f64, sigma_t_1_m: &[f64], albedo: f64) -> ExtinctionProfile {
    let n = sigma_t_1_m.len();
    let z = (0..n).map(|i| height_m * i as f64 / (n - 1) as f64).collect();
    ExtinctionProfile::new(0.0, z, vec![550.0], sigma_t_1_m.to_vec(), vec![albedo; n]).expect("valid profile")
}

/// Fog whose extinction and phase function depend on the wavelength.
#[must_use]
pub fn coloured_fog(height_m: f64, sigma_t_1_m: f64, albedo: f64) -> Medium {
    let profile = ExtinctionProfile::new(
        0.0,
        vec![0.0, 0.6 * height_m, height_m],
        vec![400.0, 700.0],
        [0.5, 0.9, 1.0, 1.6, 0.7, 1.1].map(|x| x * sigma_t_1_m).to_vec(),
        vec![albedo; 6],
    )
    .expect("valid profile");
    Medium::new(profile, Phase::Table(small_table()))
}

/// Henyey–Greenstein fog.
#[must_use]
pub fn hg_fog(profile: ExtinctionProfile, g: f32) -> Medium {
    Medium::new(profile, Phase::HenyeyGreenstein(HenyeyGreenstein::new(f64::from(g)).expect("valid g")))
}

/// No surfaces at all.
#[must_use]
pub fn empty() -> Arc<LoadedScene> {
    Arc::new(LoadedScene::default())
}

/// A scene of `tests/data`.
///
/// # Panics
/// If it cannot be loaded.
#[must_use]
pub fn load(name: &str) -> Arc<LoadedScene> {
    Arc::new(fog_scene::load(&crate::data(name), &Limits::default()).expect("scene loads"))
}

/// Camera at a height over the origin.
#[must_use]
pub fn camera(
    altitude_m: f32,
    heading_deg: f64,
    pitch_deg: f64,
    width: u32,
    height: u32,
    fov: f64,
) -> Camera {
    let pose = Pose::new(Vec3A::new(0.0, altitude_m, 0.0), heading_deg, pitch_deg, 0.0);
    Camera::new(pose, width, height, fov)
}

/// Renders on all cores.
///
/// # Panics
/// If a pixel is not finite.
#[must_use]
pub fn render(scene: &Scene, camera: &Camera, samples: u64, wavelength_nm: Option<f32>, seed: u64) -> Frame {
    let settings = Settings { samples, max_depth: None, wavelength_nm };
    fog_tracer::render::render(scene, camera, &Observer::new(), &settings, seed, &|_| true)
        .expect("finite")
        .expect("not cancelled")
}

/// Means of one channel of the image over the whole frame and its standard error from the pixels' own.
#[must_use]
pub fn mean(frame: &Frame, channel: usize) -> f64 {
    let n = frame.pixel_count();
    (0..n).map(|i| f64::from(frame.image(i)[channel])).sum::<f64>() / n as f64
}

/// Standard error of the mean luminance of the whole frame.
#[must_use]
pub fn standard_error(frame: &Frame) -> f64 {
    let sum: f64 = frame.standard_error.iter().map(|&e| f64::from(e).powi(2)).sum();
    sum.sqrt() / frame.pixel_count() as f64
}

/// One Lambertian material of this reflectance.
fn lambertian(reflectance: f32) -> Material {
    Material {
        base_color: [reflectance, reflectance, reflectance, 1.0],
        metallic: 0.0,
        specular: 0.0,
        ..Material::default()
    }
}

/// A level ground at y = 0 that reaches 200 km in every direction.
#[must_use]
pub fn lambertian_ground(reflectance: f32) -> Arc<LoadedScene> {
    let corner = |x: f32, z: f32| Vec3::new(2e5 * x, 0.0, 2e5 * z);
    let [a, b, c, d] = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
    let triangles = vec![Triangle::flat([a, b, c]), Triangle::flat([a, c, d])];
    let geometry = Geometry::new(triangles, Vec::new());
    Arc::new(LoadedScene { geometry, materials: vec![lambertian(reflectance)], ..LoadedScene::default() })
}

/// The street with every surface perfectly white.
#[must_use]
pub fn white_street() -> Arc<LoadedScene> {
    let street = fog_scene::load(&crate::data("street_day.glb"), &Limits::default()).expect("scene loads");
    let materials = vec![lambertian(1.0); street.materials.len()];
    Arc::new(LoadedScene { materials, ..street })
}
