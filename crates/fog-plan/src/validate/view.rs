//! Checks of `sensor`, `render` and `outputs`.

use super::{Check, lens::Geometry};
use crate::{
    frame::{Allocate, Approximation, Output, RenderSpec, SensorSpec, StopSpec},
    lens::ShutterSpec,
    ranges,
    schema::{
        AllocateFile, ApproximationFile, OutputFile, Outputs, RenderFile, SensorFile, ShareFile, ShutterFile,
    },
    share::Share,
};

/// `render.max_samples` where it is not given.
pub(crate) const DEFAULT_MAX_SAMPLES: u32 = 8192;
/// Fewest samples of a pixel that its noise is judged by.
const MIN_NOISE_SAMPLES: u32 = 16;

impl Check<'_> {
    pub(super) fn sensor(&mut self, sensor: &SensorFile) -> Option<SensorSpec> {
        let width = self.whole("sensor.width_px", sensor.width_px, ranges::IMAGE_PX);
        let height = self.whole("sensor.height_px", sensor.height_px, ranges::IMAGE_PX);
        let geometry = self.geometry(sensor, [width, height]);
        let exposure = self.exposure(&sensor.exposure);
        let model = self.sensor_model(sensor.model.as_ref(), exposure.as_ref());
        let Geometry { horizontal_fov_deg, intrinsics, lens, projection } = geometry?;
        Some(SensorSpec {
            width_px: width?,
            height_px: height?,
            horizontal_fov_deg,
            intrinsics,
            lens,
            projection,
            shutter: match sensor.shutter {
                Some(ShutterFile::Rolling(rolling)) => {
                    Some(ShutterSpec::Rolling { readout_s: rolling.readout_s.unwrap_or_default() })
                }
                _ => None,
            },
            exposure: exposure?,
            model: model?,
        })
    }

    pub(super) fn render(&mut self, render: &RenderFile) -> Option<RenderSpec> {
        let samples = self.whole("render.samples", render.samples, ranges::SAMPLES);
        let depth = match render.max_depth {
            None => Some(None),
            Some(depth) => self.whole("render.max_depth", depth, ranges::MAX_DEPTH).map(Some),
        };
        let wavelength = self.optional("render.wavelength_nm", render.wavelength_nm, ranges::WAVELENGTH_NM);
        let stop = self.stop(render, samples);
        let allocate = self.allocate(render);
        let share = render.share.map(|share| match share {
            ShareFile::Lights => Share::Lights,
            ShareFile::Fog => Share::Fog,
        });
        let approximation =
            render.approximation.map(|ApproximationFile::Similarity| Approximation::Similarity);
        if approximation.is_some() && share == Some(Share::Fog) {
            self.problem(
                "render.approximation",
                "paths that several fogs share (render.share: fog) know none",
            );
            return None;
        }
        Some(RenderSpec {
            approximation,
            samples: samples?,
            stop: stop?,
            allocate: allocate?,
            max_depth: depth?,
            wavelength_nm: wavelength?,
            share,
        })
    }

    /// How samples are shared out; the outer option is the check's success.
    fn allocate(&mut self, render: &RenderFile) -> Option<Option<Allocate>> {
        if render.allocate != Some(AllocateFile::RelativeError) {
            return Some(None);
        }
        if render.noise.is_some() {
            let message = "render.noise already says which pixels get more samples: leave one of the two out";
            self.problem("render.allocate", message);
            return None;
        }
        Some(Some(Allocate::RelativeError))
    }

    /// Until when pixels are sampled; the outer option is the check's success.
    fn stop(&mut self, render: &RenderFile, samples: Option<u32>) -> Option<Option<StopSpec>> {
        let Some(noise) = render.noise else {
            if render.max_samples.is_some() && !self.reported("render.noise") {
                let message =
                    "belongs to render.noise, which is absent; without it render.samples is the number";
                self.problem("render.max_samples", message);
                return None;
            }
            return Some(None);
        };
        let noise = self.range("render.noise", noise, ranges::NOISE);
        let max = match render.max_samples {
            Some(max) => self.whole("render.max_samples", max, ranges::SAMPLES),
            None => Some(samples?.max(DEFAULT_MAX_SAMPLES)),
        };
        let (samples, max_samples) = (samples?, max?);
        if samples < MIN_NOISE_SAMPLES {
            let message = format!(
                "{samples} are too few to tell the noise from; with render.noise at least {MIN_NOISE_SAMPLES}"
            );
            self.problem("render.samples", message);
            return None;
        }
        if max_samples < samples {
            let message = format!("{max_samples} is less than render.samples, which is {samples}");
            self.problem("render.max_samples", message);
            return None;
        }
        Some(Some(StopSpec { noise: noise?, max_samples }))
    }

    pub(super) fn outputs(&mut self, outputs: &Outputs, on_path: bool) -> Option<Vec<Output>> {
        if outputs.0.is_empty() {
            self.problem("outputs", "empty; name at least one output");
            return None;
        }
        let mut fine = true;
        for (index, output) in outputs.0.iter().enumerate() {
            if outputs.0[..index].contains(output) {
                self.problem(&format!("outputs.{index}"), "named twice");
                fine = false;
            }
        }
        let index = outputs.0.iter().position(|output| *output == OutputFile::Denoised);
        if let Some(index) = index.filter(|_| !outputs.0.contains(&OutputFile::Hdr)) {
            let message = "denoised is a guess from the output `hdr`, which is kept beside it: name hdr too";
            self.problem(&format!("outputs.{index}"), message);
            fine = false;
        }
        let index = outputs.0.iter().position(|output| *output == OutputFile::Flow);
        if let Some(index) = index.filter(|_| !on_path) {
            let message = "flow is the motion to the next pose of a path: give `path`";
            self.problem(&format!("outputs.{index}"), message);
            fine = false;
        }
        let mut sorted: Vec<Output> = outputs.0.iter().map(|output| domain(*output)).collect();
        sorted.sort_unstable();
        fine.then_some(sorted)
    }
}

fn domain(output: OutputFile) -> Output {
    match output {
        OutputFile::Image => Output::Image,
        OutputFile::Hdr => Output::Hdr,
        OutputFile::Depth => Output::Depth,
        OutputFile::Distance => Output::Distance,
        OutputFile::Transmittance => Output::Transmittance,
        OutputFile::Tau => Output::Tau,
        OutputFile::Direct => Output::Direct,
        OutputFile::Airlight => Output::Airlight,
        OutputFile::StandardError => Output::StandardError,
        OutputFile::Samples => Output::Samples,
        OutputFile::Denoised => Output::Denoised,
        OutputFile::Normals => Output::Normals,
        OutputFile::Position => Output::Position,
        OutputFile::Albedo => Output::Albedo,
        OutputFile::Semantic => Output::Semantic,
        OutputFile::Instance => Output::Instance,
        OutputFile::Flow => Output::Flow,
        OutputFile::Objects => Output::Objects,
        OutputFile::Raw => Output::Raw,
        OutputFile::Pair => Output::Pair,
    }
}
