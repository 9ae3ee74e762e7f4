//! The tile scheduler: pixels in parallel, each a function of (scene, camera, settings, seed) alone.

use crate::budget::{means, pilot, share_out, spread};
use crate::groups::GroupLight;
use crate::path::{PathRadiance, PathTracer};
use crate::rounds::{Round, next_round};
use crate::seen_lamps::seen_lamps;
use crate::settings::{Settings, Stop};
use crate::truth::truth;
use fog_core::colour::{Observer, Rgb};
use fog_core::random::{PathRng, stratified};
use fog_core::spectrum::{LANES, Spectrum, Wavelengths};
use fog_film::{Channels, Films, Frame, FrameError, PixelFilm};
use fog_scene::camera::{Camera, Ray};
use fog_scene::scene::Scene;
use rayon::prelude::*;
use std::ops::Range;

/// Pixels that one task renders at most: enough to hide scheduling, few enough to balance two cores to the end of a small
/// frame.
const TASK_PIXELS: usize = 64;
/// Paths that a task traces at most if it has more than one pixel.
const TASK_PATHS: u64 = 16_384;

/// How far a rendering is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// So many more paths were traced.
    Traced(u64),
    /// So many paths are probably still to be traced; heard after each round where sampling goes by noise.
    Left(u64),
}

/// Renders a frame on the current rayon pool. `progress` hears of the work, from any thread; returning `false` asks to
/// stop, which gives `Ok(None)`.
///
/// # Errors
/// If a pixel's radiance is not finite.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    observer: &Observer,
    settings: &Settings,
    seed: u64,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Result<Option<Frame>, FrameError> {
    let tracer = PathTracer::new(scene, observer, *settings);
    let count = camera.width as usize * camera.height as usize;
    let groups = group_names(scene);
    let mut films = [Films::new(count, groups.len() + usize::from(tracer.has_sensor()))];
    let pixel = |i, samples, films: &mut [Films], k| {
        let (film, groups) = films[0].pixel(k);
        tracer.pixel((camera, i), seed, samples, film, groups);
    };
    if fill(&mut films, camera.width as usize, settings, &pixel, progress).is_none() {
        return Ok(None);
    }
    let [films] = films;
    let truth = truth(scene, camera, settings.wavelength_nm);
    let frame = Frame::from_pixels(camera.width, camera.height, channels(settings), &films.pixels, truth)?;
    let lamps = seen_lamps(scene, camera, observer, settings.wavelength_nm);
    frame.with_groups(groups, &films)?.with_sensor(&films)?.with_points(&lamps).map(Some)
}

/// What the channels of the frames mean.
pub(crate) fn channels(settings: &Settings) -> Channels {
    settings.wavelength_nm.map_or(Channels::Rgb, |wavelength_nm| Channels::Mono { wavelength_nm })
}

/// Names of a scene's light groups; none where lights are not told apart.
pub(crate) fn group_names(scene: &Scene) -> Vec<String> {
    scene.light_groups().map_or_else(Vec::new, |g| g.names().map(str::to_owned).collect())
}

