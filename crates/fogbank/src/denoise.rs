//! The denoised picture of a frame: a guess, beside the radiance that it was guessed from.

use crate::error::Error;
use fog_core::colour::{Observer, Rgb};
use fog_dataset::DenoisedPicture;
use fog_denoise::{Denoiser, Images};
use fog_film::{Channels, Frame};
use fog_plan::{FrameSpec, Output};
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;
use fog_tracer::features::features;
use fog_tracer::seen_lamps::seen_lamps;
use serde_json::{Value, json};
use std::path::Path;

/// Whether a frame's outputs ask for it.
pub(crate) fn is_wanted(spec: &FrameSpec) -> bool {
    spec.outputs.contains(&Output::Denoised)
}

/// Loads the library from a file or folder, or from where the system looks for libraries.
pub(crate) fn load(path: Option<&Path>) -> Result<Denoiser, String> {
    Denoiser::load(path).map_err(|e| {
        format!(
            "the output `denoised` needs Open Image Denoise, version 2: {e}; install it (a package of your system, or \
             `pip install pyoidn`, whose folder pyoidn/oidn/lib has it) and name the library or its folder with \
             --oidn PATH or the environment variable FOGBANK_OIDN"
        )
    })
}

/// Guesses the picture without its noise, on the threads of the current rayon pool.
pub(crate) fn denoised(
    scene: &Scene,
    camera: &Camera,
    frame: &Frame,
    (denoiser, observer): (&Denoiser, &Observer),
) -> Result<DenoisedPicture, Error> {
    let guides = features(scene, camera);
    let mut radiance: Vec<Rgb> = (0..frame.pixel_count()).map(|i| shown(frame, i)).collect();
    // Lamps have no noise, and single bright pixels are what a denoiser takes for it.
    let lamps = lamps(scene, camera, frame, observer);
    for (pixel, light) in &lamps {
        (0..3).for_each(|c| radiance[*pixel][c] = (radiance[*pixel][c] - light[c]).max(0.0));
    }
    let images = Images {
        width: frame.width,
        height: frame.height,
        radiance: &radiance,
        albedo: &guides.albedo,
        normal: &guides.normal,
    };
    let mut rgb =
        denoiser.denoise(&images, rayon::current_num_threads()).map_err(|e| Error::Denoise(e.to_string()))?;
    for (pixel, light) in &lamps {
        (0..3).for_each(|c| rgb[*pixel][c] += light[c]);
    }
    let details = json!({
        "is": "an estimate of the noise-free radiance by a neural network; no measurement",
        "library": "Open Image Denoise",
        "library_version": denoiser.version(),
        "filter": "RT, hdr, cleanAux, on the processor",
        "made_from": "R, G, B (or Y) of the frame's .hdr.exr; albedo and normals of first hits, means over 16 rays of each \
                      pixel, faded by the transmittance of the fog",
        "reproducible": "with the same library on the same kind of processor, for any number of threads",
    });
    Ok(DenoisedPicture { rgb, details })
}

/// Light of lamps in the frame's pixels, as a colour.
fn lamps(scene: &Scene, camera: &Camera, frame: &Frame, observer: &Observer) -> Vec<(usize, Rgb)> {
    let wavelength_nm = match frame.channels {
        Channels::Rgb => None,
        Channels::Mono { wavelength_nm } => Some(wavelength_nm),
    };
    let lamps = seen_lamps(scene, camera, observer, wavelength_nm);
    let colour = |rgb: Rgb| if wavelength_nm.is_some() { [rgb[0]; 3] } else { rgb };
    lamps.into_iter().map(|light| (light.pixel, colour(light.radiance))).collect()
}

/// Radiance of a pixel as a colour.
fn shown(frame: &Frame, i: usize) -> Rgb {
    match frame.channels {
        Channels::Rgb => frame.image(i),
        Channels::Mono { .. } => [frame.image(i)[0]; 3],
    }
}

/// What a frame's record says of it.
pub(crate) fn record_json(id: &str) -> Value {
    json!({
        "is": "an estimate: image, hdr, truth, noise and comparisons are of the radiance that was rendered, which is kept",
        "files": [format!("{id}.denoised.exr"), format!("{id}.denoised.png")],
        "library_and_hashes": format!("{id}.denoised.json"),
        "reproducible": "not promised: depends on the library's version and on the processor",
    })
}
