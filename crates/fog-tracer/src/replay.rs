//! One path of a frame once more, with everything that happened to it.

use crate::path::PathTracer;
use crate::render::{Sample, finish};
use crate::seen_lamps::seen_lamps;
use crate::watch::Step;
use fog_core::colour::Rgb;
use fog_core::spectrum::{LANES, Spectrum, Wavelengths};
use fog_scene::camera::{Camera, Ray};

/// A path of the real integrator with the random numbers of the rendering.
#[derive(Clone, Debug)]
pub struct Replay {
    /// Where the path leaves through the image, in pixels from the frame's upper left corner.
    pub image_point: [f64; 2],
    /// The camera ray.
    pub ray: Ray,
    /// Wavelengths; the first is the hero, which decides where the path goes.
    pub wavelengths: Wavelengths,
    /// What happened, in order.
    pub steps: Vec<Step>,
    /// Sum of all that the steps added.
    pub radiance: Spectrum,
    /// Linear sRGB that radiance 1 at each wavelength gives; none in a frame of one wavelength.
    pub response: Option<[[f32; 3]; LANES]>,
    /// What the film gets.
    pub sample: Sample,
    /// Light of lamps that stand in the pixel, which no path finds: the frame has it besides the mean of its paths, in its
    /// direct light.
    pub lamps: Rgb,
}

impl PathTracer<'_> {
    /// Traces sample `sample` of pixel `i` (row-major) of the frame with this seed, as the rendering does, and keeps the
    /// steps. None where the lens sees nothing.
    #[must_use]
    pub fn replay(&self, camera: &Camera, i: usize, seed: u64, sample: u64) -> Option<Replay> {
        let mut start = self.start(camera, i, seed, sample)?;
        let mut steps = Vec::new();
        let seen = self.watched(start.ray, &start.wavelengths, start.flight, &mut start.rng, &mut steps);
        let response = self.response(&start.wavelengths);
        Some(Replay {
            image_point: start.image_point,
            ray: start.ray,
            wavelengths: start.wavelengths,
            steps,
            radiance: seen.radiance + seen.glow,
            response,
            sample: finish(response.as_ref(), seen),
            lamps: self.lamps_in(camera, i),
        })
    }

    /// Light of lamps that stand in pixel `i`.
    fn lamps_in(&self, camera: &Camera, i: usize) -> Rgb {
        let lamps = seen_lamps(self.scene, camera, self.observer, self.settings.wavelength_nm);
        let mut sum = [0.0; 3];
        for light in lamps.iter().filter(|light| light.pixel == i) {
            (0..3).for_each(|c| sum[c] += light.radiance[c]);
        }
        sum
    }
}
