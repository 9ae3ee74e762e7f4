//! Ground truth of pixel-centre rays: distances and the fog in front of them, computed and never sampled.
//!
//! The first surface of a ray may be glass, through which the image shows what is behind. Blended surfaces count where they
//! cover at least half, cut-out ones where they are solid.

use fog_core::math;
use fog_film::{SurfaceTruth, Truth};
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;
use rayon::prelude::*;

/// Wavelengths at which `transmittance.R`, `.G` and `.B` are given: the dominant wavelengths of the sRGB primaries, green
/// rounded to 550 nm so that transmittance.G = exp(−tau).
pub const TRANSMITTANCE_NM: [f64; 3] = [611.0, 550.0, 464.0];

/// Wavelength of `tau` in nm.
pub const TAU_NM: f64 = 550.0;

/// Truth of one ray.
struct Row {
    depth: f32,
    distance: f32,
    transmittance: [f32; 3],
    tau: f32,
}

/// A pixel whose centre the lens does not show.
const UNSEEN: Row = Row { depth: f32::NAN, distance: f32::NAN, transmittance: [f32::NAN; 3], tau: f32::NAN };

/// Depth, distance, transmittance and optical depth of every pixel, NaN where the lens sees nothing; of a monochromatic frame
/// the transmittance is that of its wavelength.
#[must_use]
pub fn truth(scene: &Scene, camera: &Camera, wavelength_nm: Option<f32>) -> Truth {
    let bands = wavelength_nm.map_or(TRANSMITTANCE_NM, |nm| [f64::from(nm); 3]);
    let rows: Vec<Row> = (0..camera.width as usize * camera.height as usize)
        .into_par_iter()
        .map(|i| pixel_truth(scene, camera, i, bands))
        .collect();
    Truth {
        depth_m: rows.iter().map(|r| r.depth).collect(),
        distance_m: rows.iter().map(|r| r.distance).collect(),
        transmittance: rows.iter().map(|r| r.transmittance).collect(),
        tau: rows.iter().map(|r| r.tau).collect(),
        surface: SurfaceTruth::default(),
    }
}

fn pixel_truth(scene: &Scene, camera: &Camera, i: usize, bands: [f64; 3]) -> Row {
    let (x, y) = (i % camera.width as usize, i / camera.width as usize);
    let [x, y] = [x, y].map(|v| v as f64 + 0.5);
    let Some(ray) = camera.ray(x, y) else { return UNSEEN };
    let hit = scene.intersect(ray.origin, ray.direction, f32::INFINITY);
    let distance = hit.map_or(f32::INFINITY, |h| h.t);
    let [r, g, b] = bands;
    let wavelengths = [r, g, b, TAU_NM];
    let depths = scene.optical_depths_at(ray.origin, ray.direction, f64::from(distance), wavelengths);
    Row {
        depth: camera.depth(x, y, distance),
        distance,
        transmittance: [0, 1, 2].map(|i| math::f64::exp(-depths[i]) as f32),
        tau: depths[3] as f32,
    }
}
