//! The tile scheduler: pixels in parallel, each a function of (scene, camera, settings, seed) alone.

use crate::path::{PathRadiance, PathTracer};
use crate::rounds::{Round, next_round};
use crate::settings::Settings;
use crate::truth::truth;
use fog_core::colour::{Observer, Rgb};
use fog_core::random::{PathRng, stratified};
use fog_core::spectrum::{LANES, Wavelengths};
use fog_film::{Channels, Frame, FrameError, PixelFilm};
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
    let mut films = vec![PixelFilm::default(); count];
    let all = (0..count).map(|i| (i, settings.samples)).collect();
    let mut round = Round { pixels: all, expected: settings.samples * count as u64 };
    while !round.pixels.is_empty() {
        if tracer.trace(camera, seed, &round, &mut films, progress).is_none() {
            return Ok(None);
        }
        let Some(stop) = &settings.stop else { break };
        round = next_round(&films, camera.width as usize, stop);
        progress(Work::Left(round.expected));
    }
    let channels =
        settings.wavelength_nm.map_or(Channels::Rgb, |wavelength_nm| Channels::Mono { wavelength_nm });
    let truth = truth(scene, camera, settings.wavelength_nm);
    Frame::from_pixels(camera.width, camera.height, channels, &films, truth).map(Some)
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
    /// Traces the samples of a round; `None` if `progress` asked to stop.
    fn trace(
        &self,
        camera: &Camera,
        seed: u64,
        round: &Round,
        films: &mut [PixelFilm],
        progress: &(dyn Fn(Work) -> bool + Sync),
    ) -> Option<()> {
        let most = round.pixels.iter().map(|&(i, until)| until - films[i].samples()).max().unwrap_or(0);
        let size = (TASK_PATHS / most.max(1)).clamp(1, TASK_PIXELS as u64) as usize;
        let before: &[PixelFilm] = films;
        let done: Option<Vec<Vec<PixelFilm>>> = round
            .pixels
            .par_chunks(size)
            .map(|task| {
                let mut paths = 0;
                let pixel = |&(i, until): &(usize, u64)| {
                    let mut film = before[i];
                    paths += until - film.samples();
                    self.pixel(camera, i, seed, film.samples()..until, &mut film);
                    film
                };
                let pixels = task.iter().map(pixel).collect();
                progress(Work::Traced(paths)).then_some(pixels)
            })
            .collect();
        for (&(i, _), film) in round.pixels.iter().zip(done?.into_iter().flatten()) {
            films[i] = film;
        }
        Some(())
    }

    /// Adds samples of pixel `i` (row-major) to its film, in order.
    fn pixel(&self, camera: &Camera, i: usize, seed: u64, samples: Range<u64>, film: &mut PixelFilm) {
        for sample in samples {
            let Sample { direct, airlight } = self.sample(camera, i, seed, sample);
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
        let mut start = self.start(camera, i, seed, sample);
        let seen = self.radiance(start.ray, &start.wavelengths, start.flight, &mut start.rng);
        self.finish(&start.wavelengths, seen)
    }

    #[inline]
    pub(crate) fn start(&self, camera: &Camera, i: usize, seed: u64, sample: u64) -> Start {
        let (x, y) = (i % camera.width as usize, i / camera.width as usize);
        // The first seven dimensions are stratified over the pixel's samples, the rest a plain random stream.
        let first = stratified(seed, i as u64, sample);
        let [dx, dy] = first.pixel.map(f64::from);
        let image_point = [x as f64 + dx, y as f64 + dy];
        let wavelengths = match self.settings.wavelength_nm {
            Some(nm) => Wavelengths::monochromatic(nm),
            None => self.observer.sample_wavelengths(first.wavelength),
        };
        Start {
            image_point,
            ray: camera.ray(image_point[0], image_point[1]),
            wavelengths,
            flight: first.flight,
            rng: PathRng::new(seed, i as u64, sample).with_first(first.turn, first.second_flight),
        }
    }

    /// The colour of what a path saw.
    #[inline]
    pub(crate) fn finish(&self, wavelengths: &Wavelengths, seen: PathRadiance) -> Sample {
        let (found, glow) = if self.settings.wavelength_nm.is_some() {
            ([seen.radiance[0], 0.0, 0.0], [seen.glow[0], 0.0, 0.0])
        } else {
            let response = self.observer.lane_response(wavelengths);
            let (mut found, mut glow) = ([0.0; 3], [0.0; 3]);
            for lane in 0..LANES {
                for c in 0..3 {
                    found[c] += seen.radiance[lane] * response[lane][c];
                    glow[c] += seen.glow[lane] * response[lane][c];
                }
            }
            (found, glow)
        };
        if seen.airlight {
            Sample { direct: [0.0; 3], airlight: sum(found, glow) }
        } else {
            Sample { direct: found, airlight: glow }
        }
    }
}

fn sum(a: Rgb, b: Rgb) -> Rgb {
    [0, 1, 2].map(|c| a[c] + b[c])
}
