//! Small scenes that several suites render.

use fog_core::colour::{Observer, Rgb};
use fog_core::diameter_choice::DiameterChoice;
use fog_core::droplet_table::{DropletColumn, DropletTable};
use fog_core::math;
use fog_core::optics_table::{OpticsTable, OpticsTableError, OpticsTableParts};
use fog_core::phase::HenyeyGreenstein;
use fog_core::phase_grid;
use fog_core::profile::ExtinctionProfile;
use fog_core::{Vec3, Vec3A};
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
    Medium::new(coloured_profile(height_m, sigma_t_1_m, albedo), Phase::Table(small_table()))
}

fn coloured_profile(height_m: f64, sigma_t_1_m: f64, albedo: f64) -> ExtinctionProfile {
    ExtinctionProfile::new(
        0.0,
        vec![0.0, 0.6 * height_m, height_m],
        vec![400.0, 700.0],
        [0.5, 0.9, 1.0, 1.6, 0.7, 1.1].map(|x| x * sigma_t_1_m).to_vec(),
        vec![albedo; 6],
    )
    .expect("valid profile")
}

/// Droplets with their mixtures, over the same wavelengths.
#[derive(Debug)]
pub struct Droplets {
    /// Phase functions of all droplets together.
    pub mixtures: OpticsTable,
    /// Each droplet's own.
    pub single: DropletTable,
    /// Their odds.
    pub choice: DiameterChoice,
}

/// Droplets of Henyey–Greenstein functions between which everything depends strongly on the wavelength, unlike those of
/// fog: small ones scatter backward and blue light, large ones forward and red light; the large ones are higher up.
///
/// # Panics
/// If a table is refused (a mistake here).
#[must_use]
pub fn droplets() -> Droplets {
    let (nodes, nm, diameters) = (phase_grid::nodes(), [380.0, 550.0, 780.0], [1.0, 2.0, 3.0, 4.0, 5.0]);
    let hg = |d: usize, l: usize| HenyeyGreenstein::new(-0.3 + 0.25 * d as f64 + 0.05 * l as f64).expect("g");
    let weight = |z: usize, d: usize, l: usize| {
        let steepness = 1.2 * (l as f64 - 1.0) + 0.5 * z as f64;
        math::f64::exp(steepness * (d as f64 - 2.0))
    };
    let single = DropletTable::new(&diameters, &nm, |l| {
        Ok::<_, OpticsTableError>(DropletColumn {
            c_ext_m2: vec![1.0; 5],
            c_sca_m2: vec![1.0; 5],
            g: (0..5).map(|d| hg(d, l).mean_cosine()).collect(),
            phase: (0..5).flat_map(|d| nodes.iter().map(move |&m| hg(d, l).eval(m))).collect(),
        })
    });
    let (mut weights, mut phase) = (Vec::new(), Vec::new());
    for z in 0..2 {
        for d in 0..5 {
            weights.extend((0..3).map(|l| weight(z, d, l)));
        }
        for l in 0..3 {
            let mixture = |m: f64| (0..5).map(|d| weight(z, d, l) * hg(d, l).eval(m)).sum::<f64>();
            phase.extend(nodes.iter().map(|&m| mixture(m)));
        }
    }
    let mixtures = OpticsTable::new(&OpticsTableParts {
        zeta: vec![0.0, 1.0],
        wavelengths_nm: nm.to_vec(),
        c_ext_m2: vec![1.0; 6],
        c_sca_m2: vec![1.0; 6],
        g: vec![0.0; 6],
        phase,
    });
    Droplets {
        mixtures: mixtures.expect("mixtures"),
        single: single.expect("droplets"),
        choice: DiameterChoice::new(&[0.0, 1.0], 3, &weights).expect("odds"),
    }
}

/// A layer of [`droplets`] whose extinction depends on the wavelength, by mixtures or by single droplets.
#[must_use]
pub fn parcel(height_m: f64, sigma_t_1_m: f64, single: bool) -> Medium {
    let Droplets { mixtures, single: table, choice } = droplets();
    let phase = if single { Phase::Droplets { table, choice } } else { Phase::Table(mixtures) };
    Medium::new(coloured_profile(height_m, sigma_t_1_m, 1.0), phase)
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
    let settings = Settings { samples, max_depth: None, wavelength_nm, stop: None };
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

/// A closed room of 10 m × 6 m × 14 m about the camera's place, on y = 0: every wall reflects and emits alike on both sides.
#[must_use]
pub fn enclosure(reflectance: Rgb, emission: Rgb) -> Arc<LoadedScene> {
    let (low, high) = (Vec3::new(-5.0, 0.0, -9.0), Vec3::new(5.0, 6.0, 5.0));
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for end in [low, high] {
            let corner = |u: bool, v: bool| {
                let mut p = end;
                for (k, far) in [((axis + 1) % 3, u), ((axis + 2) % 3, v)] {
                    p[k] = if far { high[k] } else { low[k] };
                }
                p
            };
            let [a, b, c, d] =
                [corner(false, false), corner(true, false), corner(true, true), corner(false, true)];
            triangles.extend([Triangle::flat([a, b, c]), Triangle::flat([a, c, d])]);
        }
    }
    let [r, g, b] = reflectance;
    let wall =
        Material { base_color: [r, g, b, 1.0], emissive: emission, double_sided: true, ..lambertian(0.0) };
    let geometry = Geometry::new(triangles, Vec::new());
    Arc::new(LoadedScene { geometry, materials: vec![wall], ..LoadedScene::default() })
}
