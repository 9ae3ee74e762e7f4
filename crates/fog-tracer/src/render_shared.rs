//! Several frames from the same paths: frames that differ in the fog, or in how bright the groups of lights are.

use crate::groups::GroupLight;
use crate::path::PathTracer;
use crate::render::{Work, channels, fill, film_value, group_names};
use crate::seen_lamps::seen_lamps;
use crate::settings::Settings;
use crate::shared::SharedTracer;
use crate::truth::truth;
use fog_core::colour::Observer;
use fog_core::random::mix64;
use fog_film::{Films, Frame, FrameError};
use fog_scene::camera::Camera;
use fog_scene::medium::Medium;
use fog_scene::scene::Scene;
use std::ops::Range;

pub use crate::shared::MAX_FOGS;

/// One of the frames that share paths.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// Index of its fog.
    pub fog: usize,
    /// Factor on the light of each group of the scene ([`fog_scene::light_groups::LightGroups::names`]); empty: 1 for all.
    pub factors: Vec<f32>,
}

/// Renders frames that share paths, on the current rayon pool. Each sample of a pixel takes one path of each fog, and counts in
/// all frames. `media` are the fogs, [`MAX_FOGS`] at most; with one or none, the fog is that of the scene.
///
/// `progress` hears of samples times frames; returning `false` asks to stop, which gives `None`. A frame with a radiance that is
/// not finite is an error of this frame alone.
pub fn render_shared(
    scene: &Scene,
    media: &[Medium],
    variants: &[Variant],
    (camera, observer): (&Camera, &Observer),
    settings: &Settings,
    seed: u64,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Option<Vec<Result<Frame, FrameError>>> {
    // Paths that several fogs share go by those, not by the scene's.
    let bare = (media.len() > 1).then(|| scene.without_fog());
    let base = PathTracer::new(bare.as_ref().unwrap_or(scene), observer, *settings);
    let names = group_names(scene);
    let pass = Pass {
        tracer: SharedTracer::new(base, media),
        variants,
        camera,
        seed,
        group_count: names.len().max(1),
    };
    let count = camera.width as usize * camera.height as usize;
    let sums = names.len() + usize::from(pass.tracer.base.has_sensor());
    let mut films = vec![Films::new(count, sums); variants.len()];
    let pixel = |i, samples, films: &mut [Films], k| pass.pixel(i, samples, films, k);
    fill(&mut films, camera.width as usize, settings, &pixel, progress)?;
    let lamps = |scene: &Scene, variant: &Variant| {
        let mut lamps = seen_lamps(scene, camera, observer, settings.wavelength_nm);
        for light in &mut lamps {
            let factor = variant.factors.get(light.group).copied().unwrap_or(1.0);
            light.radiance = light.radiance.map(|c| c * factor);
            light.sensor = light.sensor.map(|c| c * factor);
        }
        lamps
    };
    let frame = |(variant, films): (&Variant, &Films)| {
        let mut scene = scene.clone();
        if let Some(medium) = media.get(variant.fog) {
            scene.medium = Some(medium.clone());
        }
        let truth = truth(&scene, camera, settings.wavelength_nm);
        let (width, height) = (camera.width, camera.height);
        Frame::from_pixels(width, height, channels(settings), &films.pixels, truth)?
            .with_groups(names.clone(), films)?
            .with_sensor(films)?
            .with_points(&lamps(&scene, variant))
    };
    Some(variants.iter().zip(&films).map(frame).collect())
}

struct Pass<'a> {
    tracer: SharedTracer<'a>,
    variants: &'a [Variant],
    camera: &'a Camera,
    seed: u64,
    /// One where lights are in no groups.
    group_count: usize,
}

impl Pass<'_> {
    /// Adds samples of pixel `i` (row-major) to its films, which are number `k` of each frame's.
    fn pixel(&self, i: usize, samples: Range<u64>, films: &mut [Films], k: usize) {
        let (base, fogs) = (&self.tracer.base, self.tracer.fogs().max(1));
        let mut light = GroupLight::new(base.scene, self.group_count, fogs);
        // Direct light and airlight by group and fog, and what a sensor gets of both.
        let mut sums = vec![[[0.0f64; 3]; 3]; self.group_count * fogs];
        for sample in samples {
            sums.fill([[0.0; 3]; 3]);
            for hero in 0..fogs {
                // Paths of each fog are stratified among themselves.
                let seed = if hero == 0 { self.seed } else { mix64(self.seed ^ hero as u64) };
                let Some(mut start) = base.start(self.camera, i, seed, sample) else { continue };
                light.clear();
                let (waves, flight, rng) = (&start.wavelengths, start.flight, &mut start.rng);
                if fogs == 1 {
                    light.airlight = base.watched(start.ray, waves, flight, rng, &mut light).airlight;
                } else {
                    self.tracer.trace(start.ray, waves, (flight, hero), rng, &mut light);
                }
                let response = base.response(waves);
                for (sums, parts) in sums.iter_mut().zip(light.parts()) {
                    for (sum, part) in sums.iter_mut().zip(parts) {
                        let rgb = film_value(response.as_ref(), &part);
                        (0..3).for_each(|c| sum[c] += f64::from(rgb[c]) / fogs as f64);
                    }
                    if base.has_sensor() {
                        let channels = base.sensor_value(waves, &(parts[0] + parts[1]));
                        (0..3).for_each(|c| sums[2][c] += f64::from(channels[c]) / fogs as f64);
                    }
                }
            }
            for (variant, films) in self.variants.iter().zip(films.iter_mut()) {
                self.add(variant, &sums, films, k);
            }
        }
    }

    /// Adds one sample to the film of one frame.
    fn add(&self, variant: &Variant, sums: &[[[f64; 3]; 3]], films: &mut Films, k: usize) {
        let fogs = sums.len() / self.group_count;
        let (film, groups) = films.pixel(k);
        let (groups, sensor) = groups.split_at_mut(groups.len() - usize::from(self.tracer.base.has_sensor()));
        let mut value = [[0.0f64; 3]; 2];
        for g in 0..self.group_count {
            let factor = f64::from(variant.factors.get(g).copied().unwrap_or(1.0));
            let parts = &sums[g * fogs + variant.fog.min(fogs - 1)];
            for c in 0..3 {
                value[0][c] += factor * parts[0][c];
                value[1][c] += factor * parts[1][c];
                if let Some(group) = groups.get_mut(g) {
                    group[c] += factor * (parts[0][c] + parts[1][c]);
                }
                if let Some(sum) = sensor.first_mut() {
                    sum[c] += factor * parts[2][c];
                }
            }
        }
        let [direct, airlight] = value.map(|rgb| rgb.map(|v| v as f32));
        if self.tracer.base.settings.wavelength_nm.is_some() {
            film.add_mono(direct[0], airlight[0]);
        } else {
            film.add(direct, airlight);
        }
    }
}
