//! The sensor of a frame: what its pixels see of each wavelength, and its pictures.

use crate::error::Error;
use crate::exposure::photographic;
use crate::resources::Resources;
use fog_core::colour::{Observer, Rgb};
use fog_core::sensor_response::SensorResponse;
use fog_dataset::CameraPicture;
use fog_film::{Frame, srgb8};
use fog_plan::{BayerSpec, FrameSpec, PsfSpec, ResponseSpec, SensorModelSpec, VignettingSpec};
use fog_scene::camera::Camera;
use fog_sensor::bayer::Bayer;
use fog_sensor::curves::Curves;
use fog_sensor::develop::{Colour, develop};
use fog_sensor::exposure::SATURATION_LX_S;
use fog_sensor::psf::{self, Kernel};
use fog_sensor::raw::{FixedPattern, Sensor};
use fog_sensor::vignetting::Vignetting;
use fog_tracer::truth::TRANSMITTANCE_NM;
use serde_json::{Value, json};
use std::borrow::Cow;

/// What the pixels of a frame's sensor see; none where it has no sensor, or one that sees what `hdr` is.
///
/// # Errors
/// If its curves cannot be had.
fn response(spec: &FrameSpec, resources: &Resources) -> Result<Option<SensorResponse>, Error> {
    let Some(model) = &spec.sensor.model else { return Ok(None) };
    let curves = match &model.response {
        ResponseSpec::Cie => return Ok(None),
        ResponseSpec::NikonD5100 => Curves::nikon_d5100().map_err(|e| Error::Sensor(e.to_string()))?,
        ResponseSpec::File(file) => {
            let named = |e: String| Error::Sensor(format!("sensor.model.response: {e}"));
            let text = resources.files().text(file).map_err(|e| named(e.to_string()))?;
            Curves::parse(text).map_err(|e| named(format!("{}: {e}", file.display())))?
        }
    };
    let named = |e| Error::Sensor(format!("sensor.model.response: {e}"));
    curves.response(&resources.observer, model.quantum_efficiency).map(Some).map_err(named)
}

/// The observer of a frame, with its sensor beside it.
///
/// # Errors
/// As [`response`].
pub(crate) fn observer<'r>(spec: &FrameSpec, resources: &'r Resources) -> Result<Cow<'r, Observer>, Error> {
    Ok(match response(spec, resources)? {
        Some(sensor) => Cow::Owned(resources.observer.clone().with_sensor(sensor)),
        None => Cow::Borrowed(&resources.observer),
    })
}

/// A frame's sensor with its lens, at an exposure.
pub(crate) struct Chain<'a> {
    spec: &'a FrameSpec,
    model: &'a SensorModelSpec,
    camera: &'a Camera,
    exposure: f64,
    sensor: Sensor,
    colour: Colour,
    /// ISO speed at which a full well saturates the converter.
    base_iso: f64,
}

impl<'a> Chain<'a> {
    /// The chain of a frame that has a sensor; `observer` is the frame's ([`observer`]).
    pub(crate) fn new(
        spec: &'a FrameSpec,
        camera: &'a Camera,
        exposure: f64,
        observer: &Observer,
    ) -> Option<Self> {
        let model = spec.sensor.model.as_ref()?;
        let per_area = match observer.sensor() {
            Some(response) => response.electrons_per_lx_s_m2(),
            None => model.quantum_efficiency * observer.photopic_photons_per_lx_s(),
        };
        let electrons_per_lx_s = per_area * (model.pixel_um * 1e-6).powi(2);
        let base_iso = SATURATION_LX_S * electrons_per_lx_s / model.full_well_e;
        let (saturation_e, shutter_s) = match photographic(spec) {
            Some(p) => (SATURATION_LX_S / p.iso * electrons_per_lx_s, p.shutter_s),
            None => (model.full_well_e / model.gain.unwrap_or(1.0), model.shutter_s.unwrap_or(0.0)),
        };
        let sensor = Sensor {
            bayer: bayer(model.bayer),
            adc_bits: model.adc_bits,
            black_level: u16::try_from(model.black_level).unwrap_or(0),
            full_well_e: model.full_well_e,
            saturation_e,
            dark_e: model.dark_current_e_s * shutter_s,
            read_noise_e: model.read_noise_e,
            photon_noise: model.photon_noise,
            pattern: FixedPattern {
                prnu: model.prnu_1288,
                dsnu_e: model.dsnu_1288_e,
                seed: model.pattern_seed.unwrap_or(0),
            },
        };
        let colour = observer.sensor().and_then(|r| colour(r, observer)).unwrap_or(Colour::SRGB);
        Some(Self { spec, model, camera, exposure, sensor, colour, base_iso })
    }

    /// The raw picture of a frame of this view and its development; `stream` tells pictures of one frame apart.
    pub(crate) fn pictures(&self, frame: &Frame, stream: u64) -> CameraPicture {
        let (width, height) = (frame.width as usize, frame.height as usize);
        let light = self.light(frame);
        let seed = self.model.noise_seed.unwrap_or(self.spec.seed).wrapping_add(stream);
        let raw = self.sensor.expose(&light, width, height, seed);
        let linear = develop(&raw, width, height, &self.sensor, &self.colour);
        CameraPicture { srgb8: linear.iter().flat_map(|rgb| rgb.map(srgb8)).collect(), raw }
    }

