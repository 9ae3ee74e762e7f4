//! The tile scheduler: pixels in parallel, each a function of (scene, camera, settings, seed) alone.

use crate::path::PathTracer;
use crate::settings::Settings;
use crate::truth::truth;
use fog_core::colour::Observer;
use fog_core::random::{PathRng, stratified};
use fog_core::spectrum::{LANES, Wavelengths};
use fog_film::{Channels, Frame, FrameError, PixelFilm};
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;
use rayon::prelude::*;

/// Pixels that one task renders: enough to hide scheduling, few enough to balance two cores to the end of a small frame.
const TASK_PIXELS: usize = 64;

/// Renders a frame on the current rayon pool. `progress` hears of finished pixels, from any thread; returning `false` asks
/// to stop, which gives `Ok(None)`.
///
/// # Errors
/// If a pixel's radiance is not finite.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    observer: &Observer,
    settings: &Settings,
    seed: u64,
    progress: &(dyn Fn(u64) -> bool + Sync),
) -> Result<Option<Frame>, FrameError> {
    let tracer = PathTracer::new(scene, observer, *settings);
    let count = camera.width as usize * camera.height as usize;
    let starts: Vec<usize> = (0..count).step_by(TASK_PIXELS).collect();
    let tasks: Option<Vec<Vec<PixelFilm>>> = starts
        .into_par_iter()
        .map(|start| {
            let end = (start + TASK_PIXELS).min(count);
            let pixels = (start..end).map(|i| tracer.pixel(camera, i, seed)).collect();
            progress((end - start) as u64).then_some(pixels)
        })
        .collect();
    let Some(tasks) = tasks else { return Ok(None) };
    let channels =
        settings.wavelength_nm.map_or(Channels::Rgb, |wavelength_nm| Channels::Mono { wavelength_nm });
    let truth = truth(scene, camera, settings.wavelength_nm);
    Frame::from_pixels(camera.width, camera.height, channels, &tasks.concat(), truth).map(Some)
}

impl PathTracer<'_> {
    /// All samples of pixel `i` (row-major).
    #[must_use]
    pub fn pixel(&self, camera: &Camera, i: usize, seed: u64) -> PixelFilm {
        let (x, y) = (i % camera.width as usize, i / camera.width as usize);
        let mut film = PixelFilm::default();
        for sample in 0..self.settings.samples {
            // The first four dimensions are stratified over the pixel's samples, the rest a plain random stream.
            let first = stratified(seed, i as u64, sample);
            let mut rng = PathRng::new(seed, i as u64, sample);
            let [dx, dy] = first.pixel.map(f64::from);
            let ray = camera.ray(x as f64 + dx, y as f64 + dy);
            let wavelengths = match self.settings.wavelength_nm {
                Some(nm) => Wavelengths::monochromatic(nm),
                None => self.observer.sample_wavelengths(first.wavelength),
            };
            let seen = self.radiance(ray, &wavelengths, first.flight, &mut rng);
            if self.settings.wavelength_nm.is_some() {
                let (value, airlight) = (seen.radiance[0], seen.airlight);
                let glow = seen.glow[0];
                film.add_mono(if airlight { 0.0 } else { value }, if airlight { value + glow } else { glow });
                continue;
            }
            let response = self.observer.lane_response(&wavelengths);
            let (mut rgb, mut glow) = ([0.0; 3], [0.0; 3]);
            for lane in 0..LANES {
                for c in 0..3 {
                    rgb[c] += seen.radiance[lane] * response[lane][c];
                    glow[c] += seen.glow[lane] * response[lane][c];
                }
            }
            let (direct, airlight) =
                if seen.airlight { ([0.0; 3], [0, 1, 2].map(|c| rgb[c] + glow[c])) } else { (rgb, glow) };
            film.add(direct, airlight);
        }
        film
    }
}