/// Samples the films of one frame or several, all pixels in rounds. `pixel` adds the samples of a range to those of a pixel of
/// the frame, which are at a place of each of the films that it gets. `None` if `progress` asked to stop.
pub(crate) fn fill<P>(
    films: &mut [Films],
    width: usize,
    settings: &Settings,
    pixel: &P,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Option<()>
where
    P: Fn(usize, Range<u64>, &mut [Films], usize) + Sync,
{
    let (count, frames) = (films[0].pixels.len(), films.len() as u64);
    let samples = settings.samples;
    if let Some(half) = pilot(samples).filter(|_| settings.stop == Some(Stop::Budget)) {
        trace(films, &Round::of_all(count, 0, half), pixel, progress)?;
        let first: Vec<_> = films.iter().map(|films| means(&films.pixels)).collect();
        trace(films, &Round::of_all(count, half, 2 * half), pixel, progress)?;
        // Frames that share paths share what each of them wants.
        let mut wanted = vec![0.0; count];
        for (first, films) in first.iter().zip(films.iter()) {
            for (sum, wants) in wanted.iter_mut().zip(spread(first, &films.pixels, width)) {
                *sum += wants;
            }
        }
        let round = share_out(&wanted, samples, 2 * half);
        progress(Work::Left(round.expected * frames));
        return trace(films, &round, pixel, progress);
    }
    let mut round = Round::of_all(count, 0, samples);
    while !round.pixels.is_empty() {
        trace(films, &round, pixel, progress)?;
        let Some(Stop::Noise(target)) = &settings.stop else { break };
        let next = films.iter().map(|films| next_round(&films.pixels, width, target));
        round = next.reduce(Round::union).unwrap_or_default();
        progress(Work::Left(round.expected * frames));
    }
    Some(())
}

/// Traces the samples of a round.
fn trace<P>(
    films: &mut [Films],
    round: &Round,
    pixel: &P,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Option<()>
where
    P: Fn(usize, Range<u64>, &mut [Films], usize) + Sync,
{
    let most = round.pixels.iter().map(|&(i, until)| until - films[0].pixels[i].samples()).max().unwrap_or(0);
    let size = (TASK_PATHS / (most.max(1) * films.len() as u64)).clamp(1, TASK_PIXELS as u64) as usize;
    let before: &[Films] = films;
    let done: Option<Vec<Vec<Films>>> = round
        .pixels
        .par_chunks(size)
        .map(|task| {
            let select = |films: &Films| films.select(task.iter().map(|&(i, _)| i));
            let mut part: Vec<Films> = before.iter().map(select).collect();
            let mut samples = 0;
            for (k, &(i, until)) in task.iter().enumerate() {
                let range = part[0].pixels[k].samples()..until;
                samples += until - range.start;
                pixel(i, range, &mut part, k);
            }
            progress(Work::Traced(samples * part.len() as u64)).then_some(part)
        })
        .collect();
    for (task, parts) in round.pixels.chunks(size).zip(done?) {
        for (films, part) in films.iter_mut().zip(&parts) {
            films.replace(task.iter().map(|&(i, _)| i), part);
        }
    }
    Some(())
}

/// One path as the film gets it: linear sRGB, or for a single wavelength its radiance in channel 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Light that came straight.
    pub direct: Rgb,
    /// Light that the fog scattered first.
    pub airlight: Rgb,
}

impl Sample {
    /// What the film gets where the lens sees nothing.
    pub(crate) const BLACK: Self = Self { direct: [0.0; 3], airlight: [0.0; 3] };

    /// Both together.
    #[must_use]
    pub fn value(&self) -> Rgb {
        sum(self.direct, self.airlight)
    }
}

/// The beginning of one path: all that is drawn before it flies.
pub(crate) struct Start {
    /// In pixels from the upper left corner of the frame.
    pub(crate) image_point: [f64; 2],
    pub(crate) ray: Ray,
    pub(crate) wavelengths: Wavelengths,
    /// Decides the first flight.
    pub(crate) flight: f32,
    pub(crate) rng: PathRng,
}

impl PathTracer<'_> {
    /// Adds samples of pixel `i` (row-major) to its film and to the sums of its light groups, in order. The last sum is that of
    /// the sensor's channels if there is a sensor.
    fn pixel(
        &self,
        (camera, i): (&Camera, usize),
        seed: u64,
        samples: Range<u64>,
        film: &mut PixelFilm,
        groups: &mut [[f64; 3]],
    ) {
        let (groups, sensor) = groups.split_at_mut(groups.len() - usize::from(self.has_sensor()));
        let mut light = GroupLight::new(self.scene, groups.len(), 1);
        for sample in samples {
            let Sample { direct, airlight } = if groups.is_empty() && sensor.is_empty() {
                self.sample(camera, i, seed, sample)
            } else if let Some(mut start) = self.start(camera, i, seed, sample) {
                light.clear();
                let seen = if groups.is_empty() {
                    self.radiance(start.ray, &start.wavelengths, start.flight, &mut start.rng)
                } else {
                    self.watched(start.ray, &start.wavelengths, start.flight, &mut start.rng, &mut light)
                };
                if let Some(sum) = sensor.first_mut() {
                    let channels = self.sensor_value(&start.wavelengths, &(seen.radiance + seen.glow));
                    (0..3).for_each(|c| sum[c] += f64::from(channels[c]));
                }
                let response = self.response(&start.wavelengths);
                for (sum, [direct, airlight]) in groups.iter_mut().zip(light.parts()) {
                    let rgb = film_value(response.as_ref(), &(direct + airlight));
                    (0..3).for_each(|c| sum[c] += f64::from(rgb[c]));
                }
                finish(response.as_ref(), seen)
            } else {
                Sample::BLACK
            };
            if self.settings.wavelength_nm.is_some() {
                film.add_mono(direct[0], airlight[0]);
            } else {
                film.add(direct, airlight);
            }
        }
    }

    /// One sample of pixel `i`.
    #[inline]
    #[must_use]
    pub fn sample(&self, camera: &Camera, i: usize, seed: u64, sample: u64) -> Sample {
        let Some(mut start) = self.start(camera, i, seed, sample) else { return Sample::BLACK };
        let seen = self.radiance(start.ray, &start.wavelengths, start.flight, &mut start.rng);
        finish(self.response(&start.wavelengths).as_ref(), seen)
    }

    /// The beginning of one path; none where the lens sees nothing.
    #[inline]
    pub(crate) fn start(&self, camera: &Camera, i: usize, seed: u64, sample: u64) -> Option<Start> {
        let (x, y) = (i % camera.width as usize, i / camera.width as usize);
        // The first seven dimensions are stratified over the pixel's samples, the rest a plain random stream.
        let first = stratified(seed, i as u64, sample, self.branches);
        let [dx, dy] = first.pixel.map(f64::from);
        let image_point = [x as f64 + dx, y as f64 + dy];
        let wavelengths = match self.settings.wavelength_nm {
            Some(nm) => Wavelengths::monochromatic(nm),
            None => self.observer.sample_wavelengths(first.wavelength),
        };
        Some(Start {
            image_point,
            ray: camera.ray(image_point[0], image_point[1])?,
            wavelengths,
            flight: first.flight,
            rng: PathRng::new(seed, i as u64, sample).with_first(first.turns),
        })
    }

    /// Linear sRGB that radiance 1 at each wavelength gives; none where one wavelength is rendered.
    #[inline]
    pub(crate) fn response(&self, wavelengths: &Wavelengths) -> Option<Response> {
        self.settings.wavelength_nm.is_none().then(|| self.observer.lane_response(wavelengths))
    }

    /// Whether a sensor's channels are recorded beside the observer's.
    #[inline]
    pub(crate) fn has_sensor(&self) -> bool {
        self.settings.wavelength_nm.is_none() && self.observer.sensor().is_some()
    }

    /// What the sensor's channels get of a radiance; 0 without one.
    #[inline]
    pub(crate) fn sensor_value(&self, wavelengths: &Wavelengths, radiance: &Spectrum) -> Rgb {
        let Some(sensor) = self.observer.sensor() else { return [0.0; 3] };
        film_value(Some(&sensor.lane_response(wavelengths)), radiance)
    }
}

/// Colours of radiance 1 at each wavelength of a path.
pub(crate) type Response = [[f32; 3]; LANES];

/// The colour of what a path saw.
#[inline]
pub(crate) fn finish(response: Option<&Response>, seen: PathRadiance) -> Sample {
    let (found, glow) = (film_value(response, &seen.radiance), film_value(response, &seen.glow));
    if seen.airlight {
        Sample { direct: [0.0; 3], airlight: sum(found, glow) }
    } else {
        Sample { direct: found, airlight: glow }
    }
}

/// A radiance as the film gets it.
#[inline]
pub(crate) fn film_value(response: Option<&Response>, radiance: &Spectrum) -> Rgb {
    let Some(response) = response else { return [radiance[0], 0.0, 0.0] };
    let mut rgb = [0.0; 3];
    for lane in 0..LANES {
        for c in 0..3 {
            rgb[c] += radiance[lane] * response[lane][c];
        }
    }
    rgb
}

fn sum(a: Rgb, b: Rgb) -> Rgb {
    [0, 1, 2].map(|c| a[c] + b[c])
}