    /// What falls on the pixels, in units of what saturates green ones.
    fn light(&self, frame: &Frame) -> Vec<Rgb> {
        let law = match self.model.vignetting {
            VignettingSpec::None => Vignetting::Even,
            VignettingSpec::Cos4 => Vignetting::Cos4,
            VignettingSpec::Polynomial(coefficients) => Vignetting::Polynomial(coefficients),
        };
        let size = (f64::from(frame.width), f64::from(frame.height));
        let seen = |i: usize| {
            let at =
                (f64::from(i as u32 % frame.width) + 0.5, f64::from((i / frame.width as usize) as u32) + 0.5);
            let ray = self.camera.ray(at.0, at.1);
            let cosine = ray.map_or(0.0, |ray| f64::from(ray.direction.dot(self.camera.pose.forward)));
            let factor = (self.exposure * law.share(cosine, at, size)) as f32;
            frame.sensor.get(i).copied().unwrap_or_else(|| frame.image(i)).map(|v| v * factor)
        };
        let light: Vec<Rgb> = (0..frame.pixel_count()).map(seen).collect();
        let kernels = match self.model.psf {
            PsfSpec::None => return light,
            PsfSpec::GaussianPx(sigma) => [0; 3].map(|_| Kernel::gaussian(sigma)),
            PsfSpec::AiryFNumber(n) => {
                TRANSMITTANCE_NM.map(|nm| Kernel::airy(nm * 1e-3, n, self.model.pixel_um))
            }
        };
        psf::spread(&light, frame.width as usize, frame.height as usize, &kernels)
    }

    /// Writes what reading the raw picture takes into the record of the frame.
    pub(crate) fn write(&self, frame: &Frame, resources: &Resources, record: &mut Value) {
        let (sensor, colour) = (&self.sensor, &self.colour);
        let out = &mut record["sensor"];
        let [render, noise] = self.noise_e(frame);
        out["raw"] = json!({
            "pattern": sensor.bayer.name(),
            "opencv_code": sensor.bayer.opencv_code(),
            "black_level": sensor.black_level,
            "white_level": sensor.white_level(),
            "gain_dn_per_e": sensor.numbers_per_electron(),
            "saturation_e": sensor.saturation_e,
            "iso": photographic(self.spec).map_or(self.base_iso * self.model.gain.unwrap_or(1.0), |p| p.iso),
            "base_iso": self.base_iso,
            "dark_e": sensor.dark_e,
            "white_balance": colour.white_balance,
            "srgb_from_balanced": colour.matrix,
            "noise": {
                "sensor_rms_e": noise,
                "render_rms_e": render,
                "definition": "root mean squares over green pixels: of the sensor's noise, and of the rendering's, which is in the \
                               picture too",
            },
        });
        if let Some(file) = self.model.response_file() {
            let hashes = resources.files().hashes([file]);
            out["raw"]["response_blake3"] = json!(hashes.values().next());
        }
        out["encoding"] = json!(
            "sRGB of the developed raw picture: levels, demosaicing by Malvar, He & Cutler 2004, white balance, matrix; clipped \
             to [0, 1]"
        );
    }

    /// Root mean squares over the picture, in electrons of a green pixel: noise of the rendering, noise of the sensor.
    fn noise_e(&self, frame: &Frame) -> [f64; 2] {
        let of_one = self.exposure * self.sensor.saturation_e;
        let (mut render, mut sensor) = (0.0, 0.0);
        for i in 0..frame.pixel_count() {
            render += (f64::from(frame.standard_error[i]) * of_one).powi(2);
            let green = frame.sensor.get(i).map_or_else(|| frame.image(i)[1], |channels| channels[1]);
            let electrons =
                (f64::from(green).max(0.0) * of_one + self.sensor.dark_e).min(self.sensor.full_well_e);
            let shot = if self.sensor.photon_noise { electrons } else { 0.0 };
            sensor += shot + self.sensor.read_noise_e.powi(2);
        }
        let n = frame.pixel_count().max(1) as f64;
        [(render / n).sqrt(), (sensor / n).sqrt()]
    }
}

fn bayer(bayer: BayerSpec) -> Bayer {
    match bayer {
        BayerSpec::Rggb => Bayer::Rggb,
        BayerSpec::Bggr => Bayer::Bggr,
        BayerSpec::Grbg => Bayer::Grbg,
        BayerSpec::Gbrg => Bayer::Gbrg,
    }
}

/// White balance for D65, and the matrix behind it.
fn colour(response: &SensorResponse, observer: &Observer) -> Option<Colour> {
    let white = response.channels_of(|_| 1.0);
    let matrix = response.srgb_from_channels(observer)?;
    let balanced = matrix.map(|row| [row[0] * white[0], row[1] * white[1], row[2] * white[2]]);
    Some(Colour { white_balance: white.map(|w| 1.0 / w), matrix: balanced })
}
